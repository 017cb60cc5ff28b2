#!/bin/sh
# Runs every test, or with --nightly the long ones too. Installs and builds what that needs. Safe to repeat.
set -eu
cd "$(dirname "$0")"
. setup/steps.sh

case "$*" in
    '') chosen=--label-exclude ;;
    --nightly) chosen=--label-regex ;;
    *) lack "usage: $0 [--nightly]" ;;
esac

prepare_build_folder
install_packages picture tests
jobs=$(nproc)

if [ "$chosen" = --label-regex ]; then
    build release
    say "nightly tests"
    exec ctest --test-dir build/release --output-on-failure $chosen nightly
fi

# check NAME COMMAND...: a failure is remembered, so that one run shows all of them.
failed=
check() {
    name=$1
    shift
    say "$name"
    "$@" || failed="$failed${failed:+, }$name"
}

check_format() {
    find engine shaders tools tests fuzz -name '*.h' -o -name '*.cpp' | xargs clang-format-14 --dry-run --Werror
}

run_tests() {
    ctest --test-dir "$1" --output-on-failure --parallel "$jobs" --label-exclude nightly --label-regex "$2"
}

check "format (clang-format-14 -i mends it)" check_format
build asan unit_tests
check "unit tests under sanitizers" run_tests build/asan unit
build fuzz vox_fuzz
check "fuzzing" run_tests build/fuzz fuzz
build release
check "all tests" run_tests build/release .
[ -z "$failed" ] || lack "failed: $failed"

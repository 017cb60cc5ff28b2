#!/bin/sh
# Runs every test; with --nightly, only those that take long. Installs and builds what they need. Safe to repeat.
set -eu
cd "$(dirname "$0")"
. setup/steps.sh

# run_tests BUILD_FOLDER CTEST_OPTION...
run_tests() {
    folder=$1
    shift
    ctest --test-dir "$folder" --no-tests=error --output-on-failure --parallel "$(nproc)" "$@"
}

# The tests that run shaders, and the rates of the march, on the Mesa of Debian's backports.
test_newer_mesa() (
    VK_DRIVER_FILES=$(setup/newer_mesa.sh) || exit 1
    export VK_DRIVER_FILES
    run_tests build/release --label-regex 'pass|probe|stability|analytic' --label-exclude nightly &&
        build/release/voxilux bench march --extent 256,512,1024
)

check_format() {
    find engine shaders voxelizer tools tests fuzz -name '*.h' -o -name '*.cpp' | xargs clang-format-14 --dry-run --Werror
}

# check NAME COMMAND...: a failure is remembered, so that one run shows all of them.
failed=
check() {
    name=$1
    shift
    say "$name"
    "$@" || failed="$failed${failed:+, }$name"
}

case "$*" in
    '' | --nightly) ;;
    *) lack "usage: $0 [--nightly]" ;;
esac
prepare_build_folder
install_packages picture tests

if [ "$*" = --nightly ]; then
    build sanitize unit_tests vox_fuzz mesh_fuzz voxel_formats_fuzz
    check "unit tests under sanitizers" run_tests build/sanitize --label-regex unit --label-exclude nightly
    check "long fuzzing" run_tests build/sanitize --label-regex fuzz-nightly
    build release-python
    check "nightly tests" run_tests build/release --label-regex nightly
    check "newer Mesa" test_newer_mesa
else
    check "format (clang-format-14 -i mends it)" check_format
    build sanitize vox_fuzz mesh_fuzz voxel_formats_fuzz
    check "fuzzing under sanitizers" run_tests build/sanitize --label-regex fuzz --label-exclude nightly
    build release-python
    check "all tests" run_tests build/release --label-exclude nightly
fi
[ -z "$failed" ] || lack "failed: $failed"

# What the two commands of the README share. Sourced by a POSIX shell in the top folder; needs only Debian's base system.

# Space that the steps take at most, MiB.
packages_mib=2000
build_mib=1000

say() { printf '\n== %s\n' "$*"; }

# Says in one line what is lacking, and exits.
lack() {
    printf '%s: %s\n' "$0" "$*" >&2
    exit 1
}

as_root() {
    if [ "$(id -u)" = 0 ]; then "$@"; else sudo "$@"; fi
}

# free_mib FOLDER
free_mib() {
    df -Pm "$1" | { read -r _ && read -r _ _ _ available _ && echo "$available"; }
}

system_name() {
    (. /etc/os-release && echo "$PRETTY_NAME") 2>/dev/null || echo 'an unknown system'
}

# missing_packages USE...: those of packages.txt for these uses that this machine lacks.
missing_packages() {
    while read -r package use _; do
        case " $* " in
            *" $use "*) ;;
            *) continue ;;
        esac
        dpkg-query -W -f '${db:Status-Status}\n' "$package" 2>/dev/null | grep -qx installed || printf '%s ' "$package"
    done < setup/packages.txt
}

# Explains the log of a failed apt-get. The network comes first: without it, lists are missing and packages are unknown.
explain_apt() {
    if grep -qiE "no space left|don't have enough free space" "$1"; then
        lack "the disk is full: the packages take up to $packages_mib MiB; apt-get's log is $1"
    elif grep -qE 'failure resolving|Could not resolve|Could not connect|Unable to connect|Network is unreachable' "$1"; then
        lack "the package servers cannot be reached: is there a network? apt-get's log is $1"
    elif grep -q 'Unable to locate package' "$1"; then
        lack "some packages are unknown here: they are those of Debian 12, this is $(system_name); apt-get's log is $1"
    fi
    tail -n 5 "$1" >&2
    lack "apt-get failed; its log is $1"
}

# install_packages USE...: installs what is missing. Needs neither root nor network when nothing is.
install_packages() {
    command -v dpkg-query > /dev/null && command -v apt-get > /dev/null ||
        lack "no apt-get on this machine ($(system_name)): install what setup/packages.txt names by other means, then 'cmake --preset release && cmake --build --preset release'"
    missing=$(missing_packages "$@")
    [ -n "$missing" ] || return 0
    [ "$(id -u)" = 0 ] || command -v sudo > /dev/null ||
        lack "no sudo and not root; run once as root: apt-get install $missing"
    [ "$(free_mib /usr)" -ge "$packages_mib" ] ||
        lack "$(free_mib /usr) MiB free on the disk of /usr; the packages may take $packages_mib MiB"
    say "installing Debian packages (a few minutes): $missing"
    log=$PWD/build/packages.log
    # A failed update is no error by itself, since the lists may be there. Installing shows whether they are.
    as_root apt-get -q update > "$log" 2>&1 || true
    # shellcheck disable=SC2086
    as_root env DEBIAN_FRONTEND=noninteractive apt-get -q -y -o DPkg::Lock::Timeout=300 \
        install --no-install-recommends $missing < /dev/null >> "$log" 2>&1 || explain_apt "$log"
}

# Refuses early what would fail late: a folder of another user, a full disk.
prepare_build_folder() {
    mkdir -p build out 2>/dev/null && [ -w build ] && [ -w out ] && [ -z "$(find build -maxdepth 2 ! -writable)" ] ||
        lack "cannot write to $PWD/build and $PWD/out: remove them, or run as the user $(stat -c %U .)"
    [ -e build/release ] || [ "$(free_mib build)" -ge "$build_mib" ] ||
        lack "$(free_mib build) MiB free on the disk of $PWD; the builds may take $build_mib MiB"
}

# build PRESET [TARGET...]: configures and builds. Compiler output stays on the terminal.
build() {
    preset=$1
    shift
    say "building $preset"
    cmake --preset "$preset" > "build/$preset.log" 2>&1 || {
        tail -n 20 "build/$preset.log" >&2
        lack "cmake --preset $preset failed; its log is $PWD/build/$preset.log"
    }
    cmake --build --preset "$preset" ${1:+--target "$@"} || lack "the $preset build failed; the compiler's words are above"
}

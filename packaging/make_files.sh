#!/bin/sh
# make_files.sh PROGRAM FOLDER: writes the manual page, the completions and the notices that are installed.
set -eu
program=$1
license=$(dirname "$0")/../LICENSE
mkdir -p "$2"
cd "$2"
"$program" generate man | gzip -9n > voxilux.1.gz
for shell in bash zsh fish; do
    "$program" generate "$shell" > "voxilux.$shell"
done

# Libraries whose code is inside the program; Debian keeps their notices.
inside='libglm-dev libcli11-dev nlohmann-json3-dev libtinygltf-dev libstb-dev libimgui-dev libvulkan-volk-dev libvulkan-dev'
{
    cat "$license"
    printf '\nCode of other projects is inside the program. Their notices follow.\n'
    for package in $inside; do
        notice=/usr/share/doc/$package/copyright
        if [ -e "$notice" ]; then
            printf '\n==== %s\n\n' "$package"
            cat "$notice"
        fi
    done
} > copyright

#!/bin/sh
# Unpacks the Vulkan driver of a newer Mesa (Debian's bookworm-backports) into build/mesa, beside the installed one, and
# prints the file that VK_DRIVER_FILES must name for the Vulkan loader to take it. Installs nothing. Safe to repeat.
set -eu
cd "$(dirname "$0")/.."
folder=$PWD/build/mesa
driver=$folder/unpacked/usr/lib/$(gcc -dumpmachine)/libvulkan_lvp.so
manifest=$folder/lavapipe.json

apt_there() {
    program=$1
    shift
    "$program" -o Dir::Etc::sourcelist="$folder/backports.list" -o Dir::Etc::sourceparts=- \
        -o Dir::State::lists="$folder/lists" -o Dir::Cache="$folder/cache" -o APT::Sandbox::User=root "$@" >&2
}

if [ ! -e "$driver" ]; then
    mkdir -p "$folder/lists/partial" "$folder/cache/archives/partial"
    keys=/usr/share/keyrings/debian-archive-keyring.gpg
    echo "deb [signed-by=$keys] http://deb.debian.org/debian bookworm-backports main" > "$folder/backports.list"
    apt_there apt-get --quiet update
    (cd "$folder" && apt_there apt-get --quiet download mesa-vulkan-drivers)
    dpkg-deb --extract "$folder"/mesa-vulkan-drivers_*.deb "$folder/unpacked"
fi
cat > "$manifest" <<END
{"file_format_version": "1.0.0", "ICD": {"library_path": "$driver", "api_version": "1.3.0"}}
END
echo "$manifest"

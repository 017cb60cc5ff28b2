#!/bin/sh
# Installs what is missing, builds voxilux and renders a first picture. Safe to repeat.
set -eu
cd "$(dirname "$0")"
. setup/steps.sh

prepare_build_folder
install_packages picture
build release voxilux

say "rendering scenes/first_light.toml"
build/release/voxilux render scenes/first_light.toml -o out/first_light.exr -o out/first_light.png

say "the picture is there:"
echo "$PWD/out/first_light.png   to look at"
echo "$PWD/out/first_light.exr   linear light, albedo, normals, depth, ao, sun, error"

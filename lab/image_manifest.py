"""Hashes of the pixels of many small renders, one line each: two builds that print the same lines render the same bits.

    python3 lab/image_manifest.py build/release/voxilux > before.txt
    python3 lab/image_manifest.py build/release/voxilux --data ../shared/data/vox --against before.txt

Hashed are the channel list and the pixels of an EXR, not its other attributes, which hold the report.
"""

import argparse
import hashlib
import pathlib
import struct
import subprocess
import sys
import tempfile

TOP = pathlib.Path(__file__).resolve().parent.parent
SMALL = ["--size", "64x48", "--spp", "4", "--reproducible", "--seed", "7", "-q"]
CELLS = ["--ao", "hash"]
# Flags besides SMALL, by what a scene has.
VARIANTS = {
    "ao": [CELLS, [*CELLS, "-D", "ao.reproject=true"], [*CELLS, "-D", "ao.reproject=true", "-D", "ao.merged=true"],
           [*CELLS, "-D", "ao.merged=false", "-D", "ao.checkerboard=true", "-D", "ao.filter=2"],
           [*CELLS, "-D", "ao.sampling=pixel"], ["-D", "render.sequence=halton"], ["-D", "render.sequence=white"],
           ["--effect", "indirect=on", "--photons", "5000", "--radius", "2"], ["--crop", "10,8,50,40"],
           *(["--traversal", name] for name in ("dda", "brick4", "brick8", "naadf", "deep", "wide"))],
    "photons": [["--radius", "1.5"], ["-D", "photons.scatter=true"], ["-D", "photons.classic=true"],
                ["-D", "photons.roulette=false", "-D", "photons.count=2000"], ["--effect", "indirect=off"],
                ["--effect", "caustics=off"], ["--shard", "2/2"]],
    "frames": [["--frames", "1-3"]],
}
SCENES = {"first_light": "ao", "mixed": "ao", "wall_corner": "ao", "cornell": "photons", "glass_block": "photons",
          "emitters": "photons", "turntable": "frames"}


def exr_pixels(path):
    """The bytes of the channel list and of the pixels of a single-part scanline EXR."""
    data = path.read_bytes()
    at, channels = 8, b""
    while data[at]:
        name_end = data.index(b"\0", at)
        type_end = data.index(b"\0", name_end + 1)
        (size,) = struct.unpack_from("<i", data, type_end + 1)
        if data[at:name_end] == b"channels":
            channels = data[type_end + 5 : type_end + 5 + size]
        at = type_end + 5 + size
    (first,) = struct.unpack_from("<Q", data, at + 1)
    return channels + data[first:]


def lines(binary, data):
    """Yields one line for each render: the hash of its pixels, the input and the flags."""
    inputs = sorted((TOP / "scenes").glob("*.toml")) + (sorted(data.glob("*.vox")) if data else [])
    for source in inputs:
        for flags in [[], *VARIANTS.get(SCENES.get(source.stem, ""), [])]:
            with tempfile.TemporaryDirectory() as folder:
                result = subprocess.run([binary, "render", source, "-o", f"{folder}/a.exr", *SMALL, *flags],
                                        capture_output=True, text=True, check=False)
                images = [exr_pixels(image) for image in sorted(pathlib.Path(folder).glob("*.exr"))]
            found = hashlib.sha256(b"".join(images)).hexdigest()[:16] if images else f"exit {result.returncode}"
            yield " ".join([found, source.name, *flags])


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("binary", type=pathlib.Path)
    options.add_argument("--data", type=pathlib.Path, help="a folder of .vox files to render, too")
    options.add_argument("--against", type=pathlib.Path, help="exit with 1 unless its lines are the same")
    options = options.parse_args()
    expected = options.against.read_text().splitlines() if options.against else None
    found = []
    for line in lines(options.binary.resolve(), options.data):
        print(line, flush=True)
        found.append(line)
    if expected is None:
        return 0
    differing = sorted(set(found) ^ set(expected))
    for line in differing:
        print(f"{'new' if line in found else 'old'}: {line}", file=sys.stderr)
    print(f"{len(differing)} lines differ, {len(found)} renders", file=sys.stderr)
    return 1 if differing else 0


if __name__ == "__main__":
    sys.exit(main())

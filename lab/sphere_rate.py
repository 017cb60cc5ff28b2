"""How many rays a second of CPU time `voxilux render` finds among many spheres, all passes of a sample included.

    python3 lab/sphere_rate.py build/release/voxilux
    python3 lab/sphere_rate.py before/voxilux after/voxilux --spheres 2000

Each program renders a cube full of scattered grey spheres under sun and sky, with paths: first one sample, then more.
The rate is what the reports count in between, so loading, building and compiling are left out. With several programs,
rounds alternate between them, and the best round of each counts.
"""

import argparse
import json
import pathlib
import random
import subprocess
import tempfile

SPHERES_PER_VOXEL = 0.02  # a ray meets the next one after some 25 voxels, whatever their number
SAMPLES = 8
RAYS = ("primary_rays", "sun_rays", "ao_rays", "path_segments")


def scene_of(count, size):
    """A scene file: a cube of spheres of 0.3 to 1.1 voxels, places and radii from a fixed seed."""
    numbers = random.Random(5)
    half = (count / SPHERES_PER_VOXEL) ** (1 / 3) / 2
    lines = [f"[render]\nsize = [{size}, {size}]\n\n[material.grey]\ncolor = \"#a0b0c0\"\n"]
    for _ in range(count):
        center = ", ".join(f"{numbers.uniform(-half, half):.4f}" for _ in range(3))
        lines.append(f"[[sphere]]\ncenter = [{center}]\nradius = {numbers.uniform(0.3, 1.1):.4f}\nmaterial = \"grey\"\n")
    return "\n".join(lines)


def measure(program, scene, samples):
    """The rays and the CPU seconds of a render."""
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([program, "render", scene, "-o", f"{folder}/a.png", "--spp", str(samples), "-q",
                        "--json", f"{folder}/a.json"], check=True)
        report = json.loads(pathlib.Path(folder, "a.json").read_text(encoding="utf-8"))
    return sum(report["work"][key] for key in RAYS), report["cpu_s"]


def rate(program, scene):
    """Millions of rays a CPU second, of the samples after the first."""
    first_rays, first_s = measure(program, scene, 1)
    rays, seconds = measure(program, scene, 1 + SAMPLES)
    return (rays - first_rays) / (seconds - first_s) * 1e-6


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("program", nargs="+", help="a voxilux")
    options.add_argument("--spheres", type=int, default=20000)
    options.add_argument("--size", type=int, default=320, help="pixels across")
    options.add_argument("--rounds", type=int, default=3)
    options = options.parse_args()
    best = dict.fromkeys(options.program, 0.0)
    with tempfile.TemporaryDirectory() as folder:
        scene = pathlib.Path(folder, "spheres.toml")
        scene.write_text(scene_of(options.spheres, options.size), encoding="utf-8")
        for program in options.program:
            measure(program, scene, 1)  # compiles the shaders
        for _ in range(options.rounds):
            for program in options.program:
                best[program] = max(best[program], rate(program, scene))
    for program, rays in best.items():
        print(f"{rays:.3f} M rays per CPU second, {options.spheres} spheres, {program}")


if __name__ == "__main__":
    main()

"""The rate of rays among many spheres, with a stand-in for voxilux of known speed and with voxilux itself.

    sphere_rate_test.py SPHERE_RATE VOXILUX
"""

import pathlib
import subprocess
import sys
import tempfile
import unittest

RATE, VOXILUX = sys.argv[1:3]

# 3000 rays and a millisecond for each sample, and a second for all else.
FAKE = """#!/usr/bin/python3
import json, sys
value = dict(zip(sys.argv, sys.argv[1:]))
samples = int(value["--spp"])
assert open(sys.argv[2]).read().count("[[sphere]]") == 30
work = {"primary_rays": 1000 * samples, "sun_rays": 500 * samples, "ao_rays": 0, "path_segments": 1500 * samples}
json.dump({"work": work, "cpu_s": 1.0 + 0.001 * samples}, open(value["--json"], "w"))
"""


def lines_of(*words):
    done = subprocess.run([sys.executable, RATE, *words], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return done.stdout.splitlines()


class SphereRate(unittest.TestCase):
    def test_counts_the_rays_and_seconds_of_samples_alone(self):
        with tempfile.TemporaryDirectory() as folder:
            fake = pathlib.Path(folder, "fake")
            fake.write_text(FAKE, encoding="utf-8")
            fake.chmod(0o755)
            self.assertEqual(lines_of(str(fake), "--spheres", "30", "--rounds", "1"),
                             [f"3.000 M rays per CPU second, 30 spheres, {fake}"])

    def test_measures_programs_side_by_side(self):
        lines = lines_of(VOXILUX, VOXILUX, "--spheres", "40", "--size", "64", "--rounds", "1")
        self.assertEqual(len(lines), 1)  # a program that is named twice is one
        self.assertRegex(lines[0], r"^-?[0-9.]+ M rays per CPU second, 40 spheres, ")  # noise, at this size


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])

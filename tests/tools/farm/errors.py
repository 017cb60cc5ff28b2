"""Whether the farm keeps its error targets: with --error, the true error of the merged picture is below the target in at
least 95 % of the jobs. The truth is a picture with many more samples and another seed.

    errors.py BINARY SCENES [--error 3%] [--seeds 3] [--scenes 20] [--truth 64]
"""

import argparse
import json
import math
import subprocess
import sys

from cluster import bench_of_arguments

SIZE = ["--size", "64x36"]
TRUTH_SEED = "1000003"


def true_error(bench, truth, picture):
    """The square root of relMSE, as in the report."""
    found = subprocess.run([bench.binary, "compare", bench.top / truth, bench.top / picture, "--json", "-"],
                           capture_output=True, text=True, check=True)
    return math.sqrt(json.loads(found.stdout)["relmse"])


def main():
    bench = bench_of_arguments()
    options = argparse.ArgumentParser()
    options.add_argument("--error", default="3%")
    options.add_argument("--seeds", type=int, default=3)
    options.add_argument("--scenes", type=int, default=20)
    options.add_argument("--truth", type=int, default=64, help="times as many samples as the job took")
    options = options.parse_args()
    names = sorted(path.stem for path in bench.scenes.glob("*.toml"))
    held = jobs = 0
    for name in names[:options.scenes]:
        for seed in range(options.seeds):
            out, _ = bench.farm(name, "f.exr", *SIZE, "--seed", str(seed), "--error", options.error, "--workers", "2",
                                "--json", "-")
            report = json.loads(out)
            if seed == 0:
                bench.render(name, "truth.exr", *SIZE, "--seed", TRUTH_SEED, "--spp",
                             str(min(65536, options.truth * report["samples"])))
            error = true_error(bench, "truth.exr", "f.exr")
            high = report["error"]["high"]
            holds = high is not None and error <= high
            held, jobs = held + holds, jobs + 1
            claimed = "nothing" if high is None else f"{100 * high:.3g} %"
            print(f"{name} seed {seed}: {report['samples']} samples, true {100 * error:.3g} %, claimed {claimed}"
                  f"{'' if holds else '  BROKEN'}", flush=True)
    print(f"{held} of {jobs} claims hold")
    return 0 if held >= 0.95 * jobs else 1


if __name__ == "__main__":
    sys.exit(main())

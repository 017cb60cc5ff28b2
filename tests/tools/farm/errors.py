"""Whether error targets are kept: with --error, the true error of the farm's merged picture is below what is claimed in
at least 95 % of the jobs. The truth is a picture with many more samples and another seed. With --alone, of renders in one
process, whose first forecast must also hold the time that they took in 80 %.

    errors.py BINARY SCENES [--alone] [--error 3%] [--seeds 3] [--scenes 20] [--truth 64]
"""

import argparse
import json
import math
import subprocess
import sys

from cluster import bench_of_arguments

SIZE = ["--size", "64x36"]
TRUTH_SEED = "1000003"
SHORT = 0.1  # seconds


def true_error(bench, truth, picture):
    """The square root of relMSE, as in the report."""
    found = subprocess.run([bench.binary, "compare", bench.top / truth, bench.top / picture, "--json", "-"],
                           capture_output=True, text=True, check=True)
    return math.sqrt(json.loads(found.stdout)["relmse"])


def render(bench, name, output, *more):
    """What farm() does, in one process."""
    words = bench.words("render", name, "--reproducible", "-q", "-o", bench.top / output, *more)
    return subprocess.run(words, check=True, stdout=subprocess.PIPE, text=True).stdout


def is_right(forecast):
    """Whether the time was within the forecast, or missed it by less than what other programs can take."""
    took = forecast["outcome"]["wall_s"]
    return forecast["low_s"] - SHORT <= took <= forecast["high_s"] + SHORT


def main():
    bench = bench_of_arguments()
    options = argparse.ArgumentParser()
    options.add_argument("--error", default="3%")
    options.add_argument("--seeds", type=int, default=3)
    options.add_argument("--scenes", type=int, default=20)
    options.add_argument("--truth", type=int, default=64, help="times as many samples as the job took")
    options.add_argument("--alone", action="store_true")
    options = options.parse_args()
    names = sorted(path.stem for path in bench.scenes.glob("*.toml"))
    held = jobs = forecasts = in_time = 0
    for name in names[:options.scenes]:
        for seed in range(options.seeds):
            words = [*SIZE, "--seed", str(seed), "--error", options.error, "--json", "-"]
            report = json.loads(render(bench, name, "f.exr", *words) if options.alone else
                                bench.farm(name, "f.exr", *words, "--workers", "2")[0])
            if seed == 0:
                bench.render(name, "truth.exr", *SIZE, "--seed", TRUTH_SEED, "--spp",
                             str(min(65536, options.truth * report["samples"])))
            error = true_error(bench, "truth.exr", "f.exr")
            high = report["error"]["high"]
            holds = high is not None and error <= high
            held, jobs = held + holds, jobs + 1
            if "outcome" in (forecast := report.get("forecast", {})):
                forecasts, in_time = forecasts + 1, in_time + is_right(forecast)
            claimed = "nothing" if high is None else f"{100 * high:.3g} %"
            print(f"{name} seed {seed}: {report['samples']} samples, true {100 * error:.3g} %, claimed {claimed}"
                  f"{'' if holds else '  BROKEN'}", flush=True)
    print(f"{held} of {jobs} claims hold, {in_time} of {forecasts} forecasts")
    return 0 if held >= 0.95 * jobs and in_time >= 0.8 * forecasts else 1


if __name__ == "__main__":
    sys.exit(main())

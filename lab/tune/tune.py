#!/usr/bin/env python3
"""Finds the first radius, alpha and the photons per iteration for a scene by Bayesian optimisation.

Each trial renders the scene for the same time; the error that is left is what Optuna minimises (a tree-structured
Parzen estimator: Bergstra et al. 2011, "Algorithms for Hyper-Parameter Optimization", section 4). The best trial and
the scene's own settings are then rendered with other seeds, so that luck in the search does not count as a gain.
"""

import argparse
import json
import math
import pathlib
import shutil
import statistics
import subprocess
import sys
import tempfile

MISSING = 69  # exit code without Optuna
MOST_ITERATIONS = 1 << 20  # more than fit in any time limit; film sums are exact up to there
PHOTON_BITS = (12, 20)
ALPHAS = (0.4, 1.0)


class Failure(Exception):
    """The message of a render that failed."""


def run(words):
    """Standard output of a command as JSON."""
    done = subprocess.run(words, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        lines = done.stderr.strip().splitlines() or [f"exit code {done.returncode}"]
        raise Failure(f"{pathlib.Path(words[0]).name} {words[1]}: {lines[-1]}")
    return json.loads(done.stdout)


def flags_of(settings):
    """The settings of a trial as flags; none for the scene's own."""
    words = []
    for name, value in settings.items():
        words += [f"--{name}", f"{value:.6g}" if isinstance(value, float) else str(value)]
    return words


class Judge:
    """Renders with settings and returns the error."""

    def __init__(self, options, folder):
        self.options = options
        self.picture = str(pathlib.Path(folder) / "trial.exr")

    def error(self, settings, seed):
        """Root of relMSE after the time of a trial: against the reference, or as the render estimates it."""
        options = self.options
        words = [options.voxilux, "render", options.scene, "--seed", str(seed), "--quiet", "--json", "-"]
        words += ["--iterations", str(MOST_ITERATIONS), "--time-limit", f"{options.time}s", "-o", self.picture]
        if options.size:
            words += ["--size", options.size]
        report = run(words + flags_of(settings))
        return self.measured(report) * overtime(report["wall_s"], options.time)

    def measured(self, report):
        if not self.options.reference:
            estimate = report["error"]["estimate"]
            if estimate is None:
                raise Failure(f"render: its error is not known after {self.options.time:g} s; allow more by --time")
            return estimate
        words = [self.options.voxilux, "compare", self.options.reference, self.picture, "--json", "-"]
        if self.options.mask:
            words += ["--mask", self.options.mask]
        return math.sqrt(run(words)["relmse"])

    def median_error(self, settings, seeds):
        return statistics.median(self.error(settings, seed) for seed in seeds)


def overtime(wall_s, time_s):
    """The factor for the error of a trial that took too long: noise falls with the root of the time."""
    return math.sqrt(max(1.0, wall_s / time_s))


def suggest(trial, options):
    """The settings that Optuna wants to see next."""
    low, high = options.radius
    return {
        "radius": trial.suggest_float("radius", low, high, log=True),
        "alpha": trial.suggest_float("alpha", *ALPHAS),
        "photons": 1 << trial.suggest_int("photon_bits", *PHOTON_BITS),
    }


def search(optuna, judge, options, say):
    """The best settings of all trials and how many trials there were."""
    optuna.logging.set_verbosity(optuna.logging.WARNING)
    study = optuna.create_study(sampler=optuna.samplers.TPESampler(seed=options.seed))
    best = {"error": math.inf, "settings": None}

    def objective(trial):
        settings = suggest(trial, options)
        try:
            error = judge.error(settings, options.seed)
        except Failure as failure:
            say(f"trial {trial.number + 1}: {failure}")
            raise optuna.TrialPruned() from failure
        if error < best["error"]:
            best.update(error=error, settings=settings)
        say(f"trial {trial.number + 1} of {options.trials}: error {error:.4g}  {' '.join(flags_of(settings))}")
        return error

    try:
        study.optimize(objective, n_trials=options.trials)
    except KeyboardInterrupt:
        say("interrupted: the best so far counts")
    if best["settings"] is None:
        raise Failure("no trial has succeeded")
    return best["settings"], len(study.trials)


def radius_range(text):
    low, _, high = text.partition(",")
    low, high = float(low), float(high)
    if not 0.0 < low < high <= 65536.0:
        raise ValueError(text)
    return low, high


def positive(kind):
    def parse(text):
        value = kind(text)
        if not value > 0:
            raise ValueError(text)
        return value

    parse.__name__ = f"{kind.__name__} above 0"
    return parse


def parse_arguments(words):
    parser = argparse.ArgumentParser(prog="tune.py", description=__doc__.splitlines()[0])
    parser.add_argument("scene", help="a scene that calls for photons")
    parser.add_argument("--voxilux", default=shutil.which("voxilux") or "build/release/voxilux", help="the program")
    parser.add_argument("--trials", type=positive(int), default=40, help="renders of the search (40)")
    parser.add_argument("--time", type=positive(float), default=5.0, help="seconds of each render (5)")
    parser.add_argument("--size", help="picture size WxH, else that of the scene")
    parser.add_argument("--radius", type=radius_range, default=(0.1, 16.0), metavar="LOW,HIGH",
                        help="first radii that are tried, in voxels (0.1,16)")
    parser.add_argument("--reference", help="picture to compare with; else the error is the render's own estimate")
    parser.add_argument("--mask", help="with --reference: picture that is black where nothing is compared")
    parser.add_argument("--repeats", type=positive(int), default=3,
                        help="renders with other seeds of which the median tells the gain (3)")
    parser.add_argument("--seed", type=int, default=0, help="of the search and its renders (0)")
    parser.add_argument("--json", help="write the result to this file")
    parser.add_argument("--quiet", action="store_true", help="print the result only")
    return parser.parse_args(words)


def tune(optuna, options, say):
    """The result as JSON: settings, errors with them and with the scene's own, gain."""
    with tempfile.TemporaryDirectory() as folder:
        judge = Judge(options, folder)
        seeds = [options.seed + 1 + i for i in range(options.repeats)]
        # --radius auto and the defaults of the program, whatever the scene says about radius, alpha and count.
        default = judge.median_error({"radius": "auto", "alpha": 2.0 / 3.0, "photons": 0}, seeds)
        settings, trials = search(optuna, judge, options, say)
        tuned = judge.median_error(settings, seeds)
    return {"scene": options.scene, "trials": trials, "time_s": options.time,
            "metric": "relmse-root of the reference" if options.reference else "relmse-root, estimated",
            "settings": settings, "error": tuned, "default_error": default, "gain": default / tuned}


def describe(result):
    lines = [f"best      {' '.join(flags_of(result['settings']))}",
             f"error     {result['error']:.4g} after {result['time_s']:g} s; {result['default_error']:.4g} with --radius auto",
             f"gain      {result['gain']:.2f} times less error, as {result['gain'] ** 2:.2f} times the time would bring"]
    if result["gain"] <= 1.0:
        lines.append("note      nothing was gained: --radius auto serves this scene")
    if "estimated" in result["metric"]:
        lines.append("note      the error is the estimate of the render itself; --reference measures it")
    return "\n".join(lines)


def main(words):
    options = parse_arguments(words)
    try:
        import optuna  # here, so that --help works without it
    except ImportError:
        print("tune.py: needs Optuna: apt-get install python3-optuna, or pip install optuna", file=sys.stderr)
        return MISSING
    say = (lambda text: None) if options.quiet else (lambda text: print(text, file=sys.stderr, flush=True))
    try:
        result = tune(optuna, options, say)
    except (Failure, OSError) as failure:
        print(f"tune.py: {failure}", file=sys.stderr)
        return 1
    print(describe(result))
    if options.json:
        pathlib.Path(options.json).write_text(json.dumps(result, indent=1) + "\n", encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

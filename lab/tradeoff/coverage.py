#!/usr/bin/env python3
"""How often the error bounds and the forecasts of time that renders report are right.

    coverage.py --voxilux build/release/voxilux --scenes scenes

renders many views with several seeds to an error target and compares each picture with two long references of its
view. Two figures come out: the share of runs whose true error is within the bound that they report, and the share of
long runs whose time is within their forecast.

The true error needs no perfect reference. With x the picture, a and b the references, all independent and with the
same mean, relMSE(x, a) + relMSE(x, b) - relMSE(a, b) is on average twice that of x against a reference without noise.
"""

import argparse
import hashlib
import json
import math
import pathlib
import shutil
import statistics
import subprocess
import sys
import tempfile

REFUSED, BELOW = 3, 5
WANTED_CLAIMS, WANTED_FORECASTS = 0.95, 0.80
LONG_RUN_S = 30.0
Z_95 = 1.959964  # of a normal distribution, two-sided
FIRST_SEED = 1
REFERENCE_SEEDS = (1000003, 2000003)
REFERENCE_SHARE, LONG_REFERENCE_SHARE = 0.5, 1.0  # error of a reference over the error target of its view
RADIUS_SHARE = 0.5  # first radius of photons of a reference over that of a run: its blur is a quarter
CONTINUES = (0, 4)  # exit codes of a render that has written its picture
STOPPED_BY_ERROR = "error target reached"
QUICK_VIEWS, QUICK_SEEDS = 6, 2


class Failure(Exception):
    """The message of a command that failed, or of a file that cannot be read."""


def run(words):
    """The JSON that a voxilux command prints."""
    done = subprocess.run(words, capture_output=True, text=True, check=False)
    if done.returncode not in CONTINUES:
        lines = done.stderr.strip().splitlines() or [f"exit code {done.returncode}"]
        raise Failure(f"{pathlib.Path(words[0]).name} {' '.join(words[1:3])}: {lines[-1]}")
    return json.loads(done.stdout)


# ---- views ------------------------------------------------------------------------------------------------------


def percentage(text):
    """An error such as '2.5%' as a number; None for '-'."""
    if text == "-":
        return None
    if not text.endswith("%") or not 0.0 < float(text[:-1]) < 100.0:
        raise ValueError(text)
    return float(text[:-1]) / 100.0


def read_views(file):
    """Views of a file: a line each with name, error target, target of long runs or '-', scene and flags."""
    views = []
    for number, line in enumerate(file.read_text(encoding="utf-8").splitlines(), 1):
        words = line.split("#")[0].split()
        if not words:
            continue
        try:
            name, error, long_error, scene = words[0], percentage(words[1]), percentage(words[2]), words[3]
        except (IndexError, ValueError) as problem:
            raise Failure(f"{file}:{number}: not 'NAME 2% 0.5%|- SCENE FLAGS...': {problem}") from problem
        views.append({"name": name, "error": error, "long_error": long_error, "scene": scene, "flags": words[4:]})
    return views


def without_sequence(flags):
    """The flags of a view for its references, which take the default sequence: the light is the same."""
    if "--sequence" not in flags:
        return flags
    place = flags.index("--sequence")
    return flags[:place] + flags[place + 2:]


class Renderer:
    """Renders views; keeps references from run to run."""

    def __init__(self, options, folder):
        self.options = options
        self.folder = pathlib.Path(folder)
        self.kept = pathlib.Path(options.references or folder)
        self.kept.mkdir(parents=True, exist_ok=True)

    def render(self, view, words, picture):
        scene = str(pathlib.Path(self.options.scenes) / view["scene"])
        return run([self.options.voxilux, "render", scene, *view["flags"], *words, "--quiet", "--checkpoint", "0",
                    "--json", "-", "-o", str(picture)])

    def run_to(self, view, error, seed, picture):
        return self.render(view, ["--error", f"{100 * error:g}%", "--seed", str(seed),
                                  "--time-limit", f"{self.options.time_limit:g}s"], picture)

    def relmse(self, a, b):
        return run([self.options.voxilux, "compare", str(a), str(b), "--json", "-"])["relmse"]

    def references(self, view, report):
        """Two pictures of the view, and the relMSE between them. A report of a run names the radius of photons."""
        error = min(REFERENCE_SHARE * view["error"], LONG_REFERENCE_SHARE * (view["long_error"] or 1.0))
        words = ["--error", f"{100 * error:.4g}%", "--time-limit", f"{self.options.reference_limit:g}s"]
        radius = (report.get("photons") or {}).get("first_radius")
        if radius:
            words += ["--radius", f"{RADIUS_SHARE * radius:.4g}"]
        asked = json.dumps([report["version"], report["scene_hash"], view["flags"], words])
        same = dict(view, flags=without_sequence(view["flags"]))
        key = hashlib.sha256(asked.encode()).hexdigest()[:16]
        files = [self.kept / f"{view['name']}-{key}-{seed}.exr" for seed in REFERENCE_SEEDS]
        for file, seed in zip(files, REFERENCE_SEEDS):
            if not file.exists():
                part = self.folder / "reference.exr"
                self.render(same, [*words, "--seed", str(seed)], part)
                shutil.move(part, file)
        return files, self.relmse(*files)


# ---- verdicts ---------------------------------------------------------------------------------------------------


def true_error(renderer, picture, references, between):
    """Root of the picture's relMSE, less the noise of the references; 0 where that noise is all there is."""
    twice = sum(renderer.relmse(reference, picture) for reference in references) - between
    return math.sqrt(max(0.0, 0.5 * twice))


def judged(view, target, seed, report, error):
    """A row: the error bound that the run reported, and the true error. A run without a bound has no verdict."""
    claims = report["error"]["high"]
    reached = report["stopped"] == STOPPED_BY_ERROR
    limits = [one for one in (claims, target if reached else None) if one is not None]
    forecast = report.get("forecast") or {}
    low, high = forecast.get("low_s"), forecast.get("high_s")
    wall = report["wall_s"]
    is_long = wall >= LONG_RUN_S
    return {"view": view["name"], "seed": seed, "target": target, "stopped": report["stopped"],
            "estimate": report["error"]["estimate"], "claimed": min(limits) if limits else None, "true": error,
            "is_within": error <= min(limits) if limits else None, "wall_s": wall, "forecast_low_s": low,
            "forecast_high_s": high, "is_long": is_long,
            "is_forecast": low <= wall <= high if is_long and low is not None and high is not None else None}


def measure_view(renderer, view, options, say):
    """The rows of a view: every seed to its error target, then to that of long runs."""
    rows, references, between = [], None, 0.0
    targets = [view["error"]] + ([view["long_error"]] if view["long_error"] and not options.quick else [])
    for target in targets:
        for seed in range(FIRST_SEED, FIRST_SEED + options.seeds):
            picture = renderer.folder / "run.exr"
            report = renderer.run_to(view, target, seed, picture)
            if references is None:
                references, between = renderer.references(view, report)
            row = judged(view, target, seed, report, true_error(renderer, picture, references, between))
            rows.append(row)
            say(row_text(row))
    return rows


def share(verdicts):
    """How many of the verdicts are true, with the 95 % interval of Wilson (1927) for the probability behind."""
    count, hits = len(verdicts), sum(verdicts)
    if not count:
        return {"count": 0, "hits": 0, "share": None, "low": None, "high": None}
    p, z2 = hits / count, Z_95 * Z_95
    middle = (p + z2 / (2 * count)) / (1 + z2 / count)
    half = Z_95 / (1 + z2 / count) * math.sqrt(p * (1 - p) / count + z2 / (4 * count * count))
    return {"count": count, "hits": hits, "share": p, "low": middle - half, "high": middle + half}


def figures(rows):
    claims = share([row["is_within"] for row in rows if row["is_within"] is not None])
    forecasts = share([row["is_forecast"] for row in rows if row["is_forecast"] is not None])
    return {"claims": claims, "forecasts": forecasts,
            "without_claim": sum(row["is_within"] is None for row in rows),
            "without_forecast": sum(row["is_long"] and row["is_forecast"] is None for row in rows)}


def is_below(figure, wanted, is_quick):
    """Whether too few verdicts hold. With few runs, only where their whole interval is too low."""
    if figure["share"] is None:
        return False
    return (figure["high"] if is_quick else figure["share"]) < wanted


# ---- words ------------------------------------------------------------------------------------------------------


def percent(value):
    return "unknown" if value is None else f"{100 * value:.3g} %"


def time_range(low, high):
    return "-" if low is None or high is None else f"{low:.1f} to {high:.1f} s"


def row_text(row):
    within = {True: "within", False: "BEYOND", None: "no claim"}[row["is_within"]]
    forecast = {True: "within", False: "OUTSIDE", None: ""}[row["is_forecast"]]
    return (f"{row['view']:<22} seed {row['seed']}  asked {percent(row['target']):>7}  claimed {percent(row['claimed']):>7}"
            f"  true {percent(row['true']):>7}  {within:<8}  {row['wall_s']:6.1f} s"
            f"  forecast {time_range(row['forecast_low_s'], row['forecast_high_s'])} {forecast}").rstrip()


def figure_text(name, figure, wanted):
    if not figure["count"]:
        return f"{name:<10} unknown: no run to judge by"
    return (f"{name:<10} {figure['hits']} of {figure['count']} = {100 * figure['share']:.1f} % "
            f"(95 % interval {100 * figure['low']:.1f} to {100 * figure['high']:.1f} %; wanted {100 * wanted:.0f} %)")


def view_text(rows):
    """A line for a view: the runs of each target together."""
    ratios = [row["true"] / row["claimed"] for row in rows if row["claimed"]]
    within = sum(bool(row["is_within"]) for row in rows)
    ratio = f"true over claimed {min(ratios):.2f} to {max(ratios):.2f}" if ratios else "no claims"
    return (f"{rows[0]['view']:<22} asked {percent(rows[0]['target']):>7}  {within} of {len(rows)} within, {ratio}, "
            f"{statistics.median(row['wall_s'] for row in rows):.1f} s")


def describe(result):
    groups = {}
    for row in result["runs"]:
        groups.setdefault((row["view"], row["target"]), []).append(row)
    lines = [view_text(rows) for rows in groups.values()]
    lines += [figure_text("claims", result["claims"], WANTED_CLAIMS),
              figure_text("forecasts", result["forecasts"], WANTED_FORECASTS)]
    if result["without_claim"]:
        lines.append(f"note       {result['without_claim']} runs made no claim")
    if result["without_forecast"]:
        lines.append(f"note       {result['without_forecast']} long runs made no forecast")
    return "\n".join(lines)


def count(text):
    if int(text) < 1:
        raise ValueError(text)
    return int(text)


def parse_arguments(words):
    here = pathlib.Path(__file__).parent
    parser = argparse.ArgumentParser(prog="coverage.py", description=__doc__.splitlines()[0])
    parser.add_argument("--voxilux", default=shutil.which("voxilux") or "build/release/voxilux", help="the program")
    parser.add_argument("--scenes", default="scenes", help="folder of the scenes (scenes)")
    parser.add_argument("--list", default=here / "views.txt", type=pathlib.Path, help="the views (views.txt beside this)")
    parser.add_argument("--views", help="names of those to render, with commas (all)")
    parser.add_argument("--seeds", type=count, help=f"renders of each view (5; {QUICK_SEEDS} with --quick)")
    parser.add_argument("--references", help="folder that keeps references for the next time")
    parser.add_argument("--time-limit", type=float, default=300.0, help="seconds of a run at most (300)")
    parser.add_argument("--reference-limit", type=float, default=600.0, help="seconds of a reference at most (600)")
    parser.add_argument("--quick", action="store_true",
                        help=f"{QUICK_VIEWS} views of the list, no long runs; fails only where chance cannot be the reason")
    parser.add_argument("--json", help="write the result to this file")
    parser.add_argument("--quiet", action="store_true", help="print the figures only")
    options = parser.parse_args(words)
    options.seeds = options.seeds or (QUICK_SEEDS if options.quick else 5)
    return options


def chosen_views(options):
    views = read_views(options.list)
    if options.views:
        named = options.views.split(",")
        unknown = sorted(set(named) - {view["name"] for view in views})
        if unknown:
            raise Failure(f"--views: no view is called {', '.join(unknown)}")
        views = [view for view in views if view["name"] in named]
    elif options.quick:
        views = views[::max(1, len(views) // QUICK_VIEWS)][:QUICK_VIEWS]
    return views


def measure(options, say):
    """The result as JSON: all rows and the two figures."""
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        renderer = Renderer(options, folder)
        for view in chosen_views(options):
            rows += measure_view(renderer, view, options, say)
    return {"voxilux": str(options.voxilux), "views": len({row["view"] for row in rows}), "seeds": options.seeds,
            **figures(rows), "runs": rows}


def main(words):
    options = parse_arguments(words)
    say = (lambda text: None) if options.quiet else (lambda text: print(text, file=sys.stderr, flush=True))
    try:
        result = measure(options, say)
    except (Failure, OSError) as failure:
        print(f"coverage.py: {failure}", file=sys.stderr)
        return REFUSED
    print(describe(result))
    if options.json:
        pathlib.Path(options.json).write_text(json.dumps(result, indent=1) + "\n", encoding="utf-8")
    missed = [name for name, wanted in (("claims", WANTED_CLAIMS), ("forecasts", WANTED_FORECASTS))
              if is_below(result[name], wanted, options.quick)]
    if missed:
        print(f"coverage.py: too few are right: {', '.join(missed)}", file=sys.stderr)
    return BELOW if missed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

#!/usr/bin/env python3
"""Chooses the presets of --quality from measured prices and writes them as a header for the program.

    choose_presets.py prices.csv -o ../quality_presets.inc        or many tradeoff.json files

The rule. Occlusion rays stay at their default, unless another number reaches an error in at least a tenth less time:
an error e in time t is worth e^2 t, since noise falls with the root of time, and the geometric mean over the scenes
decides, each at the largest sample count measured for both. The number of photons follows the size of the picture. Then
each preset takes the smallest power of two of samples per pixel, two or more, at which the median error over the scenes
is at most its target. Scenes in which photons run are treated apart from plain ones, and have larger targets: the same
error would take them hundreds of times as long. The price is the median error and the median time there.
"""

import argparse
import math
import pathlib
import statistics
import sys

from prices import Curve, Malformed, read_prices, scenes_of

REFUSED = 3
TARGETS = {"draft": {"plain": 0.05, "photons": 0.20}, "normal": {"plain": 0.03, "photons": 0.07},
           "fine": {"plain": 0.01, "photons": 0.03}, "reference": {"plain": 0.003, "photons": 0.01}}
WORTHWHILE = 0.9  # share of the default's time for an equal error; another value must need less than this
FEWEST_LOG2, MOST_LOG2 = 1, 20  # of sample counts: one sample has no error estimate; film sums are exact up to 2^20
KNOB, DEFAULT_RAYS = "ao_rays", 1


def worth(rows):
    """By number of rays: time to an equal error over that of the default number."""
    own = [row for row in rows if row["knob"] == KNOB and row["error"] > 0.0]
    defaults = {row["spp"]: row for row in own if row["is_default"]}
    table = {}
    for row in sorted(own, key=lambda row: row["spp"]):
        if default := defaults.get(row["spp"]):
            table[row["setting"]] = row["error"] ** 2 * row["time_s"] / (default["error"] ** 2 * default["time_s"])
    return table


def choose_rays(scenes):
    """The setting of the number of rays that is measured in all scenes with occlusion and worth it; None for the
    default."""
    tables = [table for rows in scenes.values() if (table := worth(rows))]
    if not tables:
        return None
    common = set.intersection(*(set(table) for table in tables))
    means = {value: math.exp(statistics.mean(math.log(table[value]) for table in tables)) for value in common}
    best = min(means, key=means.get, default=None)
    return best if best is not None and means[best] < WORTHWHILE else None


class Kind:
    """Scenes of one kind with the chosen rays."""

    def __init__(self, scenes, rays):
        self.curves = [Curve(own, KNOB, rays) if rays else Curve(own) for own in scenes]
        self.megapixels = [own[0]["width"] * own[0]["height"] / 1e6 for own in scenes]

    def price(self, name, target):
        """Samples, median error and time of a preset."""
        for i in range(FEWEST_LOG2, MOST_LOG2 + 1):
            error = statistics.median(curve.at(1 << i, "error") for curve in self.curves)
            if error <= target:
                return {"samples": 1 << i, "error": error,
                        "is_measured": 2 * sum(curve.is_measured(1 << i) for curve in self.curves) > len(self.curves),
                        "seconds_per_megapixel": statistics.median(
                            curve.at(1 << i, "time_s") / size for curve, size in zip(self.curves, self.megapixels))}
        raise Malformed(f"no number of samples leaves a median error of {100 * target:g} % for '{name}'")


def kinds_of(rows):
    """The scenes without photons and those with them."""
    scenes = scenes_of(rows)
    kinds = {"plain": [own for own in scenes.values() if not own[0]["photons"]],
             "photons": [own for own in scenes.values() if own[0]["photons"]]}
    missing = [kind for kind, found in kinds.items() if not found]
    if missing:
        raise Malformed(f"no scene of the kind '{missing[0]}' was measured: presets need both, with photons and without")
    return kinds


def choose(rows):
    """The presets as dictionaries, in the order of TARGETS."""
    rays = choose_rays(scenes_of(rows))
    kinds = {name: Kind(scenes, rays) for name, scenes in kinds_of(rows).items()}
    return [{"name": name, "ao_rays": int(rays or DEFAULT_RAYS)}
            | {kind: scenes.price(name, targets[kind]) for kind, scenes in kinds.items()}
            for name, targets in TARGETS.items()]


def two_digits(value):
    return f"{float(f'{value:.2g}'):g}"


def header_text(about, rows, presets):
    kinds = kinds_of(rows)
    lines = ["// Written by lab/tradeoff/choose_presets.py, which has the rule, from lab/tradeoff/prices.csv.",
             f"constexpr std::array<QualityPreset, {len(presets)}> kPresets{{{{"]
    for preset in presets:
        lines += [f"    {{.name = \"{preset['name']}\",", f"     .ao_rays = {preset['ao_rays']},"]
        lines += [f"     .{kind} = {{.samples = {preset[kind]['samples']}, .error = {two_digits(preset[kind]['error'])}, "
                  f".seconds_per_megapixel = {two_digits(preset[kind]['seconds_per_megapixel'])}}}"
                  f"{',' if kind == 'plain' else '},'}" for kind in kinds]
    lines += ["}};", f"constexpr int kPlainScenes = {len(kinds['plain'])};",
              f"constexpr int kPhotonScenes = {len(kinds['photons'])};",
              f"constexpr std::string_view kPricedOn = \"{about['machine']}\";", ""]
    return "\n".join(lines)


def main(words):
    parser = argparse.ArgumentParser(prog="choose_presets.py", description=__doc__.splitlines()[0])
    parser.add_argument("prices", nargs="+", help="prices.csv, or tradeoff.json files")
    parser.add_argument("-o", "--output", help="the header; else it is printed")
    options = parser.parse_args(words)
    try:
        about, rows = read_prices(options.prices)
        text = header_text(about, rows, choose(rows))
    except (Malformed, OSError) as problem:
        print(f"choose_presets.py: {problem}", file=sys.stderr)
        return REFUSED
    if options.output:
        pathlib.Path(options.output).write_text(text, encoding="utf-8")
    else:
        print(text, end="")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

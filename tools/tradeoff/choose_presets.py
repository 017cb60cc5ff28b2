#!/usr/bin/env python3
"""Chooses the presets of --quality from measured prices and writes them as a header for the program.

    choose_presets.py prices.csv -o ../quality_presets.inc        or many tradeoff.json files

The rule. Occlusion rays and photons stay at their default, unless another value reaches an error in at least a tenth
less time: an error e in time t is worth e^2 t, since noise falls with the root of time, and the geometric mean over
the scenes decides. Then each preset takes the least power of two of samples per pixel at which the median error over
the scenes is at most its target. Its price is the median error and the median time there.
"""

import argparse
import math
import pathlib
import statistics
import sys

from prices import Curve, Malformed, read_prices, scenes_of

REFUSED = 3
TARGETS = (("draft", 0.20), ("normal", 0.07), ("fine", 0.03), ("reference", 0.01))
WORTHWHILE = 0.9  # of the time for an error, below which another value than the default is taken
MOST_SAMPLES_LOG2 = 20  # film sums are exact up to there
KNOBS = {"ao_rays": "ao_rays", "photons": "photons"}  # knob: column
DEFAULTS = {"ao_rays": 1, "photons": 0}


def worth(rows, knob):
    """By value of the knob: time for an error over that of the default, and ratios of error and time. The default of
    the knob was measured with as many samples as its other values."""
    defaults = [row for row in rows if row["is_default"]]
    default = next((row for row in defaults if row["knob"] == knob), defaults[0] if defaults else None)
    if default is None:
        return {}
    return {row["setting"]: (row["error"] ** 2 * row["time_s"] / (default["error"] ** 2 * default["time_s"]),
                             row["error"] / default["error"], row["time_s"] / default["time_s"])
            for row in rows if row["knob"] == knob and default["error"] > 0.0 and row["error"] > 0.0}


def choose_value(scenes, knob):
    """The value of the knob that all scenes with it have measured and that is worth it; None for the default."""
    tables = [table for rows in scenes.values() if (table := worth(rows, knob))]
    if not tables:
        return None
    common = set.intersection(*(set(table) for table in tables))
    means = {value: math.exp(statistics.mean(math.log(table[value][0]) for table in tables)) for value in common}
    best = min(means, key=means.get, default=None)
    return best if best is not None and means[best] < WORTHWHILE else None


def value_of(rows, knob, setting):
    """The number behind a setting's name."""
    return next(row[KNOBS[knob]] for row in rows if row["knob"] == knob and row["setting"] == setting)


class Priced:
    """Error and time of a scene with the chosen values of all knobs."""

    def __init__(self, rows, values):
        self.curve = Curve(rows)
        self.pixels = rows[0]["width"] * rows[0]["height"]
        self.factors = {"error": 1.0, "time_s": 1.0}
        for knob, value in values.items():
            _, error, time = worth(rows, knob).get(value, (1.0, 1.0, 1.0))
            self.factors["error"] *= error
            self.factors["time_s"] *= time

    def at(self, spp, key):
        return self.curve.at(spp, key) * self.factors[key]

    def seconds_per_megapixel(self, spp):
        return self.at(spp, "time_s") * 1e6 / self.pixels


def choose(rows):
    """The presets as dictionaries, in the order of TARGETS."""
    scenes = scenes_of(rows)
    values = {knob: value for knob in KNOBS if (value := choose_value(scenes, knob)) is not None}
    priced = [Priced(one, values) for one in scenes.values()]
    settings = {column: value_of(rows, knob, values[knob]) if knob in values else DEFAULTS[column]
                for knob, column in KNOBS.items()}
    presets = []
    for name, target in TARGETS:
        medians = ((1 << i, statistics.median(one.at(1 << i, "error") for one in priced))
                   for i in range(MOST_SAMPLES_LOG2 + 1))
        spp, error = next(((spp, error) for spp, error in medians if error <= target), (None, None))
        if spp is None:
            raise Malformed(f"no number of samples leaves a median error of {100 * target:g} % for '{name}'")
        presets.append({"name": name, "spp": spp, **settings, "error": error, "is_measured":
                        sum(one.curve.is_measured(spp) for one in priced) * 2 > len(priced),
                        "seconds_per_megapixel": statistics.median(one.seconds_per_megapixel(spp) for one in priced)})
    return presets


def header_text(about, rows, presets):
    lines = ["// Written by tools/tradeoff/choose_presets.py, which has the rule, from tools/tradeoff/prices.csv.",
             f"constexpr std::array<QualityPreset, {len(presets)}> kPresets{{{{"]
    for preset in presets:
        lines += [f"    {{.name = \"{preset['name']}\",", f"     .spp = {preset['spp']},",
                  f"     .ao_rays = {preset['ao_rays']},", f"     .photons = {preset['photons']},",
                  f"     .error = {preset['error']:.2g},",
                  f"     .seconds_per_megapixel = {float(format(preset['seconds_per_megapixel'], '.2g')):g}}},"]
    lines += ["}};", f"constexpr int kPricedScenes = {len(scenes_of(rows))};",
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

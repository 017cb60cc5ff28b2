#!/usr/bin/env python3
"""Stands in for voxilux in the tests of the search: its errors follow a formula with one minimum."""

import json
import math
import sys

BEST_RADIUS, BEST_ALPHA, BEST_PHOTONS = 2.0, 0.7, 1 << 16


def value_of(words, flag, default):
    return words[words.index(flag) + 1] if flag in words else default


def error(words):
    radius = value_of(words, "--radius", "auto")
    if radius == "auto":
        return 0.5
    away = math.log(float(radius) / BEST_RADIUS) ** 2
    away += (float(value_of(words, "--alpha", "1")) - BEST_ALPHA) ** 2
    away += 0.1 * math.log2(int(value_of(words, "--photons", "1")) / BEST_PHOTONS) ** 2
    return 0.1 + away


def main(words):
    if words[1] == "broken.toml":
        print("voxilux: broken.toml: no such file", file=sys.stderr)
        return 3
    if words[0] == "compare":
        print(json.dumps({"relmse": 0.04}))
        return 0
    wall = 4.0 * float(value_of(words, "--time-limit", "1s")[:-1]) if words[1] == "slow.toml" else 0.0
    estimate = None if words[1] == "unknown.toml" else error(words)
    print(json.dumps({"wall_s": wall, "error": {"estimate": estimate}}))
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

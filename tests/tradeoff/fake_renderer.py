#!/usr/bin/env python3
"""Stands for voxilux where coverage.py is tested. A picture is a file with the size of its error and of its blur.

Scenes: honest.toml; liar.toml has twice the error it claims; late.toml takes longer than its forecast; silent.toml
knows neither; noisy.toml has references as bad as its pictures; broken.toml cannot be rendered.
"""

import json
import pathlib
import sys

LONG_RUN_S = 40.0


def value_of(words, flag, default=None):
    return words[words.index(flag) + 1] if flag in words else default


def render(words):
    scene = pathlib.Path(words[1]).stem
    if scene == "broken":
        print("voxilux: broken.toml: no such file", file=sys.stderr)
        return 3
    target = float(value_of(words, "--error")[:-1]) / 100.0
    is_reference = int(value_of(words, "--seed")) > 1000
    error = 0.9 * target
    if is_reference and scene == "noisy":
        error = 2.0 * target
    true = 2.0 * error if scene == "liar" and not is_reference else error
    pathlib.Path(value_of(words, "-o")).write_text(json.dumps({"error": true, "seed": value_of(words, "--seed")}),
                                                   encoding="utf-8")
    wall = LONG_RUN_S if target < 0.02 else 3.0
    forecast = (None, None) if scene == "silent" else (1.1 * wall, 2.0 * wall) if scene == "late" else (0.8 * wall, 1.2 * wall)
    knows = scene != "silent"
    print(json.dumps({
        "version": "0", "scene_hash": scene, "stopped": "error target reached" if knows else "time limit reached",
        "wall_s": wall, "forecast": {"low_s": forecast[0], "high_s": forecast[1]},
        "error": {"estimate": error if knows else None, "high": 1.05 * error if knows else None},
        "photons": {"first_radius": 2.0} if scene == "noisy" else None, "words": words}))
    log = pathlib.Path(sys.argv[0]).parent / "log"
    with (log if log.exists() else pathlib.Path("/dev/null")).open("a", encoding="utf-8") as file:
        file.write(" ".join(words) + "\n")
    return 0


def compare(words):
    a, b = (json.loads(pathlib.Path(name).read_text(encoding="utf-8")) for name in words[1:3])
    relmse = 0.0 if a["seed"] == b["seed"] else a["error"] ** 2 + b["error"] ** 2
    print(json.dumps({"relmse": relmse}))
    return 0


if __name__ == "__main__":
    sys.exit({"render": render, "compare": compare}[sys.argv[1]](sys.argv[1:]))

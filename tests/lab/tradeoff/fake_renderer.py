"""Stands in for voxilux in the tests of coverage.py. A picture is a file with the size of its error and its seed.

Scenes: honest.toml; liar.toml has twice the error that it reports; late.toml takes longer than its forecast; silent.toml
knows neither; noisy.toml has references worse than its pictures; broken.toml cannot be rendered.
"""

import json
import pathlib

LONG_RUN_S = 40.0
FORECASTS = {"late": (1.1, 2.0), "silent": (None, None)}  # over the real time


class Refusal(Exception):
    pass


def value_of(words, flag):
    return words[words.index(flag) + 1]


def render(words):
    scene = pathlib.Path(words[1]).stem
    if scene == "broken":
        raise Refusal("broken.toml: no such file")
    target = float(value_of(words, "--error")[:-1]) / 100.0
    is_reference = int(value_of(words, "--seed")) > 1000
    error = (4.0 if is_reference and scene == "noisy" else 0.9) * target
    picture = {"error": 2.0 * error if scene == "liar" and not is_reference else error, "seed": value_of(words, "--seed")}
    pathlib.Path(value_of(words, "-o")).write_text(json.dumps(picture), encoding="utf-8")
    wall = LONG_RUN_S if target < 0.02 else 3.0
    low, high = FORECASTS.get(scene, (0.8, 1.2))
    knows = scene != "silent"
    return {"version": "0", "scene_hash": scene, "stopped": "error target reached" if knows else "time limit reached",
            "wall_s": wall, "forecast": {"low_s": low and low * wall, "high_s": high and high * wall},
            "error": {"estimate": error if knows else None, "high": 1.05 * error if knows else None},
            "photons": {"first_radius": 2.0} if scene == "noisy" else None}


def compare(words):
    a, b = (json.loads(pathlib.Path(name).read_text(encoding="utf-8")) for name in words[1:3])
    return {"relmse": 0.0 if a["seed"] == b["seed"] else a["error"] ** 2 + b["error"] ** 2}


COMMANDS = {"render": render, "compare": compare}

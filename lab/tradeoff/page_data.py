"""Reads what `voxilux tradeoff` has measured, and puts its numbers into words. Part of page.py.

All errors are roots of relMSE, where 0.01 is called 1 %.
"""

import html
import json
import math
import re


class Malformed(Exception):
    """What is wrong with the JSON file, and where."""


NUMBER, TEXT, FLAG = (int, float), str, bool


class Maybe:
    """A shape, or null, or no such key."""

    def __init__(self, shape):
        self.shape = shape


SPREAD = {"median": NUMBER, "low": NUMBER, "high": NUMBER}
SLOPE = Maybe({"value": NUMBER, "low": NUMBER, "high": NUMBER})
ERROR = {"total": NUMBER, "noise": NUMBER, "bias": Maybe(NUMBER), "bias_low": Maybe(NUMBER), "bias_high": Maybe(NUMBER),
         "is_limited": Maybe(FLAG)}
CLAIM = Maybe({"estimate": Maybe(NUMBER), "low": Maybe(NUMBER), "high": Maybe(NUMBER)})
PICTURED = Maybe([{"id": TEXT, "label": TEXT, "time_s": NUMBER, "error": NUMBER, "picture": Maybe(TEXT),
                   "difference": Maybe(TEXT), "is_reached": Maybe(FLAG)}])
RUN = {"id": TEXT, "knob": TEXT, "setting": TEXT, "is_default": FLAG, "settings": {}, "time_s": SPREAD,
       "load_s": NUMBER, "memory_bytes": NUMBER, "error": ERROR, "claimed": CLAIM, "picture": Maybe(TEXT),
       "difference": Maybe(TEXT), "slope": SLOPE, "differing_pixels": Maybe(NUMBER),
       "curve": Maybe([{"samples": NUMBER, "time_s": SPREAD, "error": ERROR}])}
SHAPE = {
    "version": TEXT, "scene": TEXT, "scene_hash": TEXT, "seed": NUMBER, "size": [NUMBER], "repeats": NUMBER,
    "wall_s": NUMBER,
    "machine": {"cpu": TEXT, "threads": NUMBER, "memory_gib": NUMBER},
    "device": {"name": TEXT, "driver": TEXT, "type": TEXT},
    "reference": {"picture": Maybe(TEXT), "samples": NUMBER, "time_s": NUMBER, "cached": FLAG, "noise": NUMBER,
                  "bias": Maybe(NUMBER)},
    "runs": [RUN],
    "knobs": [{"name": TEXT, "label": TEXT, "axis": TEXT, "why": TEXT, "runs": [TEXT], "slope": SLOPE,
               "left_out": Maybe([{"setting": TEXT, "why": TEXT}])}],
    "front": [TEXT],
    "effects": [{"name": TEXT, "on": FLAG, "reason": TEXT, "forced": FLAG, "ms_per_sample": Maybe(NUMBER),
                 "ms_low": Maybe(NUMBER), "ms_high": Maybe(NUMBER), "error": Maybe(NUMBER),
                 "error_low": Maybe(NUMBER), "error_high": Maybe(NUMBER), "is_beyond_noise": Maybe(FLAG)}],
    "equal_time": Maybe({"time_s": NUMBER, "runs": PICTURED}),
    "equal_error": Maybe({"error": NUMBER, "runs": PICTURED}),
    "fixed": Maybe([{"name": TEXT, "value": TEXT, "why": TEXT}]),
    "difference_scale": Maybe(TEXT), "difference_colours": Maybe([{"value": NUMBER, "colour": TEXT}]),
}


def check(value, shape, where):
    """Throws Malformed where `value` is not of the shape. Further keys are allowed."""
    if isinstance(shape, Maybe):
        if value is not None:
            check(value, shape.shape, where)
    elif isinstance(shape, dict):
        if not isinstance(value, dict):
            raise Malformed(f"{where} is not an object")
        for key, inner in shape.items():
            if key not in value and not isinstance(inner, Maybe):
                raise Malformed(f"{where}: '{key}' is missing")
            check(value.get(key), inner, f"{where}.{key}")
    elif isinstance(shape, list):
        if not isinstance(value, list):
            raise Malformed(f"{where} is not a list")
        for index, item in enumerate(value):
            check(item, shape[0], f"{where}[{index}]")
    elif not isinstance(value, shape) or (shape is NUMBER and isinstance(value, bool)):
        kind = {NUMBER: "a number", TEXT: "a text", FLAG: "true or false"}[shape]
        raise Malformed(f"{where} is not {kind}")


def refuse_constant(name):
    raise ValueError(f"{name} is no JSON number")


def load(path):
    """The price list of a JSON file, checked against SHAPE; its runs by id as "by_id"."""
    try:
        data = json.loads(path.read_text(encoding="utf-8"), parse_constant=refuse_constant)
    except OSError as error:
        raise Malformed(error.strerror) from error
    except ValueError as error:
        raise Malformed(f"is not JSON: {error}") from error
    check(data, SHAPE, "tradeoff")
    if len(data["size"]) != 2 or not data["runs"]:
        raise Malformed("tradeoff.size is not [width, height]" if data["runs"] else "tradeoff.runs is empty")
    data["by_id"] = {run["id"]: run for run in data["runs"]}
    named = [(i, "front") for i in data["front"]] + [(i, k["name"]) for k in data["knobs"] for i in k["runs"]]
    for name in ("equal_time", "equal_error"):
        named += [(one["id"], name) for one in (data.get(name) or {}).get("runs") or []]
    for run_id, where in named:
        if run_id not in data["by_id"]:
            raise Malformed(f"{where} names the run '{run_id}', which is not among tradeoff.runs")
    for run in data["runs"]:
        if not all(one["time_s"]["median"] > 0 for one in [run, *(run.get("curve") or [])]):
            raise Malformed(f"run '{run['id']}': its time is not above 0")
        run["words"] = name_of(data, run)
    for stop in data.get("difference_colours") or []:
        if not re.fullmatch("#[0-9a-f]{6}", stop["colour"]):
            raise Malformed(f"difference_colours: '{stop['colour']}' is not '#rrggbb'")
    if not data["front"]:
        raise Malformed("tradeoff.front is empty")
    return data


def esc(text):
    return html.escape(str(text), quote=True)


def percent(error):
    """An error in words: 0.0123 is 1.2 %. The space does not break."""
    if error is None:
        return "unknown"
    value = 100.0 * error
    digits = 0 if value == 0 or abs(value) >= 100 else max(0, 1 - math.floor(math.log10(abs(value))))
    return f"{value:.{digits}f}\u00a0%" if digits < 6 else "0\u00a0%"


def seconds(value):
    for least, unit, name in ((5400.0, 3600.0, "h"), (100.0, 60.0, "min"), (1.0, 1.0, "s")):
        if value >= least:
            return f"{value / unit:.3g}\u00a0{name}"
    return f"{1000.0 * value:.3g}\u00a0ms"


def spread(time_s):
    return f"{seconds(time_s['median'])} ({seconds(time_s['low'])} to {seconds(time_s['high'])})"


def name_of(data, run):
    """What a run is called: its parameter and setting."""
    label = next((knob["label"] for knob in data["knobs"] if knob["name"] == run["knob"]), run["knob"])
    return f"{label}: {run['setting']}"


def bias_words(error):
    """The bias with its interval; only the end of the interval where none was found."""
    if error["bias"] is None:
        return "unknown"
    if not error["bias_low"]:
        return f"\u2264\u00a0{percent(error['bias_high'])}"
    return f"{percent(error['bias'])} ({percent(error['bias_low'])} to {percent(error['bias_high'])})"


def slope_words(slope):
    return f"slope {slope['value']:.2f} ({slope['low']:.2f} to {slope['high']:.2f})" if slope else "no slope fitted"


def scene_words(path):
    """The scene without the folders above its own."""
    return "/".join(path.replace("\\", "/").split("/")[-2:])


def same_pixels(data, knob):
    """Settings of a parameter, other than the default, that change neither a compared pixel nor the error."""
    runs = [data["by_id"][i] for i in knob["runs"]]
    default = next((run for run in runs if run["is_default"]), default_of(data))
    return [run["setting"] for run in runs if not run["is_default"] and run.get("differing_pixels") == 0
            and default and run["error"]["total"] == default["error"]["total"] and knob["name"] != "samples"]


def distinct_runs(data):
    """The runs, with the default settings only once: they are the same run for every parameter."""
    first = default_of(data)
    return [run for run in data["runs"] if run is first or not run["is_default"]]


def default_of(data):
    return next((run for run in data["runs"] if run["is_default"]), None)

"""A price list that follows formulas, as `voxilux tradeoff` writes it, with pictures of its own.

    fake_price_list.py FOLDER     writes FOLDER/tradeoff.json and FOLDER/pictures
"""

import json
import math
import pathlib
import struct
import sys
import zlib

SIZE = (48, 32)


def png(path, colour_of):
    """An RGB picture of SIZE whose pixels are colour_of(x, y), three values in [0, 1]."""
    rows = b""
    for y in range(SIZE[1]):
        rows += b"\0" + bytes(max(0, min(255, round(255 * value))) for x in range(SIZE[0]) for value in colour_of(x, y))
    path.parent.mkdir(parents=True, exist_ok=True)
    chunks = [(b"IHDR", struct.pack(">IIBBBBB", *SIZE, 8, 2, 0, 0, 0)), (b"IDAT", zlib.compress(rows)), (b"IEND", b"")]
    with path.open("wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n")
        for kind, data in chunks:
            file.write(struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data)))


def grain(x, y, seed):
    """A number in [-1, 1] that looks like noise."""
    value = math.sin(12.9898 * x + 78.233 * y + 37.719 * seed) * 43758.5453
    return 2.0 * (value - math.floor(value)) - 1.0


def scene(x, y):
    light = 0.35 + 0.5 * y / SIZE[1]
    ball = (x - 24) ** 2 + (y - 17) ** 2 < 100
    return (0.8 * light, 0.3 * light, 0.2 * light) if ball else (0.3 * light, 0.45 * light, 0.7 * light)


def pictures(folder, name, error, seed):
    png(folder / "pictures" / f"{name}.png",
        lambda x, y: [value * (1.0 + 2.0 * error * grain(x, y, seed)) for value in scene(x, y)])
    png(folder / "pictures" / f"{name}-difference.png", lambda x, y: [4.0 * error * abs(grain(x, y, seed))] * 3)
    return {"picture": f"pictures/{name}.png", "difference": f"pictures/{name}-difference.png"}


def run(knob, setting, time_s, noise, bias, spp, is_default=False):
    total = math.sqrt(noise**2 + bias**2)
    return {"id": f"{knob}-{setting}", "knob": knob, "setting": setting, "is_default": is_default,
            "settings": {"spp": spp, "sequence": "sobol", "ao": "brute", "ao_rays": 1, "traversal": "wide"},
            "time_s": {"median": time_s, "low": 0.93 * time_s, "high": 1.12 * time_s}, "load_s": 0.03,
            "memory_bytes": 3250000,
            "error": {"total": total, "noise": noise, "bias": bias, "bias_low": 0.8 * bias, "bias_high": 1.2 * bias + 1e-3},
            "claimed": {"estimate": noise, "low": 0.9 * noise, "high": 1.15 * noise}, "picture": None,
            "difference": None}


def curve(one):
    """The same setting with a quarter of the samples, with as many, and with four times as many."""
    levels = []
    for factor in (0.25, 1.0, 4.0):
        other = run("", "", factor * one["time_s"]["median"], one["error"]["noise"] / math.sqrt(factor),
                    one["error"]["bias"], 0)
        levels.append({"samples": int(16 * factor), "time_s": other["time_s"], "error": other["error"]})
    return levels


def runs():
    """Samples fall as the root of time; shared occlusion is fast and biased; the rest is about the default."""
    found = [run("samples", str(n), 0.05 * n, 0.24 / math.sqrt(n), 0.0, n, n == 16) for n in (1, 4, 16, 64, 256)]
    found += [run("ao_cell", f"{px} px", 0.5 - 0.01 * px, 0.03 - 0.0005 * px, 0.002 * px, 16) for px in (2, 5, 10, 20)]
    found += [run("ao_rays", str(n), 0.5 + 0.3 * n, 0.06 / n**0.3, 0.0, 16) for n in (2, 4, 8)]
    found += [run("sequence", name, 0.81, noise, 0.0, 16) for name, noise in (("halton", 0.061), ("white", 0.083))]
    found += [run("traversal", name, time, 0.06, 0.0, 16) for name, time in (("dda", 3.1), ("brick8", 1.4), ("naadf", 0.95))]
    for one in found:
        if one["knob"] == "traversal":
            one["differing_pixels"] = 0
            one["error"] = dict(found[2]["error"])  # that of the default
        if one["knob"] != "samples":
            one["curve"], one["slope"] = curve(one), {"value": -0.49, "low": -0.55, "high": -0.43}
    found[4]["error"]["is_limited"] = True
    return found


def knob(name, label, axis, why, found, slope):
    return {"name": name, "label": label, "axis": axis, "why": why, "slope": slope,
            "runs": [one["id"] for one in found if one["knob"] == name],
            "left_out": [{"setting": "deep", "why": "needs more memory"}] if name == "traversal" else []}


def knobs(found):
    slope = {"value": -0.5, "low": -0.52, "high": -0.48, "of": "error against time"}
    return [knob("samples", "samples per pixel", "samples per pixel", "Light is a mean over random rays.", found,
                 slope),
            knob("ao_cell", "occlusion cell", "width of a cell (pixels)", "Pixels of a cell share their occlusion.", found, None),
            knob("ao_rays", "occlusion rays", "rays per sample", "More rays per hit, the rest as before.", found, None),
            knob("sequence", "sequence", "name", "How evenly samples spread.", found, None),
            knob("traversal", "traversal", "name", "The same picture through other structures.", found, None)]


def effect(name, on, reason, ms, error, forced=False):
    return {"name": name, "on": on, "reason": reason, "forced": forced, "ms_per_sample": ms,
            "ms_low": None if ms is None else 0.9 * ms, "ms_high": None if ms is None else 1.1 * ms, "error": error,
            "error_low": None if error is None else 0.95 * error, "error_high": None if error is None else 1.05 * error + 5e-4,
            "is_beyond_noise": None if error is None else error > 1e-3}


def effects():
    return [effect("ao", True, "surfaces see the sky", 12.3, 0.31), effect("sun", True, "the sun shines", 7.1, 0.58),
            effect("sky", True, "constant sky radiance", 0.4, 0.72),
            effect("caustics", False, "neither glass nor mirror is in the light's way", 31.0, 2e-4, forced=True),
            effect("spheres", False, "the scene has no analytic spheres", None, None)]


def front(found):
    best, ids = math.inf, []
    for one in sorted(found, key=lambda one: one["time_s"]["median"]):
        if one["error"]["total"] < best:
            best = one["error"]["total"]
            ids.append(one["id"])
    return ids


def group(folder, found, ids):
    chosen = [(seed, one) for seed, one in enumerate(found) if one["id"] in ids]
    return [{"id": one["id"], "label": one["id"].replace("-", " "), "time_s": one["time_s"]["median"],
             "error": one["error"]["total"]} | pictures(folder, one["id"], one["error"]["total"], seed)
            for seed, one in chosen]


def price_list(folder):
    """The whole JSON object; its pictures are written below the folder."""
    found = runs()
    png(folder / "pictures" / "reference.png", scene)
    return {
        "version": "0.1.0", "command": "tradeoff", "scene": "scenes/<made up>.toml", "scene_hash": "0123456789abcdef",
        "seed": 0, "size": list(SIZE), "repeats": 3, "wall_s": 93.1,
        "machine": {"cpu": "A processor with a long name @ 2.60GHz", "threads": 2, "memory_gib": 23.4},
        "device": {"name": "llvmpipe", "driver": "llvmpipe Mesa", "type": "cpu"},
        "reference": {"picture": "pictures/reference.png", "samples": 4096, "settings": {"spp": 4096}, "time_s": 204.0,
                      "cached": True, "noise": 0.0037, "bias": None,
                      "error": {"estimate": 0.0037, "low": 0.0035, "high": 0.0039, "confidence": 0.95}},
        "runs": found, "knobs": knobs(found), "front": front(found), "effects": effects(),
        "difference_scale": "relative difference of a pixel",
        "difference_colours": [{"value": 0.001, "colour": "#000004"}, {"value": 0.03, "colour": "#b73779"},
                               {"value": 1.0, "colour": "#fcfdbf"}],
        "equal_time": {"time_s": 0.8, "runs": group(folder, found, ("samples-16", "ao_cell-10 px", "sequence-white"))},
        "equal_error": {"error": 0.03, "runs": group(folder, found, ("samples-64", "ao_cell-5 px"))},
    }


def write(folder):
    """The JSON file of a price list in the folder."""
    file = pathlib.Path(folder) / "tradeoff.json"
    file.write_text(json.dumps(price_list(pathlib.Path(folder)), indent=1), encoding="utf-8")
    return file


if __name__ == "__main__":
    print(write(sys.argv[1]))

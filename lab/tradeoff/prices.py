"""Prices of many scenes as one small table: prices.csv, made from the tradeoff.json files of `voxilux tradeoff`.

A row is a setting at a sample count: the time of the samples and the error that was left. Only the parameters of
KEPT_KNOBS have rows. Lines that start with '#' hold what all rows have in common. Times are in seconds, errors are
roots of relMSE.
"""

import csv
import io
import json
import math
import pathlib

KEPT_KNOBS = ("samples", "ao_rays")
TEXTS = ("scene", "knob", "setting")
COUNTS = ("width", "height", "is_default", "spp", "ao_rays", "photons")
NUMBERS = ("time_s", "time_low_s", "time_high_s", "error", "noise", "bias")
PRECISION = 1e-9  # of sample counts, relative: far finer than the two digits that are printed
ABOUT = ("machine", "device", "version")


class Malformed(Exception):
    """What is wrong with a file of prices, and where."""


def scene_name(path):
    return pathlib.PurePosixPath(path).stem


def machine_of(price_list):
    """The machine in words: processor and threads."""
    machine = price_list["machine"]
    return f"{' '.join(machine['cpu'].split())}, {machine['threads']} threads"


def rows_of(price_list):
    """The rows of one tradeoff.json. A number that a run lacks is 0, and so is an unknown bias."""
    rows = []
    for run in price_list["runs"]:
        if run["knob"] not in KEPT_KNOBS:
            continue
        settings = run["settings"]
        for level in run.get("curve") or [dict(run, samples=settings["spp"])]:
            time, error = level["time_s"], level["error"]
            rows.append({
                "scene": scene_name(price_list["scene"]), "knob": run["knob"], "setting": run["setting"],
                "width": price_list["size"][0], "height": price_list["size"][1], "is_default": int(run["is_default"]),
                "spp": level["samples"], "ao_rays": settings.get("ao_rays") or 0,
                "photons": settings.get("photons") or 0, "time_s": time["median"], "time_low_s": time["low"],
                "time_high_s": time["high"], "error": error["total"], "noise": error["noise"],
                "bias": error["bias"] or 0.0})
    return rows


def gather(price_lists):
    """What the price lists have in common, and their rows. They must be of one machine, device and version."""
    about, rows = {}, []
    for price_list in price_lists:
        one = {"machine": machine_of(price_list), "version": price_list["version"],
               "device": f"{price_list['device']['name']}, {price_list['device']['driver']}"}
        if about and about != one:
            raise Malformed(f"{price_list['scene']} was measured on another machine, device or version")
        about = one
        rows += rows_of(price_list)
    return about, rows


def csv_text(about, rows):
    out = io.StringIO()
    for key in ABOUT:
        out.write(f"# {key}: {about[key]}\n")
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow(TEXTS + COUNTS + NUMBERS)
    for row in rows:
        writer.writerow([row[key] for key in TEXTS + COUNTS] + [f"{row[key]:.4g}" for key in NUMBERS])
    return out.getvalue()


def read_csv(file):
    """What csv_text wrote."""
    about, lines = {}, []
    for line in file.read_text(encoding="utf-8").splitlines():
        if line.startswith("# "):
            key, _, value = line[2:].partition(": ")
            about[key] = value
        else:
            lines.append(line)
    rows = []
    try:
        for number, row in enumerate(csv.DictReader(lines), 2 + len(about)):
            rows.append({key: row[key] for key in TEXTS} | {key: int(row[key]) for key in COUNTS}
                        | {key: float(row[key]) for key in NUMBERS})
    except (KeyError, TypeError, ValueError) as problem:
        raise Malformed(f"{file}:{number}: {problem}") from problem
    missing = [key for key in ABOUT if key not in about]
    if missing or not rows:
        raise Malformed(f"{file}: no rows, or no line '# {(missing or ABOUT)[0]}: ...'")
    return about, rows


def read_prices(files):
    """Prices of one .csv file, or of any number of tradeoff.json files."""
    files = [pathlib.Path(file) for file in files]
    if len(files) == 1 and files[0].suffix == ".csv":
        return read_csv(files[0])
    try:
        return gather([json.loads(file.read_text(encoding="utf-8")) for file in files])
    except (ValueError, KeyError, TypeError) as problem:
        raise Malformed(f"not the output of voxilux tradeoff: {type(problem).__name__}: {problem}") from problem


def scenes_of(rows):
    """Rows by scene, in their order."""
    scenes = {}
    for row in rows:
        scenes.setdefault(row["scene"], []).append(row)
    return scenes


class Curve:
    """Error and time of a setting of a scene against samples per pixel: straight lines in logarithms between measured
    points, and beyond them a power law with the fitted slope. A setting that was not measured counts as the default."""

    def __init__(self, rows, knob="samples", setting=None):
        own = [row for row in rows if row["knob"] == knob and setting in (None, row["setting"])]
        points = {row["spp"]: row for row in own or rows if row["error"] > 0.0 and (own or row["knob"] == "samples")}
        self.rows = [points[spp] for spp in sorted(points)]
        if len(self.rows) < 2:
            raise Malformed(f"{rows[0]['scene']}: fewer than two numbers of samples were measured")
        self.slopes = {key: fitted_slope(self.rows, key) for key in ("error", "time_s")}

    def at(self, spp, key):
        """The error or the time at a sample count."""
        rows = self.rows
        upper = next((i for i, row in enumerate(rows) if row["spp"] >= spp), len(rows))
        if 0 < upper < len(rows):
            a, b = rows[upper - 1], rows[upper]
            slope = math.log(b[key] / a[key]) / math.log(b["spp"] / a["spp"])
            return a[key] * (spp / a["spp"]) ** slope
        end = rows[0] if upper == 0 else rows[-1]
        return end[key] * (spp / end["spp"]) ** self.slopes[key]

    def is_measured(self, spp):
        return self.rows[0]["spp"] <= spp <= (1.0 + PRECISION) * self.rows[-1]["spp"]

    def samples_for(self, error):
        """The least sample count, a fraction, that leaves at most the error; None where none does."""
        if self.slopes["error"] >= 0.0:
            return None
        low, high = 1e-3, 1e9
        if self.at(high, "error") > error:
            return None
        while high / low > 1.0 + PRECISION:
            middle = math.sqrt(low * high)
            low, high = (low, middle) if self.at(middle, "error") <= error else (middle, high)
        return high


def fitted_slope(rows, key):
    """Least squares of the logarithms of `key` over those of samples."""
    xs, ys = [math.log(row["spp"]) for row in rows], [math.log(row[key]) for row in rows]
    mx, my = sum(xs) / len(xs), sum(ys) / len(ys)
    return sum((x - mx) * (y - my) for x, y in zip(xs, ys)) / sum((x - mx) ** 2 for x in xs)

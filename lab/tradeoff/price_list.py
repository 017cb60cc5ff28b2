#!/usr/bin/env python3
"""The price list, docs/price_list.md: a table of what accuracy costs in several scenes, and a picture of it.

    price_list.py                                             table and picture from prices.csv
    price_list.py --measure --voxilux build/release/voxilux   measures the scenes anew first; presets follow
    price_list.py --measure --scenes studio --keep            measures these, and keeps the prices of the others

Measuring runs `voxilux tradeoff` on every scene of SCENES, one after the other. Nothing else may keep the machine busy
meanwhile. The picture needs matplotlib.
"""

import argparse
import pathlib
import subprocess
import sys
import textwrap
import tempfile

import choose_presets
from prices import Curve, Malformed, csv_text, read_csv, read_prices, scenes_of

REFUSED, STALE, MISSING = 3, 5, 69
HERE = pathlib.Path(__file__).resolve().parent
TOP = HERE.parent.parent
PRICES, PRESETS = HERE / "prices.csv", TOP / "tools" / "quality_presets.inc"
BEGIN, END = "<!-- price list: begin -->", "<!-- price list: end -->"
SKY, LAMPS = ("256x192", "90s"), ("96x72", "120s")  # size of the picture, and time for all runs of a scene
SCENES = {"first_light": SKY, "night": SKY, "overcast": SKY, "slit": SKY, "spheres": SKY, "mixed": SKY,
          "studio": SKY, "far_hills": SKY, "bokeh": SKY,
          "emitters": SKY, "glass_block": LAMPS, "cornell": LAMPS, "mirror": LAMPS, "surgery": LAMPS, "random": LAMPS}
MOST_SAMPLES = 256  # asked of each scene; the time limit decides how many are measured
ERRORS = (0.10, 0.05, 0.02, 0.01)  # columns of the table
MOST_BEYOND = 16.0  # sample counts beyond the largest measured one by more than this factor get no time
COLOURS = ("#0072b2", "#c25400", "#00805e", "#b3508a", "#8a6100", "#2a8fd0", "#6a4fb3", "#5c5c5c")
KINDS = {"plain": "black", "photons": "#8a2b2b"}  # kinds of scenes, and the colours of their presets
MARKS = "osD^vP*Xdh<>"


# ---- the table --------------------------------------------------------------------------------------------------


def rounded(value):
    """Two significant digits, without an exponent."""
    return f"{float(f'{value:.2g}'):g}"


def time_text(value):
    for least, unit, name in ((5400.0, 3600.0, "h"), (100.0, 60.0, "min"), (1.0, 1.0, "s")):
        if value >= least:
            return f"{rounded(value / unit)} {name}"
    return f"{rounded(1000.0 * value)} ms"


def cell(curve, error):
    """Time to an error; in parentheses beyond what was measured, a dash far beyond."""
    spp = curve.samples_for(error)
    if spp is None or spp > MOST_BEYOND * curve.rows[-1]["spp"]:
        return "-"
    spp = max(spp, 1.0)  # no picture takes less than one sample
    text = time_text(curve.at(spp, "time_s"))
    return text if curve.is_measured(spp) else f"({text})"


def table_text(about, rows):
    """The lines between the markers."""
    heads = ["scene", "pixels", *(f"{100 * error:g} %" for error in ERRORS), "error falls as"]
    lines = ["| " + " | ".join(heads) + " |", "|---|---|" + "--:|" * len(ERRORS) + "---|"]
    for scene, own in scenes_of(rows).items():
        curve = Curve(own)
        slope = curve.slopes["error"] / curve.slopes["time_s"]
        lines.append("| " + " | ".join([f"`{scene}`", f"{own[0]['width']} x {own[0]['height']}",
                                        *(cell(curve, error) for error in ERRORS), f"time^{slope:.2f}"]) + " |")
    kinds = "".join(f"samples {kind} photons | error | s per megapixel | " for kind in ("without", "with"))
    lines += ["", f"| `--quality` | occlusion rays | {kinds.rstrip()}", "|---|" + "--:|" * 7]
    for preset in choose_presets.choose(rows):
        cells = [f"`{preset['name']}`", str(preset["ao_rays"])]
        for kind in KINDS:
            price = preset[kind]
            texts = (f"{100 * price['error']:.2g} %", rounded(price["seconds_per_megapixel"]))
            cells += [str(price["samples"]), *(text if price["is_measured"] else f"({text})" for text in texts)]
        lines.append("| " + " | ".join(cells) + " |")
    measured = f"Measured on {about['machine']}, {about['device']}, by voxilux {about['version']}."
    return "\n".join([*lines, "", textwrap.fill(measured, 110)])


def with_table(page, table):
    """The page with the table between its markers."""
    if page.count(BEGIN) != 1 or page.count(END) != 1 or page.index(BEGIN) > page.index(END):
        raise Malformed(f"price_list.md: the markers '{BEGIN}' and '{END}' must stand there once, in this order")
    before, rest = page.split(BEGIN)
    return f"{before}{BEGIN}\n{table}\n{END}{rest.split(END)[1]}"


# ---- the picture ------------------------------------------------------------------------------------------------


def draw(about, rows, file):
    """Error against seconds per megapixel, a line for each scene, dashed with photons; rings where the presets are."""
    import matplotlib
    matplotlib.use("agg")
    from matplotlib.figure import Figure
    from matplotlib.ticker import FuncFormatter

    figure = Figure(figsize=(9.0, 5.4), layout="constrained", facecolor="white")
    axes = figure.subplots()
    for index, (scene, own) in enumerate(scenes_of(rows).items()):
        megapixels = own[0]["width"] * own[0]["height"] / 1e6
        points = Curve(own).rows
        axes.plot([row["time_s"] / megapixels for row in points], [100 * row["error"] for row in points],
                  MARKS[index % len(MARKS)] + ("--" if own[0]["photons"] else "-"), color=COLOURS[index % len(COLOURS)],
                  lw=1.3, ms=6, label=scene)
    for kind, edge in KINDS.items():
        for preset in choose_presets.choose(rows):
            place = (preset[kind]["seconds_per_megapixel"], 100 * preset[kind]["error"])
            axes.plot(*place, "o", ms=15, mfc="none", mec=edge, mew=1.6, zorder=5)
            axes.annotate(preset["name"], place, xytext=(10, 8), textcoords="offset points", weight="bold", color=edge,
                          zorder=6, bbox={"fc": "white", "ec": "none", "alpha": 0.8, "pad": 1})
    axes.set(xscale="log", yscale="log", xlabel="time to take the samples (seconds per megapixel)",
             ylabel="error: root of relMSE (%)",
             title="Error against time: lines are scenes with default settings (dashed: with photons), rings are the "
             "medians of the "
             f"presets\n{about['machine']}; {about['device']}")
    axes.title.set_fontsize(9)
    for axis in (axes.xaxis, axes.yaxis):
        axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    axes.grid(color="#d9dde2")
    axes.spines[["top", "right"]].set_visible(False)
    axes.legend(frameon=False, fontsize=9, ncol=2)
    figure.savefig(file, dpi=100, metadata={"Software": None})


# ---- measuring --------------------------------------------------------------------------------------------------


def measure(options, folder):
    """Runs voxilux tradeoff on the scenes; its tradeoff.json files."""
    files = []
    for scene in options.scenes.split(","):
        target = pathlib.Path(folder) / scene
        size, limit = SCENES.get(scene, SKY)
        words = [options.voxilux, "tradeoff", f"scenes/{scene}.toml", "-o", str(target), "--quiet",
                 "--no-page", "--size", size, "--time-limit", limit, "--spp", str(MOST_SAMPLES)]
        print(f"price_list.py: {' '.join(words[1:])}", file=sys.stderr, flush=True)
        done = subprocess.run(words, check=False, stdout=subprocess.DEVNULL, cwd=TOP)
        if done.returncode != 0:
            raise Malformed(f"voxilux tradeoff {scene} ended with code {done.returncode}")
        files.append(target / "tradeoff.json")
    return files


def parse_arguments(words):
    parser = argparse.ArgumentParser(prog="price_list.py", description=__doc__.splitlines()[0])
    parser.add_argument("--measure", action="store_true", help="measure the scenes first")
    parser.add_argument("--voxilux", default=str(TOP / "build/release/voxilux"), help="the program, for --measure")
    parser.add_argument("--scenes", default=",".join(SCENES), help="names of scenes, for --measure")
    parser.add_argument("--keep", action="store_true", help="keep the prices of all other scenes")
    parser.add_argument("--from", dest="files", nargs="+", help="tradeoff.json files to take prices from, instead")
    parser.add_argument("--check", action="store_true", help="write nothing; exit code 5 when page or presets are stale")
    parser.add_argument("--page", type=pathlib.Path, default=TOP / "docs" / "price_list.md")
    parser.add_argument("--prices", type=pathlib.Path, default=PRICES)
    parser.add_argument("--presets", type=pathlib.Path, default=PRESETS)
    parser.add_argument("--picture", type=pathlib.Path, default=TOP / "docs" / "price_list.png")
    return parser.parse_args(words)


def update_prices(options):
    if options.files:
        about, rows = read_prices(options.files)
    else:
        with tempfile.TemporaryDirectory() as folder:
            about, rows = read_prices(measure(options, folder))
    if options.keep:
        known, old = read_csv(options.prices)
        if known != about:
            raise Malformed(f"{options.prices.name}: its prices are of another machine, device or version")
        measured = {row["scene"] for row in rows}
        rows = [row for row in old if row["scene"] not in measured] + rows
    choose_presets.choose(rows)  # refuses unusable prices before anything is written
    options.prices.write_text(csv_text(about, rows), encoding="utf-8")


def texts_of(options):
    """What the page and the presets should hold."""
    about, rows = read_csv(options.prices)
    return {options.page: with_table(options.page.read_text(encoding="utf-8"), table_text(about, rows)),
            options.presets: choose_presets.header_text(about, rows, choose_presets.choose(rows))}


def check(options):
    stale = [file.name for file, text in texts_of(options).items() if file.read_text(encoding="utf-8") != text]
    for name in stale:
        print(f"price_list.py: {name} does not follow {options.prices.name}; run lab/tradeoff/price_list.py", file=sys.stderr)
    return STALE if stale else 0


def main(words):
    options = parse_arguments(words)
    try:
        if options.check:
            return check(options)
        if options.measure or options.files:
            update_prices(options)
        for file, text in texts_of(options).items():
            file.write_text(text, encoding="utf-8")
        options.picture.parent.mkdir(parents=True, exist_ok=True)
        draw(*read_csv(options.prices), options.picture)
    except (Malformed, OSError) as problem:
        print(f"price_list.py: {problem}", file=sys.stderr)
        return REFUSED
    except ImportError:
        print("price_list.py: no picture; needs matplotlib: apt-get install python3-matplotlib", file=sys.stderr)
        return MISSING
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

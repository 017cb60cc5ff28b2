#!/usr/bin/env python3
"""The price list of the sky, in docs/price_list.md: what errors its tables have by size, steps and rounds.

    sky_errors.py build/release/tests/truth/unit_path_truth

Runs the test SkyPriceExternal, which measures them against the radiances of ../shared, and writes its rows into the page
and a picture beside it. The picture needs matplotlib.
"""

import pathlib
import re
import subprocess
import sys

REFUSED, MISSING = 3, 69
DOCS = pathlib.Path(__file__).resolve().parent.parent / "docs"
PAGE, PICTURE = DOCS / "price_list.md", DOCS / "sky_errors.png"
BEGIN, END = "<!-- sky: begin -->", "<!-- sky: end -->"
HEAD = ("| | sun at 10 degrees or more | sun at 0.5 and 2 degrees | sun below the horizon |\n|---|---|---|---|\n")
SUNS = ("10 degrees or more", "0.5 and 2 degrees", "below the horizon")


def rows_of(text):
    """(name, [(rms of red, green, blue) for each group of suns], line of the page) of the rows of a test's output."""
    rows = []
    for line in text.splitlines():
        cells = [cell.strip() for cell in line.split("|")[1:-1]]
        if len(cells) != 5 or not re.fullmatch(r"\w+ \d+", cells[0]):
            continue
        rms = [tuple(float(value) for value in cell.split("(")[0].split()) for cell in cells[1:4]]
        rows.append((cells[0], rms, "| " + " | ".join(cells[:4]) + " |\n"))
    return rows


def draw(rows, file):
    """The largest error of the three colours, a panel for each thing that is varied, a line for each group of suns."""
    import matplotlib
    matplotlib.use("agg")
    from matplotlib.figure import Figure

    figure = Figure(figsize=(9.0, 3.4), layout="constrained", facecolor="white")
    panels = figure.subplots(1, 3, sharey=True)
    for axes, what in zip(panels, ("rows", "rounds", "steps")):
        own = [(name.split()[1], rms) for name, rms, _ in rows if name.startswith(what)]
        for sun, label in enumerate(SUNS):
            axes.plot([number for number, _ in own], [max(rms[sun]) for _, rms in own], "o-", lw=1.3, label=label)
        axes.set(yscale="log", xlabel={"rows": "rows of the table above the horizon", "rounds": "rounds of gathering",
                                       "steps": "steps of a march"}[what])
        axes.grid(color="#d9dde2")
        axes.spines[["top", "right"]].set_visible(False)
    panels[0].set_ylabel("rms error, worst colour (%)")
    panels[0].legend(frameon=False, fontsize=8, title="sun")
    figure.savefig(file, dpi=100, metadata={"Software": None})


def main(words):
    if len(words) != 1:
        print(__doc__, file=sys.stderr)
        return REFUSED
    done = subprocess.run([words[0], "--gtest_filter=SkyPriceExternal.*"], check=False, capture_output=True, text=True)
    rows = rows_of(done.stdout)
    if done.returncode != 0 or not rows:
        print(f"sky_errors.py: {words[0]} gave no rows: is ../shared there?", file=sys.stderr)
        return MISSING
    print(done.stdout)
    page = PAGE.read_text(encoding="utf-8")
    before, rest = page.split(BEGIN)
    _, after = rest.split(END)
    PAGE.write_text(before + BEGIN + "\n" + HEAD + "".join(line for _, _, line in rows) + END + after, encoding="utf-8")
    draw(rows, PICTURE)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

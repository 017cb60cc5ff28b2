#!/usr/bin/env python3
"""The price list of a scene as one HTML file: what accuracy costs in time.

    page.py tradeoff.json page.html

reads what `voxilux tradeoff` has measured; pictures are found beside the JSON file. The page holds its plots and
pictures itself and names no other file or address. It needs matplotlib.
"""

import base64
import pathlib
import sys

from page_data import (Malformed, bias_words, default_of, esc, load, percent, same_pixels, scene_words, seconds,
                       slope_words, spread)
from page_plots import DARK, LIGHT, Plots, plot_all, plot_effects, plot_knob, plot_parts

USAGE, REFUSED, MISSING, UNWRITABLE = 2, 3, 69, 73

STYLE = """
:root { color-scheme: light dark; --paper: #fff; --card: #f6f7f9; --ink: #16191d; --soft: #69717c; --grid: #d9dde2; LIGHT }
@media screen and (prefers-color-scheme: dark) {
  :root { --paper: #14171b; --card: #1d2126; --ink: #e9ecf0; --soft: #98a1ac; --grid: #353b43; DARK } }
* { box-sizing: border-box }
body { margin: 0 auto; padding: 1.5rem; max-width: 74rem; background: var(--paper); color: var(--ink);
  font: 16px/1.55 system-ui, "DejaVu Sans", sans-serif }
h1 { font-size: 1.9rem; line-height: 1.2; margin: 0 0 .3rem } h2 { margin: 2.6rem 0 .5rem; font-size: 1.35rem }
h3 { margin: 0 0 .3rem; font-size: 1.02rem } p { max-width: 52rem; margin: .5rem 0 } code { font-size: .92em }
.soft, figcaption, .facts { color: var(--soft) } .facts { margin: 0 }
.tiles, .knobs, .row { display: grid; gap: 1rem; margin: 1.2rem 0 }
.tiles { grid-template-columns: repeat(auto-fit, minmax(13rem, 1fr)) }
.knobs { grid-template-columns: repeat(auto-fit, minmax(24rem, 1fr)) }
.row { grid-template-columns: repeat(auto-fill, minmax(13rem, 1fr)) }
.tile, .knobs figure { background: var(--card); border-radius: 8px; padding: .9rem 1rem }
.tile b { display: block; font-size: 1.55rem; line-height: 1.25 }
figure { margin: 0; break-inside: avoid } figcaption { font-size: .9rem; line-height: 1.4 }
svg { width: 100%; height: auto; display: block } svg text { font-family: inherit }
img { width: 100%; display: block; background: var(--grid); image-rendering: auto; margin-bottom: .3rem }
.scale { max-width: 30rem; font-size: .85rem } .scale i { display: block; height: .9rem; print-color-adjust: exact }
.scale div { display: flex; justify-content: space-between }
.wide { overflow-x: auto } table { border-collapse: collapse; width: 100%; font-size: .92rem }
th, td { text-align: left; padding: .3rem .7rem .3rem 0; border-bottom: 1px solid var(--grid); vertical-align: top }
td.n, th.n { text-align: right; white-space: nowrap; font-variant-numeric: tabular-nums }
summary { cursor: pointer; margin: 1rem 0 .5rem } dt { font-weight: 600; margin-top: .6rem } dd { margin: 0 0 0 1rem }
@media print { body { max-width: none; padding: 0; font-size: 11px } h2 { break-after: avoid } .tile, .knobs figure { border: 1px solid #ccc } }
"""


def colours(names):
    return " ".join(f"--s{index}: {colour};" for index, colour in enumerate(names))


def section(title, *parts):
    return "\n".join([f"<section><h2>{esc(title)}</h2>", *(part for part in parts if part), "</section>"])


def paragraph(text):
    return f"<p>{text}</p>"


def table(heads, rows, caption):
    """Heads that start with '#' are of columns of numbers. Cells are HTML."""
    kinds = [' class="n"' if head.startswith("#") else "" for head in heads]
    lines = [f'<div class="wide"><table aria-label="{esc(caption)}"><thead><tr>']
    lines += [f'<th scope="col"{kind}>{esc(head.lstrip("#"))}</th>' for head, kind in zip(heads, kinds)]
    lines.append("</tr></thead><tbody>")
    lines += ["<tr>" + "".join(f"<td{kind}>{cell}</td>" for cell, kind in zip(row, kinds)) + "</tr>" for row in rows]
    return "".join(lines) + "</tbody></table></div>"


def image(folder, name, alt):
    """A PNG file as an element that holds it; a line of text where there is none."""
    if name is None:
        return '<p class="soft">no picture was kept</p>'
    try:
        content = base64.b64encode((folder / name).read_bytes()).decode("ascii")
    except OSError:
        return f'<p class="soft">{esc(name)} is not there</p>'
    return f'<img alt="{esc(alt)}" src="data:image/png;base64,{content}">'


# ---- the sections, from top to bottom ---------------------------------------------------------------------------


def tile(head, value, words):
    return f'<div class="tile"><span class="soft">{esc(head)}</span><b>{esc(value)}</b>{esc(words)}</div>'


def headline(data):
    machine, device, size = data["machine"], data["device"], data["size"]
    front = [data["by_id"][i] for i in data["front"]]
    tiles = [tile(head, percent(run["error"]["total"]), f"in {seconds(run['time_s']['median'])}: {run['words']}")
             for head, run in (("fastest", front[0]), ("default settings", default_of(data)), ("least error", front[-1]))
             if run]
    slope = next((k["slope"] for k in data["knobs"] if k["name"] == "samples" and k["slope"]), None)
    if slope and slope["value"] < 0:
        tiles.append(tile("half the error by samples", f"{2 ** (-1 / slope['value']):.1f} times the time",
                          f"{slope_words(slope)}; -0.5 is that of random samples"))
    facts = [f"{size[0]} x {size[1]} pixels on {device['name']} ({device['driver']})",
             f"{machine['cpu']}, {machine['threads']} threads, {machine['memory_gib']:.3g} GiB",
             f"voxilux {data['version']}, seed {data['seed']}, {len(data['runs'])} settings, {data['repeats']} times each, "
             f"{seconds(data['wall_s'])} in all"]
    return "\n".join([f"<header><h1>What accuracy costs in time: {esc(scene_words(data['scene']))}</h1>",
                      *(f'<p class="facts">{esc(fact)}</p>' for fact in facts),
                      f'<div class="tiles">{"".join(tiles)}</div></header>'])


def how_to_read(data):
    return section("How to read this page", paragraph(
        "Every approximation that this scene uses was set to several values, one at a time, all others at their default. "
        "Each picture was compared with a reference that took far longer. Its <b>error</b> is the root of relMSE: the typical "
        "difference of a pixel from the reference, relative to the pixel's brightness. 1 % is hard to see, 10 % is plain "
        "grain. <b>Time</b> is that of taking the samples, without loading. In every plot, lower and further left is better. "
        "<b>Noise</b> is the part of the error that more samples remove; <b>bias</b> is the part that stays."))


def overview(plots, data):
    return section("Error against time", f"<figure>{plot_all(plots, data)}<figcaption>", paragraph(
        "One mark for each setting, at the median of its times; its bar reaches from the fastest to the slowest repeat. "
        "Thin lines follow a setting to fewer and more samples. "
        "Both axes are logarithmic, so a power law is a straight line: dotted lines are fits, their slopes stand in the legend "
        "with 95 % intervals. Random samples have slope -0.5: four times the time for half the error. The staircase is the Pareto "
        "front, the least error that any setting reached in that time."), "</figcaption></figure>")


def front_table(data):
    rows, before = [], None
    for number, run in enumerate((data["by_id"][i] for i in data["front"]), 1):
        error, time = run["error"], run["time_s"]
        step = ""
        if before:
            step = (f"{time['median'] / before['time_s']['median']:.2g} times the time, "
                    f"{error['total'] / max(before['error']['total'], 1e-12):.2g} times the error")
        rows.append([str(number), esc(run["words"]) + (" (default)" if run["is_default"] else ""), spread(time),
                     percent(error["total"]), percent(error["noise"]), esc(bias_words(error)), step])
        before = run
    heads = ["#", "setting (all else default)", "#time: median (lowest to highest)", "#error", "#noise",
             "bias (\u2264: none found)", "step from the line above"]
    return section("The Pareto front, setting by setting", paragraph(
        "Settings for which no other one was both faster and better, fastest first. All others cost more than they give."),
        table(heads, rows, "Pareto front"))


def knobs(plots, data):
    figures = []
    for index, knob in enumerate(data["knobs"]):
        words = [knob["why"], f"Changed: {knob['axis']}."]
        if knob["slope"]:
            words.append(f"Fitted: {slope_words(knob['slope'])}.")
        words += [f"Left out: {one['setting']}, {one['why']}." for one in knob.get("left_out") or []]
        same = same_pixels(data, knob)
        if same:
            words.append(f"Every pixel is the same as with the default settings: {', '.join(same)}.")
        figures.append(f"<figure><h3>{esc(knob['label'])}</h3>{plot_knob(plots, data, index)}"
                       f"<figcaption>{esc(' '.join(words))}</figcaption></figure>")
    return section("One parameter at a time", paragraph(
        "Coloured: the values of this parameter; a line follows a value to fewer and more samples. Grey: all other runs. A ring "
        "marks the default settings, a hollow mark an error so small that the reference's own noise blurs it."),
        f'<div class="knobs">{"".join(figures)}</div>')


def parts(plots, data):
    return section("Noise and bias apart", paragraph(
        "Bias is found from pairs of pictures with independent random numbers: the product of their differences from the "
        "reference has no noise in its mean. Error squared is noise squared plus bias squared. A bar that reaches the left "
        "edge means that no bias was found, and that it is at most as large as the bar's right end."),
        f"<figure>{plot_parts(plots, data)}</figure>")


def scale_bar(data):
    """The colours of difference maps, evenly spaced, with their values below."""
    stops = data.get("difference_colours") or []
    if len(stops) < 2:
        return ""
    ticks = "".join(f"<span>{percent(stop['value'])}</span>" for stop in stops)
    return (f'<div class="scale" role="img" aria-label="Colours of differences"><i style="background:linear-gradient(to right,'
            f'{",".join(stop["colour"] for stop in stops)})"></i><div>{ticks}</div></div>')


def picture_row(data, folder, key):
    group = data.get(key)
    if not group or not group["runs"]:
        return ""
    reference = data["reference"]
    cards = [f"<figure>{image(folder, reference['picture'], 'The reference')}<figcaption><b>reference</b><br>"
             f"{reference['samples']} samples per pixel, own noise {percent(reference['noise'])}</figcaption></figure>"]
    for run in group["runs"]:
        words = f"{seconds(run['time_s'])}, error {percent(run['error'])}"
        cards.append(f"<figure>{image(folder, run['picture'], 'Picture: ' + run['label'] + ', ' + words)}"
                     f"{image(folder, run['difference'], 'Difference from the reference: ' + run['label'])}"
                     f"<figcaption><b>{esc(run['label'])}</b><br>{esc(words)}"
                     f"{'' if run.get('is_reached', True) else '; did not get there'}</figcaption></figure>")
    title = (f"Pictures at equal time: about {seconds(group['time_s'])}" if key == "equal_time"
             else f"Pictures at equal error: about {percent(group['error'])}")
    scale = data.get("difference_scale") or "black where a pixel is right, brighter the further it is from the reference"
    return section(title, paragraph(f"Above the picture, below it its difference from the reference. Scale: {esc(scale)}."),
                   scale_bar(data), f'<div class="row">{"".join(cards)}</div>')


def effects(plots, data):
    used = [effect for effect in data["effects"] if effect["on"]]
    forced = [effect for effect in data["effects"] if effect["forced"]]
    measured = [effect for effect in used + forced if effect["ms_per_sample"] is not None or effect["error"] is not None]
    rows = [[esc(effect["name"]), "used" if effect["on"] else "left out", esc(effect["reason"]),
             "not measured" if effect["ms_per_sample"] is None else f"{effect['ms_per_sample']:.3g} ms",
             ("not measured" if effect["error"] is None else percent(effect["error"]))
             + (" (within noise)" if effect["is_beyond_noise"] is False else "")] for effect in data["effects"]]
    return section("What each effect costs and gives", paragraph(
        "Left: time that a sample of all pixels takes longer with the effect. Right: error of the picture without it. Both come "
        "from pictures with and without the effect and with the same random numbers, so that noise cancels. Whiskers are the "
        "lowest and highest repeat on the left, a 95 % interval on the right. Hatched: an effect that the plan leaves out, "
        "forced on; where its error is within noise, leaving it out was right and saves the time shown."),
        f"<figure>{plot_effects(plots, measured)}</figure>" if measured else "",
        table(["effect", "plan", "why", "#time per sample", "#error"], rows, "Effects"))


def fixed_rows(data):
    rows = [[esc(one["name"]), esc(one["value"]), esc(one["why"])] for one in data.get("fixed") or []]
    named = {knob["name"] for knob in data["knobs"]} | {one["name"] for one in data.get("fixed") or []}
    for key in sorted({key for run in data["runs"] for key in run["settings"]}):
        values = {str(run["settings"].get(key)) for run in data["runs"]}
        if len(values) == 1 and key not in named:
            rows.append([esc(key), esc(values.pop()), "the same in all runs"])
    return rows


def method(data):
    reference = data["reference"]
    bias = f"its bias about {percent(reference['bias'])}, " if reference["bias"] is not None else ""
    rows = fixed_rows(data)
    return section("How this was measured", "<dl>"
        "<dt>The reference</dt><dd>" + esc(
            f"{reference['samples']} samples per pixel in {seconds(reference['time_s'])}"
            f"{' (kept from an earlier run)' if reference['cached'] else ''}; {bias}its own noise {percent(reference['noise'])}, "
            "which is taken out of all errors here. Differences smaller than that mean nothing.") + "</dd>"
        "<dt>Times</dt><dd>" + esc(
            f"Each setting ran {data['repeats']} times, in turns with the others. The median counts; the lowest and the highest "
            "are the range. Other work on the machine makes the range wide.") + "</dd>"
        "<dt>Slopes</dt><dd>Straight lines fitted to the logarithms of error and time, with 95 % intervals.</dd></dl>",
        paragraph("What was held fixed, and why:") + table(["setting", "value", "why"], rows, "Fixed settings") if rows else "")


def all_runs(data):
    rows = []
    for run in data["runs"]:
        error, claimed = run["error"], run["claimed"]
        said = "none"
        if claimed and claimed["estimate"] is not None:
            said = f"{percent(claimed['estimate'])} ({percent(claimed['low'])} to {percent(claimed['high'])})"
        rows.append([esc(run["words"]) + (" (default)" if run["is_default"] else ""), spread(run["time_s"]),
                     seconds(run["load_s"]), f"{run['memory_bytes'] / 2**20:.1f} MiB", percent(error["total"]),
                     percent(error["noise"]), esc(bias_words(error)), said])
    heads = ["setting", "#time: median (lowest to highest)", "#loading", "#memory", "#error", "#noise",
             "bias (\u2264: none found)", "#error that the render reports"]
    return section("All runs", table(heads, rows, "All runs"))


def page(plots, data, folder):
    """The whole page as a text."""
    style = STYLE.replace("LIGHT", colours(LIGHT)).replace("DARK", colours(DARK))
    body = [headline(data), how_to_read(data), overview(plots, data), front_table(data), knobs(plots, data),
            parts(plots, data), picture_row(data, folder, "equal_time"), picture_row(data, folder, "equal_error"),
            effects(plots, data), method(data), all_runs(data)]
    return "\n".join(["<!DOCTYPE html>", '<html lang="en"><head><meta charset="utf-8">',
                      '<meta name="viewport" content="width=device-width, initial-scale=1">',
                      f"<title>Price list of {esc(scene_words(data['scene']))}</title><style>{style}</style></head><body>",
                      *body, "</body></html>", ""])


def fail(code, text):
    print(f"page.py: {text}", file=sys.stderr)
    return code


def main(words):
    if len(words) != 2:
        return fail(USAGE, "usage: page.py tradeoff.json page.html")
    source, target = map(pathlib.Path, words)
    try:
        data = load(source)
    except Malformed as problem:
        return fail(REFUSED, f"{source}: {problem}")
    try:
        import matplotlib  # here, so that a broken file is found without it
        matplotlib.use("svg")
        import matplotlib.ticker
    except ImportError:
        return fail(MISSING, "needs matplotlib: apt-get install python3-matplotlib, or pip install matplotlib")
    text = page(Plots(matplotlib), data, source.parent)
    try:
        target.write_text(text, encoding="utf-8")
    except OSError as problem:
        return fail(UNWRITABLE, f"{target}: {problem.strerror}")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

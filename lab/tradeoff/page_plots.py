"""The plots of a price list as elements of HTML, drawn by matplotlib. Part of page.py."""

import io
import math
import re

from page_data import default_of, distinct_runs, esc, percent, seconds, slope_words

LEAST_ERROR = 1e-5  # relative; stands on a logarithmic axis for an error of 0 or below
LABEL_GAP = 12.5  # points between the middles of two labels
LEAST_SPAN = 8.0  # least ratio of the ends of a small plot's axes, so that a small difference does not look large
NEAR = 6.0  # ratio of times within which a small plot follows a setting to other sample counts
MARKS = "osD^vP*Xdh<>"

# Okabe and Ito's colours that differ for every eye (Color Universal Design, 2008), darker on white, lighter on black.
LIGHT = ("#0072b2", "#c25400", "#00805e", "#b3508a", "#8a6100", "#2a8fd0", "#6a4fb3", "#5c5c5c")
DARK = ("#5ab4ea", "#f08a4b", "#2fc79b", "#e79ac6", "#e6b84a", "#9ad1f5", "#b3a1f0", "#b5b5b5")


class Plots:
    """Draws with matplotlib. Colours are placeholders that the page turns into its light or dark ones."""

    INK, SOFT, GRID = "#010101", "#020202", "#030303"

    def __init__(self, matplotlib):
        from matplotlib.figure import Figure

        self.figure_of = Figure
        self.ticker = matplotlib.ticker
        self.count = 0
        matplotlib.rcParams.update({
            "svg.fonttype": "none", "svg.hashsalt": "voxilux", "font.size": 10, "text.color": self.INK,
            "font.family": "sans-serif", "axes.edgecolor": self.SOFT, "axes.labelcolor": self.INK,
            "xtick.color": self.SOFT, "ytick.color": self.SOFT, "xtick.labelcolor": self.INK,
            "ytick.labelcolor": self.INK, "axes.spines.top": False, "axes.spines.right": False,
            "grid.color": self.GRID, "axes.grid": True, "axes.axisbelow": True, "legend.frameon": False,
            "axes.titlesize": 11, "path.simplify": False})

    @staticmethod
    def series(index):
        return f"#04{index % len(LIGHT):02x}04"

    def start(self, width, height, columns=1):
        """An empty figure of this size in inches, and its axes."""
        figure = self.figure_of(figsize=(width, height), layout="constrained")
        axes = figure.subplots(1, columns, squeeze=False, sharey=True)[0]
        figure.patch.set_visible(False)
        for one in axes:
            one.patch.set_visible(False)
        return figure, axes

    def finish(self, figure, alt):
        """The figure as an element of HTML."""
        buffer = io.StringIO()
        figure.savefig(buffer, format="svg", metadata={"Date": None, "Creator": None, "Format": None, "Type": None})
        self.count += 1
        text = buffer.getvalue()
        text = re.sub(r"<metadata>.*?</metadata>", "", text[text.index("<svg"):], flags=re.DOTALL)
        opening, text = text.split(">", 1)
        view_box = re.search(r'viewBox="[^"]*"', opening)[0]
        text = text.replace("xlink:href", "href")
        text = re.sub(r'(\bid="|url\(#|href="#)', rf"\g<1>p{self.count}-", text)
        for colour, name in ((self.INK, "ink"), (self.SOFT, "soft"), (self.GRID, "grid")):
            text = text.replace(colour, f"var(--{name})")
        text = re.sub(r"#04(0[0-9a-f])04", lambda found: f"var(--s{int(found[1], 16)})", text)
        return f'<svg role="img" aria-label="{esc(alt)}" {view_box}>{text}'

    def log_axes(self, axes, times, errors):
        """Times in seconds and errors in percent, both logarithmic."""
        axes.set(xscale="log", yscale="log", xlabel="time to take the samples (s)",
                 ylabel="error: root of relMSE (%)", xlim=limits(times), ylim=limits(errors))
        self.log_ticks(axes.xaxis, times, 1.0)
        self.log_ticks(axes.yaxis, errors, 100.0)

    def log_ticks(self, axis, values, scale):
        """Ticks at 1, at 1 and 3, or at 1, 2 and 5 of each decade, as the range of values leaves room."""
        decades = math.log10(max(values) / min(values))
        steps = (1.0,) if decades > 3.5 else (1.0, 3.0) if decades > 1.8 else (1.0, 2.0, 5.0)
        axis.set_major_locator(self.ticker.LogLocator(10.0, steps, numticks=40))
        axis.set_major_formatter(self.ticker.FuncFormatter(lambda value, _: f"{scale * value:.4g}"))
        axis.set_minor_locator(self.ticker.NullLocator())


def limits(values):
    """A logarithmic axis for the values, with room at both ends."""
    margin = (max(values) / min(values)) ** 0.08 * 1.12
    return min(values) / margin, max(values) * margin


def shown(error):
    return max(error or 0.0, LEAST_ERROR)


def draw_run(axes, run, colour, mark, label=None):
    """A mark with the range of its times; hollow where the reference's own noise limits the error."""
    time = run["time_s"]
    bars = [[max(0.0, time["median"] - time["low"])], [max(0.0, time["high"] - time["median"])]]
    fill = "none" if run["error"].get("is_limited") else colour
    axes.errorbar(time["median"], shown(run["error"]["total"]), xerr=bars, fmt=mark, color=colour, mfc=fill, ms=6.5,
                  elinewidth=1.2, capsize=2.5, label=label, zorder=4)


def draw_curve(axes, levels, colour, **look):
    """A line through the prices of one setting at several sample counts."""
    axes.plot([one["time_s"]["median"] for one in levels], [shown(one["error"]["total"]) for one in levels], color=colour,
              **{"lw": 1.2, "zorder": 3, **look})


def draw_default(axes, plots, run, label="default settings"):
    if run:
        axes.plot(run["time_s"]["median"], shown(run["error"]["total"]), "o", ms=14, mfc="none", mec=plots.INK,
                  mew=1.2, label=label, zorder=5, ls="none")


def draw_slope(axes, slope, runs, colour):
    """The fitted power law through the geometric mean of its runs."""
    times = [run["time_s"]["median"] for run in runs]
    middle_t = math.exp(sum(map(math.log, times)) / len(times))
    middle_e = math.exp(sum(math.log(shown(run["error"]["total"])) for run in runs) / len(runs))
    ends = [min(times), max(times)]
    axes.plot(ends, [middle_e * (t / middle_t) ** slope["value"] for t in ends], ":", color=colour, lw=1.6, zorder=2)


def draw_noise_floor(axes, plots, data):
    noise = data["reference"]["noise"]
    low, high = axes.get_ylim()
    if noise > low:
        axes.axhspan(low, min(noise, high), color=plots.GRID, alpha=0.6, lw=0, zorder=0,
                     label="below the reference's own noise")


def name_front(figure, axes, plots, front):
    """Numbers the runs of the front, beside their marks; pushes numbers down until none covers another."""
    figure.draw_without_rendering()  # settles the layout
    points = 72.0 / figure.dpi
    lowest = math.inf
    for number, run in enumerate(front, 1):
        place = (run["time_s"]["median"], shown(run["error"]["total"]))
        height = axes.transData.transform(place)[1] * points
        lowest = min(height - 11, lowest - LABEL_GAP)
        axes.annotate(f"{number}. {run['words']}", place, xytext=(-10, lowest - height), textcoords="offset points",
                      ha="right", va="center", fontsize=9, annotation_clip=False, zorder=6,
                      arrowprops={"arrowstyle": "-", "color": plots.SOFT, "lw": 0.7, "shrinkA": 0, "shrinkB": 3})


def cover(a, b):
    """Whether two boxes (x0, y0, x1, y1) share a point."""
    return a[0] < b[2] and b[0] < a[2] and a[1] < b[3] and b[1] < a[3]


def name_runs(figure, axes, runs):
    """Writes the setting beside each run, on the first side where it covers neither a mark nor another name."""
    figure.draw_without_rendering()
    points = 72.0 / figure.dpi
    places = [(run["time_s"]["median"], shown(run["error"]["total"])) for run in runs]
    centres = [axes.transData.transform(place) * points for place in places]
    taken = [(x - 5, y - 5, x + 5, y + 5) for x, y in centres]
    for run, place, (x, y) in zip(runs, places, centres):
        width = 2 + 5.4 * len(run["setting"])
        boxes = [(x + dx, y + dy, x + dx + width, y + dy + 9)
                 for dx, dy in ((6, 5), (6, -14), (-6 - width, 5), (-6 - width, -14), (6, 17), (6, -26))]
        box = next((one for one in boxes if not any(cover(one, other) for other in taken)), boxes[0])
        taken.append(box)
        axes.annotate(run["setting"], place, xytext=(box[0] - x, box[1] - y), textcoords="offset points", fontsize=9,
                      zorder=6)


def ranges(runs):
    return [run["time_s"]["median"] for run in runs], [shown(run["error"]["total"]) for run in runs]


def plot_all(plots, data):
    """Every run, the front, the fitted slopes; thin lines follow a setting to other sample counts."""
    figure, (axes,) = plots.start(10.5, 6.6)
    runs = distinct_runs(data)
    times, errors = ranges(runs)
    plots.log_axes(axes, times, errors)
    axes.set_xlim(min(times) / (max(times) / min(times)) ** 0.28 / 1.5)  # room for the names of the front
    axes.set_ylim(min(errors) / (max(errors) / min(errors)) ** 0.14 / 1.3)
    for index, knob in enumerate(data["knobs"]):
        own = [run for run in runs if run["knob"] == knob["name"]]
        colour, label = plots.series(index), knob["label"] + (f": {slope_words(knob['slope'])}" if knob["slope"] else "")
        for run in own:
            draw_run(axes, run, colour, MARKS[index % len(MARKS)], label)
            draw_curve(axes, run.get("curve") or [], colour, lw=0.7, alpha=0.5, zorder=2)
            label = None
        if knob["slope"] and own:
            draw_slope(axes, knob["slope"], own, colour)
    front = [data["by_id"][i] for i in data["front"]]
    axes.step([run["time_s"]["median"] for run in front] + [axes.get_xlim()[1]],
              [shown(run["error"]["total"]) for run in front] + [shown(front[-1]["error"]["total"])], where="post",
              color=plots.INK, lw=1.5, zorder=3, label="Pareto front: nothing is both faster and better")
    draw_default(axes, plots, default_of(data))
    draw_noise_floor(axes, plots, data)
    axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.1), ncol=2, fontsize=9)
    name_front(figure, axes, plots, front)
    return plots.finish(figure, f"Error against time of {len(data['runs'])} runs; the table of the front has its numbers")


def widened(values, factor):
    """The values, with ends added so that the axis spans at least the factor."""
    middle = math.sqrt(min(values) * max(values))
    half = math.sqrt(max(factor, max(values) / min(values)))
    return [middle / half, middle * half]


def near(run):
    """The run and its other sample counts within a factor of NEAR of its time, which a small plot shows."""
    time = run["time_s"]["median"]
    return [run] + [one for one in run.get("curve") or [] if time / NEAR <= one["time_s"]["median"] <= time * NEAR]


def plot_knob(plots, data, index):
    """The settings of one parameter, each a line over the measured sample counts; all other runs in grey."""
    knob = data["knobs"][index]
    runs = [data["by_id"][i] for i in knob["runs"]]
    curves = any(run.get("curve") for run in runs)
    figure, (axes,) = plots.start(5.2, 3.9 + (0.2 * len(runs) if curves else 0.0))
    first = default_of(data)
    times, errors = ranges([one for run in runs + ([first] if first else []) for one in near(run)])
    plots.log_axes(axes, widened(times, LEAST_SPAN), widened(errors, LEAST_SPAN))
    for run in data["runs"]:
        axes.plot(run["time_s"]["median"], shown(run["error"]["total"]), "o", ms=3.5, color=plots.SOFT, alpha=0.35)
    if not curves:
        draw_curve(axes, runs, plots.series(index))
    for number, run in enumerate(runs):
        colour, mark = (plots.series(number), number) if curves else (plots.series(index), index)
        words = f"{run['setting']}: {slope_words(run.get('slope'))}" if curves else None
        draw_curve(axes, run.get("curve") or [], colour)
        draw_run(axes, run, colour, MARKS[mark % len(MARKS)], words)
    draw_default(axes, plots, first, None if curves else "default settings")
    if curves:
        axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.17), fontsize=8.5, ncol=1)
    else:
        name_runs(figure, axes, runs)
    return plots.finish(figure, f"Error against time for {knob['label']}: "
                        + ", ".join(f"{run['setting']} {seconds(run['time_s']['median'])} "
                                    f"{percent(run['error']['total'])}" for run in runs))


def plot_parts(plots, data):
    """Noise and bias of each run, side by side on one scale."""
    runs = distinct_runs(data)
    figure, (axes,) = plots.start(10.5, 1.3 + 0.27 * len(runs))
    values = [max(value, LEAST_ERROR) for run in runs for key in ("noise", "bias", "bias_high")
              if (value := run["error"].get(key))] or [LEAST_ERROR, 1.0]
    axes.set(xscale="log", xlim=limits(values), ylim=(len(runs) - 0.5, -0.5), xlabel="error: root of relMSE (%)")
    plots.log_ticks(axes.xaxis, values, 100.0)
    axes.set_yticks(range(len(runs)), [run["words"] for run in runs])
    left = axes.get_xlim()[0]
    for row, run in enumerate(runs):
        error = run["error"]
        axes.plot(shown(error["noise"]), row, "o", color=plots.series(0), ms=7, zorder=4,
                  label=None if row else "noise: falls with more samples")
        if error["bias"] is None:
            continue
        low, high = max(error["bias_low"] or 0.0, left), max(error["bias_high"] or 0.0, left)
        axes.plot([low, high], [row, row], color=plots.series(1), lw=3 if error["bias_low"] else 1.2, solid_capstyle="butt",
                  zorder=3, label=None if row else "range of the bias; thin, to the left edge: none was found")
        if error["bias_low"]:
            axes.plot(error["bias"], row, "D", color=plots.series(1), ms=7, zorder=4)
    axes.plot([], [], "D", color=plots.series(1), ms=7, label="bias: stays however many samples are taken")
    axes.legend(loc="lower center", bbox_to_anchor=(0.5, 1.0), ncol=2, fontsize=9)
    return plots.finish(figure, "Noise and bias of every run; the table of all runs has the numbers")


def plot_effects(plots, effects):
    """What each effect costs in ms and what leaving it out costs in error."""
    figure, (cost, loss) = plots.start(10.5, 1.2 + 0.42 * len(effects), 2)
    for axes, key, low, high, scale, words, colour in (
            (cost, "ms_per_sample", "ms_low", "ms_high", 1.0, "time per sample of all pixels (ms)", plots.series(0)),
            (loss, "error", "error_low", "error_high", 100.0, "error without it: root of relMSE (%)", plots.series(1))):
        for row, effect in enumerate(effects):
            if (value := effect[key]) is None:
                axes.annotate("not measured", (0, row), xytext=(5, 0), textcoords="offset points", va="center", fontsize=9)
                continue
            ends = [scale * (effect[end] if effect[end] is not None else value) for end in (low, high)]
            bars = [[max(0.0, scale * value - ends[0])], [max(0.0, ends[1] - scale * value)]]
            axes.barh(row, scale * value, 0.6, color=colour, alpha=0.45 if effect["forced"] else 0.9,
                      hatch="///" if effect["forced"] else None, edgecolor=plots.SOFT, lw=0.6,
                      xerr=bars, error_kw={"ecolor": plots.INK, "lw": 1.2, "capsize": 3})
            noise = " within noise" if key == "error" and effect["is_beyond_noise"] is False else ""
            number = f"{scale * value:.3g}" if key != "error" else percent(value)
            axes.annotate(number + noise, (max(ends[1], scale * value, 0.0), row), xytext=(6, 0),
                          textcoords="offset points", va="center", fontsize=9)
        axes.set_xlabel(words)
        axes.margins(x=0.22)
        axes.set_xlim(left=min(0.0, axes.get_xlim()[0] if any((e[key] or 0) < 0 for e in effects) else 0.0))
    cost.set_yticks(range(len(effects)), [e["name"] + (" (forced on)" if e["forced"] else "") for e in effects])
    cost.set_ylim(len(effects) - 0.4, -0.6)
    return plots.finish(figure, "; ".join(f"{e['name']}: {e['ms_per_sample'] or 0:.3g} ms, {percent(e['error'])}"
                                          for e in effects))

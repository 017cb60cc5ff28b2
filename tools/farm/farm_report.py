"""The line of progress, and the report at the end of a job."""

import json
import math
import sys
import time

from farm_job import Job
from farm_picture import Picture
from farm_work import Work

FASTEST, SLOWEST = 0.8, 1.3  # of the time that is expected to remain


def duration(seconds: float) -> str:
    whole = round(min(seconds, 1e9))
    if whole < 100:
        return f"{whole} s"
    return f"{whole // 60} min {whole % 60:02} s" if whole < 3600 else f"{whole // 3600} h {whole % 3600 // 60:02} min"


class Progress:
    """On standard error: a line that is overwritten, or an object per line, or nothing."""

    def __init__(self, mode: str, quiet: bool):
        self.start_s = time.monotonic()
        self.mode = mode if mode != "auto" else ("line" if sys.stderr.isatty() and not quiet else "never")
        self.last_s = -math.inf

    def show(self, done: float, samples: int, workers: int, remaining_s: float | None, error: float | None) -> None:
        now = time.monotonic()
        if self.mode == "never" or now - self.last_s < 1.0:
            return
        self.last_s = now
        elapsed_s = now - self.start_s
        if self.mode == "json":
            row = {"done": done, "samples": samples, "workers": workers, "elapsed_s": elapsed_s,
                   "remaining_s": remaining_s}
            if remaining_s is not None:
                row |= {"remaining_low_s": FASTEST * remaining_s, "remaining_high_s": SLOWEST * remaining_s}
            print(json.dumps(row if error is None else row | {"error": error}), file=sys.stderr, flush=True)
            return
        left = "? left" if remaining_s is None else (f"{duration(FASTEST * remaining_s)} to "
                                                     f"{duration(SLOWEST * remaining_s)} left")
        line = f"{100 * done:5.1f} %  {samples} samples  {workers} workers  {duration(elapsed_s)}, {left}"
        line += "" if error is None else f"  error {100 * error:.2g} %"
        print(f"\r{line}\x1b[K", end="", file=sys.stderr, flush=True)

    def finish(self) -> None:
        if self.mode == "line":
            print("\r\x1b[K", end="", file=sys.stderr, flush=True)


def worker_rows(work: Work, wall_s: float) -> list[dict]:
    return [{"worker": worker, "units": speed.units, "units_per_s": speed.units_per_s,
             "utilisation": min(1.0, speed.busy_s / wall_s)} for worker, speed in sorted(work.speeds.items())]


def known_high(error: dict) -> float:
    return math.inf if error["high"] is None else error["high"]


def facts_of(job: Job, pictures: list[Picture], wall_s: float) -> dict:
    """The facts of the report. For a film: the fewest samples and the largest error of a frame."""
    outputs = [output for picture in pictures if picture.samples for output in picture.outputs]
    errors = [picture.error for picture in pictures if picture.error]
    return {"samples": min((picture.samples for picture in pictures), default=0),
            "parts": sum(part.count for part in job.parts.values()), "retries": job.retries, "workers": 0,
            "wall_s": wall_s, "cpu_s": sum(part.cpu_s for part in job.parts.values()),
            "error": max(errors, key=known_high) if errors else None,
            "output": outputs[0] if len(outputs) == 1 else outputs}


def report_of(work: Work, facts: dict) -> dict:
    """The report: the keys that the command line promises, and what one more worker would have saved."""
    rows = worker_rows(work, facts["wall_s"])
    count = len(rows)
    busy_s = sum(speed.busy_s for speed in work.speeds.values())
    return {**facts, "workers": count, "per_worker": rows,
            "one_worker_more_saves_s": busy_s / (count * (count + 1)) if count else None}


def print_missed_error(facts: dict, target: float) -> None:
    """Prints the warning that render would print."""
    high = (facts["error"] or {}).get("high")
    error = "an unknown error" if high is None else f"an error of up to {100 * high:.3g} %"
    print(f"warning: stopped after {facts['samples']} samples with {error}, over the {100 * target:g}% asked for",
          file=sys.stderr, flush=True)


def print_report(report: dict, options: dict) -> None:
    if options["json"] == "-":
        print(json.dumps(report), flush=True)
        return
    if options["json"]:
        with open(options["json"], "w", encoding="utf-8") as stream:
            json.dump(report, stream, indent=2)
    if options["quiet"]:
        return
    print(f"samples   {report['samples']} per pixel, of {report['parts']} parts, {report['retries']} tried again")
    for row in report["per_worker"]:
        print(f"worker    {row['worker']}  {row['units']} units, {row['units_per_s']:.3g} per s, busy "
              f"{100 * row['utilisation']:.0f} %")
    print(f"time      {report['wall_s']:.1f} s wall, {report['cpu_s']:.1f} s CPU")
    if report["one_worker_more_saves_s"]:
        print(f"next      one worker more would have saved {report['one_worker_more_saves_s']:.0f} s")
    if report["error"] and report["error"]["estimate"] is not None:
        print(f"error     {report['error']['estimate']:.3g} (up to {report['error']['high']:.3g})")
    for file in report["output"] if isinstance(report["output"], list) else [report["output"]]:
        print(f"wrote     {file}")

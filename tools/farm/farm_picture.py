"""From parts to pictures: merges run one after the other, beside the loop that hands out tasks."""

import concurrent.futures
import json
import math
import pathlib
import subprocess
import time

from farm_job import Job, Part, Stop
from farm_ranges import Ranges, size, text, union

MAX_PARTS = 32  # of a frame, before they are merged into one part
PREVIEW_S = 120.0  # from one preview to the next, and at least
PREVIEW_PAUSES = 100.0  # times as long as a merge takes
ROUND_MARGIN = 1.05  # more samples than the error law says
MIN_ROUND = 1.1  # times as many samples as before


def next_round(samples: int, error: float | None, target: float, most: int) -> int:
    """Samples after which the error is expected to be below the target: noise falls as samples^-0.5."""
    factor = 2.0 if error is None else max(MIN_ROUND, ROUND_MARGIN * (error / target) ** 2)
    return min(most, math.ceil(samples * factor))


def run_merge(options: dict, files: list[pathlib.Path], outputs: list[str], partial: bool) -> dict:
    """{report} of the sum, or {code, line} of the failure."""
    words = [options["binary"], "merge", *map(str, files), "--reproducible", "-q", "--json", "-",
             *options["tone_words"]]
    for output in outputs:
        words += ["-o", output]
    words += ["--partial"] if partial else []
    words += ["--allow-mixed-devices"] if options["allow_mixed_devices"] else []
    begin = time.monotonic()
    done = subprocess.run(words, capture_output=True, text=True, check=False, start_new_session=True)
    if done.returncode != 0:
        return failure_of("merge", done)
    return {"report": json.loads(done.stdout), "seconds": time.monotonic() - begin}


def failure_of(command: str, done: subprocess.CompletedProcess) -> dict:
    """The exit code and the last line of our binary. A binary that was killed is a temporary failure."""
    if done.returncode < 0:
        return {"code": 75, "line": f"{command} was killed by signal {-done.returncode}"}
    return {"code": done.returncode, "line": done.stderr.strip().split("\n")[-1].removeprefix("voxilux: ")}


class Picture:
    """A frame and what is known of its picture."""

    def __init__(self, frame: int, outputs: list[str], end: int):
        self.frame, self.outputs = frame, outputs
        self.end = end  # samples of this round
        self.rounds = 1
        self.is_written = False
        self.error: dict | None = None
        self.samples = 0

    def take_frame(self, part: Part) -> None:
        """Takes a frame that was rendered as a whole."""
        self.is_written, self.samples = True, part.samples
        self.error = part.error


class Merger:
    """Merges in the background. `finished()` returns their results."""

    def __init__(self, options: dict, job: Job):
        self.options, self.job = options, job
        self.pool = concurrent.futures.ThreadPoolExecutor(1)
        self.running: tuple | None = None
        self.last_s, self.took_s = time.monotonic(), 0.0

    def start(self, picture: Picture, parts: list[Part], outputs: list[str], partial: bool) -> None:
        files = [self.job.folder / part.file for part in parts]
        future = self.pool.submit(run_merge, self.options, files, outputs, partial)
        self.running = (picture, parts, outputs, partial, future)

    def write(self, picture: Picture, partial: bool) -> None:
        """Writes the picture of all parts that are there."""
        self.start(picture, self.job.of_frame(picture.frame), picture.outputs, partial)

    def compact(self, picture: Picture) -> None:
        """Merges all parts that are there into one, and writes a preview."""
        parts = sorted(self.job.of_frame(picture.frame), key=lambda part: part.ranges)
        name = f"parts/f{picture.frame:06d}.m{len(parts)}.{time.time_ns():x}.exr"
        outputs = [str(self.job.folder / name), str(self.job.folder / "preview.png")]
        self.start(picture, parts, outputs, True)

    def wants_compaction(self, picture: Picture) -> bool:
        count = len(self.job.of_frame(picture.frame))
        pause_s = max(PREVIEW_S, PREVIEW_PAUSES * self.took_s)
        return count >= MAX_PARTS or (count > 1 and time.monotonic() - self.last_s > pause_s)

    def wait(self) -> tuple | None:
        """Waits for the merge, and returns finished()."""
        if self.running is not None:
            concurrent.futures.wait([self.running[-1]])
        return self.finished()

    def finished(self) -> tuple | None:
        """Returns (picture, was partial, report) once after each merge, and None otherwise. Damaged parts are dropped; the
        report is then the list of their samples."""
        if self.running is None or not self.running[-1].done():
            return None
        picture, parts, outputs, partial, future = self.running
        self.running = None
        result = future.result()
        if "code" in result:
            return picture, partial, self.drop_damaged(parts, result)
        self.last_s, self.took_s = time.monotonic(), result["seconds"]
        if outputs is not picture.outputs:
            ranges = union([one for part in parts for one in part.ranges], [])
            self.job.add(Part(picture.frame, ranges, str(pathlib.Path(outputs[0]).relative_to(
                self.job.folder)), "merge", sum(part.wall_s for part in parts), sum(part.cpu_s for part in parts),
                of=[part.file for part in parts], count=sum(part.count for part in parts)))
        return picture, partial, result["report"]

    def drop_damaged(self, parts: list[Part], failure: dict) -> Ranges:
        """Drops the part whose file the failure names."""
        for part in parts:
            if failure["code"] == 3 and failure["line"].startswith(f"{self.job.folder / part.file}: "):
                self.job.drop(part.file)
                self.job.retries += 1
                return part.ranges
        raise Stop(failure["code"], failure["line"])


def missing_line(job: Job, pictures: list[Picture]) -> str:
    """The samples that an unfinished job lacks, in words."""
    rows = []
    for picture in pictures:
        missing = job.missing(picture.frame, picture.end)
        if missing and not picture.is_written:
            rows.append(f"samples {text(missing)} of frame {picture.frame}" if len(pictures) > 1
                        else f"samples {text(missing)}")
    if len(rows) > 3:
        rows = [*rows[:3], f"those of {len(rows) - 3} frames more"]
    return ", ".join(rows) if rows else "nothing"


def samples_of(job: Job, picture: Picture) -> int:
    return size(job.samples(picture.frame))

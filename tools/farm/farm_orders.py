"""The order that a worker gets for a task: the renders that it consists of."""

import json
import pathlib
import subprocess

from farm_job import Stop
from farm_picture import failure_of
from farm_ranges import text
from farm_work import Task

FIRST_ROUND = 64  # samples, where there is no forecast


def frame_words(options: dict, frame: int) -> list[str]:
    return ["--frame", str(frame)] if options["is_animation"] else []


def order_of(options: dict, task: Task, by_frames: bool, patience_s: float) -> dict:
    """A task of a film is a range of its frames, a task of a picture a range of its samples."""
    if by_frames:
        units = [frame_unit(options, index) for index in range(task.first, task.end)]
    else:
        ranges = [(task.first, task.end)]
        units = [{"frame": task.lane, "ranges": ranges,
                  "files": [f"parts/f{task.lane:06d}.s{task.first}-{task.end - 1}.exr"],
                  "words": [*frame_words(options, task.lane), "--samples", text(ranges)]}]
    return {"units": units, "words": [], "patience_s": patience_s}


def frame_unit(options: dict, index: int) -> dict:
    frame, outputs = options["frames"][index], options["outputs"][index]
    words = [*frame_words(options, frame), "--spp", str(options["spp"]), *options["tone_words"]]
    if options["error"] is not None:
        words += ["--error", str(options["error"])]
    files = [f"parts/f{frame:06d}.{i}{pathlib.Path(output).suffix}" for i, output in enumerate(outputs)]
    return {"frame": frame, "ranges": [], "files": files, "words": words}


def first_round(options: dict, frame: int) -> int:
    """The samples that the renderer's pilot would ask for in a render of its own."""
    words = [options["binary"], "plan", options["scene"], *options["words"], "--error", str(options["error"]), "--spp",
             str(options["spp"]), *frame_words(options, frame), "-q", "--json", "-"]
    done = subprocess.run(words, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise Stop(*failure_of("plan", done).values())
    forecast = json.loads(done.stdout).get("forecast") or {}
    return min(forecast.get("samples") or FIRST_ROUND, options["spp"])

"""voxilux farm: renders a picture or a film on the workers of a Dask cluster. The binary starts this with one argument,
the job as JSON. A part is a pure function of the scene and of the numbers of its samples, so whatever happens to
workers, the sum has the bytes of one render."""

import json
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import time
import uuid

from farm_cluster import Cluster, Member
from farm_job import Job, Part, Stop, files_of_scene, say, sha256_of
from farm_picture import Merger, Picture, missing_line, next_round, samples_of
from farm_ranges import size, text
from farm_report import Progress, print_report, report_of
from farm_work import MAX_TRIES, Task, Work

NEVER = (2, 3, 70)  # exit codes of a render that will be the same on every worker
FIRST_ROUND = 64  # samples, where no forecast tells the number
POLL_S = 0.25
END_S = 2.0  # of a time limit, beside twice the last merge, for writing the picture


class Farm:
    """One job, from its scene to its pictures."""

    def __init__(self, options: dict):
        self.options = options
        self.start_s = time.monotonic()
        self.signals = 0
        self.frames: list[int] = options["frames"]
        self.files = files_of_scene(pathlib.Path(options["scene"]), options["overrides"])
        self.scene = next(iter(self.files))
        manifest = {"id": uuid.uuid4().hex, "build": sha256_of(pathlib.Path(options["binary"])), "scene": self.scene,
                    "words": options["words"], "frames": self.frames}
        self.job = Job(pathlib.Path(options["job"]).absolute(), manifest)
        self.job.start(self.files, options["resume"])
        self.work = Work()
        self.merger = Merger(options, self.job)
        self.progress = Progress(options["progress"], options["quiet"])
        self.pictures = [Picture(frame, outputs, options["spp"])
                         for frame, outputs in zip(self.frames, options["outputs"])]
        self.cluster: Cluster | None = None
        self.by_frames = False
        self.last_line = ""

    # What is to do

    def open_cluster(self) -> None:
        words = self.options["words"]
        setup = {"id": self.job.manifest["id"], "folder": str(self.job.folder), "scene": self.scene, "words": words,
                 "build": self.job.manifest["build"], "binary": self.options["worker_binary"],
                 "files": self.job.manifest["files"]}
        self.cluster = Cluster(self.options, setup, self.files)
        address = self.cluster.dashboard()
        if address and not self.options["quiet"]:
            say(f"dashboard: {address}")

    def plan_work(self) -> None:
        """Whole frames where there are enough of them for all workers, else samples."""
        workers = max(len(self.cluster.groups), len(self.cluster.members), 1)
        self.by_frames = bool(self.options["whole_frames"]) or len(self.frames) >= 2 * workers
        if self.by_frames:
            done = {part.frame for part in self.job.parts.values() if not part.ranges}
            for index, picture in enumerate(self.pictures):
                picture.is_written = picture.frame in done
                if not picture.is_written:
                    self.work.add(0, [(index, index + 1)])
            return
        for picture in self.pictures:
            if self.options["error"] is not None:
                picture.end = max(self.first_round(picture), samples_of(self.job, picture))
            self.work.add(picture.frame, self.job.missing(picture.frame, picture.end))

    def first_round(self, picture: Picture) -> int:
        """What the pilot of the renderer says, as for a render of its own."""
        words = [self.options["binary"], "plan", self.options["scene"], *self.options["words"], "--error",
                 str(self.options["error"]), "--spp", str(self.options["spp"]), *self.frame_words(picture.frame),
                 "-q", "--json", "-"]
        done = subprocess.run(words, capture_output=True, text=True, check=False)
        if done.returncode != 0:
            raise Stop(done.returncode, done.stderr.strip().split("\n")[-1].removeprefix("voxilux: "))
        forecast = json.loads(done.stdout).get("forecast") or {}
        return min(forecast.get("samples") or FIRST_ROUND, self.options["spp"])

    def frame_words(self, frame: int) -> list[str]:
        return ["--frame", str(frame)] if self.options["is_animation"] else []

    def order_of(self, task: Task, worker: str) -> dict:
        """What a worker is told of a task."""
        if self.by_frames:
            units = [self.frame_unit(index) for index in range(task.first, task.end)]
        else:
            name = f"parts/f{task.lane:06d}.s{task.first}-{task.end - 1}.exr"
            units = [{"frame": task.lane, "ranges": [(task.first, task.end)], "files": [name],
                      "words": [*self.frame_words(task.lane), "--samples", text([(task.first, task.end)])]}]
        return {"units": units, "words": [], "patience_s": self.work.patience_s(task, worker)}

    def frame_unit(self, index: int) -> dict:
        frame, outputs = self.frames[index], self.options["outputs"][index]
        words = [*self.frame_words(frame), "--spp", str(self.options["spp"]), *self.options["tone_words"]]
        if self.options["error"] is not None:
            words += ["--error", str(self.options["error"])]
        files = [f"parts/f{frame:06d}.{i}{pathlib.Path(output).suffix}" for i, output in enumerate(outputs)]
        return {"frame": frame, "ranges": [], "files": files, "words": words}

    # The loop

    def run(self) -> int:
        self.open_cluster()
        listen(self)
        self.cluster.look()
        self.plan_work()
        while not all(picture.is_written for picture in self.pictures):
            if self.signals or self.is_out_of_time():
                return self.end_early()
            for member in self.cluster.look():
                self.lose(member)
            self.hand_out()
            for member, kind, future in self.cluster.collect(POLL_S):
                self.take(member, kind, future)
            if not self.by_frames:
                self.look_at_pictures()
            self.show()
        self.progress.finish()
        self.report()
        self.remove_folder()
        return 0 if self.reached_error() else 4

    def hand_out(self) -> None:
        ready = max(len(self.cluster.ready()), 1)
        for member in self.cluster.idle():
            task = self.work.next_task(member.address, ready, time.monotonic())
            if task is None:
                return
            self.cluster.run(member, task, self.order_of(task, member.address))

    def take(self, member: Member, kind: str, future) -> None:
        """A worker has answered, or failed to."""
        if future is not member.future:
            return  # of a worker that was given up
        task, member.task = member.task, None
        if future.status != "finished":
            self.cluster.failed(member, f"Dask says {future.status}: {self.cause_of(future)}")
            if task is not None:
                self.give_back(task, member)
            elif member.state == "asked":
                self.cluster.ask(member)
        elif kind == "asked":
            self.cluster.answer(member, future.result())
        elif kind == "storing":
            self.cluster.ask(member)
        else:
            self.take_results(member, task, future.result())

    @staticmethod
    def cause_of(future) -> str:
        return str(future.exception()) if future.status == "error" else "it is gone"

    def take_results(self, member: Member, task: Task, results: list[dict]) -> None:
        failed = results[-1] if results[-1]["code"] not in (0, 4) else None
        began_s = task.runs.get(member.address, time.monotonic())
        units = self.order_of(task, member.address)["units"]
        for unit, result in zip(units, results):
            if result["code"] in (0, 4):
                self.keep(unit, result, member)
        if failed is None:
            member.failures = 0
            self.work.end(task, member.address, task.units(), time.monotonic() - began_s)
            return
        if failed["code"] in NEVER:
            raise Stop(failed["code"], failed["line"].removeprefix("voxilux: "))
        self.last_line = failed["line"].removeprefix("voxilux: ")
        task.first += len(results) - 1 if self.by_frames else 0  # the frames before are done
        self.give_back(task, member)
        self.cluster.failed(member, self.last_line)

    def give_back(self, task: Task, member: Member) -> None:
        self.job.retries += 1
        self.work.fail(task, member.address)
        if task.tries >= MAX_TRIES:
            raise Stop(75, f"tried {MAX_TRIES} times: {self.last_line or 'the worker died'}")

    def keep(self, unit: dict, result: dict, member: Member) -> None:
        """Adds a part to the job, or a frame to the film."""
        for name, data in zip(unit["files"], result.get("bytes", [])):
            temporary = self.job.folder / (name + ".new")
            temporary.write_bytes(data)
            os.replace(temporary, self.job.folder / name)
        part = Part(unit["frame"], [tuple(one) for one in unit["ranges"]], unit["files"][0], member.address,
                    result["wall_s"], result["cpu_s"], result["sha256"][0])
        if not self.by_frames:
            if not self.job.add(part) and part.file not in self.job.parts:
                (self.job.folder / part.file).unlink(missing_ok=True)
            return
        picture = self.pictures[self.frames.index(unit["frame"])]
        if picture.is_written:
            return
        for name, output in zip(unit["files"], picture.outputs):
            shutil.move(self.job.folder / name, output)
        (self.job.folder / part.file).touch()  # says that the frame is done
        self.job.add(part)
        picture.is_written, picture.samples = True, result["samples"]
        picture.error = {"estimate": result["error"], "high": result["error"]}

    def lose(self, member: Member) -> None:
        if member.task is not None:
            member.future.cancel()
            self.last_line = f"worker {member.address} died"
            self.give_back(member.task, member)

    def look_at_pictures(self) -> None:
        ended = self.merger.finished()
        if ended is not None:
            self.take_picture(*ended)
        if self.merger.running is not None:
            return
        for picture in self.pictures:
            is_round_done = self.work.is_idle(picture.frame) and not self.job.missing(picture.frame, picture.end)
            if picture.is_written or not self.job.of_frame(picture.frame):
                continue
            if is_round_done and (self.options["error"] is None or picture.error is not None):
                return self.merger.write(picture)
            if is_round_done or self.merger.wants_compaction(picture):
                return self.merger.compact(picture)

    def take_picture(self, picture: Picture, partial: bool, report) -> None:
        """A merge has ended. `report` is a list of samples where a part was damaged."""
        if isinstance(report, list):
            return self.work.add(picture.frame, report)
        picture.samples = report["samples"]
        target = self.options["error"]
        if not partial:
            picture.error, picture.is_written = report["error"], True
        elif target is not None and samples_of(self.job, picture) >= picture.end:
            high = report["error"]["high"]
            if (high is not None and high <= target) or picture.end >= self.options["spp"]:
                picture.error = report["error"]
                return None
            picture.rounds += 1
            picture.end = next_round(picture.end, high, target, self.options["spp"])
            self.work.add(picture.frame, self.job.missing(picture.frame, picture.end))
        return None

    # The end

    def is_out_of_time(self) -> bool:
        limit_s = self.options["time_limit_s"]
        return limit_s is not None and time.monotonic() - self.start_s > limit_s - END_S - 2.0 * self.merger.took_s

    def end_early(self) -> int:
        """Pictures of what is there."""
        self.progress.finish()
        self.write_what_is_there()
        self.report()
        say(f"{'interrupted' if self.signals else 'no time left'}; {self.missing()}; --resume goes on")
        return 130 if self.signals else 4

    def write_what_is_there(self) -> None:
        while self.merger.running is not None:
            self.merger.finished()
            time.sleep(0.05)
        for picture in self.pictures:
            if not picture.is_written and not self.by_frames and self.job.of_frame(picture.frame):
                self.merger.start(picture, self.job.of_frame(picture.frame), picture.outputs, True)
                result = self.merger.running[-1].result()
                self.merger.running = None
                picture.samples = result.get("report", {}).get("samples", 0)
                picture.error = result.get("report", {}).get("error")

    def missing(self) -> str:
        if self.by_frames:
            frames = [picture.frame for picture in self.pictures if not picture.is_written]
            return f"{len(frames)} of {len(self.pictures)} frames are missing, from {frames[0]} on" if frames else \
                "nothing is missing"
        return f"missing: {missing_line(self.job, self.pictures)}"

    def reached_error(self) -> bool:
        target = self.options["error"]
        highs = [(picture.error or {}).get("high") for picture in self.pictures]
        return target is None or all(high is not None and high <= target for high in highs)

    def remove_folder(self) -> None:
        shutil.rmtree(self.job.folder, ignore_errors=True)

    def show(self) -> None:
        error = next((picture.error["high"] for picture in self.pictures if picture.error), None)
        if self.by_frames:
            done, samples = sum(picture.is_written for picture in self.pictures), 0
            total = len(self.pictures)
        else:
            done = samples = sum(samples_of(self.job, picture) for picture in self.pictures)
            total = sum(picture.end for picture in self.pictures)
        ready = [member.address for member in self.cluster.ready()]
        self.progress.show(min(1.0, done / max(total, 1)), samples, len(ready), self.work.remaining_s(ready), error)

    def report(self) -> None:
        outputs = [output for picture in self.pictures if picture.samples for output in picture.outputs]
        errors = [picture.error for picture in self.pictures if picture.error]
        facts = {"samples": min((picture.samples for picture in self.pictures), default=0),
                 "parts": sum(part.count for part in self.job.parts.values()),
                 "retries": self.job.retries, "workers": 0, "wall_s": time.monotonic() - self.start_s,
                 "cpu_s": sum(part.cpu_s for part in self.job.parts.values()),
                 "error": max(errors, key=lambda one: one["high"] or 0.0) if errors else None,
                 "output": outputs[0] if len(outputs) == 1 else outputs}
        print_report(report_of(self.work, facts), self.options)


def listen(farm: Farm) -> None:
    """From now on signals end the job in order; the second one at once."""
    def interrupt(*_: object) -> None:
        farm.signals += 1
        if farm.signals > 1:
            os._exit(130)

    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, interrupt)


def farm_main(options: dict) -> None:
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, signal.SIG_IGN)  # so do the workers, which a terminal tells, too
    farm = None
    try:
        farm = Farm(options)
        code = farm.run()
    except Stop as stop:
        code = stop.code
        say(str(stop) if farm is None or farm.cluster is None else f"{stop}; {farm.missing()}; --resume goes on")
    except OSError as cause:
        code = 73
        say(f"{cause}; {farm.missing() if farm else 'nothing is done'}; --resume goes on")
    if farm is not None and farm.cluster is not None:
        farm.cluster.close()
    sys.stdout.flush()
    sys.stderr.flush()
    os._exit(code)  # whatever threads Dask still has


if __name__ == "__main__":
    globals().pop("__file__", None)  # "<stdin>", which new processes would look for
    farm_main(json.loads(sys.argv[1]))

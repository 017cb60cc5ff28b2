"""The loop of a job. A part is a pure function of the scene and of the numbers of its samples, so whatever happens to
workers, the sum has the bytes of one render."""

import os
import pathlib
import shutil
import subprocess
import time
import uuid

from farm_cluster import Cluster, Member
from farm_job import Job, Part, Stop, files_of_scene, say, sha256_of, write_atomically
from farm_orders import first_round, order_of
from farm_picture import Merger, Picture, failure_of, missing_line, next_round, samples_of
from farm_report import Progress, facts_of, print_missed_error, print_report, report_of
from farm_work import MAX_TRIES, Task, Work

NEVER = (2, 3, 70)  # exit codes of a render that would be the same on every worker
POLL_S = 0.25
END_S = 2.0  # of a time limit, kept for writing the picture, besides twice the last merge


class Farm:
    """One job, from its scene to its pictures."""

    def __init__(self, options: dict):
        self.options = options
        self.start_s = time.monotonic()
        self.signals = 0
        self.frames: list[int] = options["frames"]
        self.files = files_of_scene(pathlib.Path(options["scene"]), options["overrides"])
        self.scene = next(iter(self.files)) + ("" if options["mesh_words"] is None else ".vox")
        manifest = {"id": uuid.uuid4().hex, "build": sha256_of(pathlib.Path(options["binary"])), "scene": self.scene,
                    **{key: options[key] for key in ("words", "frames", "spp", "error", "tone_words")},
                    "outputs": [[os.path.abspath(file) for file in files] for files in options["outputs"]],
                    "by_frames": None, "device": ""}
        self.job = Job(pathlib.Path(options["job"]).absolute(), manifest, options["allow_mixed_devices"])
        self.job.open(options["resume"])
        if options["mesh_words"] is not None:
            self.convert_scene()
        self.job.start(self.files)
        self.work = Work()
        self.merger = Merger(options, self.job)
        self.progress = Progress(options["progress"], options["quiet"])
        self.pictures = [Picture(frame, outputs, options["spp"])
                         for frame, outputs in zip(self.frames, options["outputs"])]
        self.cluster: Cluster | None = None
        self.last_line = ""

    def convert_scene(self) -> None:
        """Converts a mesh or another program's file to the .vox file that workers get. A mesh may name further files."""
        voxels = self.job.folder / "imported.vox"
        words = [self.options["binary"], "convert", self.options["scene"], str(voxels), *self.options["mesh_words"],
                 "-q"]
        done = subprocess.run(words, capture_output=True, text=True, check=False)
        if done.returncode != 0:
            raise Stop(*failure_of("convert", done).values())
        self.files = {self.scene: voxels, **dict(list(self.files.items())[1:])}

    def open_cluster(self) -> None:
        words = self.options["words"]
        setup = {"id": self.job.manifest["id"], "folder": str(self.job.folder), "scene": self.scene, "words": words,
                 "build": self.job.manifest["build"], "binary": self.options["worker_binary"],
                 "files": self.job.manifest["files"]}
        self.cluster = Cluster(self.options, setup, self.files, self.job.manifest["device"])
        address = self.cluster.dashboard()
        if address and not self.options["quiet"]:
            say(f"dashboard: {address}")

    @property
    def by_frames(self) -> bool:
        return bool(self.job.manifest["by_frames"])

    def plan_work(self) -> None:
        """Hands out whole frames where there are enough of them for all workers, else samples. A resumed job keeps its
        choice, whatever workers there are now."""
        if self.job.manifest["by_frames"] is None:
            workers = max(len(self.cluster.groups), len(self.cluster.members), 1)
            self.job.remember(by_frames=bool(self.options["whole_frames"]) or len(self.frames) >= 2 * workers)
        if self.by_frames:
            done = {part.frame: part for part in self.job.parts.values()}
            for index, picture in enumerate(self.pictures):
                if picture.frame in done and all(os.path.exists(output) for output in picture.outputs):
                    picture.take_frame(done[picture.frame])
                else:
                    self.work.add(0, [(index, index + 1)])
            return
        for picture in self.pictures:
            if self.options["error"] is not None:
                picture.end = max(first_round(self.options, picture.frame), samples_of(self.job, picture))
            self.work.add(picture.frame, self.job.missing(picture.frame, picture.end))

    def is_done(self) -> bool:
        return all(picture.is_written for picture in self.pictures)

    def run(self) -> int:
        """Runs the job to its end; returns the exit code that render would have."""
        self.cluster.look()
        self.plan_work()
        while not self.is_done():
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
        return self.end()

    def end(self) -> int:
        self.progress.finish()
        self.report()
        shutil.rmtree(self.job.folder, ignore_errors=True)
        return 0

    def hand_out(self) -> None:
        ready = max(len(self.cluster.ready()), 1)
        for member in self.cluster.idle():
            task = self.work.next_task(member.address, ready, time.monotonic())
            if task is None:
                continue
            patience_s = self.work.patience_s(task, member.address)
            self.cluster.run(member, task, order_of(self.options, task, self.by_frames, patience_s))

    def take(self, member: Member, kind: str, future) -> None:
        """Takes the answer of a worker, or its failure."""
        if future is not member.future:
            return  # the worker was given up before
        task, member.task = member.task, None
        if future.status != "finished":
            self.cluster.failed(member, f"Dask says {future.status}: {self.cause_of(future)}")
            if task is not None:
                self.give_back(task, member)
            elif member.state != "refused":
                self.cluster.ask(member)
        elif kind == "asked":
            self.cluster.answer(member, future.result())
            self.job.remember(device=self.cluster.device)
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
        for unit, result in zip(member.order["units"], results):
            if result["code"] in (0, 4):
                self.keep(unit, result, member)
        if failed is None:
            member.failures = 0
            self.work.end(task, member.address, task.units(), time.monotonic() - began_s)
            return
        if failed["code"] in NEVER:
            raise Stop(failed["code"], failed["line"].removeprefix("voxilux: "))
        self.last_line = failed["line"].removeprefix("voxilux: ")
        if self.by_frames and len(task.runs) == 1:
            task.first += len(results) - 1  # the frames before are done
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
            write_atomically(self.job.folder / name, data)
        part = Part(unit["frame"], [tuple(one) for one in unit["ranges"]], unit["files"][0], member.address,
                    result["wall_s"], result["cpu_s"], result["sha256"][0], result["samples"], result["error"])
        if not self.by_frames:
            if not self.job.add(part) and part.file not in self.job.parts:
                (self.job.folder / part.file).unlink(missing_ok=True)
            return
        picture = self.pictures[self.frames.index(unit["frame"])]
        if picture.is_written:
            return
        for name, output in zip(unit["files"], picture.outputs):
            shutil.move(self.job.folder / name, output)
        (self.job.folder / part.file).touch()  # marks the frame as done
        self.job.add(part)
        picture.take_frame(part)

    def lose(self, member: Member) -> None:
        """Gives up a worker that is gone. Whatever Dask reports of it later is ignored."""
        task, future = member.task, member.future
        member.task = member.future = None
        if task is not None:
            future.cancel()
            self.last_line = f"worker {member.address} died"
            self.give_back(task, member)

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
                return self.merger.write(picture, False)
            if is_round_done or self.merger.wants_compaction(picture):
                return self.merger.compact(picture)

    def take_picture(self, picture: Picture, partial: bool, report) -> None:
        """Takes the result of a merge. `report` is a list of samples to render again where a part was damaged."""
        if isinstance(report, list):
            return self.work.add(picture.frame, report)
        picture.samples = report["samples"]
        target = self.options["error"]
        if not partial:
            picture.error, picture.is_written = report["error"], True
        elif target is not None and report["samples"] >= picture.end:
            high = report["error"]["high"]
            if (high is not None and high <= target) or picture.end >= self.options["spp"]:
                picture.error = report["error"]
                return None
            picture.rounds += 1
            picture.end = next_round(picture.end, high, target, self.options["spp"])
            self.work.add(picture.frame, self.job.missing(picture.frame, picture.end))
        return None

    def is_out_of_time(self) -> bool:
        limit_s = self.options["time_limit_s"]
        return limit_s is not None and time.monotonic() - self.start_s > limit_s - END_S - 2.0 * self.merger.took_s

    def end_early(self) -> int:
        """Writes the pictures of what is there."""
        self.progress.finish()
        self.write_what_is_there()
        if self.is_done():
            return self.end()
        self.report()
        say(f"{'interrupted' if self.signals else 'no time left'}; {self.missing()}; --resume goes on")
        if self.signals:
            return 130
        has_pictures = all(picture.samples for picture in self.pictures)
        return 0 if has_pictures and self.reached_error() else 4

    def write_what_is_there(self) -> None:
        ended = self.merger.wait()
        if ended is not None:
            self.take_picture(*ended)
        if self.by_frames:
            return
        for picture in self.pictures:
            while not picture.is_written and self.job.of_frame(picture.frame):
                lacks_some = bool(self.job.missing(picture.frame, picture.end))
                self.merger.write(picture, lacks_some or self.options["error"] is not None)
                _, partial, report = self.merger.wait()
                if isinstance(report, dict):  # else a part was damaged and dropped
                    picture.samples, picture.error, picture.is_written = report["samples"], report["error"], not partial
                    break

    def missing(self) -> str:
        frames = [picture.frame for picture in self.pictures if not picture.is_written]
        if self.by_frames and frames:
            return f"{len(frames)} of {len(self.pictures)} frames are missing, from {frames[0]} on"
        return f"missing: {missing_line(self.job, self.pictures)}"

    def reached_error(self) -> bool:
        target = self.options["error"]
        highs = [(picture.error or {}).get("high") for picture in self.pictures]
        return target is None or all(high is not None and high <= target for high in highs)

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
        facts = facts_of(self.job, self.pictures, time.monotonic() - self.start_s)
        print_report(report_of(self.work, facts), self.options)
        if not self.reached_error() and not self.options["quiet"]:
            print_missed_error(facts, self.options["error"])

"""What the loop of a job does with the answers of workers. A client of our own stands in for Dask."""

import contextlib
import io
import os
import pathlib
import queue
import stat
import subprocess
import tempfile
import unittest
from unittest import mock

import farm
import farm_worker
from farm_cluster import MAX_FAILURES, Cluster, Member
from farm_job import Part, Stop
from farm_loop import Farm
from farm_picture import failure_of
from farm_report import known_high


class Future:
    """What a worker was sent, and what came of it."""

    def __init__(self, function, arguments):
        self.function, self.arguments = function, arguments
        self.status, self.value = "pending", None

    def add_done_callback(self, _):
        pass

    def cancel(self):
        self.status = "cancelled"

    def exception(self):
        return self.value

    def result(self):
        return self.value


class Client:
    def submit(self, function, *arguments, **_):
        return Future(function, arguments)


class Loop(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.top = pathlib.Path(scratch.name)
        (self.top / "s.toml").write_text("")
        self.last = None

    def farm(self, workers=1, **changes):
        options = {"frames": [1], "scene": str(self.top / "s.toml"), "overrides": [], "binary": str(self.top / "s.toml"),
                   "words": [], "tone_words": [], "spp": 4, "error": None, "job": str(self.top / "o.exr.farm"),
                   "allow_mixed_devices": False, "resume": False, "progress": "never", "quiet": True, "device": "",
                   "whole_frames": "", "mesh_words": None, "is_animation": True, **changes}
        options["outputs"] = [[str(self.top / f"o.{frame}.exr")] for frame in options["frames"]]
        if self.last is not None:
            os.close(self.last.job.lock)  # as its process would have, when it ended
        self.last = one = Farm(options)
        one.cluster = cluster = Cluster.__new__(Cluster)
        cluster.options, cluster.setup, cluster.files = options, {"id": "1"}, one.files
        cluster.client, cluster.results, cluster.device, cluster.gpus = Client(), queue.Queue(), "", []
        cluster.groups = [[]] * workers
        cluster.members = {str(slot): Member(str(slot), slot) for slot in range(workers)}
        return one

    def answer(self, one, member, kind, value):
        member.future.status = "error" if isinstance(value, Exception) else "finished"
        member.future.value = value
        with contextlib.redirect_stderr(io.StringIO()):
            one.take(member, kind, member.future)

    def test_worker_that_cannot_store_the_scene_is_given_up(self):
        one = self.farm()
        member = one.cluster.members["0"]
        one.cluster.ask(member)
        lacks = {"device": "d", "lacking": ["s.toml"], "shares": False}
        with self.assertRaises(Stop) as stop:
            for _ in range(MAX_FAILURES):
                self.assertIs(member.future.function, farm_worker.prepare, "it is asked again")
                self.answer(one, member, "asked", lacks)
                self.assertIs(member.future.function, farm_worker.store)
                self.answer(one, member, "storing", OSError("No space left on device"))
        self.assertEqual(stop.exception.code, 75)
        self.assertIn("No space left on device", str(stop.exception))

    def test_dead_worker_costs_one_try(self):
        one = self.farm(workers=2)
        one.plan_work()
        member = one.cluster.members["0"]
        member.state = "ready"
        one.hand_out()
        task, future = member.task, member.future
        one.lose(one.cluster.members.pop("0"))
        one.take(member, "task", future)
        self.assertEqual((one.job.retries, task.tries), (1, 1))

    def test_each_worker_renders_on_a_device_of_its_own(self):
        one = self.farm(workers=3)
        one.cluster.gpus = [2, 5]
        one.plan_work()
        for member in one.cluster.members.values():
            one.cluster.ask(member)
            self.assertEqual(member.future.arguments[1], {"0": "2", "1": "5", "2": "2"}[member.address])
        member = one.cluster.members["1"]
        self.answer(one, member, "asked", {"device": "d", "lacking": [], "shares": True})
        one.hand_out()
        self.assertEqual(member.future.arguments[1]["words"], ["--device", "5"])
        self.assertEqual(one.job.manifest["device"], "d")

    def test_film_that_is_resumed_is_dealt_out_as_before_whatever_workers_there_are(self):
        frames = {"frames": [1, 2, 3, 4]}
        one = self.farm(workers=2, **frames)
        one.plan_work()
        self.assertTrue(one.by_frames)
        for frame in (1, 2):
            part = Part(frame, [], f"parts/f{frame:06d}.0.exr", samples=4, error={"estimate": 0.1, "high": 0.2})
            (one.job.folder / part.file).touch()
            one.job.add(part)
        (self.top / "o.1.exr").touch()
        again = self.farm(workers=8, resume=True, **frames)
        again.plan_work()
        self.assertTrue(again.by_frames)
        self.assertEqual([picture.is_written for picture in again.pictures], [True, False, False, False],
                         "the file of frame 2 was removed")
        self.assertEqual((again.pictures[0].samples, again.pictures[0].error["high"]), (4, 0.2))
        self.assertEqual(again.work.left(), 3)

    def test_any_other_fault_is_one_line_and_70(self):
        with contextlib.redirect_stderr(io.StringIO()) as said:
            code = farm.farm_main({})
        self.assertEqual(code, 70)
        self.assertEqual(said.getvalue(), "voxilux: internal error: KeyError: 'frames'; nothing is done\n")

    def test_network_that_fails_may_be_tried_again_a_file_that_fails_may_not(self):
        of_dask = type("CommClosedError", (OSError,), {"__module__": "distributed.comm.core"})
        for cause, code in ((ConnectionRefusedError(), 75), (TimeoutError(), 75), (of_dask(), 75), (OSError(), 73),
                            (BrokenPipeError(), 73), (PermissionError(), 73)):
            with mock.patch("farm.Farm", side_effect=cause), contextlib.redirect_stderr(io.StringIO()):
                self.assertEqual(farm.farm_main({}), code, type(cause))

    def test_merge_that_is_killed_may_be_tried_again(self):
        killed = subprocess.CompletedProcess([], -9, "", "")
        self.assertEqual(failure_of("merge", killed), {"code": 75, "line": "merge was killed by signal 9"})
        refused = subprocess.CompletedProcess([], 3, "", "note: a\nvoxilux: b\n")
        self.assertEqual(failure_of("merge", refused), {"code": 3, "line": "b"})

    def test_frame_of_unknown_error_has_the_largest(self):
        errors = [{"high": 0.1}, {"high": None}, {"high": 0.2}]
        self.assertIsNone(max(errors, key=known_high)["high"])


class Worker(unittest.TestCase):
    def test_device_is_the_one_that_a_render_would_take(self):
        row = {"usable": True, "would_use": False}
        rows = [{**row, "index": 0, "name": "llvmpipe"}, {**row, "index": 1, "name": "Big GPU", "would_use": True},
                {**row, "index": 2, "name": "Old GPU", "usable": False}]
        for selector, index in (("", 1), ("0", 0), ("gpu", 1), ("llvm", 0)):
            self.assertEqual(farm_worker.selected(rows, selector)["index"], index)
        for selector in ("2", "7", "old", "none"):
            self.assertIsNone(farm_worker.selected(rows, selector))

    def test_folder_of_its_own_is_private_and_removed(self):
        setup = {"id": os.urandom(8).hex(), "folder": "/nowhere"}
        farm_worker.store(setup, {"a/b.vox": b"1"})
        folder = farm_worker.own_folder(setup)
        self.assertEqual(stat.S_IMODE(folder.stat().st_mode), 0o700)
        self.assertEqual((folder / "scene/a/b.vox").read_bytes(), b"1")
        farm_worker.forget(setup)
        self.assertFalse(folder.exists())


if __name__ == "__main__":
    unittest.main()

"""The farm's decisions, without a cluster: ranges, the folder of a job, who gets which task."""

import os
import pathlib
import random
import shutil
import stat
import tempfile
import unittest
from unittest import mock

import farm_job
import farm_picture
import farm_ranges
from farm_job import Job, Part, Stop
from farm_work import MAX_TRIES, Work


def ranges_of(numbers):
    return farm_ranges.union([(number, number + 1) for number in numbers], [])


class Ranges(unittest.TestCase):
    def test_operations_are_those_of_sets(self):
        chance = random.Random(1)
        for _ in range(500):
            a, b = ({chance.randrange(20) for _ in range(chance.randrange(9))} for _ in range(2))
            self.assertEqual(farm_ranges.union(ranges_of(a), ranges_of(b)), ranges_of(a | b))
            self.assertEqual(farm_ranges.difference(ranges_of(a), ranges_of(b)), ranges_of(a - b))
            self.assertEqual(farm_ranges.size(ranges_of(a)), len(a))
            self.assertEqual(farm_ranges.overlaps(ranges_of(a), ranges_of(b)), bool(a & b))

    def test_text_is_that_of_the_flag(self):
        self.assertEqual(farm_ranges.text([(0, 8), (16, 17)]), "0-7,16")


class JobFolder(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.top = pathlib.Path(scratch.name)
        self.scene = self.top / "s.toml"
        self.scene.write_text("")
        self.last = None

    def job(self, resumes=False, **changes):
        """Opens the folder as a new process would: the process before has ended, and with it its lock."""
        if self.last is not None:
            os.close(self.last.lock)
        manifest = {"id": "1", "build": "b", "scene": "s.toml", "words": [], "frames": [0], "by_frames": False,
                    "device": "", **changes}
        self.last = job = Job(self.top / "job", manifest)
        job.open(resumes)
        job.start({"s.toml": self.scene})
        return job

    def add(self, job, first, end, **more):
        part = Part(0, [(first, end)], f"parts/{first}.exr", "w", **more)
        (job.folder / part.file).write_bytes(b"")
        return job.add(part)

    def test_parts_are_there_again_after_a_kill(self):
        job = self.job()
        self.add(job, 0, 4)
        self.add(job, 8, 9)
        with open(job.folder / "journal.jsonl", "a", encoding="utf-8") as journal:
            journal.write('{"frame": 0, "ranges": [[4')  # incomplete
        again = self.job(resumes=True)
        self.assertEqual(again.samples(0), [(0, 4), (8, 9)])
        self.assertEqual(again.missing(0, 10), [(4, 8), (9, 10)])
        self.add(again, 4, 8)
        self.assertEqual(self.job(resumes=True).samples(0), [(0, 9)], "the line after the torn one is whole")

    def test_damaged_folder_is_refused_with_one_line(self):
        job = self.job()
        self.add(job, 0, 4)
        for name, text in (("journal.jsonl", "nonsense\n"), ("manifest.json", "[]"), ("manifest.json", "{")):
            (job.folder / name).write_text(text)
            with self.assertRaises(Stop) as stop:
                self.job(resumes=True)
            self.assertEqual(stop.exception.code, 3)
            self.assertRegex(str(stop.exception), "^.*/job: cannot go on: [^\n]*$")
            (job.folder / "journal.jsonl").write_text("")

    def test_part_whose_file_is_gone_is_missing(self):
        job = self.job()
        self.add(job, 0, 4)
        (job.folder / "parts/0.exr").unlink()
        self.assertEqual(self.job(resumes=True).samples(0), [])

    def test_samples_that_are_there_are_refused_and_those_merged_replace_theirs(self):
        job = self.job()
        self.add(job, 0, 4)
        self.add(job, 4, 6)
        self.assertFalse(self.add(job, 3, 5))
        (job.folder / "parts/m.exr").write_bytes(b"")
        self.assertTrue(job.add(Part(0, [(0, 6)], "parts/m.exr", of=["parts/0.exr", "parts/4.exr"], count=2)))
        self.assertFalse((job.folder / "parts/4.exr").exists())
        again = self.job(resumes=True)
        self.assertEqual([part.count for part in again.parts.values()], [2])
        again.drop("parts/m.exr")
        self.assertEqual(self.job(resumes=True).samples(0), [])

    def test_two_workers_that_disagree_stop_the_job(self):
        job = self.job()
        self.add(job, 0, 4, sha256="a")
        self.assertFalse(self.add(job, 0, 4, sha256="a"))
        with self.assertRaises(Stop) as stop:
            self.add(job, 0, 4, sha256="b")
        self.assertEqual(stop.exception.code, 70)
        job.mixes_devices = True
        self.assertFalse(self.add(job, 0, 4, sha256="b"), "devices of another kind round differently")

    def test_job_keeps_what_it_has_decided_once_something_is_done(self):
        job = self.job(by_frames=True, device="a GPU", spp=4)
        self.assertEqual(self.job(resumes=True, id="2", device="", spp=4).manifest["id"], "2", "nothing is done")
        job = self.job(resumes=True, by_frames=True, device="a GPU", spp=4)
        self.add(job, 0, 4)
        again = self.job(resumes=True, id="3", by_frames=None, spp=4).manifest
        self.assertEqual([again[key] for key in ("id", "by_frames", "device")], ["1", True, "a GPU"])

    def test_finished_frames_fix_what_the_samples_of_a_picture_leave_open(self):
        for by_frames in (False, True):
            self.add(self.job(resumes=True, by_frames=by_frames, spp=4, tone_words=[]), 0, 4)
            changed = {"by_frames": by_frames, "tone_words": ["--exposure", "1"], "spp": 8}
            if not by_frames:
                self.assertEqual(self.job(resumes=True, **changed).manifest["spp"], 8)
                shutil.rmtree(self.top / "job")
                continue
            with self.assertRaises(Stop) as stop:
                self.job(resumes=True, **changed)
            self.assertIn("its spp is 4 and not 8", str(stop.exception))

    def test_folder_is_taken_over_only_on_request_and_only_of_the_same_job(self):
        self.job()
        with self.assertRaises(Stop) as stop:
            self.job()
        self.assertEqual(stop.exception.code, 2)
        self.scene.write_text("[render]\n")
        with self.assertRaises(Stop) as stop:
            self.job(resumes=True)
        self.assertEqual(stop.exception.code, 3)
        self.assertIn("its files", str(stop.exception))

    def test_two_farms_never_work_in_one_folder(self):
        job = self.job()
        for resumes in (False, True):
            with self.assertRaises(Stop) as stop:
                Job(job.folder, {}).open(resumes)
            self.assertEqual(stop.exception.code, 75)
            self.assertIn("another farm works in it", str(stop.exception))
        os.close(job.lock)
        Job(job.folder, {}).open(True)

    def test_folder_is_of_one_user_alone(self):
        job = self.job()
        self.assertEqual(stat.S_IMODE(job.folder.stat().st_mode), 0o700)
        with mock.patch("os.geteuid", lambda: job.folder.stat().st_uid + 1), self.assertRaises(Stop) as stop:
            Job(job.folder, {}).open(True)
        self.assertEqual(stop.exception.code, 73)
        self.assertIn("belongs to another user", str(stop.exception))

    def test_file_is_written_through_no_link_and_readable_as_others_are(self):
        victim, plain = self.top / "victim", self.top / "plain"
        victim.write_bytes(b"mine")
        plain.write_bytes(b"")
        (self.top / f".f.{os.getpid()}").symlink_to(victim)
        (self.top / f".f.{'0' * 32}").symlink_to(victim)
        farm_job.write_atomically(self.top / "f", b"1")
        self.assertEqual(((self.top / "f").read_bytes(), victim.read_bytes()), (b"1", b"mine"))
        self.assertEqual((self.top / "f").stat().st_mode, plain.stat().st_mode)
        with mock.patch("uuid.uuid4", lambda: mock.Mock(hex="0" * 32)), self.assertRaises(FileExistsError):
            farm_job.write_atomically(self.top / "f", b"2")
        self.assertEqual(victim.read_bytes(), b"mine")

    def test_files_that_a_scene_names_go_with_it(self):
        (self.top / "models").mkdir()
        (self.top / "models/a.vox").write_bytes(b"a")
        (self.top / "scenes").mkdir()
        scene = self.top / "scenes/s.toml"
        scene.write_text('[[model]]\nfile = "../models/a.vox"\n[sky]\nmodel = "constant"\n')
        self.assertEqual(set(farm_job.files_of_scene(scene, [])), {"scenes/s.toml", "models/a.vox"})
        self.assertEqual(next(iter(farm_job.files_of_scene(scene, []))), "scenes/s.toml")


class Tasks(unittest.TestCase):
    """Workers with a clock of our own: each takes a task, and ends it when its speed says so."""

    def play(self, speeds, units, start_s=0.5, dies=()):
        """Runs all tasks; returns them in the order of their ends, and when the last one ended. A worker that dies gives its
        task back half way."""
        work, now_s, ends, done = Work(), 0.0, [], []
        work.add(0, [(0, units)])
        while farm_ranges.size(farm_ranges.union([(t.first, t.end) for t, *_ in done], [])) < units:
            for worker, speed in speeds.items():
                if any(row[1] == worker for row in ends):
                    continue
                task = work.next_task(worker, len(speeds), now_s)
                if task:
                    ends.append((now_s + start_s + task.units() / speed, worker, task))
            ends.sort(key=lambda row: row[0])
            end_s, worker, task = ends.pop(0)
            began_s = task.runs.get(worker, now_s)
            now_s = max(now_s, end_s)
            if worker in dies:
                work.fail(task, worker)
                del speeds[worker]
                continue
            if work.end(task, worker, task.units(), now_s - began_s):
                done.append((task, worker, now_s - began_s))
        return done, now_s

    def test_each_sample_is_rendered_once(self):
        done, _ = self.play({"a": 10.0, "b": 3.0, "c": 0.7}, 2000)
        ranges = sorted((task.first, task.end) for task, *_ in done)
        self.assertEqual(farm_ranges.union(ranges, []), [(0, 2000)])
        self.assertEqual(sum(end - first for first, end in ranges), 2000)

    def test_tasks_take_their_time_whatever_the_speed_and_end_together(self):
        speeds = {"a": 50.0, "b": 10.0, "c": 2.0}
        done, end_s = self.play(dict(speeds), 20000)
        middle = [seconds for task, _, seconds in done if task.number > 5][:-12]
        self.assertTrue(all(20.0 <= seconds <= 60.0 for seconds in middle), middle)
        self.assertLess(end_s, 1.15 * 20000 / sum(speeds.values()))

    def test_task_of_a_dead_worker_is_done_by_another(self):
        done, _ = self.play({"a": 10.0, "b": 10.0}, 500, dies=("b",))
        self.assertEqual(sum(task.units() for task, *_ in done), 500)
        self.assertEqual({worker for _, worker, _ in done}, {"a"})

    def test_straggler_is_run_twice_and_counts_once(self):
        work = Work()
        work.add(0, [(0, 1)])
        work.end(work.next_task("fast", 2, 0.0), "fast", 1, 1.0)
        work.add(0, [(1, 2)])
        task = work.next_task("slow", 2, 10.0)
        self.assertIsNone(work.next_task("fast", 2, 11.0), "not late yet")
        self.assertIs(work.next_task("fast", 2, 14.0), task)
        self.assertIsNone(work.next_task("third", 3, 99.0), "twice is enough")
        self.assertTrue(work.end(task, "fast", 1, 1.0))
        self.assertFalse(work.end(task, "slow", 1, 5.0))

    def test_failures_are_counted(self):
        work = Work()
        work.add(3, [(0, 1)])
        for tries in range(1, MAX_TRIES + 1):
            task = work.next_task("a", 1, 0.0)
            work.fail(task, "a")
            self.assertEqual(task.tries, tries)
        self.assertFalse(work.is_idle(3))

    def test_worker_does_not_get_again_what_it_failed_while_others_may(self):
        work = Work()
        work.add(0, [(0, 1)])
        task = work.next_task("a", 2, 0.0)
        work.fail(task, "a")
        self.assertIsNone(work.next_task("a", 2, 0.0))
        self.assertIs(work.next_task("b", 2, 0.0), task)
        work.fail(task, "b")
        self.assertIs(work.next_task("a", 2, 0.0), task, "all have failed it")

    def test_lanes_come_in_order(self):
        work = Work()
        work.add(2, [(0, 1)])
        work.add(1, [(0, 1)])
        self.assertEqual([work.next_task(name, 1, 0.0).lane for name in "ab"], [1, 2])
        self.assertIsNone(work.next_task("c", 1, 0.0))


class Rounds(unittest.TestCase):
    def test_next_round_follows_the_law_of_noise(self):
        self.assertEqual(farm_picture.next_round(100, 0.02, 0.01, 10000), 420)
        self.assertEqual(farm_picture.next_round(100, 0.0101, 0.01, 10000), 111, "never a step too small to matter")
        self.assertEqual(farm_picture.next_round(100, None, 0.01, 10000), 200, "unknown")
        self.assertEqual(farm_picture.next_round(100, 0.5, 0.01, 300), 300)


if __name__ == "__main__":
    unittest.main()

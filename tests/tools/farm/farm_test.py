"""voxilux farm with Dask on the loopback: bytes equal to those of one render, whatever happens to the workers."""

import functools
import json
import os
import pathlib
import shutil
import signal
import subprocess
import tempfile
import unittest

from cluster import Cluster, bench_of_arguments, can_hide_folders, kill, workers_of

BENCH = bench_of_arguments()
SMALL = ["--size", "48x27", "--spp", "24"]
# The first part is one sample, so a test that looks for it 50 times a second finds most of the work still to be done.
LONG = ["--size", "320x180", "--spp", "48"]


@functools.cache
def whole_of_long():
    return BENCH.render("mixed", "long.exr", *LONG)


class Farm(unittest.TestCase):
    def test_picture_has_the_bytes_of_one_render(self):
        more = ["--exposure", "1", "--transparent", "-D", "sun.elevation=30"]
        whole = BENCH.render("mixed", "whole.exr", *SMALL, "-o", BENCH.top / "whole.png", *more)
        out, err = BENCH.farm("mixed", "f.exr", "-o", BENCH.top / "f.png", *more, *SMALL, "--workers", "2", "--json",
                              "-", "--progress", "json")
        self.assertEqual((BENCH.top / "f.exr").read_bytes(), whole)
        self.assertEqual((BENCH.top / "f.png").read_bytes(), (BENCH.top / "whole.png").read_bytes())
        self.assertFalse((BENCH.top / "f.exr.farm").exists())
        report = json.loads(out)
        self.assertLessEqual({"samples", "parts", "retries", "workers", "wall_s", "cpu_s", "error", "output"},
                             set(report))
        self.assertEqual((report["samples"], report["retries"], report["workers"]), (24, 0, 2))
        self.assertGreater(report["parts"], 1)
        progress = [json.loads(line) for line in err.splitlines()]
        self.assertTrue(all({"done", "samples", "elapsed_s", "remaining_s"} <= set(row) for row in progress))

    def test_frames_have_the_bytes_of_their_renders(self):
        BENCH.farm("turntable", "t.exr", *SMALL[:2], "--spp", "4", "--frames", "1-5", "--workers", "2", "-q")
        for frame in (1, 4, 5):
            alone = BENCH.render("turntable", "one.exr", *SMALL[:2], "--spp", "4", "--frame", str(frame))
            self.assertEqual((BENCH.top / f"t.000{frame}.exr").read_bytes(), alone)

    def test_turntable_has_the_bytes_of_its_renders(self):
        turn = [*SMALL[:2], "--spp", "4", "--turntable", "3", "--turn", "light"]
        BENCH.farm("mixed", "l.exr", *turn, "--workers", "2", "-q")
        for frame in (1, 2, 3):
            alone = BENCH.render("mixed", "one.exr", *turn, "--frame", str(frame))
            self.assertEqual((BENCH.top / f"l.000{frame}.exr").read_bytes(), alone)

    def test_mesh_with_files_of_its_own_is_rendered_by_its_voxels(self):
        """Its colour is in a file beside it, which no worker needs."""
        (BENCH.top / "m.mtl").write_text("newmtl red\nKd 0.8 0.1 0.1\n")
        mesh = BENCH.top / "m.obj"
        mesh.write_text("mtllib m.mtl\nv 0 0 0\nv 4 0 0\nv 0 3 0\nv 0 0 2\n"
                        "usemtl red\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n")
        more = [*SMALL[:2], "--spp", "8", "--resolution", "24", "--up", "z"]
        subprocess.run([BENCH.binary, "convert", mesh, BENCH.top / "m.obj.vox", *more[-4:], "-q"], check=True)
        whole = BENCH.render(BENCH.top / "m.obj.vox", "whole.exr", *more)
        BENCH.farm(mesh, "mesh.exr", *more, "--workers", "2", "-q")
        self.assertEqual((BENCH.top / "mesh.exr").read_bytes(), whole)
        self.assertEqual(self.difference(mesh, *more), 0.0)
        pale = mesh.with_name("pale.obj")
        pale.write_text(mesh.read_text().replace("usemtl red\n", ""))
        self.assertGreater(self.difference(pale, *more), 0.0, "or the colour is not seen")

    def difference(self, mesh, *more):
        """The difference between a render in one process and the picture of the farm."""
        BENCH.render(mesh, "direct.exr", *more)
        words = [BENCH.binary, "compare", BENCH.top / "direct.exr", BENCH.top / "mesh.exr", "--json", "-"]
        found = subprocess.run(words, capture_output=True, text=True, check=True)
        return json.loads(found.stdout)["relmse"]

    def test_signal_to_all_processes_ends_the_job_with_one_line(self):
        """As a terminal or a batch system sends it."""
        child = BENCH.start("mixed", "g.exr", *LONG, "--workers", "2", "-q")
        BENCH.wait_for_parts(child, "g.exr", 1)
        os.killpg(child.pid, signal.SIGTERM)
        _, err = child.communicate()
        self.assertEqual(child.returncode, 130, err)
        self.assertRegex(err, r"^voxilux: interrupted; missing: samples [\d,-]+; --resume goes on\n$")

    def test_killed_worker_loses_nothing(self):
        child = BENCH.start("mixed", "w.exr", *LONG, "--workers", "2", "-q")
        BENCH.wait_for_parts(child, "w.exr", 1)
        kill(workers_of(child.pid)[0])
        _, err = child.communicate(timeout=600)
        self.assertEqual(child.returncode, 0, err)
        self.assertEqual((BENCH.top / "w.exr").read_bytes(), whole_of_long())

    def test_killed_job_goes_on_where_it_was(self):
        child = BENCH.start("mixed", "k.exr", *LONG, "--workers", "2", "-q")
        BENCH.wait_for_parts(child, "k.exr", 1)
        kill(child.pid)
        child.communicate()
        done = BENCH.journal("k.exr")
        self.assertGreater(done, 0, "or this tests nothing")
        self.assertFalse((BENCH.top / "k.exr").exists())
        _, err = BENCH.farm("mixed", "k.exr", *LONG, "-q", code=2)
        self.assertIn("--resume goes on with it", err)
        BENCH.farm("mixed", "k.exr", *LONG, "--workers", "2", "-q", "--resume")
        self.assertEqual((BENCH.top / "k.exr").read_bytes(), whole_of_long())

    def test_interrupted_job_leaves_a_picture_and_goes_on(self):
        child = BENCH.start("mixed", "i.exr", *LONG, "--workers", "2", "--json", "-")
        BENCH.wait_for_parts(child, "i.exr", 1)
        child.send_signal(signal.SIGINT)
        out, err = child.communicate()
        self.assertEqual(child.returncode, 130, err)
        self.assertRegex(err, r"voxilux: interrupted; missing: samples [\d,-]+; --resume goes on\n$")
        samples = json.loads(out)["samples"]
        self.assertTrue(0 < samples < 48, samples)
        self.assertEqual(json.loads(BENCH.info("i.exr"))["attributes"]["voxilux.report"]["samples"], samples)
        BENCH.farm("mixed", "i.exr", *LONG, "--workers", "2", "-q", "--resume")
        self.assertEqual((BENCH.top / "i.exr").read_bytes(), whole_of_long())

    def test_worker_without_the_folder_gets_the_scene_and_sends_its_parts(self):
        if not can_hide_folders():
            self.assertNotEqual(os.environ.get("CI"), "true", "a folder cannot be hidden: there is no unshare -rm")
            self.skipTest("a folder cannot be hidden: there is no unshare -rm")
        whole = BENCH.render("mixed", "whole.exr", *SMALL)
        before = set(pathlib.Path(tempfile.gettempdir()).glob("voxilux-farm-*"))
        with Cluster(BENCH.top) as cluster:
            cluster.add_worker(before=cluster.hidden())
            BENCH.farm("mixed", "r.exr", *SMALL, "--scheduler", cluster.address, "-q")
        self.assertEqual((BENCH.top / "r.exr").read_bytes(), whole)
        self.assertEqual(set(pathlib.Path(tempfile.gettempdir()).glob("voxilux-farm-*")) - before, set())

    def test_worker_of_another_build_is_not_used(self):
        other = BENCH.top / "other"
        shutil.copy(BENCH.binary, other)
        with open(other, "ab") as binary:
            binary.write(b"another")
        with Cluster(BENCH.top) as cluster:
            cluster.add_worker()
            _, err = BENCH.farm("mixed", "o.exr", *SMALL, "--scheduler", cluster.address, "--worker-binary", other,
                                code=75)
            self.assertIn("is not used: ", err)
            self.assertIn("is another build", err)
            self.assertIn("missing: samples 0-23; --resume goes on", err)
            # Its input is longer than the 128 KiB that an argument may have.
            _, err = BENCH.farm("turntable", "many.exr", "--frames", "1-4000", "--scheduler", cluster.address,
                                "--worker-binary", other, code=75)
            self.assertIn("4000 of 4000 frames are missing, from 1 on", err)

    def test_error_is_reached_by_the_merged_picture(self):
        out, _ = BENCH.farm("mixed", "e.exr", "--size", "96x54", "--error", "3%", "--workers", "2", "--json", "-")
        report = json.loads(out)
        self.assertLessEqual(report["error"]["high"], 0.03)
        whole = BENCH.render("mixed", "whole.exr", "--size", "96x54", "--spp", str(report["samples"]))
        self.assertEqual((BENCH.top / "e.exr").read_bytes(), whole)

    def test_what_no_worker_can_do_ends_the_job_at_once(self):
        _, err = BENCH.farm("mixed", "n.exr", "--effect", "nothing=on", code=2)
        self.assertIn("there is no effect", err)
        (BENCH.top / "full").mkdir()
        os.symlink("/dev/full", BENCH.top / "full/journal.jsonl")
        (BENCH.top / "full").rename(BENCH.top / "d.exr.farm")
        _, err = BENCH.farm("mixed", "d.exr", *SMALL, "--workers", "1", code=73)
        self.assertIn("No space left on device; missing: samples 0-23; --resume goes on", err)


if __name__ == "__main__":
    unittest.main()

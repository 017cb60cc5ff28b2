"""The Python module against the command line, and the example of docs/python.md.

    module_test.py MODULE_FOLDER SOURCE_FOLDER PROGRAM
"""

import ast
import gzip
import json
import os
import pathlib
import re
import struct
import subprocess
import sys
import tempfile
import threading
import unittest

import needs

FOLDER, TOP, PROGRAM = sys.argv[1:]
needs.need_modules("numpy", "matplotlib")
if not list(pathlib.Path(FOLDER).glob("voxilux.*.so")):
    print("skipped: the Python module is not built; cmake --preset release-python builds it")
    sys.exit(1 if os.environ.get("CI") == "true" else needs.SKIPPED)
sys.path.insert(0, FOLDER)

import numpy as np
import voxilux

SMALL = {"size": (24, 16), "spp": 2, "seed": 3}
FLAGS = ["--size", "24x16", "--spp", "2", "--seed", "3"]
PALETTE = np.array([[0, 0, 0], [200, 40, 30], [20, 180, 60]], np.uint8)


def command(*words):
    return subprocess.run([PROGRAM, *words], capture_output=True, text=True)


def blocks():
    """Two colours with holes, off the origin, longer than one model of a .vox file."""
    rng = np.random.default_rng(5)
    voxels = rng.integers(0, 3, (260, 3, 5), np.uint8)
    voxels[0, 0, 0] = voxels[-1, -1, -1] = 1
    return {"voxels": voxels, "palette": PALETTE, "low": (-7, 4, 2), "materials": {2: {"_type": "_metal"}}}


class Folder(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)


class Render(Folder):
    def test_channels_and_report_are_those_of_the_command_line(self):
        voxilux.write_vox(self.folder / "a.vox", blocks())
        exr = self.folder / "a.exr"
        run = command("render", str(self.folder / "a.vox"), *FLAGS, "-o", str(exr), "--json", "-")
        self.assertEqual(run.returncode, 0, run.stderr)
        report_of_command = json.loads(run.stdout)
        channels, report = voxilux.render(self.folder / "a.vox", **SMALL)
        self.assertEqual({plane.shape for plane in channels.values()}, {(16, 24)})
        self.assertLessEqual({"R", "G", "B", "albedo.R", "error.Y", "Z"}, channels.keys())
        for key in ("exr_clamped", "exr_non_finite"):  # of the file that the command line writes
            self.assertEqual(report_of_command["faults"].pop(key), 0)
        for key in ("scene_hash", "seed", "size", "error", "work", "faults"):
            self.assertEqual(report[key], report_of_command[key], key)
        self.assertEqual(list(report), list(report_of_command))
        # The EXR holds the beauty as halves.
        halves = {name: channels[name].astype(np.float16).astype(np.float32) for name in "RGB"}
        self.assertEqual(voxilux.compare(exr, halves)["max_abs"], 0.0)
        self.assertEqual(command("compare", str(exr), str(exr), "--json", "-").stdout,
                         json.dumps(voxilux.compare(exr, halves), indent=2) + "\n")
        other, _ = voxilux.render(self.folder / "a.vox", **{**SMALL, "seed": 4})
        self.assertGreater(voxilux.compare(exr, other)["max_abs"], 0.01)

    def test_voxels_in_memory_give_the_picture_of_their_file(self):
        voxilux.write_vox(self.folder / "a.vox", blocks())
        of_file, _ = voxilux.render(self.folder / "a.vox", **SMALL)
        red = of_file["R"]
        self.assertEqual(type(red.base).__name__, "PyCapsule", "not a copy")
        before = red.copy()
        of_array, _ = voxilux.render(blocks(), **SMALL)
        self.assertTrue(np.array_equal(red, before), "planes outlive the render")
        self.assertEqual(of_file.keys(), of_array.keys())
        for name in of_file:
            self.assertTrue(np.array_equal(of_file[name], of_array[name]), name)
        self.assertGreater(of_file["R"].std(), 0.0)

    def test_flags_reach_the_engine(self):
        off, report = voxilux.render(blocks(), effect=["ao=off", "sun=off"], D={"render.seed": 9}, size=(8, 4), spp=1)
        self.assertEqual(off["R"].shape, (4, 8))
        states = {effect["name"]: effect["on"] for effect in report["effects"]}
        self.assertEqual((states["ao"], states["sun"], report["seed"]), (False, False, 9))
        clear, _ = voxilux.render(blocks(), transparent=True, quiet=None, **SMALL)
        self.assertIn("A", clear)

    def test_other_threads_run_meanwhile(self):
        done = []
        thread = threading.Thread(target=lambda: done.append(voxilux.render(blocks(), size=(64, 48), spp=24)))
        thread.start()
        turns = 0
        while thread.is_alive() and turns < 1000:
            thread.join(0.001)
            turns += 1
        thread.join()
        self.assertGreater(turns, 10)
        self.assertEqual(len(done), 1)


class Errors(Folder):
    def refused(self, code, words, call, *values, **flags):
        with self.assertRaises(voxilux.Error) as caught:
            call(*values, **flags)
        self.assertEqual(caught.exception.code, code, caught.exception)
        self.assertIn(words, str(caught.exception))
        self.assertEqual(len(str(caught.exception).splitlines()), 1)

    def test_line_and_code_are_those_of_the_command_line(self):
        broken = self.folder / "broken.vox"
        broken.write_bytes(b"VOX \x96\0\0\0MAIN")
        for words, flags in (([str(broken)], {}), ([str(self.folder / "gone.vox")], {}),
                             ([str(broken), "--spp=0"], {"spp": 0}), ([str(broken), "--szie=1x1"], {"szie": (1, 1)})):
            run = command("render", *words)
            line = run.stderr.splitlines()[0].removeprefix("voxilux: ")
            self.refused(run.returncode, line, voxilux.render, words[0], **flags)

    def test_what_a_call_cannot_do_is_refused(self):
        self.refused(2, "output", voxilux.render, blocks(), output="a.exr")
        self.refused(2, "one picture", voxilux.render, blocks(), turntable=4)
        self.refused(2, "--shard", voxilux.render, blocks(), shard="1/2", samples="0-1")
        self.refused(2, "scene", voxilux.render, 7)
        self.refused(2, "output", voxilux.voxelize, self.folder / "a.obj", output="a.vox")
        self.refused(2, ".vox", voxilux.write_vox, self.folder / "a.qb", blocks())
        self.refused(73, "gone", voxilux.write_vox, self.folder / "gone" / "a.vox", blocks())
        self.refused(3, "broken", voxilux.read_vox, __file__.replace(".py", ".broken"))

    def test_arrays_of_another_kind_are_refused(self):
        cube = np.ones((2, 2, 2), np.uint8)
        for voxels in (cube.astype(np.float32), cube[0], "abc"):
            self.refused(2, "uint8", voxilux.render, {"voxels": voxels})
        self.refused(2, "palette", voxilux.render, {"voxels": cube, "palette": np.ones((2, 5))})
        self.refused(2, "'colour'", voxilux.render, {"voxels": cube, "colour": 1})
        self.refused(2, "256", voxilux.render, {"voxels": cube, "materials": {256: {}}})
        self.refused(3, "no voxel", voxilux.render, {"voxels": 0 * cube})
        self.refused(3, "beyond", voxilux.render, {"voxels": cube, "low": (1 << 30, 0, 0)})
        self.refused(2, "linear light", voxilux.compare, cube, cube)


class Voxels(Folder):
    def test_written_voxels_are_read_back(self):
        given = blocks()
        voxilux.write_vox(self.folder / "a.vox", given)
        read = voxilux.read_vox(self.folder / "a.vox")
        self.assertTrue(np.array_equal(read["voxels"], given["voxels"]))
        self.assertTrue(np.array_equal(read["palette"][:3, :3], PALETTE))
        self.assertEqual((read["low"], read["materials"]), (given["low"], given["materials"]))
        voxilux.write_vox(self.folder / "b.vox", read)
        self.assertEqual(voxilux.read_vox(self.folder / "b.vox")["voxels"].tobytes(), read["voxels"].tobytes())

    def test_strided_arrays_keep_their_order(self):
        whole = blocks()["voxels"]
        turned = whole.transpose(2, 1, 0)[::-1, :, ::2]
        voxilux.write_vox(self.folder / "a.vox", {"voxels": turned})
        read = voxilux.read_vox(self.folder / "a.vox")
        low = np.array(read["low"])
        part = turned[low[0]:, low[1]:, low[2]:]
        size = read["voxels"].shape
        self.assertTrue(np.array_equal(part[:size[0], :size[1], :size[2]], read["voxels"]))
        self.assertEqual(np.count_nonzero(read["voxels"]), np.count_nonzero(turned))

    def test_mesh_is_voxelized_as_by_the_command_line(self):
        mesh = self.folder / "a.obj"
        mesh.write_text("v 0 0 0\nv 9 0 0\nv 0 9 0\nv 0 0 9\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n", encoding="ascii")
        out = self.folder / "a.vox"
        run = command("voxelize", str(mesh), "--resolution", "12", "--solid", "-o", str(out), "--json", "-")
        self.assertEqual(run.returncode, 0, run.stderr)
        voxels, report = voxilux.voxelize(mesh, resolution=12, solid=True)
        of_file = voxilux.read_vox(out)
        self.assertTrue(np.array_equal(voxels["voxels"], of_file["voxels"]))
        self.assertEqual(voxels["low"], of_file["low"])
        of_command = json.loads(run.stdout)
        for key in ("voxels", "surface", "interior", "grid", "models", "palette", "warnings"):
            self.assertEqual(report[key], of_command[key], key)
        self.assertEqual(np.count_nonzero(voxels["voxels"]), report["voxels"])


class Minecraft(Folder):
    def test_blocks_of_a_schematic_are_voxels_with_materials(self):
        """Against a writer of our own here, and colours that everybody knows."""
        blocks = ["minecraft:air", "minecraft:lime_wool", "minecraft:lava", "minecraft:water", "mod:thing"]
        rng = np.random.default_rng(1)
        numbers = rng.integers(0, 5, (4, 3, 6), np.uint8)  # [y][z][x]
        numbers[0, 0, 0] = numbers[-1, -1, -1] = 1
        numbers[1, 0, :3] = 2, 3, 4

        def tag(kind, name, payload):
            return struct.pack(">BH", kind, len(name)) + name.encode() + payload

        sides = zip(("Height", "Length", "Width"), numbers.shape)
        body = b"".join(tag(2, name, struct.pack(">h", side)) for name, side in sides)
        body += tag(10, "Palette", b"".join(tag(3, n, struct.pack(">i", i)) for i, n in enumerate(blocks)) + b"\0")
        body += tag(7, "BlockData", struct.pack(">i", numbers.size) + numbers.tobytes())
        file = self.folder / "a.schem"
        file.write_bytes(gzip.compress(tag(10, "Schematic", body + b"\0")))
        read = voxilux.read_vox(file)
        indices = numbers[:, ::-1, :].transpose(2, 1, 0)  # x, -z, y
        self.assertTrue(np.array_equal(read["voxels"] > 0, indices > 0))
        types = {name: {read["materials"][int(i)]["_type"] for i in np.unique(read["voxels"][indices == number])}
                 for number, name in enumerate(blocks) if number > 0}
        self.assertEqual(list(types.values()), [{"_diffuse"}, {"_emit"}, {"_glass"}, {"_diffuse"}])
        colours = read["palette"][read["voxels"]].astype(int)
        lime, lava, water, grey = (colours[indices == number][0] for number in (1, 2, 3, 4))
        self.assertTrue(lime[1] > lime[0] > lime[2] and lava[0] > lava[1] > lava[2] and water[2] > water[1] > water[0])
        self.assertEqual(list(grey[:3]), [128, 128, 128])
        run = command("convert", str(file), str(self.folder / "a.vox"))
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertIn(f"warning: {np.count_nonzero(numbers == 4)} voxels are grey", run.stderr)


class Compare(unittest.TestCase):
    def test_metrics_of_arrays_are_their_definition(self):
        rng = np.random.default_rng(2)
        ref, test = rng.random((2, 9, 12, 3), np.float32)
        metrics = voxilux.compare(ref, test)
        difference = test.astype(np.float64) - ref
        self.assertAlmostEqual(metrics["rmse"], float(np.sqrt(np.mean(difference ** 2))), delta=1e-9)
        self.assertAlmostEqual(metrics["mae"], float(np.mean(np.abs(difference))), delta=1e-9)
        self.assertEqual(metrics["max_abs"], float(np.abs(test - ref).max()))
        boxed = voxilux.compare(ref, test, box=(2, 1, 7, 4))
        part = difference[1:4, 2:7]
        self.assertAlmostEqual(boxed["mae"], float(np.mean(np.abs(part))), delta=1e-9)
        mask = np.zeros((9, 12), np.float32)
        mask[1:4, 2:7] = 1
        self.assertEqual(voxilux.compare(ref, test, mask=mask)["mae"], boxed["mae"])


class Document(Folder):
    def test_example_of_the_document_runs_in_ten_lines(self):
        text = (pathlib.Path(TOP) / "docs/python.md").read_text(encoding="utf-8")
        example = re.search(r"^```python\n(.*?)^```", text, re.M | re.S).group(1)
        self.assertLessEqual(len([line for line in example.splitlines() if line.strip()]), 10)
        spied = example + "\nimport json; print(json.dumps([r['error']['estimate'] for r in reports]))\n"
        run = subprocess.run([sys.executable, "-c", spied], cwd=self.folder, capture_output=True, text=True,
                             env={**os.environ, "PYTHONPATH": FOLDER, "MPLBACKEND": "Agg"})
        self.assertEqual(run.returncode, 0, run.stderr)
        errors = json.loads(run.stdout)
        for few, more in zip(errors, errors[1:]):  # four times the samples: half the error, and not far from it
            self.assertGreater(few / more, 1.3)
        self.assertEqual((self.folder / "error.png").read_bytes()[:4], b"\x89PNG")

    def test_installed_module_is_found(self):
        build = str(pathlib.Path(FOLDER).parent)
        subprocess.run(["cmake", "--install", build, "--component", "python", "--prefix", str(self.folder)],
                       check=True, capture_output=True)
        place = self.folder / "lib/python3/dist-packages"
        self.assertEqual(len(list(place.iterdir())), 2)
        run = subprocess.run([sys.executable, "-c", "import voxilux; print(voxilux.__file__)"], capture_output=True,
                             text=True, env={**os.environ, "PYTHONPATH": str(place)})
        self.assertTrue(run.stdout.startswith(str(place)), run.stderr)

    def test_type_hints_name_every_function(self):
        hints = ast.parse((pathlib.Path(FOLDER) / "voxilux.pyi").read_text(encoding="utf-8"))
        public = {name for name in dir(voxilux) if not name.startswith("_")}
        named = {node.name for node in hints.body if isinstance(node, (ast.FunctionDef, ast.ClassDef))}
        self.assertEqual(public, named - {"Voxels", "_Voxels"})
        for name in public:
            self.assertTrue(getattr(voxilux, name).__doc__, name)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])

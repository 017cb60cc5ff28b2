"""The tuning tool, with a stand-in for voxilux and with voxilux itself.

    tune_test.py TUNE VOXILUX SCENE
"""

import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

import needs

TUNE, VOXILUX, SCENE = sys.argv[1:4]
FAKE = pathlib.Path(__file__).with_name("fake_voxilux.py")


def tune(*words):
    return subprocess.run([sys.executable, TUNE, *words], capture_output=True, text=True, check=False)


def tuned(*words):
    """The result of a search that succeeds."""
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder) / "result.json"
        done = tune(*words, "--quiet", "--json", str(file))
        assert done.returncode == 0, done.stderr
        return json.loads(file.read_text(encoding="utf-8")), done.stdout


class Search(unittest.TestCase):
    def test_finds_what_has_the_smallest_error(self):
        result, text = tuned("a.toml", "--voxilux", str(FAKE), "--trials", "60", "--repeats", "1")
        settings = result["settings"]
        self.assertGreater(settings["radius"], 1.2)
        self.assertLess(settings["radius"], 3.3)
        self.assertLess(result["error"], 0.5)
        self.assertEqual(result["default_error"], 0.5)
        self.assertAlmostEqual(result["gain"], 0.5 / result["error"])
        self.assertIn(f"gain      {result['gain']:.2f} times less error", text)

    def test_same_seed_gives_the_same_result(self):
        words = ["a.toml", "--voxilux", str(FAKE), "--trials", "8", "--repeats", "1"]
        self.assertEqual(tuned(*words), tuned(*words))
        self.assertNotEqual(tuned(*words), tuned(*words, "--seed", "3"))

    def test_reference_counts_instead_of_the_estimate(self):
        words = ["a.toml", "--voxilux", str(FAKE), "--trials", "1", "--repeats", "1"]
        result, text = tuned(*words, "--reference", "b.exr")
        self.assertAlmostEqual(result["error"], 0.2)
        self.assertIn("nothing was gained", text)
        self.assertNotIn("estimate of the render itself", text)

    def test_render_over_its_time_pays_for_it(self):
        words = ["--voxilux", str(FAKE), "--trials", "1", "--repeats", "1"]
        fast, _ = tuned("a.toml", *words)
        slow, _ = tuned("slow.toml", *words)
        self.assertAlmostEqual(slow["error"], 2.0 * fast["error"])


class Refusal(unittest.TestCase):
    def expect(self, code, message, *words):
        done = tune(*words, "--voxilux", str(FAKE), "--quiet", "--trials", "2")
        self.assertEqual(done.returncode, code, done.stderr)
        self.assertIn(message, done.stderr)
        self.assertEqual(done.stdout, "")
        self.assertNotIn("Traceback", done.stderr)

    def test_what_voxilux_says_is_passed_on(self):
        self.expect(1, "voxilux: broken.toml: no such file", "broken.toml")

    def test_error_that_is_not_known_is_said(self):
        self.expect(1, "its error is not known", "unknown.toml")

    def test_flags_out_of_range(self):
        self.expect(2, "--radius", "a.toml", "--radius", "3,1")
        self.expect(2, "--time", "a.toml", "--time", "0")
        self.expect(2, "--repeats", "a.toml", "--repeats", "none")

    def test_machine_without_optuna(self):
        with tempfile.TemporaryDirectory() as folder:
            (pathlib.Path(folder) / "optuna.py").write_text("raise ImportError", encoding="utf-8")
            done = subprocess.run([sys.executable, TUNE, "a.toml"], capture_output=True, text=True, check=False,
                                  env={**os.environ, "PYTHONPATH": folder})
        self.assertEqual((done.returncode, done.stdout), (69, ""))
        self.assertTrue(done.stderr.startswith("tune.py: needs Optuna: "), done.stderr)
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)

    def test_program_that_is_not_there(self):
        done = tune("a.toml", "--voxilux", "no/such/program", "--trials", "1")
        self.assertEqual(done.returncode, 1)
        self.assertIn("no/such/program", done.stderr)
        self.assertNotIn("Traceback", done.stderr)


class Real(unittest.TestCase):
    def test_three_trials_of_a_small_picture(self):
        with tempfile.TemporaryDirectory() as folder:
            truth = str(pathlib.Path(folder) / "truth.exr")
            subprocess.run([VOXILUX, "render", SCENE, "--size", "16x16", "--iterations", "8", "--quiet", "-o", truth],
                           check=True)
            result, text = tuned(SCENE, "--voxilux", VOXILUX, "--trials", "3", "--time", "0.2", "--size", "16x16",
                                 "--repeats", "1", "--reference", truth)
        self.assertEqual(result["trials"], 3)
        self.assertEqual(sorted(result["settings"]), ["alpha", "photons", "radius"])
        self.assertGreater(result["error"], 0.0)
        self.assertGreater(result["default_error"], 0.0)
        self.assertIn("--radius auto", text)


if __name__ == "__main__":
    needs.need_modules("optuna")
    unittest.main(argv=sys.argv[:1])

"""The coverage tool, with a stand-in for voxilux whose error bounds are right or wrong.

    coverage_test.py COVERAGE SCENES VOXILUX
"""

import contextlib
import io
import json
import pathlib
import sys
import tempfile
import unittest

COVERAGE, SCENES, VOXILUX = map(pathlib.Path, sys.argv[1:4])
sys.path.insert(0, str(COVERAGE.resolve().parent))

import coverage  # noqa: E402
import fake_renderer  # noqa: E402


class Measured:
    """What coverage.py says about views, which are lines of its list. Without `voxilux` a stand-in renders."""

    def __init__(self, lines, *words, voxilux=None):
        self.renders = []
        real = coverage.run
        if voxilux is None:
            coverage.run = self.stand_in
        try:
            self.measure(lines, ["--voxilux", str(voxilux or "voxilux"), "--quiet", *words])
        finally:
            coverage.run = real

    def stand_in(self, words):
        if words[1] == "render":
            self.renders.append(" ".join(words[1:]))
        try:
            return fake_renderer.COMMANDS[words[1]](words[1:])
        except fake_renderer.Refusal as refusal:
            raise coverage.Failure(f"voxilux {words[1]}: {refusal}") from refusal

    def measure(self, lines, words):
        out, err = io.StringIO(), io.StringIO()
        with tempfile.TemporaryDirectory() as folder:
            views, result = pathlib.Path(folder) / "views.txt", pathlib.Path(folder) / "result.json"
            views.write_text("\n".join(lines) + "\n", encoding="utf-8")
            with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
                self.code = coverage.main(["--list", str(views), "--json", str(result), *words])
            self.result = json.loads(result.read_text(encoding="utf-8")) if result.exists() else None
        self.out, self.err = out.getvalue(), err.getvalue()


def honest(count):
    return [f"honest{index} 5% - honest.toml" for index in range(count)]


class Figures(unittest.TestCase):
    def test_honest_claims_and_forecasts_pass(self):
        measured = Measured([*honest(3), "long 5% 1% honest.toml"])
        self.assertEqual((measured.code, measured.err), (0, ""))
        claims, forecasts = measured.result["claims"], measured.result["forecasts"]
        self.assertEqual((claims["count"], claims["hits"]), (25, 25))
        self.assertEqual((forecasts["count"], forecasts["hits"]), (5, 5))
        self.assertIn("claims     25 of 25 = 100.0 %", measured.out)
        self.assertIn("forecasts  5 of 5 = 100.0 %", measured.out)

    def test_true_error_is_that_of_the_picture(self):
        row = Measured(honest(1), "--seeds", "1").result["runs"][0]
        self.assertAlmostEqual(row["true"], 0.045)
        self.assertAlmostEqual(row["claimed"], 1.05 * 0.045)

    def test_noise_of_the_references_does_not_count(self):
        measured = Measured(["noisy 5% - noisy.toml"])
        self.assertEqual(measured.code, 0, measured.out)
        self.assertAlmostEqual(measured.result["runs"][0]["true"], 0.045)

    def test_one_that_lies_is_caught(self):
        measured = Measured([*honest(9), "liar 5% - liar.toml"])
        self.assertEqual(measured.code, 5)
        self.assertIn("too few are right: claims", measured.err)
        self.assertEqual(measured.result["claims"]["hits"], 45)
        self.assertEqual({row["view"] for row in measured.result["runs"] if not row["is_within"]}, {"liar"})

    def test_error_target_that_is_missed_is_caught_though_the_claim_holds(self):
        row = Measured(honest(1), "--seeds", "1").result["runs"][0]
        self.assertLess(row["claimed"], 0.05)
        liar = Measured(["liar 5% - liar.toml"], "--seeds", "1").result["runs"][0]
        self.assertGreater(liar["true"], liar["target"])

    def test_forecasts_that_fail_are_caught(self):
        measured = Measured(["late 5% 1% late.toml", "long 5% 1% honest.toml"])
        self.assertEqual(measured.code, 5)
        self.assertIn("too few are right: forecasts", measured.err)
        self.assertEqual((measured.result["forecasts"]["hits"], measured.result["forecasts"]["count"]), (5, 10))

    def test_short_runs_do_not_count_for_forecasts(self):
        measured = Measured(["late 5% - late.toml"])
        self.assertEqual((measured.code, measured.result["forecasts"]["count"]), (0, 0))
        self.assertIn("forecasts  unknown: no run to judge by", measured.out)

    def test_run_without_a_claim_is_told_apart(self):
        measured = Measured(["silent 5% 1% silent.toml", *honest(1)])
        self.assertEqual(measured.code, 0)
        self.assertEqual((measured.result["claims"]["count"], measured.result["without_claim"]), (5, 10))
        self.assertIn("10 runs made no claim", measured.out)
        self.assertIn("5 long runs made no forecast", measured.out)

    def test_interval_is_that_of_wilson(self):
        """19 of 20 by the published formula: 0.764 to 0.991."""
        measured = Measured([*honest(19), "liar 5% - liar.toml"], "--seeds", "1")
        self.assertAlmostEqual(measured.result["claims"]["low"], 0.7639, 3)
        self.assertAlmostEqual(measured.result["claims"]["high"], 0.9911, 3)

    def test_quick_forgives_what_chance_may_have_done(self):
        lines = [*honest(5), "liar 5% 1% liar.toml"]
        quick = Measured(lines, "--quick", "--seeds", "1")
        self.assertEqual((quick.code, quick.result["claims"]["hits"], quick.result["claims"]["count"]), (0, 5, 6))
        self.assertEqual(Measured(lines, "--seeds", "1").code, 5)
        self.assertEqual(Measured(["liar 5% - liar.toml"], "--quick", "--seeds", "4").code, 5)


class References(unittest.TestCase):
    def test_are_kept_and_have_a_smaller_radius(self):
        with tempfile.TemporaryDirectory() as folder:
            words = ["--seeds", "1", "--references", str(pathlib.Path(folder) / "kept")]
            first = Measured(["noisy 5% - noisy.toml --size 8x8"], *words)
            self.assertEqual(len(first.renders), 3)
            self.assertTrue(all("--size 8x8" in line for line in first.renders))
            self.assertTrue(all("--radius 1 " in line for line in first.renders[1:]))
            self.assertNotIn("--radius", first.renders[0])
            again = Measured(["noisy 5% - noisy.toml --size 8x8"], *words)
            self.assertEqual(len(again.renders), 1)
            self.assertEqual(first.result["runs"], again.result["runs"])
            self.assertEqual(len(Measured(["noisy 5% - noisy.toml --size 9x8"], *words).renders), 3)

    def test_take_the_default_sequence(self):
        renders = Measured(["a 5% - honest.toml --sequence halton --size 8x8"], "--seeds", "1").renders
        self.assertIn("--sequence halton --size 8x8", renders[0])
        self.assertEqual([("halton" in line, "--size 8x8" in line) for line in renders[1:]], [(False, True)] * 2)


class Refusal(unittest.TestCase):
    def expect(self, message, *arguments):
        measured = Measured(*arguments)
        self.assertEqual(measured.code, 3, measured.err)
        self.assertIn(message, measured.err)
        self.assertEqual(measured.err.count("\n"), 1)

    def test_what_voxilux_says_is_passed_on(self):
        self.expect("broken.toml: no such file", ["a 5% - broken.toml"])

    def test_line_that_is_no_view(self):
        self.expect("views.txt:2: not 'NAME 2% 0.5%|- SCENE FLAGS...'", ["# a comment", "a 5 - honest.toml"])
        self.expect("views.txt:1", ["a 5%"])

    def test_program_that_is_not_there(self):
        measured = Measured(honest(1), voxilux="no/such/program")
        self.assertEqual(measured.code, 3)
        self.assertIn("no/such/program", measured.err)

    def test_view_that_is_not_in_the_list(self):
        self.expect("no view is called ghost", honest(1), "--views", "ghost,honest0")


class List(unittest.TestCase):
    def test_has_twenty_views_of_scenes_that_exist(self):
        lines = [line.split() for line in COVERAGE.with_name("views.txt").read_text(encoding="utf-8").splitlines()
                 if not line.startswith("#")]
        self.assertGreaterEqual(len({" ".join(words[3:]) for words in lines}), 20)
        self.assertEqual(len({words[0] for words in lines}), len(lines))
        for words in lines:
            self.assertTrue((SCENES / words[3]).exists(), words[3])
        self.assertGreaterEqual(sum(words[2] != "-" for words in lines), 4)

    def test_real_program_is_understood(self):
        """One small view with the real program: its report has every key that is read."""
        measured = Measured(["slit 20% - slit.toml --size 48x32"], "--seeds", "1", "--scenes", str(SCENES),
                            voxilux=VOXILUX)
        self.assertIn(measured.code, (0, 5), measured.err)
        self.assertEqual(measured.result["claims"]["count"], 1)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])

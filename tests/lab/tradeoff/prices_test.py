"""The tables of prices, the presets chosen from them and the page of the price list.

    prices_test.py FOLDER_OF_TOOLS
"""

import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

TOOLS = pathlib.Path(sys.argv[1]).resolve()
sys.path.insert(0, str(TOOLS))

import choose_presets  # noqa: E402
import fake_price_list  # noqa: E402
import prices  # noqa: E402
import price_list  # noqa: E402

TOP = TOOLS.parent.parent
LARGEST_PICTURE = 200_000  # bytes: it is loaded with the front page


def row(scene, spp, error, time_s, knob="samples", setting=None, is_default=False, ao_rays=1, photons=0):
    return {"scene": scene, "knob": knob, "setting": setting or str(spp), "width": 1000, "height": 500,
            "is_default": int(is_default), "spp": spp, "ao_rays": ao_rays, "photons": photons, "time_s": time_s,
            "time_low_s": time_s, "time_high_s": time_s, "error": error, "noise": error, "bias": 0.0}


def scene_rows(name, at_one, second=0.1):
    """Error at_one / sqrt(spp), `second` seconds for a sample of half a megapixel."""
    return [row(name, spp, at_one / spp**0.5, second * spp, is_default=spp == 16) for spp in (1, 4, 16, 64)]


def with_photons(rows):
    return [dict(one, photons=5000, ao_rays=0) for one in rows]


LAMP = with_photons(scene_rows("lamp", 0.8, second=0.5))
THREE = [one for name, at_one in (("easy", 0.08), ("middling", 0.4), ("hard", 2.0)) for one in scene_rows(name, at_one)]
ALL = THREE + LAMP


class Presets(unittest.TestCase):
    def test_least_samples_whose_median_error_is_within_the_target(self):
        """0.4 / sqrt(spp): 64 samples for 5 %, 178 for 3 %, 1600 for 1 %, 17778 for 0.3 %. 0.8 / sqrt(spp): 16 for 20 %,
        131 for 7 %, 711 for 3 %, 6400 for 1 %."""
        found = choose_presets.choose(ALL)
        self.assertEqual([one["name"] for one in found], list(choose_presets.TARGETS))
        self.assertEqual([one["plain"]["samples"] for one in found], [64, 256, 2048, 32768])
        self.assertEqual([one["photons"]["samples"] for one in found], [16, 256, 1024, 8192])
        self.assertAlmostEqual(found[0]["plain"]["error"], 0.05)
        self.assertAlmostEqual(found[3]["plain"]["error"], 0.4 / 32768**0.5)

    def test_price_is_the_median_time_of_a_megapixel(self):
        found = choose_presets.choose(ALL)[0]
        self.assertAlmostEqual(found["plain"]["seconds_per_megapixel"], 0.1 * 64 / 0.5)
        self.assertAlmostEqual(found["photons"]["seconds_per_megapixel"], 0.5 * 16 / 0.5)

    def test_what_is_not_measured_is_told(self):
        found = choose_presets.choose(ALL)
        self.assertEqual([one["plain"]["is_measured"] for one in found], [True, False, False, False])
        self.assertEqual([one["photons"]["is_measured"] for one in found], [True, False, False, False])

    def rays(self, name, error, time):
        """A scene whose error and time change by these factors with 4 rays."""
        default = [dict(one, knob="ao_rays", setting="1", is_default=1) for one in scene_rows(name, 0.4)]
        other = [dict(one, setting="4", is_default=0, ao_rays=4, error=error * one["error"], time_s=time * one["time_s"])
                 for one in default]
        return [*scene_rows(name, 0.4), *default, *other]

    def test_rays_that_are_worth_it_are_taken_with_their_own_price(self):
        found = choose_presets.choose(self.rays("a", 0.5, 1.25) + LAMP)
        self.assertTrue(all(one["ao_rays"] == 4 for one in found))
        self.assertEqual(found[0]["plain"]["samples"], 16)
        self.assertAlmostEqual(found[0]["plain"]["error"], 0.05)
        self.assertAlmostEqual(found[0]["plain"]["seconds_per_megapixel"], 1.25 * 0.1 * 16 / 0.5)
        self.assertEqual(found[0]["photons"], choose_presets.choose(ALL)[0]["photons"])

    def test_rays_that_gain_less_than_a_tenth_are_not(self):
        self.assertTrue(all(one["ao_rays"] == 1 for one in choose_presets.choose(self.rays("a", 1.0, 0.95) + LAMP)))

    def test_rays_must_be_worth_it_over_all_scenes(self):
        rows = self.rays("a", 0.5, 1.25) + self.rays("b", 1.0, 9.0) + LAMP
        self.assertTrue(all(one["ao_rays"] == 1 for one in choose_presets.choose(rows)))

    def test_scene_without_occlusion_keeps_its_own_curve(self):
        rows = self.rays("a", 0.5, 1.25) + scene_rows("b", 0.4) + scene_rows("c", 0.4) + LAMP
        found = choose_presets.choose(rows)
        self.assertEqual((found[0]["ao_rays"], found[0]["plain"]["samples"]), (4, 64))

    def test_one_sample_is_too_few_to_know_its_error(self):
        rows = scene_rows("a", 0.01) + LAMP
        self.assertEqual(choose_presets.choose(rows)[0]["plain"]["samples"], 2)

    def test_both_kinds_of_scenes_are_needed(self):
        for rows, kind in ((THREE, "photons"), (LAMP, "plain")):
            with self.assertRaisesRegex(prices.Malformed, f"no scene of the kind '{kind}'"):
                choose_presets.choose(rows)

    def test_scene_whose_error_does_not_fall_is_refused(self):
        rows = [row("flat", spp, 0.3, spp) for spp in (1, 4, 16)] + LAMP
        with self.assertRaisesRegex(prices.Malformed, "no number of samples leaves a median error of 5 %"):
            choose_presets.choose(rows)


class Curve(unittest.TestCase):
    def setUp(self):
        self.curve = prices.Curve(scene_rows("a", 0.4))

    def test_passes_through_what_was_measured(self):
        self.assertAlmostEqual(self.curve.at(16, "error"), 0.1)
        self.assertAlmostEqual(self.curve.at(16, "time_s"), 1.6)

    def test_is_a_power_law_between_and_beyond(self):
        for spp in (0.5, 2, 30, 1024):
            self.assertAlmostEqual(self.curve.at(spp, "error"), 0.4 / spp**0.5)

    def test_samples_for_an_error_leave_that_error(self):
        self.assertAlmostEqual(self.curve.samples_for(0.05), 64.0, 4)
        self.assertIsNone(prices.Curve([row("a", 1, 0.3, 1), row("a", 4, 0.3, 4)]).samples_for(0.1))


class Table(unittest.TestCase):
    ABOUT = {"machine": "a machine, 2 threads", "device": "a device", "version": "1"}

    def test_times_follow_from_the_curve(self):
        text = price_list.table_text(self.ABOUT, scene_rows("a", 0.4) + LAMP)
        self.assertIn("| `a` | 1000 x 500 | 1.6 s | 6.4 s | (40 s) | - | time^-0.50 |", text)
        self.assertIn("Measured on a machine, 2 threads, a device, by voxilux 1.", text)

    def test_time_far_beyond_what_was_measured_is_not_given(self):
        self.assertIn("| (10 s) | (40 s) | - | - |", price_list.table_text(self.ABOUT, scene_rows("a", 1.0) + LAMP))

    def test_csv_keeps_every_row(self):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "prices.csv"
            file.write_text(prices.csv_text(self.ABOUT, THREE), encoding="utf-8")
            about, rows = prices.read_csv(file)
        self.assertEqual(about, self.ABOUT)
        self.assertEqual(len(rows), len(THREE))
        for a, b in zip(rows, THREE):
            self.assertEqual(a.keys(), b.keys())
            self.assertAlmostEqual(a["error"], b["error"], 4)

    def test_markers_stay_and_the_rest_too(self):
        readme = f"one\n{price_list.BEGIN}\nold\n{price_list.END}\ntwo\n"
        once = price_list.with_table(readme, "new")
        self.assertEqual(once, f"one\n{price_list.BEGIN}\nnew\n{price_list.END}\ntwo\n")
        self.assertEqual(price_list.with_table(once, "new"), once)
        with self.assertRaisesRegex(prices.Malformed, "markers"):
            price_list.with_table("one", "new")


class Gathered(unittest.TestCase):
    def lists(self, folder):
        data = fake_price_list.price_list(pathlib.Path(folder))
        other = json.loads(json.dumps(dict(data, scene="scenes/other.toml")))
        for run in other["runs"]:
            run["settings"]["photons"] = 5000
        return data, other

    def test_price_lists_become_rows(self):
        with tempfile.TemporaryDirectory() as folder:
            one, other = self.lists(folder)
        about, rows = prices.gather([one, other])
        kept = [run for run in one["runs"] if run["knob"] in prices.KEPT_KNOBS]
        self.assertEqual(len(rows), 2 * sum(len(run.get("curve") or [run]) for run in kept))
        self.assertEqual(about["machine"], "A processor with a long name @ 2.60GHz, 2 threads")
        self.assertEqual({row["scene"] for row in rows}, {"<made up>", "other"})
        self.assertEqual(len(choose_presets.choose(rows)), 4)

    def test_two_machines_are_not_mixed(self):
        with tempfile.TemporaryDirectory() as folder:
            one, other = self.lists(folder)
        other["machine"] = dict(other["machine"], threads=64)
        with self.assertRaisesRegex(prices.Malformed, "other.toml was measured on another machine"):
            prices.gather([one, other])

    def test_other_scenes_keep_their_prices(self):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            one, other = self.lists(name)
            known = prices.gather([one, other])
            (folder / "prices.csv").write_text(prices.csv_text(*known), encoding="utf-8")
            for run in other["runs"]:
                run["settings"]["photons"] = 7000
            (folder / "other.json").write_text(json.dumps(other), encoding="utf-8")
            words = ["--from", str(folder / "other.json"), "--keep", "--prices", str(folder / "prices.csv")]
            price_list.update_prices(price_list.parse_arguments(words))
            rows = prices.read_csv(folder / "prices.csv")[1]
            self.assertEqual(len(rows), len(known[1]))
            self.assertEqual({row["photons"] for row in rows if row["scene"] == "other"}, {7000})
            self.assertNotIn(7000, {row["photons"] for row in rows if row["scene"] != "other"})
            other["version"] = "0.0.0"
            (folder / "other.json").write_text(json.dumps(other), encoding="utf-8")
            with self.assertRaisesRegex(prices.Malformed, "of another machine, device or version"):
                price_list.update_prices(price_list.parse_arguments(words))

    def test_command_writes_the_header(self):
        with tempfile.TemporaryDirectory() as folder:
            files, out = [], pathlib.Path(folder) / "presets.inc"
            for number, data in enumerate(self.lists(folder)):
                files.append(pathlib.Path(folder) / f"{number}.json")
                files[-1].write_text(json.dumps(data), encoding="utf-8")
            self.assertEqual(choose_presets.main([*map(str, files), "-o", str(out)]), 0)
            self.assertIn('{.name = "draft",', out.read_text(encoding="utf-8"))

    def test_file_that_is_no_price_list_is_one_clear_line(self):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "a.json"
            file.write_text(json.dumps({"runs": []}), encoding="utf-8")
            done = subprocess.run([sys.executable, str(TOOLS / "choose_presets.py"), str(file)], capture_output=True,
                                  text=True, check=False)
        self.assertEqual(done.returncode, 3)
        self.assertIn("not the output of voxilux tradeoff", done.stderr)
        self.assertEqual(done.stderr.count("\n"), 1)


class Committed(unittest.TestCase):
    """Page, presets and picture are what the scripts make of prices.csv."""

    def test_page_and_presets_follow_the_prices(self):
        self.assertEqual(price_list.main(["--check"]), 0)

    def test_table_that_was_edited_is_found(self):
        with tempfile.TemporaryDirectory() as folder:
            page = pathlib.Path(folder) / "price_list.md"
            text = (TOP / "docs" / "price_list.md").read_text(encoding="utf-8")
            page.write_text(text.replace("| `draft` |", "| `draft` | 1", 1), encoding="utf-8")
            self.assertEqual(price_list.main(["--check", "--page", str(page)]), 5)

    def test_scenes_are_there(self):
        _, rows = prices.read_csv(price_list.PRICES)
        for scene in (*price_list.SCENES, *prices.scenes_of(rows)):
            self.assertTrue((TOP / "scenes" / f"{scene}.toml").exists(), scene)

    def test_picture_is_there_and_small(self):
        picture = (TOP / "docs" / "price_list.png").read_bytes()
        self.assertTrue(picture.startswith(b"\x89PNG"))
        self.assertLessEqual(len(picture), LARGEST_PICTURE)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])

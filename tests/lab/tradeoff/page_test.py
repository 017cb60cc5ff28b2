"""The page of a price list, from a made-up one.

    page_test.py FOLDER_OF_PAGE JOINED

The folder has page.py and its parts; JOINED is the script that the build makes of them.
"""

import contextlib
import html.parser
import io
import json
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

import fake_price_list
import needs

JOINED = pathlib.Path(sys.argv[2]).resolve()
FOLDER = pathlib.Path(sys.argv[1]).resolve()
sys.path.insert(0, str(FOLDER))
VOID = {"meta", "img", "br", "link", "hr", "input"}


class Ending:
    """Runs page.py in this process, because loading matplotlib takes longer than making a page."""

    def __init__(self, *words):
        import page

        err = io.StringIO()
        with contextlib.redirect_stderr(err):
            self.returncode = page.main([str(word) for word in words])
        self.stderr = err.getvalue()


def make(source, *, folder):
    """page.html in the folder."""
    return Ending(source, pathlib.Path(folder) / "page.html")


class Reader(html.parser.HTMLParser):
    """Elements that are closed in order, attributes that name something, ids, and the text without styles."""

    def __init__(self):
        super().__init__()
        self.open, self.faults, self.targets, self.ids, self.uses, self.alts, self.text = [], [], [], [], [], [], ""

    def handle_starttag(self, tag, attrs):
        named = dict(attrs)
        self.targets += [value for key, value in attrs if key in ("src", "href", "data", "action", "srcset")]
        self.uses += re.findall(r"url\(#([^)]*)\)", " ".join(str(value) for value in named.values()))
        if "id" in named:
            self.ids.append(named["id"])
        if tag in ("img", "svg"):
            self.alts.append(named.get("alt") or named.get("aria-label"))
        if tag not in VOID:
            self.open.append(tag)

    def handle_startendtag(self, tag, attrs):
        self.handle_starttag(tag, attrs)
        if tag not in VOID:
            self.open.pop()

    def handle_endtag(self, tag):
        if not self.open or self.open.pop() != tag:
            self.faults.append(f"</{tag}> at {self.getpos()}")

    def handle_data(self, data):
        if self.open and self.open[-1] != "style":
            self.text += data + " "


def read(text):
    reader = Reader()
    reader.feed(text)
    reader.close()
    reader.faults += [f"<{tag}> stays open" for tag in reader.open]
    reader.text = " ".join(reader.text.split())  # also turns spaces that do not break into plain ones
    return reader


class Page(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        with tempfile.TemporaryDirectory() as folder:
            source = fake_price_list.write(folder)
            done = make(source, folder=folder)
            assert done.returncode == 0, done.stderr
            cls.data = json.loads(source.read_text(encoding="utf-8"))
            cls.source = (pathlib.Path(folder) / "page.html").read_text(encoding="utf-8")
        cls.page = read(cls.source)

    def test_elements_are_closed_in_order(self):
        self.assertEqual(self.page.faults, [])
        self.assertTrue(self.source.startswith("<!DOCTYPE html>"))

    def test_ids_are_unique_and_what_uses_them_finds_them(self):
        self.assertEqual(len(self.page.ids), len(set(self.page.ids)))
        inside = [target[1:] for target in self.page.targets if target.startswith("#")]
        self.assertGreater(len(inside), 10)
        self.assertEqual(set(inside + self.page.uses) - set(self.page.ids), set())

    def test_names_no_other_file_or_address(self):
        text = re.sub(r"data:image/png;base64,[^\"]*", "", self.source)
        self.assertEqual(re.findall(r"https?:|//[a-z]|@import|<script|<link", text), [])
        outside = [target for target in self.page.targets if not target.startswith(("#", "data:image/png;base64,"))]
        self.assertEqual(outside, [])

    def test_every_run_is_named(self):
        for run in self.data["runs"]:
            label = next(knob["label"] for knob in self.data["knobs"] if knob["name"] == run["knob"])
            self.assertIn(f"{label}: {run['setting']}", self.page.text)

    def test_every_knob_and_effect_is_named_with_its_reason(self):
        for knob in self.data["knobs"]:
            self.assertIn(knob["why"], self.page.text)
        for effect in self.data["effects"]:
            self.assertIn(effect["reason"], self.page.text)

    def test_axes_have_units(self):
        plots = 1 + len(self.data["knobs"])
        self.assertEqual(self.page.text.count("time to take the samples (s)"), plots)
        self.assertEqual(self.page.text.count("error: root of relMSE (%)"), plots + 1)  # and that of noise and bias
        self.assertIn("time per sample of all pixels (ms)", self.page.text)
        self.assertIn("error without it: root of relMSE (%)", self.page.text)

    def test_front_stands_in_its_order(self):
        table = self.page.text[self.page.text.index("The Pareto front, setting by setting"):]
        places = [table.index(f"{number} {words}") for number, words in
                  enumerate(("samples per pixel: 1", "samples per pixel: 4", "occlusion cell: 20 px"), 1)]
        self.assertEqual(places, sorted(places))
        self.assertIn("4 times the time, 0.5 times the error", table)

    def test_machine_device_and_reference_are_named(self):
        for words in (self.data["machine"]["cpu"], "2 threads", "llvmpipe Mesa", "4096 samples per pixel",
                      "own noise 0.37 %", "kept from an earlier run", "scenes/<made up>.toml"):
            self.assertIn(words, self.page.text)

    def test_slopes_stand_with_their_intervals(self):
        self.assertIn("samples per pixel: slope -0.50 (-0.52 to -0.48)", self.page.text)
        self.assertIn("4.0 times the time", self.page.text)

    def test_settings_stand_with_the_slopes_of_their_own_samples(self):
        self.assertIn("white: slope -0.49 (-0.55 to -0.43)", self.page.text)

    def test_settings_that_change_nothing_or_were_left_out_are_told(self):
        self.assertIn("Every pixel is the same as with the default settings: dda, brick8, naadf.", self.page.text)
        self.assertIn("Left out: deep, needs more memory.", self.page.text)

    def test_bias_stands_apart_from_noise(self):
        self.assertIn("4.0 % (3.2 % to 4.9 %)", self.page.text)
        self.assertIn("\u2264 0.10 %", self.page.text)
        self.assertIn("bias (\u2264: none found)", self.page.text)

    def test_forced_effect_says_whether_it_matters(self):
        self.assertIn("caustics (forced on)", self.page.text)
        self.assertIn("0.020 % (within noise)", self.page.text)

    def test_pictures_and_plots_have_words_for_those_who_do_not_see_them(self):
        self.assertGreater(len(self.page.alts), 15)
        self.assertTrue(all(self.page.alts))

    def test_pictures_are_inside(self):
        groups = self.data["equal_time"]["runs"] + self.data["equal_error"]["runs"]
        self.assertEqual(self.source.count("data:image/png;base64,iVBOR"), 2 * len(groups) + 2)

    def test_difference_maps_have_a_scale(self):
        self.assertIn("Scale: relative difference of a pixel.", self.page.text)
        self.assertIn("0.10 % 3.0 % 100 %", self.page.text)

    def test_colours_follow_light_and_dark(self):
        self.assertIn("prefers-color-scheme: dark", self.source)
        self.assertEqual(re.findall(r"#0[1-4]0[0-9a-f]0[1-4]\b", self.source), [])
        used = set(re.findall(r"var\((--\w+)\)", self.source))
        for name in used:
            self.assertEqual(len(re.findall(rf"{name}:", self.source)), 2, name)

    def test_page_that_is_broken_is_found(self):
        self.assertNotEqual(read(self.source.replace("</table>", "", 1)).faults, [])
        self.assertNotEqual(read(self.source.replace("</svg>", "</figure>", 1)).faults, [])


class Joined(unittest.TestCase):
    def test_joined_source_runs_from_standard_input(self):
        """Runs the joined script as voxilux does, which holds it inside the binary."""
        with tempfile.TemporaryDirectory() as folder:
            source = fake_price_list.write(folder)
            done = make(source, folder=folder)
            self.assertEqual(done.returncode, 0, done.stderr)
            target = pathlib.Path(folder) / "joined.html"
            done = subprocess.run([sys.executable, "-", str(source), str(target)], input=JOINED.read_text(encoding="utf-8"),
                                  capture_output=True, text=True, check=False, cwd=folder)
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            self.assertTrue(target.read_bytes() == (pathlib.Path(folder) / "page.html").read_bytes())


class Changed(unittest.TestCase):
    """Price lists that lack something."""

    def made(self, change):
        with tempfile.TemporaryDirectory() as folder:
            source = fake_price_list.write(folder)
            data = json.loads(source.read_text(encoding="utf-8"))
            change(data, pathlib.Path(folder))
            source.write_text(json.dumps(data), encoding="utf-8")
            done = make(source, folder=folder)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual(done.stderr, "")
            page = read((pathlib.Path(folder) / "page.html").read_text(encoding="utf-8"))
        self.assertEqual(page.faults, [])
        return page.text

    def test_error_below_the_noise_of_the_reference(self):
        self.made(lambda data, _: data["runs"][4]["error"].update(total=0.0, noise=0.0))

    def test_bias_that_is_not_known(self):
        def change(data, _):
            for run in data["runs"]:
                run["error"].update(bias=None, bias_low=None, bias_high=None)
        self.assertIn("unknown", self.made(change))

    def test_no_pictures(self):
        def change(data, folder):
            (folder / "pictures" / "reference.png").unlink()
            data["equal_time"]["runs"][0]["picture"] = None
            data["equal_error"] = None
        text = self.made(change)
        self.assertIn("pictures/reference.png is not there", text)
        self.assertIn("no picture was kept", text)
        self.assertNotIn("Pictures at equal error", text)

    def test_one_run_alone(self):
        def change(data, _):
            data["runs"], data["knobs"], data["front"] = data["runs"][:1], [], [data["runs"][0]["id"]]
            data["equal_time"] = data["equal_error"] = None
            data["effects"] = []
        self.made(change)

    def test_many_knobs(self):
        def change(data, _):
            for index in range(12):
                data["knobs"].append(dict(data["knobs"][0], name=f"k{index}", label=f"knob {index}"))
        self.assertIn("knob 11 ", self.made(change))


class Refusal(unittest.TestCase):
    def expect(self, code, message, text):
        with tempfile.TemporaryDirectory() as folder:
            source = pathlib.Path(folder) / "tradeoff.json"
            source.write_text(text, encoding="utf-8")
            done = make(source, folder=folder)
            self.assertFalse((pathlib.Path(folder) / "page.html").exists())
        self.assertEqual(done.returncode, code, done.stderr)
        self.assertIn(message, done.stderr)
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)

    def changed(self, change):
        with tempfile.TemporaryDirectory() as folder:
            data = fake_price_list.price_list(pathlib.Path(folder))
        change(data)
        return json.dumps(data)

    def test_no_json(self):
        self.expect(3, "is not JSON", "{")
        self.expect(3, "tradeoff is not an object", "[]")
        self.expect(3, "NaN is no JSON number", '{"seed": NaN}')
        self.expect(3, "tradeoff: 'version' is missing", "{}")

    def test_wrong_kind_is_named_with_its_place(self):
        self.expect(3, "tradeoff.runs[2].time_s.low is not a number",
                    self.changed(lambda data: data["runs"][2]["time_s"].update(low="1 s")))
        self.expect(3, "tradeoff.machine.threads is not a number",
                    self.changed(lambda data: data["machine"].update(threads=True)))
        self.expect(3, "tradeoff.effects[0].on is not true or false",
                    self.changed(lambda data: data["effects"][0].update(on=1)))
        self.expect(3, "tradeoff.knobs is not a list", self.changed(lambda data: data.update(knobs={})))

    def test_what_cannot_be_drawn(self):
        self.expect(3, "tradeoff.runs is empty", self.changed(lambda data: data.update(runs=[])))
        self.expect(3, "tradeoff.front is empty", self.changed(lambda data: data.update(front=[])))
        self.expect(3, "time is not above 0",
                    self.changed(lambda data: data["runs"][0]["time_s"].update(median=0)))
        self.expect(3, "front names the run 'ghost'", self.changed(lambda data: data["front"].append("ghost")))

    def test_colour_that_is_none(self):
        self.expect(3, "difference_colours: 'red;' is not '#rrggbb'",
                    self.changed(lambda data: data["difference_colours"][0].update(colour="red;")))

    def test_files_that_are_not_there(self):
        with tempfile.TemporaryDirectory() as folder:
            done = make("none.json", folder=folder)
            self.assertEqual((done.returncode, done.stderr), (3, "page.py: none.json: No such file or directory\n"))
            done = Ending(fake_price_list.write(folder), "no/such/page.html")
            self.assertEqual((done.returncode, done.stderr),
                             (73, "page.py: no/such/page.html: No such file or directory\n"))

    def test_words_that_are_missing(self):
        done = Ending()
        self.assertEqual((done.returncode, done.stderr), (2, "page.py: usage: page.py tradeoff.json page.html\n"))


if __name__ == "__main__":
    needs.need_modules("matplotlib")
    unittest.main(argv=sys.argv[:1])

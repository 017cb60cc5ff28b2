"""The page of a price list in headless Chromium, light and dark.

    chromium_test.py FOLDER_OF_PAGE     exit code 77 where Chromium is missing, which no command installs
"""

import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

import fake_price_list
import needs

sys.path.insert(0, str(pathlib.Path(sys.argv[1]).resolve()))
SIZE = (1200, 5000)
DARK = "--blink-settings=preferredColorScheme=0"
PAPER = {"light": (255, 255, 255), "dark": (0x14, 0x17, 0x1B)}


def picture_of(chromium, page, folder, *words):
    """What Chromium shows of the page, as RGB."""
    from PIL import Image

    target = pathlib.Path(folder) / "page.png"
    subprocess.run([chromium, "--headless", "--no-sandbox", "--disable-gpu", "--hide-scrollbars",
                    "--host-resolver-rules=MAP * ~NOTFOUND", f"--user-data-dir={folder}/profile",
                    f"--window-size={SIZE[0]},{SIZE[1]}", f"--screenshot={target}", *words, page.as_uri()],
                   capture_output=True, timeout=240, check=True)
    return Image.open(target).convert("RGB")


class Shown(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        import page

        with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as folder:
            target = pathlib.Path(folder).resolve() / "page.html"
            code = page.main([str(fake_price_list.write(folder)), str(target)])
            assert code == 0
            cls.pictures = {"light": picture_of(CHROMIUM, target, folder),
                            "dark": picture_of(CHROMIUM, target, folder, DARK)}

    def test_paper_follows_the_scheme(self):
        for scheme, colour in PAPER.items():
            self.assertEqual(self.pictures[scheme].getpixel((2, 2)), colour, scheme)

    def test_page_is_full_from_top_to_bottom(self):
        """Every stretch of 400 pixels has something other than background."""
        for scheme, picture in self.pictures.items():
            for top in range(0, SIZE[1] - 400, 400):
                stretch = picture.crop((0, top, SIZE[0], top + 400))
                self.assertGreater(len(stretch.getcolors(1 << 22)), 20, f"{scheme}, from row {top}")

    def test_nothing_runs_over_the_side(self):
        for scheme, picture in self.pictures.items():
            side = picture.crop((SIZE[0] - 8, 0, SIZE[0], SIZE[1]))
            self.assertEqual([colour for _, colour in side.getcolors(1 << 16)], [PAPER[scheme]], scheme)

    def test_knobs_keep_their_colours_apart_in_both_schemes(self):
        from page_plots import DARK as dark, LIGHT as light

        for scheme, names in (("light", light), ("dark", dark)):
            found = {colour for _, colour in self.pictures[scheme].getcolors(1 << 24)}
            for name in names[:4]:
                rgb = tuple(int(name[i:i + 2], 16) for i in (1, 3, 5))
                self.assertIn(rgb, found, f"{scheme} {name}")


if __name__ == "__main__":
    CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser")
    if not CHROMIUM:
        print("skipped: chromium is not there: apt-get install chromium")
        sys.exit(needs.SKIPPED)
    needs.need_modules("matplotlib", "PIL")
    unittest.main(argv=sys.argv[:1])

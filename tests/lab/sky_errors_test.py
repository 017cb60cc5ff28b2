"""The price list of the sky: which rows of a test's output it takes, and that its page holds them.

    sky_errors_test.py FOLDER_OF_LAB
"""

import sys
import unittest

sys.path.insert(0, sys.argv.pop(1))
import sky_errors  # noqa: E402

OUTPUT = """[ RUN      ] SkyPriceExternal.errors
| rows 16 | 2.5 1.7 1.6 (+0.8 +0.1 -0.9) | 3.0 2.0 1.0 (+0.0 +0.0 +0.0) | 8.0 8.1 9.2 (+1.3 +1.1 -0.4) | 28 |
| a | table | of | something | else |
"""


class Rows(unittest.TestCase):
    def test_rows_of_the_output_are_taken_and_nothing_else(self):
        (name, rms, line), = sky_errors.rows_of(OUTPUT)
        self.assertEqual(name, "rows 16")
        self.assertEqual(rms, [(2.5, 1.7, 1.6), (3.0, 2.0, 1.0), (8.0, 8.1, 9.2)])
        self.assertTrue(line.startswith("| rows 16 | 2.5 1.7 1.6 (+0.8 +0.1 -0.9) |") and "28" not in line)

    def test_page_has_the_rows_between_its_marks(self):
        page = sky_errors.PAGE.read_text(encoding="utf-8")
        table = page.split(sky_errors.BEGIN)[1].split(sky_errors.END)[0]
        self.assertGreater(len(table.splitlines()), 8)
        self.assertIn(sky_errors.HEAD, table)
        self.assertTrue(sky_errors.PICTURE.exists())

    def test_binary_that_prints_no_rows_is_refused(self):
        self.assertEqual(sky_errors.main(["/bin/true"]), sky_errors.MISSING)


if __name__ == "__main__":
    unittest.main()

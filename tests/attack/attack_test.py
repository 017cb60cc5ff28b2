#!/usr/bin/env python3
"""Programs that break a promise. Each attack has to notice."""

import pathlib
import random
import tempfile
import unittest
from unittest import mock

import attack

CUT = "while [ \"$1\" != -o ]; do shift; done\nprintf '\\166\\057\\061\\001' > \"$2\"\n"


class Twins(unittest.TestCase):
    def bench(self, script):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        top = pathlib.Path(scratch.name)
        (top / "try").mkdir()
        (top / "fake").write_text("#!/bin/sh\n" + script)
        (top / "fake").chmod(0o755)
        return attack.Bench(top / "fake", top / "try", top / "caches")

    def test_program_that_takes_no_signal(self):
        script = 'echo \'{"done": 0.1, "sample": 1}\' >&2\nexec sleep 3\n'
        with mock.patch("time.sleep"):
            self.assertIsNotNone(attack.stop_by_signal(self.bench(script), random.Random(1)))

    def test_pictures_that_are_cut_short(self):
        for trial in (attack.fill_disk, attack.limit_time):
            self.assertIn("cut short", trial(self.bench(CUT), random.Random(0)) or "", trial.__name__)

    def test_crash_and_control_characters(self):
        self.assertIn("ended with", attack.name_oddly(self.bench("exit 70"), random.Random(1)))
        self.assertIn("control", attack.name_oddly(self.bench("printf '\\033[2J' >&2; exit 2"), random.Random(1)))

    def test_render_that_does_not_go_on(self):
        with mock.patch("time.sleep"):
            self.assertIsNotNone(attack.kill_and_resume(self.bench("exec sleep 1\n"), random.Random(1)))


if __name__ == "__main__":
    unittest.main()

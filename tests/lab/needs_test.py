"""A missing module skips a test, and fails it where CI=true."""

import os
import subprocess
import sys
import unittest


def code_of(ci, *modules):
    words = [sys.executable, "-c", f"import needs; needs.need_modules(*{modules!r})"]
    return subprocess.run(words, env={**os.environ, "CI": ci}, stdout=subprocess.DEVNULL, check=False).returncode


class NeedModules(unittest.TestCase):
    def test_missing_module_skips(self):
        self.assertEqual(code_of("", "json", "no_such_module"), 77)
        self.assertEqual(code_of("false", "no_such_module"), 77)

    def test_missing_module_fails_where_ci_is_true(self):
        self.assertEqual(code_of("true", "json", "no_such_module"), 1)

    def test_modules_that_are_there_let_the_test_run(self):
        self.assertEqual(code_of("true", "json", "unittest"), 0)


if __name__ == "__main__":
    unittest.main()

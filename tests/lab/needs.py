"""Skips tests whose modules or programs the machine lacks."""

import importlib.util
import os
import shutil
import sys

SKIPPED = 77  # ctest's SKIP_RETURN_CODE


def need_modules(*names):
    """Skips the test where one of Debian's modules is missing. With CI=true it fails instead, because the second command of
    the README has installed them."""
    _skip_without([name for name in names if importlib.util.find_spec(name) is None])


def need_programs(*names):
    """The same for programs."""
    _skip_without([name for name in names if shutil.which(name) is None])


def _skip_without(missing):
    if missing:
        print(f"missing: {', '.join(missing)}; setup/packages.txt has their packages")
        sys.exit(1 if os.environ.get("CI") == "true" else SKIPPED)

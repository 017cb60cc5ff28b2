"""What a test needs and the machine may lack."""

import importlib.util
import os
import shutil
import sys

SKIPPED = 77  # ctest's SKIP_RETURN_CODE


def need_modules(*names):
    """Ends the test where one of Debian's modules is missing: it is skipped. Where CI=true it fails, because the
    second command of the README has installed them, and a skip would leave nothing that guards."""
    _skip_without([name for name in names if importlib.util.find_spec(name) is None])


def need_programs(*names):
    """The same for programs."""
    _skip_without([name for name in names if shutil.which(name) is None])


def _skip_without(missing):
    if missing:
        print(f"missing: {', '.join(missing)}; setup/packages.txt has their packages")
        sys.exit(1 if os.environ.get("CI") == "true" else SKIPPED)

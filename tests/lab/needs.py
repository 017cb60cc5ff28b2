"""What a test needs and the machine may lack."""

import importlib.util
import os
import sys

SKIPPED = 77  # ctest's SKIP_RETURN_CODE


def need_modules(*names):
    """Ends the test where one of Debian's modules is missing: it is skipped. Where CI=true it fails, because the
    second command of the README has installed them, and a skip would leave nothing that guards."""
    missing = [name for name in names if importlib.util.find_spec(name) is None]
    if missing:
        print(f"missing: {', '.join(missing)}; setup/packages.txt has their packages")
        sys.exit(1 if os.environ.get("CI") == "true" else SKIPPED)

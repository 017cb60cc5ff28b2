"""The image of the sky in scenes/ is what its script writes.

    studio_sky_test.py STUDIO_SKY SCENES
"""

import pathlib
import subprocess
import sys
import tempfile
import unittest

SCRIPT, SCENES = sys.argv[1:3]


class StudioSky(unittest.TestCase):
    def test_image_in_the_repository_is_what_the_script_writes(self):
        with tempfile.TemporaryDirectory() as folder:
            image = pathlib.Path(folder, "studio.hdr")
            subprocess.run([sys.executable, SCRIPT, str(image)], check=True)
            self.assertEqual(image.read_bytes(), pathlib.Path(SCENES, "studio.hdr").read_bytes())


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])

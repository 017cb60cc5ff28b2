"""The Debian package that cpack makes: what it needs, what it holds, and what lintian says if it is installed.

    deb_test.py BUILD_FOLDER
"""

import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

from needs import need_programs

BUILD = sys.argv[1]
need_programs("dpkg-deb", "dpkg-shlibdeps", "file")


def output(*words):
    return subprocess.run(words, check=True, stdout=subprocess.PIPE, text=True).stdout


def lintian_errors(package):
    done = subprocess.run(["lintian", "--allow-root", str(package)], stdout=subprocess.PIPE, text=True, check=False)
    return re.findall(r"^E: .*", done.stdout, re.M)


class Package(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp())
        subprocess.run(["cpack", "--config", f"{BUILD}/CPackConfig.cmake", "-B", str(cls.folder)], check=True,
                       stdout=subprocess.DEVNULL)
        (cls.package,) = cls.folder.glob("*.deb")

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    def field(self, name):
        return output("dpkg-deb", "--field", str(self.package), name)

    def test_needs_the_libraries_that_it_links_and_a_vulkan_device(self):
        needed = re.split(r",\s*", self.field("Depends").strip())
        names = {need.split()[0] for need in needed}
        self.assertLessEqual({"libc6", "libvulkan1", "libglfw3", "libopenexr-3-1-30", "libfmt9"}, names)
        self.assertIn("mesa-vulkan-drivers | vulkan-icd", needed)
        self.assertIn("python3-distributed", self.field("Suggests"))
        self.assertFalse([name for name in names if name.endswith("-dev")])

    def test_holds_files_of_root_below_usr_alone(self):
        rows = [line.split() for line in output("dpkg-deb", "--contents", str(self.package)).splitlines()]
        self.assertEqual({row[1] for row in rows}, {"root/root"})
        names = {row[5] for row in rows}
        self.assertFalse([name for name in names if not name.startswith("./usr/") and name != "./"])
        for name in ("bin/voxilux", "share/man/man1/voxilux.1.gz", "share/zsh/vendor-completions/_voxilux",
                     "share/doc/voxilux/changelog.Debian.gz", "share/voxilux/scenes/cornell.toml"):
            self.assertIn(f"./usr/{name}", names)

    def test_runs_nothing_when_it_is_installed(self):
        output("dpkg-deb", "--control", str(self.package), str(self.folder / "control"))
        self.assertEqual({file.name for file in (self.folder / "control").iterdir()}, {"control", "md5sums"})

    @unittest.skipUnless(shutil.which("lintian"), "no lintian")
    def test_lintian_finds_no_error(self):
        self.assertEqual(lintian_errors(self.package), [])
        broken = self.folder / "broken"
        output("dpkg-deb", "--raw-extract", str(self.package), str(broken))
        (broken / "usr/share/doc/voxilux/copyright").unlink()
        output("dpkg-deb", "--build", "--root-owner-group", str(broken), str(self.folder / "broken.deb"))
        self.assertNotEqual(lintian_errors(self.folder / "broken.deb"), [])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])

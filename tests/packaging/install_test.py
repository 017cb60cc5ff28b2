"""cmake --install into a folder that is moved afterwards: everything is there, works, and can be read by desktops.

    install_test.py BUILD_FOLDER SOURCE_FOLDER
"""

import configparser
import pathlib
import resource
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest

from needs import need_modules, need_programs

BUILD, SOURCE = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
need_modules("matplotlib")
need_programs("desktop-file-validate", "appstreamcli", "update-mime-database")

FILES = ["bin/voxilux", "share/applications/voxilux.desktop", "share/bash-completion/completions/voxilux",
         "share/doc/voxilux/README.md", "share/doc/voxilux/copyright", "share/doc/voxilux/docs/window.png",
         "share/fish/vendor_completions.d/voxilux.fish", "share/icons/hicolor/scalable/apps/voxilux.svg",
         "share/man/man1/voxilux.1.gz", "share/metainfo/voxilux.metainfo.xml", "share/mime/packages/voxilux.xml",
         "share/thumbnailers/voxilux.thumbnailer", "share/voxilux/scenes/first_light.toml",
         "share/zsh/site-functions/_voxilux"]
LONGEST_THUMBNAIL_S = 5.0  # of the processor, for a small file: as long as the thumbnailer's --time-limit


def chunk(name, content, children=b""):
    return name + struct.pack("<ii", len(content), len(children)) + content + children


def transform(node, child, place=None):
    words = struct.pack("<i2si", 2, b"_t", len(place)) + place.encode() if place else b""
    frame = struct.pack("<i", 1 if place else 0) + words
    return chunk(b"nTRN", struct.pack("<iiiiii", node, 0, child, -1, -1, 1) + frame)


def vox_file(side=24, instances=0):
    """A solid block of voxels, once or as so many instances beside each other."""
    cells = [(x, y, z) for x in range(side) for y in range(side) for z in range(side)]
    voxels = struct.pack("<i", len(cells)) + b"".join(struct.pack("4B", *cell, 79) for cell in cells)
    model = chunk(b"SIZE", struct.pack("<iii", side, side, side)) + chunk(b"XYZI", voxels)
    nodes = b""
    if instances:
        names = [2 + 2 * i for i in range(instances)]
        nodes = transform(0, 1) + chunk(b"nGRP", struct.pack(f"<iii{instances}i", 1, 0, instances, *names))
        for i, name in enumerate(names):
            nodes += transform(name, name + 1, f"{side * (i % 50)} {side * (i // 50)} 0")
            nodes += chunk(b"nSHP", struct.pack("<iiiii", name + 1, 0, 1, 0, 0))
    return b"VOX " + struct.pack("<i", 150) + chunk(b"MAIN", b"", model + nodes)


def cpu_seconds():
    """Of all children that have ended; other work on the machine does not count."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def size_of_png(file):
    head = file.read_bytes()[:24]
    return struct.unpack(">II", head[16:24]) if head.startswith(b"\x89PNG") else None


class Installed(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp())
        first, cls.prefix = cls.folder / "first", cls.folder / "moved here"
        install = ["cmake", "--install", str(BUILD), "--prefix", str(first)]
        subprocess.run(install, check=True, stdout=subprocess.DEVNULL)
        first.rename(cls.prefix)

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    def run_voxilux(self, *words):
        program = str(self.prefix / "bin" / "voxilux")
        return subprocess.run([program, *words], capture_output=True, text=True, check=False, cwd=self.folder)

    def thumbnail(self, vox, cpu="10"):
        """Runs what the thumbnailer entry says, as file managers do: into a file that is there already."""
        entry = configparser.RawConfigParser()
        entry.read(self.prefix / "share/thumbnailers/voxilux.thumbnailer")
        picture = self.folder / "thumbnail.png"
        picture.write_bytes(b"")
        values = {"%i": str(vox), "%o": str(picture), "%sx%s": "128x128"}
        words = [values.get(word, word) for word in entry["Thumbnailer Entry"]["Exec"].split()]
        limits = ["prlimit", "--cpu=10", "--as=4294967296"]
        self.assertEqual(words[:4], [*limits, "voxilux"])
        words = ["prlimit", f"--cpu={cpu}", limits[2], str(self.prefix / "bin" / "voxilux"), *words[4:]]
        before = cpu_seconds()
        done = subprocess.run(words, capture_output=True, text=True, check=False, cwd=self.folder)
        return done, picture, cpu_seconds() - before

    def test_everything_is_there(self):
        self.assertEqual([name for name in FILES if not (self.prefix / name).is_file()], [])
        scenes = {file.name for file in (SOURCE / "scenes").iterdir()}
        self.assertEqual({file.name for file in (self.prefix / "share/voxilux/scenes").iterdir()}, scenes)

    def test_moved_program_renders_an_installed_scene(self):
        scene = self.prefix / "share/voxilux/scenes/mixed.toml"
        done = self.run_voxilux("render", str(scene), "--size", "32x24", "--spp", "1", "-o", "a.png", "--quiet")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertEqual(size_of_png(self.folder / "a.png"), (32, 24))

    def test_python_of_the_program_is_found(self):
        scene = self.prefix / "share/voxilux/scenes/one_voxel.toml"
        done = self.run_voxilux("tradeoff", str(scene), "-o", "prices", "--size", "16x12", "--spp", "4",
                                "--time-limit", "3s", "--quiet")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertIn("<html", (self.folder / "prices/tradeoff.html").read_text(encoding="utf-8"))

    def test_nothing_installed_names_the_build_folder(self):
        named = [file for file in self.prefix.rglob("*") if file.is_file() and bytes(SOURCE) in file.read_bytes()]
        self.assertEqual(named, [])

    def test_thumbnail_is_made_quietly_and_in_time(self):
        vox = self.folder / "block.vox"
        vox.write_bytes(vox_file())
        done, picture, seconds = self.thumbnail(vox)
        self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "", ""))
        self.assertEqual(size_of_png(picture), (128, 128))
        self.assertLess(seconds, LONGEST_THUMBNAIL_S)

    def test_file_that_takes_too_long_has_no_thumbnail(self):
        vox = self.folder / "crowd.vox"
        vox.write_bytes(vox_file(side=100, instances=2000))
        done, picture, seconds = self.thumbnail(vox, cpu="1")
        self.assertNotEqual(done.returncode, 0)
        self.assertEqual(picture.read_bytes(), b"")
        self.assertLess(seconds, LONGEST_THUMBNAIL_S)

    def test_broken_file_has_no_thumbnail(self):
        vox = self.folder / "broken.vox"
        vox.write_bytes(vox_file()[:200])
        done, picture, _ = self.thumbnail(vox)
        self.assertEqual(done.returncode, 3)
        self.assertEqual(picture.read_bytes(), b"")

    def test_desktop_file_is_valid(self):
        entry = self.prefix / "share/applications/voxilux.desktop"
        validate = ["desktop-file-validate", str(entry)]
        self.assertEqual(subprocess.run(validate, check=False).returncode, 0)
        broken = self.folder / "broken.desktop"
        broken.write_text(entry.read_text(encoding="utf-8").replace("Exec=", "Exes="), encoding="utf-8")
        validate[1] = str(broken)
        self.assertNotEqual(subprocess.run(validate, stdout=subprocess.DEVNULL, check=False).returncode, 0)

    def validate_metadata(self, file):
        # There is no domain to name it by.
        words = ["appstreamcli", "validate", "--no-net", "--override=cid-desktopapp-is-not-rdns=info", str(file)]
        return subprocess.run(words, stdout=subprocess.DEVNULL, check=False).returncode

    def test_metadata_is_valid(self):
        file = self.prefix / "share/metainfo/voxilux.metainfo.xml"
        self.assertEqual(self.validate_metadata(file), 0)
        broken = self.folder / "broken.metainfo.xml"
        broken.write_text(file.read_text(encoding="utf-8").replace("summary>", "sumary>"), encoding="utf-8")
        self.assertNotEqual(self.validate_metadata(broken), 0)

    def test_desktops_know_vox_files_by_name_and_content(self):
        mime = self.folder / "mime"
        shutil.copytree(self.prefix / "share/mime", mime)
        subprocess.run(["update-mime-database", str(mime)], check=True, stderr=subprocess.DEVNULL)
        self.assertIn("model/x-magicavoxel:*.vox", (mime / "globs2").read_text(encoding="utf-8"))
        self.assertIn(b"VOX ", (mime / "magic").read_bytes())


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])

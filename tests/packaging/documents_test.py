"""The documents as a reader finds them: links lead somewhere, pictures are small, commands are those of the README.

    documents_test.py SOURCE_FOLDER
"""

import pathlib
import re
import sys
import unittest

TOP = pathlib.Path(sys.argv[1])
LARGEST_PICTURE = 400 * 1024  # bytes: they are loaded with the front page
LONGEST_LINE = 110


def documents():
    return [file for file in sorted(TOP.rglob("*.md")) if file.relative_to(TOP).parts[0] not in ("build", "out")]


def without_code(text):
    text = re.sub(r"^```.*?^```", "", text, flags=re.M | re.S)
    return re.sub(r"`[^`\n]*`", "``", re.sub(r"^    .*", "", text, flags=re.M))


def anchors(text):
    """What the headings of a document are called in links: lower case, hyphens for spaces, no punctuation."""
    heads = re.findall(r"^#+ +(.*)", re.sub(r"^```.*?^```", "", text, flags=re.M | re.S), re.M)
    return {re.sub(r"[^\w\- ]", "", head.lower()).strip().replace(" ", "-") for head in heads}


def broken_links(file, text):
    """Relative links of a document at this place that lead nowhere."""
    broken = []
    for link in re.findall(r"\]\(([^)\s]+)\)", without_code(text)):
        if re.match(r"[a-z]+:", link):
            continue
        path, _, anchor = link.partition("#")
        target = file.parent / path if path else file
        is_there = not path or target.exists()
        known = anchors(target.read_text(encoding="utf-8") if path and target.is_file() and anchor else text)
        if not is_there or (anchor and anchor not in known):
            broken.append(f"{file.relative_to(TOP)}: {link}")
    return broken


def two_commands(readme):
    """The commands of the first block of code, which must stand before every picture and section."""
    start = re.match(r"# .*?^```sh\n(.*?)^```", readme, re.M | re.S)
    before = readme[: start.start(1)]
    assert "![" not in before and "\n## " not in before
    return [line.partition("#")[0].strip() for line in start.group(1).splitlines()]


def steps(workflow):
    return re.findall(r"^ *- run: (.*)$", workflow, re.M)


def packages():
    lines = (TOP / "setup/packages.txt").read_text(encoding="utf-8").splitlines()
    return [line.split()[0] for line in lines if not line.startswith("#")]


class Links(unittest.TestCase):
    def test_every_relative_link_and_anchor_leads_somewhere(self):
        self.assertGreater(len(documents()), 15)
        for file in documents():
            self.assertEqual(broken_links(file, file.read_text(encoding="utf-8")), [])

    def test_broken_links_are_found(self):
        text = ("# A b, `c`!\n[a](gone.md) [b](#a-b-c) [c](#gone) [d](https://x.org) `[e](gone)` [f](LICENSE)\n"
                "```\n[g](gone)\n```\n")
        self.assertEqual(broken_links(TOP / "x.md", text), ["x.md: gone.md", "x.md: #gone"])


class FrontPage(unittest.TestCase):
    readme = (TOP / "README.md").read_text(encoding="utf-8")

    def test_two_commands_come_first_and_are_what_ci_runs(self):
        commands = two_commands(self.readme)
        self.assertEqual(commands, ["./first_picture.sh", "./all_tests.sh"])
        workflow = (TOP / ".github/workflows/ci.yml").read_text(encoding="utf-8")
        self.assertEqual(steps(workflow), commands)
        self.assertIn("container: debian:12\n", workflow)
        self.assertNotIn("${{", workflow)
        own = (TOP / ".ci/run").read_text(encoding="utf-8").splitlines()
        self.assertEqual([line for line in own if line.startswith("./")], commands)

    def test_workflow_with_a_step_more_is_found(self):
        self.assertNotEqual(steps("  - run: ./first_picture.sh\n  - run: apt-get install x\n  - run: ./all_tests.sh\n"),
                            two_commands(self.readme))

    def test_pictures_follow_the_commands(self):
        pictures = re.findall(r"!\[[^\]]+\]\(([^)]+)\)", self.readme)
        self.assertEqual(len(pictures), 3)
        self.assertLess(self.readme.index("!["), self.readme.index("\n## "))
        self.assertLess(len(self.readme.splitlines()), 90, "the front page is to be read in a minute")

    def test_pictures_are_small(self):
        for picture in (TOP / "docs").glob("*.png"):
            self.assertLessEqual(picture.stat().st_size, LARGEST_PICTURE, picture.name)


class Texts(unittest.TestCase):
    def test_every_package_is_in_the_list_of_third_parties(self):
        named = (TOP / "docs/third_party.md").read_text(encoding="utf-8")
        self.assertGreater(len(packages()), 30)
        self.assertEqual([package for package in packages() if f"`{package}`" not in named], [])

    def test_changes_and_metadata_tell_of_this_version(self):
        project = (TOP / "CMakeLists.txt").read_text(encoding="utf-8")
        newest = re.search(r"^## ([\d.]+) \((.*)\)$", (TOP / "CHANGELOG.md").read_text(encoding="utf-8"), re.M).groups()
        metadata = (TOP / "packaging/voxilux.metainfo.xml").read_text(encoding="utf-8")
        self.assertEqual(newest, re.search(r'<release version="(.*)" date="(.*)"/>', metadata).groups())
        self.assertEqual(newest[0], re.search(r"project\(voxilux VERSION ([\d.]+)", project).group(1))

    def test_lines_are_short(self):
        for file in documents():
            long = [line for line in file.read_text(encoding="utf-8").splitlines()
                    if len(line) > LONGEST_LINE and not line.startswith(("|", "    "))]
            self.assertEqual(long, [], file)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])

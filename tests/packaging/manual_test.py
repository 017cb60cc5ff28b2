"""The manual page and the completions against --help, flag by flag, in the shells themselves.

    manual_test.py VOXILUX
"""

import functools
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

from needs import need_programs

VOXILUX = sys.argv[1]
need_programs("mandoc", "bash", "zsh", "fish")


def output(*words):
    return subprocess.run(words, check=True, capture_output=True, text=True).stdout


@functools.cache
def generated(what):
    return output(VOXILUX, "generate", what)


@functools.cache
def commands():
    """Flags of each command as --help lists them, by its words: {("bench", "march"): {"-h", "--help", ...}}."""
    found = {}

    def look(path):
        text = output(VOXILUX, *path, "--help")
        found[path] = {name for names in re.findall(r"^  (-[^ ]+)", text, re.M) for name in names.split(",")}
        parts = re.search(r"^Subcommands:\n((?:  .*\n)*)", text, re.M)
        for name in re.findall(r"^  (\w+)", parts.group(1), re.M) if parts else ():
            look((*path, name))

    look(())
    return found


# ---- what each document says of a command ----


def man_flags(page):
    """Flags in bold that start the entries of each .SS section."""
    found = {}
    for section in re.split(r"^\.S[HS] ", page.replace("\\-", "-"), flags=re.M)[1:]:
        title, _, body = section.partition("\n")
        path = tuple(title.split()[1:]) if title.startswith("voxilux") else () if title == "DESCRIPTION" else None
        if path is not None:
            entries = re.findall(r"^\.TP\n(.*)", body, re.M)
            found[path] = {name for entry in entries for name in re.findall(r"\\fB(-[^\\]*)\\fR", entry)}
    return found


def bash_words(script, words):
    """What bash would offer for the last of the words."""
    line = f"COMP_WORDS=({' '.join(map(repr, words))}); COMP_CWORD={len(words) - 1}"
    program = f"{script}\n{line}\n_voxilux\n" + 'printf "%s\\n" "${COMPREPLY[@]}"'
    return set(output("bash", "-c", program).split())


def zsh_flags(script, path):
    """The flags in the specifications that the script gives to _arguments."""
    functions = script.replace('_voxilux "$@"\n', "")
    program = f"_arguments() {{ print -rl -- $@ }}\n{functions}{'_'.join(('_voxilux', *path))}"
    specifications = output("zsh", "-f", "-c", program).split("\n")
    names = (re.match(r"(?:\*|\([^)]*\))(-[^\[]*)\[", one) for one in specifications)
    return {name.group(1) for name in names if name}


def fish_words(script, line):
    """What fish would offer for the end of the line, without configuration and in an empty folder."""
    program = f"source -; complete -C '{line}'"
    with tempfile.TemporaryDirectory() as home:
        done = subprocess.run(["fish", "-c", program], input=script, check=True, stdout=subprocess.PIPE, text=True,
                              cwd=home, env={"HOME": home, "PATH": "/usr/bin:/bin"})
    return {one.split("\t")[0] for one in done.stdout.split("\n") if one}


class Manual(unittest.TestCase):
    def test_page_has_every_flag_of_every_command(self):
        self.assertGreater(sum(map(len, commands().values())), 200)
        documented = man_flags(generated("man"))
        for path, flags in commands().items():
            if path != ("bench",):
                self.assertEqual(documented[path], flags, path)

    def test_page_tells_defaults(self):
        self.assertIn("\n\\fB--resolution\\fR \\fIN\\fR\n", generated("man").replace("\\-", "-"))
        self.assertRegex(generated("man"), r"resolution.*\n.*\(default 256\)\n")

    def test_flag_that_the_page_lacks_is_found(self):
        page = generated("man").replace(".TP\n\\fB\\-\\-crop", "\n\\fB\\-\\-crop", 1)
        self.assertNotEqual(man_flags(page)[("render",)], commands()[("render",)])

    def test_page_is_well_formed(self):
        with tempfile.NamedTemporaryFile("w", suffix=".1") as file:
            file.write(generated("man"))
            file.flush()
            lint = ["mandoc", "-T", "lint", "-W", "warning", file.name]
            done = subprocess.run(lint, stdout=subprocess.PIPE, text=True, check=False)
        faults = [line for line in done.stdout.splitlines() if "missing date" not in line]
        self.assertEqual(faults, [])

    def test_page_has_the_exit_codes_of_help(self):
        page = generated("man").replace("\\-", "-")
        for line in re.findall(r"^ +\d+  .*$", output(VOXILUX, "--help"), re.M):
            self.assertIn(line, page)

    def test_generator_is_hidden(self):
        self.assertNotIn("generate", output(VOXILUX, "--help") + generated("man") + generated("bash"))


class Bash(unittest.TestCase):
    def test_offers_every_flag(self):
        for path, flags in commands().items():
            self.assertEqual(bash_words(generated("bash"), ["voxilux", *path, "-"]), flags, path)

    def test_flag_that_it_lacks_is_found(self):
        script = generated("bash").replace(" --crop ", " ", 1)
        self.assertNotEqual(bash_words(script, ["voxilux", "render", "-"]), commands()[("render",)])

    def test_offers_subcommands_values_and_files(self):
        words = functools.partial(bash_words, generated("bash"))
        self.assertEqual(words(["voxilux", "vo"]), {"voxelize"})
        self.assertEqual(words(["voxilux", "bench", ""]), {"march", "ao", "photons"})
        self.assertEqual(words(["voxilux", "render", "--quality", ""]), {"draft", "normal", "fine", "reference"})
        self.assertEqual(words(["voxilux", "render", "--tone", "=", "f"]), {"filmic"})
        self.assertEqual(words(["voxilux", "render", "--spp", ""]), set())
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "a.vox"
            file.touch()
            self.assertEqual(words(["voxilux", "render", f"{folder}/"]), {str(file)})
            self.assertEqual(words(["voxilux", "render", "-o", f"{folder}/a"]), {str(file)})


class Zsh(unittest.TestCase):
    def test_specifies_every_flag(self):
        for path, flags in commands().items():
            self.assertEqual(zsh_flags(generated("zsh"), path), flags, path)

    def test_flag_that_it_lacks_is_found(self):
        script = re.sub(r"^.*--crop.*\n", "", generated("zsh"), count=1, flags=re.M)
        self.assertNotEqual(zsh_flags(script, ("render",)), commands()[("render",)])

    def test_values_and_files_are_in_the_specifications(self):
        self.assertIn(":(draft normal fine reference)'", generated("zsh"))
        self.assertIn("'*:INPUT:_files'", generated("zsh"))


class Fish(unittest.TestCase):
    def test_offers_every_flag(self):
        for path, flags in commands().items():
            line = " ".join(("voxilux", *path))
            script = generated("fish")
            short = {f"-{name[1]}" for name in fish_words(script, f"{line} -") if len(name) == 2}
            long = {name.rstrip("=") for name in fish_words(script, f"{line} --")}
            self.assertEqual(short | long, flags, path)

    def test_flag_that_it_lacks_is_found(self):
        script = re.sub(r"^.*from render.* -l crop .*\n", "", generated("fish"), count=1, flags=re.M)
        offered = fish_words(generated("fish"), "voxilux render --")
        self.assertEqual(offered - fish_words(script, "voxilux render --"), {"--crop"})

    def test_offers_subcommands_and_values(self):
        words = functools.partial(fish_words, generated("fish"))
        self.assertEqual(words("voxilux vo"), {"voxelize"})
        self.assertEqual(words("voxilux bench "), {"march", "ao", "photons"})
        self.assertEqual(words("voxilux render --quality "), {"draft", "normal", "fine", "reference"})


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])

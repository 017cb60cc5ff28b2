"""Helpers of the farm's tests: renders, jobs, and clusters on the loopback."""

import contextlib
import os
import pathlib
import signal
import socket
import subprocess
import sys
import tempfile
import time

from needs import need_modules

need_modules("dask", "distributed")
PYTHON = sys.executable
HIDE = ["unshare", "-rm", "sh", "-c"]  # a shell whose mounts nobody else sees; root or not


class Bench:
    """A folder, the binary, and the scenes."""

    def __init__(self, binary, scenes):
        self.binary, self.scenes = pathlib.Path(binary).resolve(), pathlib.Path(scenes).resolve()
        self.scratch = tempfile.TemporaryDirectory()
        self.top = pathlib.Path(self.scratch.name)

    def words(self, command, scene, *more):
        """A scene by its name, or any file by its path."""
        return [self.binary, command, self.scenes / (f"{scene}.toml" if isinstance(scene, str) else scene), *more]

    def render(self, scene, output, *more):
        """The bytes of a render in one process."""
        subprocess.run(self.words("render", scene, "--reproducible", "-q", "-o", self.top / output, *more), check=True)
        return (self.top / output).read_bytes()

    def start(self, scene, output, *more):
        return subprocess.Popen(self.words("farm", scene, "-o", self.top / output, *more), stdout=subprocess.PIPE,
                                stderr=subprocess.PIPE, text=True, start_new_session=True)

    def farm(self, scene, output, *more, code=0):
        """(what a job prints, its messages)"""
        out, err = (child := self.start(scene, output, *more)).communicate(timeout=600)
        if child.returncode != code:
            raise AssertionError(f"exit {child.returncode} and not {code}: {err}")
        return out, err

    def info(self, output):
        return subprocess.run([self.binary, "info", self.top / output, "--json", "-"], check=True, text=True,
                              stdout=subprocess.PIPE).stdout

    def journal(self, output):
        """Lines of the journal so far: parts that are done."""
        with contextlib.suppress(OSError):
            return (self.top / f"{output}.farm/journal.jsonl").read_text().count("\n")
        return 0

    def wait_for_parts(self, child, output, count):
        while self.journal(output) < count and child.poll() is None:
            time.sleep(0.02)


def children_of(process):
    """Processes below one, the deepest last: (id, words)."""
    rows = []
    for folder in pathlib.Path("/proc").glob("[0-9]*"):
        with contextlib.suppress(OSError, ValueError, IndexError):
            parent = int((folder / "stat").read_text().rsplit(")", 1)[1].split()[1])
            rows.append((int(folder.name), parent, (folder / "cmdline").read_bytes().replace(b"\0", b" ").decode()))
    found, front = [], {process}
    while front:
        front = {row[0] for row in rows if row[1] in front}
        found += [(row[0], row[2]) for row in rows if row[0] in front]
    return found


def workers_of(process):
    return [number for number, words in children_of(process) if "spawn_main" in words]


def kill(number):
    with contextlib.suppress(ProcessLookupError):
        os.kill(number, signal.SIGKILL)


def free_port():
    with socket.socket() as one:
        one.bind(("127.0.0.1", 0))
        return one.getsockname()[1]


def can_hide_folders():
    words = [*HIDE, "mount -t tmpfs none /mnt", "sh"]
    return subprocess.run(words, stderr=subprocess.DEVNULL, check=False).returncode == 0


class Cluster:
    """A Dask scheduler and workers, as others start them."""

    def __init__(self, folder, host="127.0.0.1", tls=()):
        """tls: the flags that name an authority, a certificate and its key."""
        self.folder, self.port, self.tls = folder, free_port(), tls
        self.address = f"{'tls' if tls else 'tcp'}://{host}:{self.port}"
        self.processes = []
        self.run("distributed.cli.dask_scheduler", "--host", host, "--port", str(self.port), "--no-dashboard", *tls)

    def run(self, module, *words, before=()):
        self.processes.append(subprocess.Popen(
            [*before, PYTHON, "-m", module, *words], cwd="/", stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
            start_new_session=True))
        return self.processes[-1]

    def add_worker(self, before=(), host=""):
        words = [self.address, "--nthreads", "1", "--no-nanny", "--no-dashboard", "--local-directory", self.folder,
                 *self.tls]
        words += ["--host", host] if host else []
        return self.run("distributed.cli.dask_worker", *words, before=before)

    def hidden(self):
        """Words before a command that does not see the folder of this test: as on a machine without a shared disk."""
        return [*HIDE, f'mount -t tmpfs none {self.folder} && exec "$@"', "sh"]

    def __enter__(self):
        return self

    def __exit__(self, *_):
        for process in self.processes:
            process.kill()
            process.wait()


def bench_of_arguments():
    """The first two words of the command line: the binary and the folder of scenes."""
    binary, scenes = sys.argv[1:3]
    del sys.argv[1:3]
    return Bench(binary, scenes)

#!/usr/bin/env python3
"""Attacks voxilux as its environment might, and counts broken promises of docs/trust.md.

    attack.py --voxilux build/release/voxilux                     five minutes, divided among the attacks
    attack.py --voxilux build/release/voxilux --full              as many tries as docs/trust.md counts: an hour
    attack.py --voxilux build/release/voxilux --only kills --seconds 600
    attack.py --voxilux build/release/voxilux --table docs/trust.md   puts the figures into that document

Every try follows from --seed and its number, so a broken promise can be played again. The exit code is 1 where a
promise was broken, and each is a line on standard error.
"""

import argparse
import gzip
import itertools
import os
import pathlib
import random
import resource
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass, field
from typing import Callable

TOP = pathlib.Path(__file__).resolve().parent.parent.parent
SCENE = TOP / "scenes" / "one_voxel.toml"
BEGIN, END = "<!-- figures: begin -->", "<!-- figures: end -->"
PATIENCE = 120.0  # seconds, after which a run counts as hanging
MOST_BYTES = 4 << 30  # of address space, for files that were made to hurt
DONE, WRONG, REFUSED, LATE, INTERNAL, CANNOT_WRITE, NO_MEMORY, INTERRUPTED = 0, 2, 3, 4, 70, 73, 74, 130
NO_DEVICE = 69


@dataclass
class Ending:
    code: int  # negative: the signal that ended it
    seconds: float
    err: str


@dataclass
class Attack:
    """A kind of attack, the exit codes it may end with, and its results."""

    name: str
    promise: str
    trial: Callable[["Bench", random.Random], str | None]
    full: int  # tries
    tries: int = 0
    broken: list[str] = field(default_factory=list)


class Bench:
    """A folder for one try, and the program in it."""

    def __init__(self, binary: pathlib.Path, folder: pathlib.Path, caches: pathlib.Path):
        self.binary = binary
        self.folder = folder
        self.tries = 1
        self.environment = os.environ | {"XDG_CACHE_HOME": str(caches), "XDG_STATE_HOME": str(caches / "state")}

    def start(self, words: list, limits: dict | None = None, **streams) -> subprocess.Popen:
        def set_limits():
            for kind, bytes_ in (limits or {}).items():
                resource.setrlimit(kind, (bytes_, bytes_))

        streams = {"stdout": subprocess.DEVNULL, "stderr": subprocess.PIPE} | streams
        return subprocess.Popen([self.binary, *words], cwd=self.folder, env=self.environment,
                                preexec_fn=set_limits, **streams)

    def finish(self, child: subprocess.Popen, since: float) -> Ending:
        try:
            _, err = child.communicate(timeout=PATIENCE)
        except subprocess.TimeoutExpired:
            child.kill()
            child.communicate()
            return Ending(-signal.SIGALRM, time.monotonic() - since, "it hangs")
        return Ending(child.returncode, time.monotonic() - since, (err or b"").decode(errors="replace"))

    def run(self, words: list, limits: dict | None = None, **streams) -> Ending:
        since = time.monotonic()
        return self.finish(self.start(words, limits, **streams), since)

    def names(self) -> list[str]:
        return sorted(os.fsdecode(name) for name in os.listdir(os.fsencode(self.folder)))


def render(output, *more) -> list:
    return ["render", SCENE, "--size", "64x36", "--reproducible", "-o", output, *more]


def unexpected(ending: Ending, allowed: tuple) -> str | None:
    if ending.code in allowed:
        return None
    return f"ended with {ending.code}: {ending.err.strip()[-200:]}"


def is_whole_exr(data: bytes) -> bool:
    """Whether the file ends where the last block of its offset table does."""
    try:
        at = 8
        while data[at]:  # name, type, size and value of an attribute
            at = data.index(0, data.index(0, at) + 1) + 1
            at += 4 + struct.unpack_from("<I", data, at)[0]
        at += 1
        (first,) = struct.unpack_from("<Q", data, at)
        places = struct.unpack_from(f"<{(first - at) // 8}Q", data, at)
        return max(place + 8 + struct.unpack_from("<I", data, place + 4)[0] for place in places) == len(data)
    except (IndexError, ValueError, struct.error):
        return False


def is_picture(file: pathlib.Path) -> bool:
    """Whether a file is an EXR or a PNG that is not cut short."""
    data = file.read_bytes()
    if data.startswith(b"\x76\x2f\x31\x01"):
        return is_whole_exr(data)
    return data.startswith(b"\x89PNG") and data.endswith(b"IEND\xaeB`\x82")


# ---- the attacks -------------------------------------------------------------------------------------------------


def kill_and_resume(bench: Bench, rng: random.Random) -> str | None:
    """Again and again on its way to the end."""
    words = render("a.exr", "--spp", "3000", "--checkpoint", "0.05")
    bench.tries = 0
    while bench.tries < 8:
        child = bench.start([*words, "--resume"] if bench.tries else words)
        time.sleep(rng.uniform(0.1, 1.0))
        if child.poll() is not None:
            if problem := unexpected(bench.finish(child, time.monotonic()), (DONE,)):
                return f"before it was killed it {problem}"
            break
        child.kill()
        child.communicate()
        bench.tries += 1
    if problem := unexpected(bench.run([*words, "--resume"]), (DONE,)):
        return problem
    if bench.names() != ["a.exr"]:
        return f"left {bench.names()}"
    whole = bench.folder.parent / "whole.exr"
    if not whole.exists():
        bench.run(render(whole, "--spp", "3000"))
    same = (bench.folder / "a.exr").read_bytes() == whole.read_bytes()
    return None if same else "the resumed picture is another one"


def stop_by_signal(bench: Bench, rng: random.Random) -> str | None:
    """Waits until the render reports that it takes samples."""
    which = rng.choice((signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGUSR1))
    since = time.monotonic()
    limit = "4s" if which == signal.SIGUSR1 else "60s"  # the other signals must come first
    child = bench.start(render("a.exr", "--spp", "1000000", "--time-limit", limit, "--progress", "json"))
    child.stderr.readline()
    time.sleep(rng.uniform(0.0, 2.0))
    child.send_signal(which)
    ending = bench.finish(child, since)
    if problem := unexpected(ending, (DONE,) if which == signal.SIGUSR1 else (INTERRUPTED,)):
        return f"{which.name}: {problem}"
    if "a.exr" not in bench.names():
        return f"{which.name}: no picture"
    return None if is_picture(bench.folder / "a.exr") else f"{which.name}: the picture is cut short"


def limit_time(bench: Bench, rng: random.Random) -> str | None:
    limit = 0.1 * 200 ** rng.random()
    ending = bench.run(render("a.exr", "--spp", "1000000", "--time-limit", f"{limit:.3f}s"))
    if problem := unexpected(ending, (DONE, LATE)):
        return problem
    late = ending.seconds - limit
    if late > max(2.0, 0.05 * limit):
        return f"{late:.1f} s after a limit of {limit:.1f} s"
    return None if is_picture(bench.folder / "a.exr") else "the picture is cut short"


def limit_memory(bench: Bench, rng: random.Random) -> str | None:
    """Of the process's address space, or of what the device may hold."""
    size = rng.choice(("64x36", "512x512", "2048x2048"))
    words = ["render", SCENE, "--size", size, "--spp", "1", "-o", "a.exr"]
    limits = {}
    if rng.random() < 0.5:
        limits[resource.RLIMIT_AS] = int(rng.uniform(0.2, 3.0) * 2**30)
    else:
        words += ["--memory-budget", str(int(2 ** rng.uniform(0.0, 11.0)))]
    ending = bench.run(words, limits)
    if problem := unexpected(ending, (DONE, NO_MEMORY, NO_DEVICE)):
        return f"{words} {limits} {problem}"
    wanted = ["a.exr"] if ending.code == DONE else []
    return None if bench.names() == wanted else f"left {bench.names()}"


def fill_disk(bench: Bench, rng: random.Random) -> str | None:
    most = int(2 ** rng.uniform(0.0, 18.0))
    name = rng.choice(("a.exr", "a.png"))
    ending = bench.run(render(name, "--spp", "2"), {resource.RLIMIT_FSIZE: most})
    if problem := unexpected(ending, (DONE, CANNOT_WRITE)):
        return f"{most} bytes: {problem}"
    wanted = [name] if ending.code == DONE else []
    if bench.names() != wanted:
        return f"left {bench.names()}"
    return None if not wanted or is_picture(bench.folder / name) else f"{most} bytes: the picture is cut short"


def close_streams(bench: Bench, rng: random.Random) -> str | None:
    with open("/dev/full", "wb") as full:
        streams = rng.choice(({"stderr": full}, {"stdout": full}, {"stdout": full, "stderr": full}))
        ending = bench.run(render("a.png", "--spp", "2", *rng.choice(([], ["-v"], ["--progress", "json"]))), **streams)
    if problem := unexpected(ending, (DONE, CANNOT_WRITE)):
        return problem
    return None if is_picture(bench.folder / "a.png") else "the picture is lost"


def odd_name(rng: random.Random) -> bytes:
    allowed = [b for b in range(1, 256) if b not in b"/"]
    return bytes(rng.choice(allowed) for _ in range(rng.randint(1, 251))) + b".exr"


def name_oddly(bench: Bench, rng: random.Random) -> str | None:
    name = odd_name(rng)
    ending = bench.run(render(b"./" + name, "--spp", "2"))
    if problem := unexpected(ending, (DONE, WRONG, CANNOT_WRITE)):
        return f"{name!r}: {problem}"
    if any(ord(c) < 32 and c not in "\n" for c in ending.err):
        return f"{name!r}: control characters reach the terminal"
    wanted = [os.fsdecode(name)] if ending.code == DONE else []
    return None if bench.names() == wanted else f"{name!r}: left {bench.names()}"


def tiny_vox() -> bytes:
    def chunk(kind: bytes, content: bytes, children: bytes = b"") -> bytes:
        return kind + struct.pack("<II", len(content), len(children)) + content + children

    voxels = bytes(b for x in range(3) for y in range(3) for z in range(2) for b in (x, y, z, 1 + x))
    size = chunk(b"SIZE", struct.pack("<3I", 3, 3, 2))
    xyzi = chunk(b"XYZI", struct.pack("<I", len(voxels) // 4) + voxels)
    return b"VOX " + struct.pack("<I", 150) + chunk(b"MAIN", b"", size + xyzi + chunk(b"RGBA", bytes(range(256)) * 4))


def tiny_stl() -> bytes:
    triangles = [(0, 0, 1, 0, 0, 0, 4, 0, 0, 0, 4, 0), (0, 0, 1, 4, 0, 0, 4, 4, 4, 0, 4, 0)]
    return bytes(80) + struct.pack("<I", 2) + b"".join(struct.pack("<12fH", *t, 0) for t in triangles)


def tiny_qb() -> bytes:
    cells = b"".join(struct.pack("<4B", 40 * i, 90, 200, 255 * (i % 3 > 0)) for i in range(6))
    matrix = b"\x01a" + struct.pack("<3I3i", 3, 2, 1, 0, 0, 0) + cells
    return struct.pack("<6I", 257, 0, 0, 0, 0, 1) + matrix


def nbt(kind: int, name: bytes, payload: bytes) -> bytes:
    return struct.pack(">BH", kind, len(name)) + name + payload


def tiny_schem(rng: random.Random) -> bytes:
    """Damaged before it is packed, half of the time."""
    sides = b"".join(nbt(2, side, struct.pack(">h", 2)) for side in (b"Width", b"Height", b"Length"))
    palette = b"".join(nbt(3, name, struct.pack(">i", i)) for i, name in enumerate((b"minecraft:air", b"minecraft:lava")))
    data = nbt(7, b"BlockData", struct.pack(">i", 8) + bytes((0, 1) * 4))
    whole = nbt(10, b"Schematic", sides + nbt(10, b"Palette", palette + b"\0") + data + b"\0")
    return gzip.compress(mutated(whole, rng) if rng.random() < 0.5 else whole, mtime=0)


def tiny_las() -> bytes:
    head = bytearray(227)
    struct.pack_into("<4s20x2B", head, 0, b"LASF", 1, 2)
    struct.pack_into("<HII", head, 94, 227, 227, 0)
    struct.pack_into("<BHI", head, 104, 2, 26, 3)
    struct.pack_into("<6d", head, 131, 0.5, 0.5, 0.5, 0.0, 0.0, 0.0)
    return bytes(head) + b"".join(struct.pack("<3i8x3H", 4 * i, i, 7 * i, 9000 * i, 500, 60000) for i in range(3))


PLY = (b"ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
       b"property uchar red\nproperty uchar green\nproperty uchar blue\nelement face 1\n"
       b"property list uchar int vertex_indices\nend_header\n"
       b"0 0 0 255 0 0\n4 0 0 0 255 0\n4 4 0 0 0 255\n0 4 4 9 9 9\n4 0 1 2 3\n")
XYZ = b"0 0 0 255 0 0\n1.5 2 3 10 20 30\n# words\n4 4 4 0 0 0\n"
BINVOX = (b"#binvox 1\ndim 4 4 4\ntranslate 0 0 0\nscale 1\ndata\n"
          + bytes((0, 20, 1, 3, 0, 1, 1, 30, 0, 10)))
OBJ = b"mtllib a.mtl\nv 0 0 0\nv 4 0 0\nv 4 4 0\nv 0 4 4\nvt 0 0\nusemtl m\nf 1/1 2/1 3/1 4/1\nf -1 -2 -3\n"
GLTF = (b'{"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0,"scale":[2,1,1]}],'
        b'"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"accessors":[{"bufferView":0,'
        b'"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]}],'
        b'"bufferViews":[{"buffer":0,"byteLength":36}],"buffers":[{"byteLength":36,'
        b'"uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]}')


def mutated(data: bytes, rng: random.Random) -> bytes:
    """Some bytes changed, a part cut out, doubled or moved, or the end cut off."""
    out = bytearray(data)
    for _ in range(rng.choice((1, 1, 2, 8, 64))):
        at, end = sorted(rng.randrange(len(out) + 1) for _ in range(2))
        kind = rng.randrange(6)
        if kind == 0 and out:
            out[at % len(out)] = rng.randrange(256)
        elif kind == 1 and len(out) >= 4:
            word = rng.choice((0, 1, 0x7FFFFFFF, 0x80000000, 0xFFFFFFFF, 0xFFFFFFFE, rng.getrandbits(32)))
            struct.pack_into("<I", out, at % (len(out) - 3), word)
        elif kind == 2:
            del out[at:min(end, at + 64)]
        elif kind == 3:
            out[at:at] = out[at:min(end, at + 64)] * rng.choice((1, 2, 50))
        elif kind == 4:
            out[at:at] = rng.choice((b"nan", b"1e999", b"-1", b"[[", b"\x00", b"\xff\xfe", b"99999999999"))
        else:
            del out[max(at, 8):]
    return bytes(out)


def feed_file(bench: Bench, rng: random.Random) -> str | None:
    seeds = {"a.vox": tiny_vox(), "a.qb": tiny_qb(), "a.binvox": BINVOX, "a.toml": SCENE.read_bytes(), "a.obj": OBJ,
             "a.gltf": GLTF, "a.stl": tiny_stl(), "a.ply": PLY, "a.xyz": XYZ,
             "a.schem": tiny_schem(rng), "a.las": tiny_las()}
    for picture in ("seed.exr", "seed.png"):
        file = bench.folder.parent / picture
        seeds[picture.replace("seed", "a")] = file.read_bytes()
    name = rng.choice(sorted(seeds))
    (bench.folder / name).write_bytes(mutated(seeds[name], rng))
    ending = bench.run(command_for(name, rng), {resource.RLIMIT_AS: MOST_BYTES})
    if problem := unexpected(ending, (DONE, REFUSED, NO_MEMORY, WRONG, CANNOT_WRITE)):
        keep = f"broken_{rng.getrandbits(32):08x}_{name}"
        shutil.copy(bench.folder / name, keep)
        return f"{keep}: {problem}"
    return None if ending.seconds < 20.0 else f"{name}: {ending.seconds:.0f} s"


def command_for(name: str, rng: random.Random) -> list:
    if name.endswith((".exr", ".png")):
        return ["compare", name, name] if rng.random() < 0.7 else ["merge", name, "-o", "b.exr"]
    if name.endswith((".qb", ".binvox", ".xyz", ".schem", ".las")):
        return ["convert", name, "b.vox"]
    if name.endswith((".obj", ".gltf", ".stl", ".ply")):
        return ["voxelize", name, "-o", "b.vox", "--resolution", "8"]
    return [rng.choice(("info", "plan")), name] if name.endswith(".vox") else ["plan", name]


def attacks() -> list[Attack]:
    return [
        Attack("kills", "a render that is killed at any moment, and again, goes on with --resume to the bytes of one "
               "that was not, and nothing is left beside the picture", kill_and_resume, 1000),
        Attack("signals", "INT, TERM and HUP leave a whole picture of what is done; USR1 stops nothing",
               stop_by_signal, 100),
        Attack("time", "--time-limit holds to 2 s or 5 %, with a whole picture", limit_time, 200),
        Attack("memory", "under any limit of the address space or the device's memory: the picture, or exit code 74 "
               "or 69 and no file", limit_memory, 500),
        Attack("disk", "where the file system takes no more: exit code 73 and no file, or the whole one", fill_disk,
               500),
        Attack("streams", "messages that nobody can read cost no picture", close_streams, 200),
        Attack("names", "any bytes are a name; none of them commands the terminal", name_oddly, 500),
        Attack("files", "whatever a file holds: an exit code that says so, 4 GiB and 20 s at most", feed_file, 100000),
    ]


# ---- running them ------------------------------------------------------------------------------------------------


def play(attack: Attack, number: int, seed: int, binary: pathlib.Path, shared: pathlib.Path) -> None:
    folder = shared / f"{attack.name}_{number}"
    folder.mkdir()
    bench = Bench(binary, folder, shared / "caches")
    problem = attack.trial(bench, random.Random(f"{seed} {attack.name} {number}"))
    attack.tries += bench.tries
    if problem:
        attack.broken.append(problem)
        print(f"{attack.name} {number}: {problem}", file=sys.stderr, flush=True)
    shutil.rmtree(os.fsencode(folder))


def play_all(attack: Attack, seconds: float | None, seed: int, binary: pathlib.Path, shared: pathlib.Path) -> None:
    """For so long, or as often as the whole takes."""
    end = time.monotonic() + (seconds or 0.0)
    for number in itertools.count():
        play(attack, number, seed, binary, shared)
        if attack.tries >= attack.full if seconds is None else time.monotonic() >= end:
            return


def make_seeds(binary: pathlib.Path, shared: pathlib.Path) -> None:
    bench = Bench(binary, shared, shared / "caches")
    words = ["render", SCENE, "--size", "16x9", "--spp", "2", "-q", "-o", "seed.exr", "-o", "seed.png"]
    if problem := unexpected(bench.run([*words, "--shard", "1/1"]), (DONE,)):
        sys.exit(f"the seeds cannot be made: {problem}")


def table(played: list[Attack]) -> str:
    rows = ["| attack | what is promised | tries | broken |", "|---|---|---|---|"]
    rows += [f"| {a.name} | {a.promise} | {a.tries} | {len(a.broken)} |" for a in played]
    return "\n".join(rows)


def put_table(document: pathlib.Path, text: str) -> None:
    before, _, rest = document.read_text().partition(BEGIN)
    _, _, after = rest.partition(END)
    document.write_text(f"{before}{BEGIN}\n{text}\n{END}{after}")


def main() -> int:
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("--voxilux", type=pathlib.Path, required=True)
    options.add_argument("--seconds", type=float, default=300.0, help="for all attacks together")
    options.add_argument("--full", action="store_true", help="count tries, not seconds")
    options.add_argument("--seed", type=int, default=1)
    options.add_argument("--only", help="names of attacks, with commas between them")
    options.add_argument("--number", type=int, help="one try of each attack again, by its number")
    options.add_argument("--table", type=pathlib.Path, help="the document that the figures go into")
    given = options.parse_args()
    known = {attack.name: attack for attack in attacks()}
    names = given.only.split(",") if given.only else list(known)
    for name in names:
        if name not in known:
            options.error(f"there is no attack {name!r}, but {', '.join(known)}")
    chosen = [known[name] for name in names]
    with tempfile.TemporaryDirectory(prefix="voxilux_attack_") as folder:
        shared = pathlib.Path(folder)
        make_seeds(given.voxilux.resolve(), shared)
        for attack in chosen:
            if given.number is not None:
                play(attack, given.number, given.seed, given.voxilux.resolve(), shared)
                continue
            seconds = None if given.full else given.seconds / len(chosen)
            play_all(attack, seconds, given.seed, given.voxilux.resolve(), shared)
    print(table(chosen))
    if given.table:
        put_table(given.table, table(chosen))
    return 1 if any(a.broken for a in chosen) else 0


if __name__ == "__main__":
    sys.exit(main())

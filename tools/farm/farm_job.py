"""The folder of a job: what is rendered, and who has done which parts. Files appear under their names only when they
are whole. The journal grows by lines, and a last line that is incomplete is cut off."""

import dataclasses
import fcntl
import hashlib
import json
import os
import pathlib
import reprlib
import shutil
import sys
import tomllib
import uuid

from farm_ranges import Ranges, difference, overlaps, union


OF_JOB = ("build", "scene", "files", "words", "frames")  # equal in a resumed job, and
OF_FILM = ("spp", "error", "tone_words", "outputs")  # where whole frames are handed out: they are final when they come
DECIDED = ("id", "by_frames", "device")  # by the job itself, and kept when it is resumed


class Stop(Exception):
    """The job cannot go on: the exit code, and one line that says why."""

    def __init__(self, code: int, line: str):
        super().__init__(line)
        self.code = code


@dataclasses.dataclass
class Part:
    """Some samples of a frame, or a whole frame (no ranges), in a file of the job's folder."""
    frame: int
    ranges: Ranges
    file: str
    worker: str = ""
    wall_s: float = 0.0
    cpu_s: float = 0.0
    sha256: str = ""
    samples: int = 0
    error: dict | None = None  # estimate and high
    of: list[str] = dataclasses.field(default_factory=list)  # the files that were merged into it
    count: int = 1  # of parts that workers have rendered


def sha256_of(file: pathlib.Path) -> str:
    with open(file, "rb") as stream:
        return hashlib.file_digest(stream, "sha256").hexdigest()


def write_atomically(file: pathlib.Path, data: bytes) -> None:
    """Writes a new file whose name nobody can guess, and renames it."""
    temporary = file.with_name(f".{file.name}.{uuid.uuid4().hex}")
    try:
        with open(temporary, "xb") as stream:
            stream.write(data)
            stream.flush()
            os.fsync(stream.fileno())
        os.replace(temporary, file)
    except OSError:
        temporary.unlink(missing_ok=True)
        raise


def strings_in(value: object) -> list[str]:
    """All texts in the values of a scene file."""
    if isinstance(value, str):
        return [value]
    if isinstance(value, dict):
        value = list(value.values())
    return [text for item in value for text in strings_in(item)] if isinstance(value, list) else []


def files_of_scene(scene: pathlib.Path, overrides: list[str]) -> dict[str, pathlib.Path]:
    """The scene file and the files it names, by their paths in the job's copy. Files with an absolute path are not copied:
    every worker needs them where they are."""
    named = [text.partition("=")[2].strip(' "') for text in overrides]
    if scene.suffix.lower() == ".toml":
        named += strings_in(tomllib.loads(scene.read_text("utf-8")))
    files = [scene] + [scene.parent / name for name in named
                       if name and not os.path.isabs(name) and (scene.parent / name).is_file()]
    root = os.path.commonpath([os.path.dirname(os.path.normpath(file)) for file in files])
    return {os.path.relpath(os.path.normpath(file), root): file for file in files}


class Job:
    """The folder, its manifest, and the parts that are done."""

    def __init__(self, folder: pathlib.Path, manifest: dict, mixes_devices: bool = False):
        self.folder = folder
        self.manifest = manifest
        self.mixes_devices = mixes_devices
        self.parts: dict[str, Part] = {}
        self.retries = 0
        self.lock: int | None = None  # while this file is open, no other farm works in the folder

    def open(self, resumes: bool) -> None:
        """Makes the folder for this user alone, or takes one that is there."""
        try:
            self.folder.mkdir(mode=0o700, parents=True)
        except FileExistsError:
            if self.folder.lstat().st_uid != os.geteuid():
                raise Stop(73, f"{self.folder} belongs to another user") from None
        self.lock = os.open(self.folder / "lock", os.O_RDWR | os.O_CREAT, 0o600)  # until the process ends
        try:
            fcntl.flock(self.lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            raise Stop(75, f"{self.folder}: another farm works in it") from None
        except OSError:
            pass  # some network file systems have no locks
        if (self.folder / "manifest.json").exists() and not resumes:
            raise Stop(2, f"{self.folder} is there: --resume goes on with it; remove it to start anew")

    def start(self, files: dict[str, pathlib.Path]) -> None:
        """Starts a new job in the open folder, or goes on with the same one."""
        self.manifest["files"] = {name: sha256_of(file) for name, file in sorted(files.items())}
        if (self.folder / "manifest.json").exists():
            self.go_on()
        (self.folder / "parts").mkdir(exist_ok=True)
        for name, file in files.items():
            copy = self.folder / "scene" / name
            copy.parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(file, copy)
        self.write_manifest()

    def write_manifest(self) -> None:
        write_atomically(self.folder / "manifest.json", json.dumps(self.manifest, indent=1).encode())

    def remember(self, **facts: object) -> None:
        """Keeps decisions of this job in the manifest."""
        if any(self.manifest[key] != value for key, value in facts.items()):
            self.manifest |= facts
            self.write_manifest()

    def go_on(self) -> None:
        """Takes over what the folder has of the job."""
        try:
            before = json.loads((self.folder / "manifest.json").read_text())
            self.check(before)
            self.read_journal()
            if self.parts:
                self.manifest |= {key: before[key] for key in DECIDED}
        except (ValueError, TypeError, KeyError, AttributeError) as cause:
            raise Stop(3, f"{self.folder}: cannot go on: it is damaged: {type(cause).__name__}: {cause}") from cause

    def check(self, before: dict) -> None:
        for key in OF_JOB + (OF_FILM if before.get("by_frames") else ()):
            if before.get(key) != self.manifest.get(key):
                raise Stop(3, f"{self.folder}: cannot go on: its {key} is {reprlib.repr(before.get(key))} and not "
                              f"{reprlib.repr(self.manifest.get(key))}")

    def read_journal(self) -> None:
        file = self.folder / "journal.jsonl"
        if not file.exists():
            return
        text = file.read_bytes()
        whole = text.rfind(b"\n") + 1
        if whole < len(text):
            os.truncate(file, whole)  # else the next line would be appended to the incomplete one
        for line in text[:whole].splitlines():
            row = json.loads(line)
            if "dropped" in row:
                self.parts.pop(row["dropped"], None)
                continue
            part = Part(**{**row, "ranges": [tuple(one) for one in row["ranges"]]})
            self.keep(part)
        for name in [name for name in self.parts if not (self.folder / name).exists()]:
            del self.parts[name]

    def keep(self, part: Part) -> None:
        for file in part.of:
            self.parts.pop(file, None)
        self.parts[part.file] = part

    def write_line(self, row: dict) -> None:
        with open(self.folder / "journal.jsonl", "ab") as journal:
            journal.write(json.dumps(row).encode() + b"\n")
            journal.flush()
            os.fsync(journal.fileno())

    def add(self, part: Part) -> bool:
        """Returns False for a late part, some of whose samples other files have already. A part that comes twice must be
        equal, unless devices of several kinds render."""
        known = self.parts.get(part.file)
        differs = known is not None and known.sha256 and part.sha256 and known.sha256 != part.sha256
        if differs and not self.mixes_devices:
            raise Stop(70, f"{part.worker} and {known.worker} rendered {part.file} differently")
        if not part.of and self.has_some(part):
            return False
        self.write_line(dataclasses.asdict(part))
        self.keep(part)
        for file in part.of:
            (self.folder / file).unlink(missing_ok=True)
        return True

    def has_some(self, part: Part) -> bool:
        mine = self.of_frame(part.frame)
        return any(not other.ranges or overlaps(part.ranges, other.ranges) for other in mine)

    def drop(self, file: str) -> Part | None:
        """Forgets a part whose file turned out to be damaged."""
        part = self.parts.pop(file, None)
        if part is not None:
            self.write_line({"dropped": file})
        return part

    def of_frame(self, frame: int) -> list[Part]:
        return [part for part in self.parts.values() if part.frame == frame]

    def samples(self, frame: int) -> Ranges:
        done: Ranges = []
        for part in self.of_frame(frame):
            done = union(done, part.ranges)
        return done

    def missing(self, frame: int, spp: int) -> Ranges:
        return difference([(0, spp)], self.samples(frame))


def say(line: str) -> None:
    print(f"voxilux: {line}", file=sys.stderr, flush=True)

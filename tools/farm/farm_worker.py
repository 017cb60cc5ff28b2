"""The functions that run on the workers of the cluster. Dask sends them there, so they import what they need
themselves, and no module of ours."""

import ctypes
import hashlib
import json
import os
import pathlib
import shutil
import signal
import subprocess
import tempfile
import time


def file_hash(file: pathlib.Path) -> str:
    if not file.is_file():
        return ""
    with open(file, "rb") as stream:
        return hashlib.file_digest(stream, "sha256").hexdigest()


def own_folder(setup: dict) -> pathlib.Path:
    """The folder of this machine for workers that do not see the job's folder. The id is random, so nobody else can have
    made a folder of that name."""
    folder = pathlib.Path(tempfile.gettempdir()) / f"voxilux-farm-{setup['id']}"
    folder.mkdir(mode=0o700, exist_ok=True)
    return folder


def program_of(setup: dict) -> str:
    return setup["binary"] if os.path.exists(setup["binary"]) else shutil.which("voxilux") or ""


def scene_folder(setup: dict) -> pathlib.Path:
    """The job's folder if this machine sees it, else the one that store() fills."""
    return (pathlib.Path(setup["folder"]) if sees_job(setup) else own_folder(setup)) / "scene"


def sees_job(setup: dict) -> bool:
    try:
        return json.loads((pathlib.Path(setup["folder"]) / "manifest.json").read_text())["id"] == setup["id"]
    except (OSError, ValueError, KeyError):
        return False


def selected(devices: list[dict], selector: str) -> dict | None:
    """The device that --device names, or that a render would choose."""
    if not selector:
        fits = [row for row in devices if row["would_use"]]
    elif selector.isdigit():
        fits = [row for row in devices if row["index"] == int(selector)]
    else:
        fits = [row for row in devices if selector.lower() in row["name"].lower()]
    return next((row for row in fits if row["usable"]), None)


def prepare(setup: dict, selector: str) -> dict:
    """Returns what the worker is, and which files of the scene it lacks."""
    program = program_of(setup)
    if not program:
        return {"refusal": f"there is no {setup['binary']}, nor a voxilux in PATH"}
    build = file_hash(pathlib.Path(program))
    if build != setup["build"]:
        return {"refusal": f"{program} is another build"}
    found = subprocess.run([program, "devices", "--json", "-"], capture_output=True, text=True, check=False)
    devices = json.loads(found.stdout) if found.returncode == 0 else []
    used = selected(devices, selector)
    if used is None:
        return {"refusal": "it has no usable Vulkan device" + (f" '{selector}'" if selector else "")}
    try:
        folder = scene_folder(setup)
    except OSError as cause:
        return {"refusal": str(cause)}
    lacking = [name for name, digest in setup["files"].items() if file_hash(folder / name) != digest]
    return {"device": f"{used['name']}, {used['driver']}", "lacking": lacking, "shares": sees_job(setup)}


def store(setup: dict, files: dict[str, bytes]) -> dict:
    """Stores files of the scene that come from the scheduler."""
    for name, data in files.items():
        file = scene_folder(setup) / name
        file.parent.mkdir(parents=True, exist_ok=True)
        temporary = file.with_name(f".{file.name}.{os.getpid()}")
        temporary.write_bytes(data)
        os.replace(temporary, file)
    return {}


def forget(setup: dict) -> None:
    """Removes the folder of a job that has ended."""
    shutil.rmtree(own_folder(setup), ignore_errors=True)


def start_render(words: list[str], cores: list[int]) -> subprocess.Popen:
    """Makes the render die with the worker, however that ends, and keeps its threads on these cores; empty: on any."""
    libc = ctypes.CDLL(None, use_errno=True)

    def in_child() -> None:
        libc.prctl(1, signal.SIGKILL)  # PR_SET_PDEATHSIG
        if cores:
            os.sched_setaffinity(0, cores)

    environment = dict(os.environ)
    if cores:
        environment["LP_NUM_THREADS"] = str(len(cores))
    return subprocess.Popen(words, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                            preexec_fn=in_child, start_new_session=True, env=environment)


def run_one(setup: dict, task: dict, unit: dict) -> dict:
    """Runs one render; returns its exit code, last line, times and file."""
    folder = pathlib.Path(setup["folder"]) if task["shares"] else own_folder(setup)
    (folder / "parts").mkdir(parents=True, exist_ok=True)
    files = [folder / name for name in unit["files"]]
    words = [program_of(setup), "render", str(scene_folder(setup) / setup["scene"]), *setup["words"], *task["words"],
             *unit["words"], "--reproducible", "--checkpoint", "0", "-q", "--json", "-"]
    for file in files:
        words += ["-o", str(file)]
    begin = time.monotonic()
    child = start_render(words, task["cores"])
    try:
        out, err = child.communicate(timeout=task["patience_s"])
    except subprocess.TimeoutExpired:
        child.kill()
        child.communicate()
        return {"code": 75, "line": f"no end after {task['patience_s']:.0f} s"}
    lines = [line for line in err.strip().split("\n") if line]
    result = {"code": child.returncode, "line": lines[-1] if lines else "", "wall_s": time.monotonic() - begin}
    if child.returncode not in (0, 4):
        return result
    report = json.loads(out)
    # A part that was there already, left by a worker that was given up, has no times.
    result |= {"cpu_s": report.get("cpu_s", 0.0), "samples": report["samples"], "error": {name: report["error"][name] for name in ("estimate", "high")},
               "sha256": [file_hash(file) for file in files]}
    if not task["shares"]:
        result["bytes"] = [file.read_bytes() for file in files]
        for file in files:
            file.unlink()
    return result


def run_task(setup: dict, task: dict) -> list[dict]:
    """Runs the renders of a task, up to the first one that fails."""
    results = []
    for unit in task["units"]:
        results.append(run_one(setup, task, unit))
        if results[-1]["code"] not in (0, 4):
            break
    return results

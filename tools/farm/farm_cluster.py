"""The workers of a Dask cluster: which there are, what each is, and which may be used."""

import dataclasses
import json
import logging
import math
import os
import pathlib
import queue
import subprocess
import sys
import threading
import time

from farm_job import Stop, say
from farm_worker import forget, prepare, run_task, store

CORES_OF_A_WORKER = 8  # without a GPU; more threads on one picture gain little
MAX_FAILURES = 3  # in a row; then a worker gets no more tasks
CONNECT_S = 30.0
CLEAN_S = 5.0  # for workers to remove what they have stored
DASK_SETTINGS = {
    "logging.distributed": "critical", "distributed.scheduler.transition-log-length": "1000",
    "distributed.scheduler.events-log-length": "1000", "distributed.admin.log-length": "1000",
    "distributed.worker.profile.interval": "10s",
    "distributed.admin.tick.interval": "1s", "distributed.admin.tick.limit": "60s",
    "distributed.admin.system-monitor.interval": "5s",
    "distributed.scheduler.work-stealing": "False"}  # each task is for one worker
LOOK_S = 0.5  # between two queries of the scheduler, which answers with all it knows of every worker
LONELY_S = 60.0  # without any worker; then the job ends


@dataclasses.dataclass
class Member:
    """A worker of the cluster."""
    address: str
    slot: int
    state: str = "new"  # then asked, storing, ready or refused
    device: str = ""
    shares: bool = False  # sees the job's folder
    failures: int = 0
    task: object = None
    order: dict = dataclasses.field(default_factory=dict)
    future: object = None


def usable_gpus(binary: str) -> list[int]:
    """The usable GPUs of this machine, as indices among all devices."""
    found = subprocess.run([binary, "devices", "--json", "-"], capture_output=True, text=True, check=False)
    devices = json.loads(found.stdout) if found.returncode == 0 else []
    return [row["index"] for row in devices if row["usable"] and row["type"] != "cpu"]


def core_groups(workers: int) -> list[list[int]]:
    """The cores of this process, divided among the workers; empty groups where there are more workers than cores."""
    cores = sorted(os.sched_getaffinity(0))
    if workers > len(cores):
        return [[] for _ in range(workers)]
    return [cores[i * len(cores) // workers:(i + 1) * len(cores) // workers] for i in range(workers)]


def quiet_dask() -> None:
    """Silences Dask, because we report what matters ourselves. Keeps its logs in memory short, and keeps it from
    profiling workers that wait for a render and from waking up 50 times a second. Local workers inherit that."""
    for name, value in DASK_SETTINGS.items():
        os.environ.setdefault(f"DASK_{name.replace('.', '__').replace('-', '_').upper()}", value)
    logging.getLogger("distributed").setLevel(logging.CRITICAL)
    logging.getLogger("asyncio").setLevel(logging.CRITICAL)


def divert_errors(log: str) -> None:
    """Sends the standard error of processes started from now on to a file: they write there when a signal ends them
    while they start. Our own messages stay where they are."""
    with open(log, "ab") as stream:
        sys.stderr = open(os.dup(2), "w", buffering=1, errors="backslashreplace")  # noqa: SIM115
        os.dup2(stream.fileno(), 2)


def open_local(workers: int, folder: str):
    """A cluster of this machine that listens on the loopback alone, and keeps its files in this folder."""
    os.environ.setdefault("DASK_TEMPORARY_DIRECTORY", folder)  # read by Dask when it is imported
    from distributed import Client, LocalCluster
    cluster = LocalCluster(n_workers=0, threads_per_worker=1, processes=True, host="127.0.0.1", memory_limit=0,
                           dashboard_address="127.0.0.1:0", silence_logs=logging.CRITICAL)
    client = Client(cluster)
    cluster.scale(workers)  # not waiting: a worker that dies while it starts would never come
    return client, cluster


def open_remote(address: str):
    from distributed import Client
    try:
        return Client(address, timeout=CONNECT_S), None
    except (OSError, ValueError) as cause:
        raise Stop(75, f"no scheduler at {address}: {cause}") from cause


class Cluster:
    """Asks new workers what they are, sends them the scene, and runs tasks on them."""

    def __init__(self, options: dict, setup: dict, files: dict[str, pathlib.Path], device: str):
        """`device` is the kind that a resumed job has used; empty: that of the first worker."""
        quiet_dask()
        self.options, self.setup, self.files = options, setup, files
        self.members: dict[str, Member] = {}
        self.results: queue.Queue = queue.Queue()
        self.device = device
        self.gpus: list[int] = []
        self.groups: list[list[int]] = []
        if options["scheduler"]:
            self.client, self.cluster = open_remote(options["scheduler"])
        else:
            self.gpus = [] if options["device"] else usable_gpus(options["binary"])
            cores = len(os.sched_getaffinity(0))
            workers = options["workers"] or len(self.gpus) or max(1, cores // CORES_OF_A_WORKER)
            self.groups = [[]] * workers if self.gpus else core_groups(workers)
            divert_errors(f"{setup['folder']}/workers.log")
            self.client, self.cluster = open_local(workers, f"{setup['folder']}/dask")
        self.seen_s = self.heard_s = time.monotonic()
        self.looked_s = -math.inf

    def dashboard(self) -> str:
        try:
            import bokeh  # noqa: F401  Dask has no dashboard without it
        except ImportError:
            return ""
        return self.client.dashboard_link

    def submit(self, member: Member, kind: str, function, *arguments) -> None:
        future = self.client.submit(function, *arguments, workers=[member.address], allow_other_workers=False,
                                    pure=False, retries=0)
        member.future = future
        future.add_done_callback(lambda done: self.results.put((member, kind, done)))

    def look(self) -> list[Member]:
        """Meets new workers; returns those that are gone."""
        now = time.monotonic()
        if now - self.looked_s < LOOK_S:
            return []
        self.looked_s = now
        if self.client.status == "running":
            self.heard_s = now
        if now - self.heard_s > CONNECT_S:
            raise Stop(75, "the scheduler is gone")
        there = set(self.client.scheduler_info(n_workers=-1)["workers"])  # -1: else some versions name only 5
        gone = [self.members.pop(address) for address in list(self.members) if address not in there]
        for address in there - set(self.members):
            used = {member.slot for member in self.members.values()}
            slot = next(i for i in range(len(there) + 1) if i not in used)
            self.members[address] = Member(address, slot)
            self.ask(self.members[address])
        if there:
            self.seen_s = now
        if now - self.seen_s > LONELY_S:
            raise Stop(75, f"no worker for {LONELY_S:.0f} s")
        return gone

    def selector(self, member: Member) -> str:
        """The --device of a worker's renders; empty: a render chooses."""
        return str(self.gpus[member.slot % len(self.gpus)]) if self.gpus else self.options["device"]

    def ask(self, member: Member) -> None:
        member.state = "asked"
        self.submit(member, "asked", prepare, self.setup, self.selector(member))

    def answer(self, member: Member, answer: dict) -> None:
        """Takes what a new worker reports about itself."""
        if "refusal" in answer:
            return self.refuse(member, answer["refusal"])
        member.device, member.shares = answer["device"], answer["shares"]
        self.device = self.device or member.device
        if member.device != self.device and not self.options["allow_mixed_devices"]:
            return self.refuse(member, f"its device is {member.device} and not {self.device}; other devices round "
                                       "differently: --allow-mixed-devices")
        member.state = "ready"
        if answer["lacking"]:
            member.state = "storing"
            lacking = {name: self.files[name].read_bytes() for name in answer["lacking"]}
            self.submit(member, "storing", store, self.setup, lacking)
        return None

    def refuse(self, member: Member, why: str) -> None:
        member.state = "refused"
        say(f"worker {member.address} is not used: {why}")
        if all(one.state == "refused" for one in self.members.values()):
            raise Stop(75, f"no worker is left: {why}")

    def failed(self, member: Member, why: str) -> None:
        member.failures += 1
        if member.failures >= MAX_FAILURES:
            self.refuse(member, f"it failed {MAX_FAILURES} times: {why}")

    def ready(self) -> list[Member]:
        return [member for member in self.members.values() if member.state == "ready"]

    def idle(self) -> list[Member]:
        return [member for member in self.ready() if member.task is None]

    def run(self, member: Member, task, order: dict) -> None:
        member.task, member.order = task, order
        order |= {"cores": self.groups[member.slot] if member.slot < len(self.groups) else [],
                  "shares": member.shares}
        if self.gpus:
            order["words"] = [*order["words"], "--device", self.selector(member)]
        self.submit(member, "task", run_task, self.setup, order)

    def collect(self, timeout_s: float) -> list[tuple[Member, str, object]]:
        """Returns what has ended: (worker, kind, Dask's future)."""
        ended = []
        try:
            ended.append(self.results.get(timeout=timeout_s))
            while True:
                ended.append(self.results.get_nowait())
        except queue.Empty:
            return ended

    def clean(self) -> None:
        """Makes workers without the job's folder remove what they have stored, even while they render."""
        away = [member.address for member in self.members.values() if member.device and not member.shares]
        if not away:
            return
        thread = threading.Thread(daemon=True, target=lambda: self.client.run(
            forget, self.setup, workers=away, on_error="ignore"))
        thread.start()
        thread.join(CLEAN_S)

    def close(self) -> None:
        self.clean()
        for part in (self.client, self.cluster):
            if part is not None:
                try:
                    part.close(timeout=5)
                except Exception:  # noqa: BLE001  the job is over, whatever becomes of the cluster
                    pass

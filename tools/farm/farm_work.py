"""Decides who renders what next. Work lies in lanes of whole numbers: the samples of a frame, or the frames of a film.
A task is a range of a lane. Nothing here knows of Dask, renders or clocks: times are arguments."""

import dataclasses
import itertools
import math
import statistics

from farm_ranges import Ranges, difference, size, union

TASK_S = 40.0  # of a task: long against the start of a render, short against what the death of a worker loses
MIN_TASK_S = 10.0
LAST_SHARE = 0.75  # near the end, a task is this share of what is left for each worker, so that tasks get smaller
FIRST_SHARE = 32  # a worker's first task is one part in so many of its work, and measures its speed
STRAGGLER = 1.5  # times as long as expected, and at least
STRAGGLER_S = 2.0  # longer: another worker gets the same task
HUNG = 8.0  # times as long as expected, and at least
HUNG_S = 120.0  # longer: the render is ended
MAX_TRIES = 5


@dataclasses.dataclass
class Task:
    lane: int
    first: int
    end: int
    number: int = 0
    tries: int = 0
    failed: set[str] = dataclasses.field(default_factory=set)  # workers that failed it
    runs: dict[str, float] = dataclasses.field(default_factory=dict)  # start time, by worker

    def units(self) -> int:
        return self.end - self.first


@dataclasses.dataclass
class Speed:
    """Units per second of a worker."""
    units_per_s: float = 0.0
    units: int = 0
    busy_s: float = 0.0

    def add(self, units: int, seconds: float) -> None:
        self.units += units
        self.busy_s += seconds
        now = units / max(seconds, 1e-3)
        self.units_per_s = now if self.units_per_s == 0.0 else 0.5 * (self.units_per_s + now)


class Work:
    """Ranges that nobody works on yet, and tasks that run."""

    def __init__(self) -> None:
        self.lanes: dict[int, Ranges] = {}
        self.again: list[Task] = []
        self.running: dict[int, Task] = {}
        self.speeds: dict[str, Speed] = {}
        self.numbers = itertools.count()

    def add(self, lane: int, ranges: Ranges) -> None:
        self.lanes[lane] = union(self.lanes.get(lane, []), ranges)
        if not self.lanes[lane]:
            del self.lanes[lane]

    def left(self) -> int:
        """Units that nobody works on."""
        return sum(size(ranges) for ranges in self.lanes.values()) + sum(task.units() for task in self.again)

    def is_idle(self, lane: int) -> bool:
        return lane not in self.lanes and all(task.lane != lane for task in [*self.again, *self.running.values()])

    def speed(self, worker: str) -> float:
        """The measured speed of a worker, or the median of the others, or 0."""
        own = self.speeds.get(worker, Speed()).units_per_s
        known = [speed.units_per_s for speed in self.speeds.values() if speed.units_per_s > 0.0]
        return own or (statistics.median(known) if known else 0.0)

    def size_for(self, worker: str, workers: int) -> int:
        """Units of the next task: work for TASK_S, and less near the end, so that all workers end together."""
        left = self.left()
        speed = self.speed(worker)
        if speed == 0.0:
            return max(1, left // (workers * FIRST_SHARE))
        fair = max(math.ceil(LAST_SHARE * left / workers), math.ceil(speed * MIN_TASK_S))
        return max(1, min(fair, int(speed * TASK_S)))

    def next_task(self, worker: str, workers: int, now_s: float) -> Task | None:
        """A task that failed elsewhere, a new one, or one with which another worker is late."""
        task = (self.failed_elsewhere(worker, workers) or self.new_task(worker, workers)
                or self.straggler(worker, now_s))
        if task is None:
            return None
        task.runs[worker] = now_s
        self.running[task.number] = task
        return task

    def failed_elsewhere(self, worker: str, workers: int) -> Task | None:
        """A task that this worker has not failed yet, or that all workers have failed."""
        for task in self.again:
            if worker not in task.failed or len(task.failed) >= workers:
                self.again.remove(task)
                return task
        return None

    def new_task(self, worker: str, workers: int) -> Task | None:
        if not self.lanes:
            return None
        lane = min(self.lanes)
        first, end = self.lanes[lane][0]
        end = min(end, first + self.size_for(worker, workers))
        self.lanes[lane] = difference(self.lanes[lane], [(first, end)])
        if not self.lanes[lane]:
            del self.lanes[lane]
        return Task(lane, first, end, next(self.numbers))

    def expected_s(self, task: Task, worker: str) -> float | None:
        speed = self.speed(worker)
        return task.units() / speed if speed > 0.0 else None

    def straggler(self, worker: str, now_s: float) -> Task | None:
        late = []
        for task in self.running.values():
            runs = list(task.runs.items())
            if len(runs) != 1 or runs[0][0] == worker or worker in task.failed:
                continue
            expected_s = self.expected_s(task, runs[0][0])
            elapsed_s = now_s - runs[0][1]
            if expected_s is not None and elapsed_s > STRAGGLER * expected_s + STRAGGLER_S:
                late.append((elapsed_s / expected_s, task))
        return max(late, key=lambda row: row[0])[1] if late else None

    def patience_s(self, task: Task, worker: str) -> float:
        """Seconds after which a render counts as hung."""
        expected_s = self.expected_s(task, worker)
        return HUNG_S + HUNG * expected_s if expected_s is not None else 24 * 3600.0

    def end(self, task: Task, worker: str, units: int, seconds: float) -> bool:
        """Notes that this worker has done the task; False when another was faster."""
        self.speeds.setdefault(worker, Speed()).add(units, seconds)
        return self.running.pop(task.number, None) is not None

    def fail(self, task: Task, worker: str) -> None:
        """Notes that this worker has failed the task, which another one will do or is doing already."""
        task.runs.pop(worker, None)
        task.failed.add(worker)
        if task.number not in self.running or task.runs:
            return
        del self.running[task.number]
        task.tries += 1
        self.again.append(task)

    def remaining_s(self, workers: list[str]) -> float | None:
        """Time to the end at the speeds so far; running tasks count as half done."""
        speed = sum(self.speed(worker) for worker in workers)
        if speed == 0.0:
            return None
        return (self.left() + 0.5 * sum(task.units() for task in self.running.values())) / speed

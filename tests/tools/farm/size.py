"""Jobs of the largest size, with workers that sleep instead of rendering: what handing out a task costs, and whether
memory stays flat.

    size.py [--frames 10000] [--ranges 100000] [--threads 64]
"""

import argparse
import logging
import queue
import resource
import sys
import time

from needs import need_modules

need_modules("dask", "distributed")

from farm_cluster import Cluster, Member, quiet_dask  # noqa: E402  after the modules are known to be there
from farm_work import Work  # noqa: E402

NAP_S = 0.02
WORKERS = 4
MAX_TASK_MS = 2.0  # of CPU time, with cores of its own: other work on them slows each task by a tenth and more
MAX_GROWTH_MIB = 100.0  # from a tenth of the tasks to the end


def nap(_order):
    time.sleep(NAP_S)
    return [{"code": 0, "line": "", "wall_s": NAP_S, "cpu_s": 0.0, "sha256": ["0" * 64]}]


class Sleepers(Cluster):
    """Processes with several threads, each of which is a worker to us. Scheduler and client are this process."""

    def __init__(self, threads):
        from distributed import Client, LocalCluster  # after quiet_dask()
        self.results = queue.Queue()
        self.cluster = LocalCluster(n_workers=WORKERS, threads_per_worker=threads // WORKERS, processes=True,
                                    memory_limit=0, dashboard_address="127.0.0.1:0", silence_logs=logging.CRITICAL)
        self.client = Client(self.cluster)
        addresses = list(self.client.scheduler_info(n_workers=-1)["workers"])
        self.members = {slot: Member(addresses[slot % WORKERS], slot, "ready") for slot in range(threads)}


def memory_mib():
    with open("/proc/self/statm", encoding="ascii") as text:
        return int(text.read().split()[1]) * resource.getpagesize() / 2**20


def play(cluster, what, tasks):
    """Hands out tasks of one unit; returns ms of CPU of scheduler and client per task, and MiB more than after a tenth."""
    work = Work()
    work.add(0, [(0, tasks)])
    begin_s, own_s, done, early = time.process_time(), time.thread_time(), 0, 0.0
    while done < tasks:
        for member in cluster.idle():
            task = work.next_task(member.address, 10**9, time.monotonic())
            if task is not None:
                member.task = task
                cluster.submit(member, "task", nap, {"units": [task.first, task.end]})
        for member, _, future in cluster.collect(0.05):
            task, member.task = member.task, None
            assert future.status == "finished" and future.result()[0]["code"] == 0
            done += task.units()
            work.end(task, member.address, task.units(), NAP_S)
            work.speeds.clear()  # tasks stay of one unit
        if not early and done > tasks // 10:
            early = memory_mib()
    ms, own_ms = 1000 * (time.process_time() - begin_s) / done, 1000 * (time.thread_time() - own_s) / done
    print(f"{done} {what} on {len(cluster.members)} threads: {ms:.2f} ms of CPU a task (ours {own_ms:.2f}, the others "
          f"Dask's scheduler and client), {early:.0f} MiB after a tenth, {memory_mib():.0f} MiB at the end",
          flush=True)
    return ms, memory_mib() - early


def main():
    options = argparse.ArgumentParser()
    options.add_argument("--frames", type=int, default=10000)
    options.add_argument("--ranges", type=int, default=100000)
    options.add_argument("--threads", type=int, default=64)
    options = options.parse_args()
    quiet_dask()
    cluster = Sleepers(options.threads)
    results = [play(cluster, "frames", options.frames), play(cluster, "ranges", options.ranges)]
    cluster.close()
    return 1 if any(ms > MAX_TASK_MS or growth > MAX_GROWTH_MIB for ms, growth in results) else 0


if __name__ == "__main__":
    sys.exit(main())

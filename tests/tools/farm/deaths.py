"""Jobs whose workers are killed at random moments; in every fourth one everything is killed, and the job resumed. Every
picture has the bytes of one render, and every sample was counted once. A job that finds no worker in time, as on a busy
machine, says what is missing, and is resumed too.

    deaths.py BINARY SCENES [--jobs 40] [--seed 1]
"""

import argparse
import json
import random
import sys
import time

from cluster import bench_of_arguments, children_of, kill, workers_of

FLAGS = ["--size", "240x135", "--spp", "64"]
KILLS_EVERY = 3.0  # seconds, mean
TRY_ELSEWHERE = 75
MAX_KILLS = 4  # more, and a task that is killed again and again ends the job, as it should


def play(bench, name, chance, kills_all):
    """One job; returns its report, how many workers were killed, and how often it was resumed."""
    kills = resumes = 0
    words = ["--workers", "2", "--json", "-"]
    child = bench.start("mixed", name, *FLAGS, *words)
    while child.poll() is None:
        time.sleep(chance.expovariate(1.0 / KILLS_EVERY))
        if kills_all and resumes == 0 and bench.journal(name) > 0:
            for number, _ in children_of(child.pid):
                kill(number)
            kill(child.pid)
            child.communicate()
            child = bench.start("mixed", name, *FLAGS, *words, "--resume")
            resumes += 1
        workers = workers_of(child.pid)
        if workers and kills < MAX_KILLS:
            kill(chance.choice(workers))
            kills += 1
    out, err = child.communicate()
    if child.returncode == TRY_ELSEWHERE and "missing: samples" in err:
        out, err = (child := bench.start("mixed", name, *FLAGS, *words, "--resume")).communicate()
        resumes += 1
    if child.returncode != 0:
        raise SystemExit(f"{name}: exit {child.returncode}: {err}")
    return json.loads(out), kills, resumes


def main():
    bench = bench_of_arguments()
    options = argparse.ArgumentParser()
    options.add_argument("--jobs", type=int, default=40)
    options.add_argument("--seed", type=int, default=1)
    options = options.parse_args()
    chance = random.Random(options.seed)
    whole = bench.render("mixed", "whole.exr", *FLAGS)
    totals = [0, 0]
    wrong = 0
    for number in range(options.jobs):
        name = f"job{number}.exr"
        report, kills, resumes = play(bench, name, chance, number % 4 == 3)
        is_equal = (bench.top / name).read_bytes() == whole and report["samples"] == 64
        wrong += not is_equal
        totals = [totals[0] + kills, totals[1] + resumes]
        print(f"{name}: {'equal' if is_equal else 'DIFFERS'}, {kills} workers killed, {resumes} resumed, "
              f"{report['retries']} tried again", flush=True)
    print(f"{options.jobs} jobs: {wrong} differ, {totals[0]} workers killed, {totals[1]} jobs killed and resumed")
    return 1 if wrong or totals[0] < options.jobs // 2 else 0


if __name__ == "__main__":
    sys.exit(main())

"""A worker in a network namespace of its own is cut off for a while: its work is done elsewhere, and the picture has the
bytes of one render. Needs root and iproute2; without them it is skipped. A job that ends before the cut, or in which
the other worker did nothing in the meantime, fails the test: it has shown nothing.

    netcut.py BINARY SCENES [--cut 30]
"""

import argparse
import contextlib
import os
import shutil
import subprocess
import sys
import time

from cluster import Cluster, bench_of_arguments
from needs import SKIPPED

FLAGS = ["--size", "240x135", "--spp", "96"]
HERE, THERE = "10.231.7.1", "10.231.7.2"


def ip(*words, check=True):
    return subprocess.run(["ip", *words], check=check, stderr=None if check else subprocess.DEVNULL).returncode == 0


@contextlib.contextmanager
def namespace():
    """(its name, our end of the cable into it)"""
    name, cable = f"vx{os.getpid()}", f"vxa{os.getpid()}"[:15]
    try:
        ip("netns", "add", name)
        ip("link", "add", cable, "type", "veth", "peer", "name", "vxb", "netns", name)
        ip("addr", "add", f"{HERE}/24", "dev", cable)
        ip("link", "set", cable, "up")
        for words in (["addr", "add", f"{THERE}/24", "dev", "vxb"], ["link", "set", "vxb", "up"],
                      ["link", "set", "lo", "up"]):
            ip("-n", name, *words)
        yield name, cable
    finally:
        ip("netns", "del", name, check=False)


def main():
    bench = bench_of_arguments()
    options = argparse.ArgumentParser()
    options.add_argument("--cut", type=float, default=30.0, help="seconds")
    options = options.parse_args()
    if os.geteuid() != 0 or not shutil.which("ip") or not ip("netns", "list", check=False):
        print("no network namespaces: this needs root and iproute2")
        return SKIPPED
    whole = bench.render("mixed", "whole.exr", *FLAGS)
    with namespace() as (name, cable), Cluster(bench.top, HERE) as cluster:
        cluster.add_worker()
        cluster.add_worker(before=["ip", "netns", "exec", name], host=THERE)
        time.sleep(5.0)
        child = bench.start("mixed", "n.exr", *FLAGS, "--scheduler", cluster.address, "--json", "-")
        bench.wait_for_parts(child, "n.exr", 2)
        ended_before = child.poll() is not None
        ip("link", "set", cable, "down")
        parts, begin_s = bench.journal("n.exr"), time.monotonic()
        while time.monotonic() - begin_s < options.cut and child.poll() is None:
            time.sleep(0.1)
        ended_cut_off = child.poll() is not None
        goes_on = ended_cut_off or bench.journal("n.exr") > parts
        ip("link", "set", cable, "up")
        out, err = child.communicate(timeout=600)
    is_equal = child.returncode == 0 and (bench.top / "n.exr").read_bytes() == whole
    print(f"exit {child.returncode}, {'equal' if is_equal else 'DIFFERS'}, ended "
          f"{'while the worker was cut off' if ended_cut_off else 'later'}\n{out}{err}")
    return 0 if is_equal and goes_on and not ended_before else 1


if __name__ == "__main__":
    sys.exit(main())

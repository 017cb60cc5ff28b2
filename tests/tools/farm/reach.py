"""Clusters as docs/farm.md says to start them on other machines: behind TLS, and over SSH (here a server of asyncssh).

    reach.py BINARY SCENES
"""

import asyncio
import os
import subprocess
import threading
import unittest

from cluster import Cluster, bench_of_arguments, free_port
from needs import need_modules, need_programs

need_modules("asyncssh")
need_programs("openssl")
import asyncssh  # noqa: E402  after it is known to be there
from distributed import SSHCluster  # noqa: E402

BENCH = bench_of_arguments()
SMALL = ["--size", "48x27", "--spp", "24"]


def openssl(*words):
    subprocess.run(["openssl", *words], check=True, cwd=BENCH.top, stderr=subprocess.DEVNULL)


def make_certificate(name):
    """An authority, and a certificate that it has signed."""
    key = ["-newkey", "rsa:2048", "-nodes", "-keyout"]
    openssl("req", "-x509", *key, f"{name}_ca.key", "-out", f"{name}_ca.pem", "-days", "1", "-subj", f"/CN={name}")
    openssl("req", *key, f"{name}.key", "-out", f"{name}.csr", "-subj", "/CN=localhost")
    openssl("x509", "-req", "-in", f"{name}.csr", "-CA", f"{name}_ca.pem", "-CAkey", f"{name}_ca.key",
            "-CAcreateserial", "-out", f"{name}.pem", "-days", "1")
    return [str(BENCH.top / f"{name}{ending}") for ending in ("_ca.pem", ".pem", ".key")]


def dask_settings(authority, certificate, key):
    tls = "DASK_DISTRIBUTED__COMM__TLS__"
    return {f"{tls}CA_FILE": authority, f"{tls}CLIENT__CERT": certificate, f"{tls}CLIENT__KEY": key}


class LoopbackSsh:
    """A server on the loopback that lets in one key and runs what it is told."""

    def __init__(self):
        self.port = free_port()
        self.host_key = asyncssh.generate_private_key("ssh-ed25519")
        self.user_key = asyncssh.generate_private_key("ssh-ed25519")
        (BENCH.top / "allowed").write_bytes(self.user_key.export_public_key())
        self.loop = asyncio.new_event_loop()
        threading.Thread(target=self.loop.run_forever, daemon=True).start()
        asyncio.run_coroutine_threadsafe(self.listen(), self.loop).result(30)

    async def listen(self):
        await asyncssh.listen("127.0.0.1", self.port, server_host_keys=[self.host_key],
                              authorized_client_keys=str(BENCH.top / "allowed"), process_factory=self.answer)

    @staticmethod
    async def answer(process):
        pipe = asyncio.subprocess.PIPE
        child = await asyncio.create_subprocess_shell(process.command, stdin=pipe, stdout=pipe, stderr=pipe)
        await process.redirect(stdin=child.stdin, stdout=child.stdout, stderr=child.stderr)
        process.exit(await child.wait())

    def options(self):
        return {"port": self.port, "client_keys": [self.user_key], "known_hosts": None, "username": "voxel"}


class Reach(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.whole = BENCH.render("mixed", "whole.exr", *SMALL)

    def test_tls_gives_the_same_bytes(self):
        authority, certificate, key = make_certificate("ours")
        flags = ("--tls-ca-file", authority, "--tls-cert", certificate, "--tls-key", key)
        with Cluster(BENCH.top, tls=flags) as cluster:
            cluster.add_worker()
            os.environ.update(dask_settings(authority, certificate, key))
            BENCH.farm("mixed", "t.exr", *SMALL, "--scheduler", cluster.address, "-q")
            self.assertEqual((BENCH.top / "t.exr").read_bytes(), self.whole)
            os.environ.update(dask_settings(*make_certificate("theirs")))
            self.refused("of_others.exr", cluster.address)
            self.refused("plain.exr", cluster.address.replace("tls:", "tcp:"))

    def refused(self, output, address):
        _, err = BENCH.farm("mixed", output, *SMALL, "--scheduler", address, "-q", code=75)
        self.assertEqual(err.count("\n"), 1, err)
        self.assertFalse((BENCH.top / output).exists())

    def test_ssh_gives_the_same_bytes(self):
        hosts = ["127.0.0.1"] * 3  # the scheduler's, and one for each worker
        with SSHCluster(hosts, connect_options=LoopbackSsh().options(),
                        worker_options={"nthreads": 1, "host": "127.0.0.1"},
                        scheduler_options={"port": 0, "dashboard": False, "host": "127.0.0.1"}) as cluster:
            BENCH.farm("mixed", "s.exr", *SMALL, "--scheduler", cluster.scheduler_address, "-q")
        self.assertEqual((BENCH.top / "s.exr").read_bytes(), self.whole)


if __name__ == "__main__":
    unittest.main()

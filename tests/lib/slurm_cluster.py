"""A real Slurm on this machine, for tests: munged, slurmctld and slurmd of Debian's slurm-wlm, as the user who runs the test.

    python3 tests/lib/slurm_cluster.py [--nodes 2] [--cpus 4]      until Ctrl-C; prints the SLURM_CONF that sbatch needs

No systemd, no cgroups, no accounting: processes are tracked by their parents, and a job that has ended is forgotten after MinJobAge. Nodes are
daemons of their own on this machine, with as many cores as they are told to have.
"""

import argparse
import getpass
import os
import pathlib
import shutil
import signal
import socket
import subprocess
import tempfile
import time

PROGRAMS = ("munged", "slurmctld", "slurmd", "sbatch", "squeue", "scontrol")
SECONDS = 600  # that something may take on a busy machine
CONF = """ClusterName=hvi
SlurmctldHost={host}(127.0.0.1)
SlurmUser={user}
SlurmdUser={user}
AuthType=auth/munge
AuthInfo=socket={folder}/munge.socket
SlurmctldPort={port}
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.%n.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd.%n.log
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool.%n
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
SchedulerParameters=sched_interval=1,batch_sched_delay=1
SlurmdParameters=config_overrides
ReturnToService=2
MpiDefault=none
KillWait={kill_wait}
MinJobAge={age}
OverTimeLimit=0
SlurmctldTimeout=30
SlurmdTimeout=30
PartitionName=short Nodes=ALL Default=YES MaxTime=INFINITE State=UP
"""


def path():
    """with the folders of daemons, which are not on every user's path"""
    return os.pathsep.join([os.environ.get("PATH", ""), "/usr/sbin", "/sbin"])


def lacks():
    """programs that are not here"""
    return [name for name in PROGRAMS if not shutil.which(name, path=path())]


def free_ports(number):
    sockets = [socket.socket() for _ in range(number)]
    for one in sockets:
        one.bind(("127.0.0.1", 0))
    ports = [one.getsockname()[1] for one in sockets]
    for one in sockets:
        one.close()
    return ports


class Cluster:
    """Nodes n0, n1, ... in a folder of their own; with it as a context the daemons run, and end with it."""

    def __init__(self, nodes=2, cpus=4, kill_wait=5, age=6 * SECONDS):
        """age: seconds that an ended job is remembered: a test asks for all of its jobs at its end, minutes after the first on a busy machine"""
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="hvi-slurm-", dir="/tmp"))  # short: paths of sockets are
        self.names, self.daemons = [f"n{k}" for k in range(nodes)], {}
        port, *ports = free_ports(nodes + 1)
        text = CONF.format(host=socket.gethostname(), user=getpass.getuser(), folder=self.folder, port=port, kill_wait=kill_wait, age=age)
        text += "".join(f"NodeName={name} NodeHostname={socket.gethostname()} NodeAddr=127.0.0.1 Port={own} CPUs={cpus} State=UNKNOWN\n" for name, own in zip(self.names, ports))
        self.conf = self.folder / "slurm.conf"
        self.conf.write_text(text)
        for name in ("state", *(f"spool.{name}" for name in self.names)):
            (self.folder / name).mkdir()
        key = self.folder / "munge.key"
        key.write_bytes(os.urandom(128))
        key.chmod(0o400)
        self.environment = {**os.environ, "SLURM_CONF": str(self.conf), "PATH": path()}

    def start(self, name, *words):
        with open(self.folder / f"{name}.out", "a") as out:  # in a session of its own: Ctrl-C reaches the test only, which ends jobs before daemons
            self.daemons[name] = subprocess.Popen(words, env=self.environment, stdin=subprocess.DEVNULL, stdout=out, stderr=subprocess.STDOUT, start_new_session=True)

    def stop(self, name, how=signal.SIGTERM):
        daemon = self.daemons.pop(name)
        daemon.send_signal(how)
        try:
            daemon.wait(timeout=20)
        except subprocess.TimeoutExpired:
            daemon.kill()
            daemon.wait()

    def start_controller(self):
        self.start("slurmctld", "slurmctld", "-D", "-f", str(self.conf))

    def start_node(self, name):
        self.start(name, "slurmd", "-D", "-N", name, "-f", str(self.conf))

    def __enter__(self):
        try:
            self.start("munged", "munged", "--foreground", "--force", f"--socket={self.folder}/munge.socket", f"--key-file={self.folder}/munge.key", f"--pid-file={self.folder}/munged.pid",
                       f"--log-file={self.folder}/munged.log", f"--seed-file={self.folder}/munge.seed")
            self.wait_for(lambda: (self.folder / "munge.socket").exists(), "munged")
            self.start_controller()
            for name in self.names:
                self.start_node(name)
            self.wait_for(lambda: self.states() == {name: "idle" for name in self.names}, "idle nodes")
        except BaseException:
            self.__exit__()
            raise
        return self

    def __exit__(self, *_):
        if "slurmctld" in self.daemons:
            self.clear()
        for name in [*self.daemons][::-1]:
            self.stop(name)
        shutil.rmtree(self.folder, ignore_errors=True)

    def clear(self):
        """no jobs any more, and all nodes as at the beginning"""
        self.said("scancel", f"--user={getpass.getuser()}")
        until = time.monotonic() + 60
        while self.said("squeue", "--noheader").strip() and time.monotonic() < until:
            time.sleep(0.2)
        for name in (name for name, state in self.states().items() if state.startswith(("drain", "down"))):
            self.said("scontrol", "update", f"nodename={name}", "state=resume")

    def said(self, *words):
        """what a command of Slurm prints"""
        return subprocess.run(words, env=self.environment, check=False, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True).stdout

    def states(self):
        """{node: idle, mixed, drained, ...}"""
        return dict(line.split() for line in self.said("sinfo", "--noheader", "--Node", "--format=%N %T").splitlines() if len(line.split()) == 2)

    def queue(self):
        """[(job, state), ...] of all that Slurm remembers"""
        return [tuple(line.split()) for line in self.said("squeue", "--noheader", "--array", "--states=all", "--format=%i %T").splitlines()]

    def wait_for(self, true, what, seconds=SECONDS):
        until = time.monotonic() + seconds
        while not true():
            if time.monotonic() > until:
                logs = "\n".join(f"{path.name}: {path.read_text(errors='replace')[-2000:]}" for path in sorted(self.folder.glob("*.log")))
                raise TimeoutError(f"no {what} after {seconds} s: {self.states()} {self.queue()}\n{logs}")
            time.sleep(0.1)


def main():
    parser = argparse.ArgumentParser(description="Slurm on this machine until Ctrl-C")
    parser.add_argument("--nodes", type=int, default=2)
    parser.add_argument("--cpus", type=int, default=4)
    args = parser.parse_args()
    if missing := lacks():
        raise SystemExit(f"{', '.join(missing)} not found: apt-get install slurm-wlm munge")
    with Cluster(args.nodes, args.cpus) as cluster:
        print(f"export SLURM_CONF={cluster.conf}", flush=True)
        try:
            signal.pause()
        except KeyboardInterrupt:
            pass


if __name__ == "__main__":
    main()

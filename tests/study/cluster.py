"""A cluster on this machine: munged, slurmctld and slurmd on loopback, as root, in a folder of its own."""

import os
import shutil
import signal
import socket
import subprocess
import time

CONF = """ClusterName=loop
SlurmctldHost={host}(127.0.0.1)
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket={root}/munge/socket
CryptoType=crypto/munge
StateSaveLocation={root}/state
SlurmdSpoolDir={root}/spool
SlurmctldPidFile={root}/slurmctld.pid
SlurmdPidFile={root}/slurmd.pid
SlurmctldLogFile={root}/log/slurmctld.log
SlurmdLogFile={root}/log/slurmd.log
SlurmctldPort=16817
SlurmdPort=16818
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
SchedulerType=sched/backfill
SchedulerParameters=batch_sched_delay=0,sched_min_interval=0,sched_interval=2,default_queue_depth=500,bf_interval=2,sched_max_job_start=0
CompleteWait=0
SlurmdTimeout=10
KillWait=2
MinJobAge=2
JobAcctGatherType=jobacct_gather/linux
AccountingStorageType=accounting_storage/none
MpiDefault=none
ReturnToService=2
MaxArraySize=100001
MaxJobCount=100000
NodeName={host} NodeAddr=127.0.0.1 CPUs={cpus} Boards=1 SocketsPerBoard=1 CoresPerSocket={cpus} ThreadsPerCore=1 RealMemory=1000 State=UNKNOWN
PartitionName=main Nodes={host} Default=YES MaxTime=INFINITE State=UP OverSubscribe=NO
"""


def is_possible():
    """Why it is not, in words; empty where it is."""
    lacking = [name for name in ("slurmctld", "slurmd", "sbatch", "munged") if shutil.which(name) is None]
    if lacking:
        return f"{', '.join(lacking)} not installed: `make test-slurm` does"
    return "" if os.geteuid() == 0 else "a cluster of one's own needs root"


class Cluster:
    """Programs that this started are ended by their own process, never by name."""

    def __init__(self, root):
        self.root = root
        self.host = socket.gethostname().split(".")[0]
        for name in ("state", "spool", "log", "munge"):
            os.makedirs(os.path.join(root, name))
        os.chmod(os.path.join(root, "munge"), 0o755)
        key = os.path.join(root, "munge", "key")
        with open(key, "wb") as file:
            file.write(os.urandom(1024))
        os.chmod(key, 0o400)
        self.conf = os.path.join(root, "slurm.conf")
        with open(self.conf, "w", encoding="utf-8") as file:
            file.write(CONF.format(host=self.host, root=root, cpus=os.cpu_count()))
        self.environment = dict(os.environ, SLURM_CONF=self.conf)
        self.munged = self._start("munged", "--foreground", "--force", "--key-file", key, "--socket",
                                  os.path.join(root, "munge", "socket"), "--pid-file", os.path.join(root, "munge", "pid"),
                                  "--log-file", os.path.join(root, "munge", "log"), "--seed-file",
                                  os.path.join(root, "munge", "seed"))
        self._until(lambda: os.path.exists(os.path.join(root, "munge", "socket")), "munged")
        self.controller = self.node = None
        self.start_controller()
        self.start_node()
        self._until(self.is_idle, "a node that is idle")

    def _start(self, *command):
        with open(os.path.join(self.root, "log", command[0] + ".out"), "ab") as out:
            return subprocess.Popen(command, env=self.environment, stdout=out, stderr=out, stdin=subprocess.DEVNULL)

    def call(self, *command):
        return subprocess.run(command, env=self.environment, capture_output=True, text=True, timeout=60, check=False).stdout

    def _until(self, holds, what, seconds=60):
        end = time.monotonic() + seconds
        while not holds():
            if time.monotonic() > end:
                raise TimeoutError(f"no {what} in {seconds} s: {self.root}/log")
            time.sleep(0.3)

    def start_controller(self):
        self.controller = self._start("slurmctld", "-D", "-f", self.conf)

    def start_node(self):
        self.node = self._start("slurmd", "-D", "-f", self.conf, "-N", self.host)

    def kill_controller(self):
        self.controller.kill()
        self.controller.wait()

    def _of_tasks(self):
        """Process ids of what the node does: its steps and their programs, known by the environment they were given."""
        mine = f"SLURM_CONF={self.conf}".encode()
        pids = []
        for pid in filter(str.isdigit, os.listdir("/proc")):
            try:
                with open(f"/proc/{pid}/environ", "rb") as file:
                    words = file.read().split(b"\0")
                with open(f"/proc/{pid}/comm", encoding="utf-8") as file:
                    is_step = file.read().startswith("slurmstepd")
            except OSError:
                continue  # it has ended
            if mine in words and (is_step or any(word.startswith(b"SLURM_JOB_ID=") for word in words)):
                pids.append(int(pid))
        return pids

    def kill_node(self):
        """The node dies with all that it does, and tells no one."""
        self.node.kill()
        self.node.wait()
        for pid in self._of_tasks():
            try:
                os.kill(pid, signal.SIGKILL)
            except ProcessLookupError:
                pass

    def is_idle(self):
        return self.call("sinfo", "-h", "-o", "%t").split() == ["idle"]

    def resume_node(self):
        """As its administrator does: a controller that was killed before it had saved that a task is started starts it
        once more, finds it running, and drains the node."""
        self.call("scontrol", "update", f"nodename={self.host}", "state=resume")

    def clear(self):
        """No tasks, and a node that takes some."""
        self.call("scancel", "-u", "root")
        for _ in range(60):
            if self.is_idle():
                return
            self.resume_node()
            time.sleep(1)
        raise TimeoutError(f"the node does not become idle: {self.root}/log")

    def close(self):
        self.call("scancel", "-u", "root")
        time.sleep(1)
        for process in (self.node, self.controller, self.munged):
            if process is not None and process.poll() is None:
                process.terminate()
                try:
                    process.wait(10)
                except subprocess.TimeoutExpired:
                    process.kill()
                    process.wait()

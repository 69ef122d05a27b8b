"""A Slurm of this machine alone, with folders, ports and a key of its own, for as long as a test wants it."""

import os
import pathlib
import pwd
import shutil
import socket
import subprocess
import tempfile
import time

DAEMONS = ("munged", "slurmctld", "slurmd")
START = 30  # [s] within which the node is there
CONFIGURATION = """ClusterName=toryu_test
SlurmctldHost={host}(127.0.0.1)
SlurmUser=root
AuthType=auth/munge
AuthInfo=socket={folder}/munge/socket
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
MpiDefault=none
ReturnToService=2
SchedulerParameters=sched_min_interval=0,batch_sched_delay=0,sched_interval=1
KillWait=10
SlurmctldPort={ports[0]}
SlurmdPort={ports[1]}
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd.log
NodeName={host} NodeAddr=127.0.0.1 CPUs={cores} State=UNKNOWN
PartitionName=main Nodes={host} Default=YES MaxTime=INFINITE State=UP
"""


class CannotStart(Exception):
    """Why there is no Slurm here."""


def free_ports(count):
    sockets = [socket.socket() for _ in range(count)]
    try:
        for one in sockets:
            one.bind(("127.0.0.1", 0))
        return [one.getsockname()[1] for one in sockets]
    finally:
        for one in sockets:
            one.close()


class OneNodeSlurm:
    """`environment` is what its programs need."""

    def __init__(self):
        missing = [name for name in DAEMONS if not shutil.which(name)]
        if missing or os.geteuid() != 0:
            raise CannotStart(f"no program '{missing[0]}'; tools/install.sh cluster" if missing else "root alone can start it")
        # munged wants folders above its socket that nobody else may write to
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="toryu_slurm_", dir="/run"))
        self.processes = []
        self.environment = os.environ | {"SLURM_CONF": str(self.folder / "slurm.conf")}
        try:
            self._start()
        except BaseException:
            self.close()
            raise

    def _start(self):
        self.folder.chmod(0o755)
        host = socket.gethostname().partition(".")[0]
        (self.folder / "slurm.conf").write_text(CONFIGURATION.format(
            host=host, folder=self.folder, ports=free_ports(2), cores=len(os.sched_getaffinity(0))))
        for name in ("state", "spool", "munge"):
            (self.folder / name).mkdir()
        own, user = self.folder / "munge", pwd.getpwnam("munge")
        (own / "key").write_bytes(os.urandom(128))
        (own / "key").chmod(0o400)
        for path in (own, own / "key"):
            os.chown(path, user.pw_uid, user.pw_gid)
        self._daemon("setpriv", "--reuid=munge", "--regid=munge", "--clear-groups", "munged", "--foreground",
                     f"--socket={own}/socket", f"--key-file={own}/key", f"--pid-file={own}/pid", f"--seed-file={own}/seed",
                     f"--log-file={own}/log")
        self._wait_for((own / "socket").exists)
        for name in ("slurmctld", "slurmd"):
            self._daemon(name, "-D", "-f", self.folder / "slurm.conf")
        self._wait_for(lambda: "idle" in subprocess.run(["sinfo", "-h", "-o", "%T"], env=self.environment, capture_output=True,
                                                        text=True).stdout)

    def _daemon(self, *command):
        self.processes.append(subprocess.Popen(command, env=self.environment, stdin=subprocess.DEVNULL,
                                               stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL))

    def _wait_for(self, condition):
        end = time.monotonic() + START
        while not condition():
            if time.monotonic() > end or any(process.poll() is not None for process in self.processes):
                raise CannotStart("its daemons do not come up")
            time.sleep(0.1)

    def close(self):
        for process in reversed(self.processes):
            process.terminate()
            try:
                process.wait(20)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()
        shutil.rmtree(self.folder, ignore_errors=True)

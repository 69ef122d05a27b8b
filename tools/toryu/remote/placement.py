"""Which programs of a run are on other hosts: the options that say so, and what becomes of their commands."""

import os
import secrets
import shlex
import shutil
import socket
import subprocess
import sys

from toryu import nearest, program
from toryu.installation import on_other_hosts
from toryu.processes import BAD_INPUT, DONE, Run, start
from toryu.remote.job import Job

OTHER = {"fluid": "solid", "solid": "fluid"}
NAMES = {"coupler": "coupler", "fluid": "fluid_solver", "solid": "solid_solver"}
# Asks nothing, since nobody could answer; and gives up a host that is away.
SSH = "ssh -T -o BatchMode=yes -o ConnectTimeout=10 -o ServerAliveInterval=15"
LOOPBACK = "127.0.0.1"
LONGEST_SILENCE = 3.0  # [s], as in common/run/network.hpp


def add_options(parser):
    group = parser.add_argument_group("programs on other hosts", "coupler/README.md, \"On several hosts\"")
    group.add_argument("--host", metavar="PROGRAM=ADDRESS", action="append", default=[],
                       help="where the program 'fluid', 'solid' or 'coupler' runs; the others run here")
    group.add_argument("--launcher", metavar="COMMAND", default=SSH, help="what reaches a host, called as COMMAND ADDRESS "
                       "bash; default ssh without questions")
    group.add_argument("--remote-bin", metavar="DIR", help="folder of the programs there; default as here")
    group.add_argument("--remote-folder", metavar="DIR", help="folder there for what a program writes until it is brought "
                       "here; default its TMPDIR, or /tmp")
    group.add_argument("--peers", metavar="A,B,C", help="all hosts as they reach each other; default the addresses of --host "
                       "and that of this machine")


def refuse(text):
    print(text, file=sys.stderr)
    raise SystemExit(BAD_INPUT)


def hosts_of(options, names):
    """Program -> address of those of the programs `names` that --host puts elsewhere."""
    found = {}
    known = [word for word, name in NAMES.items() if name in names]
    for text in options.host:
        word, _, address = text.partition("=")
        if word not in NAMES:
            refuse(f"--host {text}: error: must begin with the program and '=', as fluid=ADDRESS"
                   f"{nearest(word, list(NAMES))}")
        if word not in known:
            refuse(f"--host {text}: error: the case has no {word}; it takes {', '.join(known)}")
        if not address or address.startswith("-") or not address.isprintable() or any(map(str.isspace, address)):
            refuse(f"--host {text}: error: must have the name or address of a host after '='")
        if NAMES[word] in found:
            refuse(f"--host {text}: error: {word} has a host already: {found[NAMES[word]]}")
        if word == OTHER.get(options.only):
            refuse(f"--host {text}: error: with --only {options.only} the {word} is the record's, and here")
        found[NAMES[word]] = address
    return found


def launcher_of(options):
    try:
        words = shlex.split(options.launcher)
    except ValueError as error:
        refuse(f"--launcher {options.launcher}: error: {error}")
    if not words or not shutil.which(words[0]):
        refuse(f"--launcher {options.launcher}: error: no such program"
               f"{'; install openssh-client' if options.launcher == SSH else ''}")
    return words


def is_loopback(address):
    return address.startswith("127.")


def own_address(host):
    """The address by which `host`, an address, knows this machine; nothing is sent."""
    try:
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
            probe.connect((host, 7400))
            return probe.getsockname()[0]
    except OSError as error:
        refuse(f"--host: error: no way leads to {host}: {error.strerror}; 'ip route get {host}' shows why")


def address_of(host):
    try:
        return socket.getaddrinfo(host, None, socket.AF_INET)[0][4][0]
    except OSError as error:
        refuse(f"--host: error: no IPv4 address of {host} is known ({error.strerror}): give the one by which the other hosts "
               "reach it, or all of them by --peers")


def peers_of(hosts, names):
    """All hosts of a run, by addresses that each of them can reach: loopback is this machine, which others know by another."""
    remote = [address_of(address.rpartition("@")[2]) for address in hosts.values()]
    own = next((address for address in map(own_address, remote) if not is_loopback(address)), LOOPBACK)
    here = [own] if len(hosts) < len(names) else []
    return ",".join(dict.fromkeys(here + [own if is_loopback(address) else address for address in remote]))


def version_of(executable):
    return subprocess.run([executable, "--version"], stdout=subprocess.PIPE, stdin=subprocess.DEVNULL,
                          encoding="utf-8", errors="replace").stdout.strip()


class Placement:
    """The programs of a run and where they are: `jobs` of those that are on other hosts, and what each program of the run is
    told of the `network`."""

    def __init__(self, options, case, executables, own):
        """`executables`: program -> path, the lead first; those of `own` are of toryu."""
        self.secret = options.out / "run.secret"
        hosts = hosts_of(options, executables)
        self.jobs, self.network = {}, []
        if not hosts:
            return self._refuse_without(options)
        launcher = launcher_of(options)
        is_coupled = len(executables) > 1
        if is_coupled:
            self.network = [f"--peers={options.peers or peers_of(hosts, executables)}", "--collected"]
        for name, address in hosts.items():
            path, is_own = str(executables[name]), name in own
            if is_own:
                path = os.path.join(options.remote_bin, name) if options.remote_bin else str(on_other_hosts(path))
            self.jobs[name] = Job(
                name, address, launcher, os.path.abspath(path) if os.sep in path else path, folder=options.remote_folder,
                packages=packages_there(options),
                version=version_of(executables[name]) if is_own else "", lost_after=silence_of(options), case=options.case,
                out=str(options.out), files=[str(path) for path in inputs_of(case)], is_lead=name == next(iter(executables)),
                is_coupled=is_coupled, restarts=options.restart is not None)

    def _refuse_without(self, options):
        if options.peers:
            refuse(f"--peers {options.peers}: error: goes with --host; programs that are started by hand take it themselves")
        for name in ("remote_bin", "remote_folder"):
            if getattr(options, name):
                refuse(f"--{name.replace('_', '-')} {getattr(options, name)}: error: goes with --host")
        if options.launcher != SSH:
            refuse(f"--launcher {options.launcher}: error: goes with --host")

    def check(self):
        """Whether each host can run its program; says what is wrong, and returns an exit code."""
        looks = [start(program.python("remote", job.as_text()), subprocess.PIPE) for job in self.jobs.values()]
        for look in looks:
            words = look.communicate()[0].decode(errors="replace").strip()
            if look.returncode != DONE:
                print(words, file=sys.stderr)
        return max((look.returncode for look in looks), default=DONE)

    def run_of(self, commands, environment, have_met):
        """The run of `commands`, name -> words, with what stands here for those on other hosts."""
        placed, stands = {}, set()
        for name, command in commands.items():
            if job := self.jobs.get(name):
                name = f"{name} on {job.address}"
                stands.add(name)
                job.arguments = command[3:]  # without the program, the case and the results
                placed[name] = program.python("remote", job.as_text())
            else:
                placed[name] = command
        return Run(placed, lead=next(iter(placed)), environment=environment, stands=stands, have_met=have_met)

    def make_secret(self):
        """Of a coupled run: each host gets a copy (common/link/run_secret.hpp)."""
        if self.network:
            with open(os.open(self.secret, os.O_CREAT | os.O_EXCL | os.O_WRONLY, 0o600), "w") as file:
                file.write(f"{secrets.token_hex(16)}\n")

    def forget_secret(self):
        self.secret.unlink(missing_ok=True)


def packages_there(options):
    """Where a program in Python finds toryu on a host: beside the build, or the command of an installation, there."""
    if not options.remote_bin:
        return str(program.PACKAGE.parent)
    return os.pathsep.join(os.path.abspath(os.path.join(options.remote_bin, tools)) for tools in
                           ("../../../tools", "../lib/toryu/tools"))


def silence_of(options):
    try:
        return max(LONGEST_SILENCE, float(options.lost_after or 0))
    except ValueError:
        return LONGEST_SILENCE  # the programs refuse it


def inputs_of(case):
    """What a program reads that is not named by an absolute path: that must be on its host."""
    absolute = {path for path in map(os.path.normpath, case.files) if os.path.isabs(path)}
    return [path for path in case.inputs if os.path.normpath(path) not in absolute and os.path.isfile(path)]

"""A real JupyterHub on loopback: its own login, its own proxy, an account for each student.

Shared by the test and the benchmark. Everything is gone afterwards, the accounts too.
"""

import os
import pwd
import re
import secrets
import shutil
import signal
import subprocess
import tempfile
import time
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path
from urllib.parse import quote

import requests
from environments import run
from hub_environment import PAGE, PLACE, proxy_of
from lab import free_port

ROOT_UID = 0
PATIENCE_SECONDS = 300  # twenty students start on two cores
HOME_MODE = 0o700  # what keeps students apart; TLJH takes the others' rights away, too
CONFIG = """
from jupyterhub.app import JupyterHub

{page}
c.JupyterHub.bind_url = "http://127.0.0.1:{port}"
c.JupyterHub.hub_port = {hub_port}
c.ConfigurableHTTPProxy.api_url = "http://127.0.0.1:{proxy_port}"
c.ConfigurableHTTPProxy.command = [{proxy!r}]
c.JupyterHub.concurrent_spawn_limit = {at_once}
JupyterHub.spawn_throttle_retry_range.tag(config=True)  # 5.5.4 lets nobody set it: 30 to 60 s
c.JupyterHub.spawn_throttle_retry_range = (1, 2)
c.Authenticator.allowed_users = {names!r}
c.Spawner.poll_interval = 5  # seconds until it notices that a server has died
"""
LINK = re.findall(r"^https://hub\.example\.org(\S+)$", PAGE, re.MULTILINE)[0]
REPOSITORY = quote("https://git.example.org/", safe="")


@dataclass(frozen=True)
class Account:
    """An account of the system, made for a student."""

    name: str
    password: str
    home: Path

    def processes(self, command: str = "") -> list[int]:
        """Return the ids of the student's processes whose command line contains a text."""
        uid, found = pwd.getpwnam(self.name).pw_uid, []
        for folder in Path("/proc").glob("[0-9]*"):
            with suppress(FileNotFoundError, ProcessLookupError):
                said = (folder / "cmdline").read_bytes().decode(errors="replace")
                if folder.stat().st_uid == uid and command in said:
                    found.append(int(folder.name))
        return found


@dataclass(frozen=True)
class Hub:
    """A hub that runs; `link` is what the teacher gives to the class."""

    address: str
    link: str
    accounts: list[Account]
    process: int
    log: Path

    def memory_mb(self) -> float:
        """Return what the hub and its proxy take of the memory, in MB."""
        started = Path(f"/proc/{self.process}/task/{self.process}/children").read_text("ascii")
        children = [Path("/proc", number) for number in started.split()]
        proxies = [int(one.name) for one in children if one.stat().st_uid == ROOT_UID]
        return sum(map(proportional_mb, [self.process, *proxies]))


@contextmanager
def running_hub(
    environment: Path, course: Path, students: int, at_once: int = 100, more: str = ""
) -> Iterator[Hub]:
    """Start a hub for so many students, who are given a course by the page's link.

    It starts no more than `at_once` servers at the same time; `more` are settings.
    """
    with ExitStack() as stack:
        folder = Path(stack.enter_context(tempfile.TemporaryDirectory(prefix="cammotion-hub-")))
        folder.chmod(0o711)  # to be passed through, not to be listed
        accounts = [stack.enter_context(account(folder, n)) for n in range(1, students + 1)]
        git = stack.enter_context(served(course))
        own = folder / "hub"
        own.mkdir(mode=0o700)
        port = free_port()
        settings = CONFIG.format(
            page=page_settings(environment),
            port=port,
            hub_port=free_port(),
            proxy_port=free_port(),
            proxy=str(proxy_of(environment)),
            at_once=at_once,
            names={each.name for each in accounts},
        )
        (own / "jupyterhub_config.py").write_text(settings + more, "utf-8")
        address = f"http://127.0.0.1:{port}"
        process = stack.enter_context(started(environment, own, address))
        link = LINK.replace(REPOSITORY, quote(git, safe=""))
        yield Hub(address, address + link, accounts, process, own / "hub.log")


def page_settings(environment: Path) -> str:
    """Return the settings that docs/classroom.md gives, for this environment."""
    (settings,) = re.findall(r"```python\n(c\.Spawner.*?)```", PAGE, re.DOTALL)
    return str(settings).replace(PLACE, str(environment))


@contextmanager
def started(environment: Path, own: Path, address: str) -> Iterator[int]:
    """Run the hub, wait until it answers, and give its process; its servers end with it."""
    path = os.pathsep.join([str(environment / "bin"), os.environ["PATH"]])
    log = own / "hub.log"
    with log.open("w") as output:
        hub = subprocess.Popen(
            [environment / "bin" / "jupyterhub"],
            cwd=own,
            env={"PATH": path, "LANG": "C.UTF-8", "HOME": str(own)},
            stdin=subprocess.DEVNULL,
            stdout=output,
            stderr=subprocess.STDOUT,
        )
    try:
        end = time.monotonic() + PATIENCE_SECONDS
        while not answers(f"{address}/hub/api"):
            if time.monotonic() > end or hub.poll() is not None:
                raise RuntimeError(f"The hub is not ready:\n{log.read_text('utf-8')}")
            time.sleep(0.1)
        yield hub.pid
    finally:
        hub.terminate()
        hub.wait(PATIENCE_SECONDS)


def answers(address: str) -> bool:
    with suppress(requests.ConnectionError):
        return requests.get(address, timeout=PATIENCE_SECONDS).ok
    return False


@contextmanager
def account(homes: Path, number: int) -> Iterator[Account]:
    """Make an account with a home of its own; end what it runs and remove it afterwards."""
    name, password = f"cam-{secrets.token_hex(3)}-{number}", secrets.token_hex(16)
    home = homes / name
    run("useradd", "--create-home", "--home-dir", home, "--shell", "/usr/sbin/nologin", name)
    made = Account(name, password, home)
    try:
        home.chmod(HOME_MODE)
        run("chpasswd", told=f"{name}:{password}\n")
        yield made
    finally:
        for process in made.processes():
            with suppress(ProcessLookupError):
                os.kill(process, signal.SIGKILL)
        run("userdel", "--force", name)


@contextmanager
def served(course: Path) -> Iterator[str]:
    """Give a git repository to whoever asks on loopback, as a host on the web would."""
    port = free_port()
    git = shutil.which("git") or "git"
    command = [git, "daemon", "--listen=127.0.0.1", f"--port={port}", "--export-all"]
    daemon = subprocess.Popen(
        [*command, f"--base-path={course.parent}", str(course.parent)],
        stdin=subprocess.DEVNULL,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        start_new_session=True,
    )
    try:
        yield f"git://127.0.0.1:{port}/"
    finally:
        os.killpg(daemon.pid, signal.SIGTERM)
        daemon.wait(PATIENCE_SECONDS)


def proportional_mb(process: int) -> float:
    """Return a process's share of the memory, in MB: what it has alone, and its part of the rest.

    What several processes have in common counts for each by its share, so that the sum over all
    of them is what they need together.
    """
    said = Path(f"/proc/{process}/smaps_rollup").read_text("ascii")
    return int(re.findall(r"^Pss:\s+(\d+) kB", said, re.MULTILINE)[0]) * 1024 / 1e6


def processor_s(process: int) -> float:
    """Return how long a process, and what it has waited for, has had a processor, in s."""
    _, _, said = Path(f"/proc/{process}/stat").read_text("ascii").rpartition(")")
    return sum(map(int, said.split()[11:15])) / os.sysconf("SC_CLK_TCK")

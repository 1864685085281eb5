"""pip or uv at work: how far it is, and in words why it failed."""

import re
import shutil
import subprocess
import tempfile
from collections.abc import Callable

from starter import download, processes, reasons
from starter.errors import WorkbookError
from starter.paths import ON_WINDOWS, ROOT, VENV, VENV_PYTHON

PATIENCE = {"PIP_RETRIES": "2", "UV_HTTP_RETRIES": "2", "PIP_DISABLE_PIP_VERSION_CHECK": "1"}
# Settings of the user's that would send the packages elsewhere than into the environment.
ELSEWHERE = ("PIP_USER", "PIP_TARGET", "PIP_PREFIX", "PIP_ROOT", "PIP_PYTHON")
PACKAGES = ("Lib" if ON_WINDOWS else "lib/python*") + "/site-packages"
INSTALLED = f"{PACKAGES}/*.dist-info"


def find_uv() -> str | None:
    """Return the path of uv, if it is installed."""
    return shutil.which("uv")


def has_pip() -> bool:
    """Tell whether pip is in the environment."""
    return any(VENV.glob(f"{PACKAGES}/pip/__main__.py"))


def add_pip() -> None:
    """Put pip into the environment."""
    run([str(VENV_PYTHON), "-Im", "ensurepip"], lambda _lines: "adding pip")


def install_packages(step: str, whole: bool) -> None:
    """Install what environment.txt pins, `whole` with what only tests need; say how far it is."""
    total, before = len(download.pinned_packages(whole)), count_installed()
    uv = find_uv()
    tool = [uv, "pip", "install", "-p"] if uv else []
    tool += [str(VENV_PYTHON)] if uv else [str(VENV_PYTHON), "-m", "pip", "install", "--no-user"]
    # As pip always does: or what the package lays into .venv would stay as it was.
    tool += ["--reinstall-package", "cammotion"] if uv else []
    # As pip always does, too: else warnings of what only tests need would be errors in them.
    tool += ["--compile-bytecode"] if uv and whole else []
    time_needed = "uv" if uv else "pip (a few minutes, once)"
    print(f"{step} Installing about {total} packages with {time_needed} ...")
    run(
        [*tool, *download.requirements(whole)],
        lambda lines: describe_progress(lines, count_installed() - before, total),
    )


def count_installed() -> int:
    """Count the distributions in the environment."""
    return sum(1 for _ in VENV.glob(INSTALLED))


def describe_progress(lines: list[str], installed: int, total: int) -> str:
    """Say how far an installation is."""
    if installed > 0:
        return f"installed {installed} of {total}"
    found = re.findall(r"^(?:Collecting|Processing) (?:.*[/\\])?([\w.]+)", "".join(lines), re.M)
    return f"fetched {len(found)} of {total}: {found[-1]}" if found else "looking for packages"


def run(command: list[str], describe: Callable[[list[str]], str]) -> None:
    """Run an installer in the workbook's folder, with a line of progress; raise if it fails."""
    process = subprocess.Popen(
        command,
        cwd=ROOT,
        env=environ(),
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        encoding="utf-8",
        errors="replace",
        close_fds=False,  # it inherits the lock of environment.ensure
    )
    lines: list[str] = []
    reader = processes.listen(process.stdout, lines.append)
    try:
        processes.wait_until(lambda: not reader.is_alive(), lambda: describe(lines))
        process.wait()
    finally:
        processes.stop(process, grace=1)
    if process.returncode != 0:
        output = "".join(lines)
        raise WorkbookError(processes.tail(lines) + keep(output) + explain(output))


def environ() -> dict[str, str]:
    """Return the variables for an installer: the user's index and proxy, but .venv as the place."""
    variables = PATIENCE | processes.environ()
    return {name: value for name, value in variables.items() if name not in ELSEWHERE}


def keep(output: str) -> str:
    """Write an installer's output where it outlives the environment, and say where."""
    try:
        with tempfile.NamedTemporaryFile(
            "w", prefix="workbook-", suffix=".log", delete=False, encoding="utf-8"
        ) as file:
            file.write(output)
    except OSError:
        return ""
    return f"All that the installer said: {file.name}\n"


def explain(output: str) -> str:
    """Say in words why an installer failed, and what to do."""
    return reasons.find(output) or "The installation failed: the installer's lines above say why."

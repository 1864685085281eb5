"""What the figures were measured on: the machine, its system, the versions."""

import os
import platform
import re
import subprocess
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
PACKAGES = (
    *("numpy", "scipy", "sympy", "matplotlib", "ipywidgets", "anywidget"),
    *("jupyterlab", "jupyter-server", "ipykernel", "nbval"),
)


def describe() -> str:
    """Return in three lines what the table below them depends on."""
    system = f"{platform.system()} {platform.release()}, Python {platform.python_version()}"
    return "\n".join(
        [
            f"{_processor()}, {os.cpu_count()} cores, {_memory()}; {system}",
            ", ".join(f"{name} {_version(name)}" for name in PACKAGES),
            f"cammotion {_version('cammotion')}, commit {_commit()}",
        ]
    )


def _processor() -> str:
    """Return what the processor calls itself, where the system says so."""
    file = Path("/proc/cpuinfo")
    found = re.search(r"^model name\s*: (.+)$", file.read_text() if file.exists() else "", re.M)
    return found[1] if found else platform.processor() or platform.machine()


def _memory() -> str:
    try:
        pages = os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE")
    except (AttributeError, ValueError, OSError):  # Windows has no sysconf
        return "memory unknown"
    return f"{pages / 2**30:.0f} GiB"


def _version(name: str) -> str:
    try:
        return version(name)
    except PackageNotFoundError:
        return "not installed"


def _commit() -> str:
    """Return the commit, with a plus for what is changed since; outside of git say so."""
    command = ["git", "describe", "--always", "--dirty=+", "--exclude=*"]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    return done.stdout.strip() or "unknown"

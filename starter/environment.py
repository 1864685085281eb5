"""Make, update or repair .venv, so that it is ready."""

import contextlib
import importlib.util
import os
import shutil
from pathlib import Path

from starter import download, inspection, installer, processes
from starter.errors import WorkbookError
from starter.paths import ON_WINDOWS, PACKAGE, PYTHON_VERSION, ROOT, START, VENV, first_free

MARKER = VENV / "made-by-workbook"
BEFORE = VENV.with_name(".venv-before")  # until the new one is there
MB_FOR_NEW, MB_FOR_TESTS, MB_FOR_UPDATE = 1000, 1400, 400


def ensure(whole: bool = False) -> None:
    """Make, update or repair .venv, unless it is ready; `whole` with what only tests need."""
    download.check()
    state, reason = inspection.judge(whole)
    if state == "ready":
        return
    if not os.access(ROOT, os.W_OK):
        raise WorkbookError(
            f"The environment in .venv is not ready ({reason or state}), and you may not write in "
            f"{ROOT}: whoever looks after that folder has to run `{START} setup` there. "
            "Or put the workbook into a folder of your own, and start again."
        )
    with processes.only_one_in(ROOT, "Another set-up is at work in this folder"):
        state, reason = inspection.judge(whole)
        if state == "changed":
            update(reason, whole)
        elif state != "ready":
            make(reason, whole)


def make(reason: str, whole: bool) -> None:
    """Make .venv from nothing; if that fails leave what was there, and nothing half-made."""
    check_path()
    check_modules()
    if reason:
        print(f"The environment in .venv is not used: {reason}.")
    needed_mb = MB_FOR_TESTS if whole else MB_FOR_NEW
    clear_the_way(needed_mb)
    try:
        check_disk(needed_mb)
        print(f"[1/3] Making the Python environment in .venv (Python {PYTHON_VERSION})")
        create()
        installer.install_packages("[2/3]", whole)
        record("[3/3]", whole)
    except BaseException:
        shutil.rmtree(VENV, ignore_errors=True)
        with contextlib.suppress(OSError):  # there was none, or what is left is in use
            BEFORE.rename(VENV)
        raise
    shutil.rmtree(BEFORE, ignore_errors=True)


def update(reason: str, whole: bool) -> None:
    """Install into the existing .venv what changed or is missing; what is whole stays whole."""
    print(f"The environment in .venv is updated: {reason}.")
    before = inspection.read_stamp()
    whole = whole or bool(before and before.whole)
    check_disk(MB_FOR_UPDATE)
    lacks_pip = not (installer.find_uv() or installer.has_pip())
    if lacks_pip:  # uv made it, and is gone
        check_modules()
    inspection.STAMP.unlink()
    try:
        if lacks_pip:
            installer.add_pip()
        installer.install_packages("[1/2]", whole)
        record("[2/2]", whole)
    except BaseException:
        now = inspection.inspect()
        # Nothing was touched (no network, say): the next start need not make it anew.
        if before and now and not inspection.differences(before, now):
            inspection.write_stamp(before)
        raise


def create() -> None:
    """Make an environment, with pip unless uv does the installing."""
    import venv

    VENV.mkdir()
    MARKER.write_text("workbook.py made this folder and may remove it\n", encoding="ascii")
    venv.EnvBuilder(symlinks=not ON_WINDOWS).create(VENV)
    if not installer.find_uv():
        installer.add_pip()


def record(step: str, whole: bool) -> None:
    """Check the result of an installation, and stamp it."""
    print(f"{step} Checking the environment")
    now = inspection.inspect()
    if now is None or Path(now.package) != PACKAGE:
        raise WorkbookError(
            "The packages were installed, but Python does not find cammotion. Does a setting of "
            "pip or uv send them elsewhere, such as target, prefix or root?"
        )
    pinned = download.pinned_packages(whole)
    versions = {name: version for name, version in now.versions.items() if name in pinned}
    inspection.write_stamp(now._replace(versions=versions, whole=whole))


def check_path() -> None:
    """Refuse a folder whose path no variable can list: Python makes no environment there."""
    if os.pathsep in str(VENV):
        raise WorkbookError(
            f"In {ROOT} no Python environment can be made, since the path has a {os.pathsep!r} "
            "(a Mac shows it as a slash). Rename that folder, and start again."
        )


def check_modules() -> None:
    """Refuse, before anything is made, if this Python cannot make environments."""
    needed = ["venv"] if installer.find_uv() else ["venv", "ensurepip"]
    for name in needed:
        if importlib.util.find_spec(name) is None:
            raise WorkbookError(
                f"This Python {PYTHON_VERSION} lacks its module {name}, "
                "which some systems split off.\n"
                f"On Debian and Ubuntu: sudo apt install python{PYTHON_VERSION}-venv\n"
                "Or, anywhere: install uv (https://docs.astral.sh/uv/). Then start again."
            )


def check_disk(needed_mb: int) -> None:
    """Refuse if the installation would not fit."""
    if free_mb() < needed_mb:
        raise WorkbookError(
            f"Too little room on the disk: {free_mb()} MB are free in {ROOT}, "
            f"and the installation needs {needed_mb} MB. Make room and start again."
        )


def free_mb() -> int:
    """Return how much room the disk has."""
    return shutil.disk_usage(ROOT).free // 1_000_000


def clear_the_way(needed_mb: int = 0) -> None:
    """Put a .venv aside: for good if it is not ours, else until a new one is there.

    One of ours is removed at once if it is half-made, or if the disk has no room for two.
    """
    if MARKER.is_file() and not VENV.is_symlink():
        if inspection.read_stamp() is None:
            shutil.rmtree(VENV)
        else:
            shutil.rmtree(BEFORE, ignore_errors=True)
            VENV.rename(BEFORE)
    elif os.path.lexists(VENV):
        aside = first_free(VENV.with_name(".venv-old"))
        VENV.rename(aside)
        print(f"That .venv was not made by the workbook: it is kept as {aside.name}.")
    if free_mb() < needed_mb:
        shutil.rmtree(BEFORE, ignore_errors=True)

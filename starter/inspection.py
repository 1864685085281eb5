"""What is in .venv, and whether it is what the last installation left there."""

import hashlib
import json
import os
import subprocess
from typing import NamedTuple

from starter.paths import ENVIRONMENT, LAB_SETTING, SERVER_SWITCH, VENV, VENV_PYTHON

STAMP = VENV / "installed.json"
PROBE = """
import importlib.metadata, importlib.util, json, os, re, sys
package = importlib.util.find_spec("cammotion")
print(json.dumps({
    "python": "%d.%d" % sys.version_info[:2],
    "prefix": sys.prefix,
    "package": os.path.realpath(os.path.dirname(package.origin or "")) if package else "",
    "versions": {
        re.sub("[-_.]+", "-", item.metadata["Name"] or "").lower(): item.version
        for item in importlib.metadata.distributions()
    },
}))
"""


class Environment(NamedTuple):
    """What is, or at the end of an installation was, in .venv and asked for by `files`.

    `whole` is a stamp's: whether that was installed, too, which only the tests need.
    """

    files: dict[str, str]
    python: str
    prefix: str
    package: str
    versions: dict[str, str]
    whole: bool = True


def judge(whole: bool = False) -> tuple[str, str]:
    """Look at .venv: missing, or what `compare` says; `whole` asks for what only tests need."""
    if not os.path.lexists(VENV):
        return "missing", ""
    stamp = read_stamp()
    verdict = compare(stamp, inspect() if stamp else None)
    lacks_tests = verdict[0] == "ready" and whole and stamp and not stamp.whole
    return ("changed", "the tests need more packages") if lacks_tests else verdict


def compare(stamp: Environment | None, now: Environment | None) -> tuple[str, str]:
    """Compare the environment with its stamp: ready, changed or broken, and why."""
    if stamp is None:
        return "broken", "its installation was not completed"
    if now is None:
        return "broken", "its Python does not run"
    if now.python != stamp.python:
        return "broken", f"its Python was {stamp.python} and is {now.python}"
    if (now.prefix, now.package) != (stamp.prefix, stamp.package):
        return "broken", "the folder of the workbook was moved or copied"
    changed = [name for name in now.files if now.files[name] != stamp.files.get(name)]
    reason = f"{' and '.join(changed)} changed" if changed else differences(stamp, now)
    return ("changed" if reason else "ready"), reason


def differences(before: Environment, now: Environment) -> str:
    """Say which packages are missing or have another version than before."""
    return ", ".join(
        f"{name} is {now.versions[name]} instead of {version}"
        if name in now.versions
        else f"{name} is missing"
        for name, version in before.versions.items()
        if now.versions.get(name) != version
    )


def inspect() -> Environment | None:
    """Ask the environment's Python what it is and has; return None if it does not run."""
    files = {
        path.name: hashlib.sha256(path.read_bytes()).hexdigest()
        for path in (ENVIRONMENT, SERVER_SWITCH, LAB_SETTING)
    }
    probe = [str(VENV_PYTHON), "-I", "-c", PROBE]
    try:
        answer = subprocess.run(probe, capture_output=True, text=True, timeout=60, check=True)
        return Environment(files, **json.loads(answer.stdout))
    except (OSError, ValueError, TypeError, subprocess.SubprocessError):
        return None


def read_stamp() -> Environment | None:
    """Read what the last completed installation left; return None if there is none."""
    try:
        return Environment(**json.loads(STAMP.read_text(encoding="utf-8")))
    except (OSError, ValueError, TypeError):
        return None


def write_stamp(environment: Environment) -> None:
    """Record a completed installation."""
    STAMP.write_text(json.dumps(environment._asdict()), encoding="utf-8")

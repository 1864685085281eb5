"""What README, notebooks, pyproject.toml and environment.txt say of each other is true."""

import json
import re
import shlex
import subprocess
import sys
import tomllib
from pathlib import Path
from typing import Any

import motion_picture
import pytest
from packaging.markers import default_environment
from packaging.requirements import Requirement

ROOT = Path(__file__).parent.parent
sys.path.append(str(ROOT))

from starter import commands, notebooks  # noqa: E402

README = (ROOT / "README.md").read_text("utf-8")
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]
COMMAND = re.compile(r"(?:python3?|py) workbook\.py([^`\n]*)")


def texts() -> dict[str, str]:
    """Return all prose that may name a command: README, the teacher's page, and the notebooks."""
    found = {"README.md": README, "teaching.md": (ROOT / "docs/teaching.md").read_text("utf-8")}
    for path in notebooks.originals():
        cells = json.loads(path.read_text("utf-8"))["cells"]
        prose = ["".join(c["source"]) for c in cells if c["cell_type"] == "markdown"]
        found[path.name] = "\n".join(prose)
    return found


NAMED = [(where, command) for where, text in texts().items() for command in COMMAND.findall(text)]


@pytest.mark.parametrize(("where", "command"), NAMED)
def test_each_command_that_is_named_exists(where: str, command: str) -> None:
    assert where
    options = commands.parse(shlex.split(command))
    if options.command == "fresh":
        notebooks.find(options.notebook)


def test_the_readme_names_every_command() -> None:
    said = {commands.parse(shlex.split(command)).command for where, command in NAMED}
    assert said == set(commands.COMMANDS)


def test_ci_calls_the_test_command_of_the_readme() -> None:
    assert "\npython3 workbook.py test\n" in README
    run = (ROOT / ".ci" / "run").read_text("utf-8")
    assert "\npython3 workbook.py test\n" in run
    fresh = 'python3 workbook.py test --fresh --seconds 120 --seed "$(git rev-parse HEAD)"'
    assert f"\n{fresh}\n" in run
    assert '\nfor versions in lowest newest; do\n    .ci/versions "$versions" src README' in run


def test_each_direct_dependency_has_a_lowest_version() -> None:
    """On which `.ci/versions lowest` runs the tests, as the README says."""
    for needed in DIRECT:
        assert {"~=", ">=", "=="} & {each.operator for each in needed.specifier}, needed.name
    assert "`.ci/versions lowest`" in README
    assert "`.ci/versions newest`" in README


@pytest.mark.skipif(sys.platform == "win32", reason="a script for bash")
@pytest.mark.parametrize("words", [[], ["other"]])
def test_which_versions_are_meant_is_asked_for(words: list[str]) -> None:
    """Before anything is installed."""
    command = ["/bin/bash", str(ROOT / ".ci" / "versions"), *words]
    ran = subprocess.run(command, capture_output=True, text=True, check=False)
    assert ran.returncode == 2
    assert ran.stderr == "Say which versions: .ci/versions lowest, or .ci/versions newest.\n"


def test_the_readme_lists_every_notebook() -> None:
    for path in notebooks.originals():
        assert f"(notebooks/{path.name})" in README


DIRECT = [
    Requirement(line)
    for line in (
        PROJECT["dependencies"]
        + PROJECT["optional-dependencies"]["lab"]
        + PROJECT["optional-dependencies"]["test"]
    )
]
PINS = [
    Requirement(line)
    for line in (ROOT / "environment.txt").read_text("utf-8").splitlines()
    if line and not line.lstrip().startswith(("#", "-e"))
]


@pytest.mark.parametrize("python", ["3.11.7", "3.12.1", "3.13.0", "3.14.8"])
@pytest.mark.parametrize("needed", DIRECT, ids=lambda needed: needed.name)
def test_one_pin_serves_each_direct_dependency(needed: Requirement, python: str) -> None:
    environment: dict[str, Any] = {
        **default_environment(),
        "python_full_version": python,
        "python_version": python.rsplit(".", 1)[0],
    }
    pins = [
        pin
        for pin in PINS
        if pin.name == needed.name and (pin.marker is None or pin.marker.evaluate(environment))
    ]
    assert len(pins) == 1
    (version,) = pins[0].specifier
    assert version.operator == "=="
    assert needed.specifier.contains(version.version)


def test_the_environment_installs_the_package_itself() -> None:
    assert "\n-e .\n" in (ROOT / "environment.txt").read_text("utf-8")


def test_the_moving_picture_is_what_the_package_draws() -> None:
    """If not, tests/motion_picture.py draws it anew."""
    assert motion_picture.PICTURE.read_text("utf-8") == motion_picture.animation().svg
    assert "(notebooks/images/motion.svg)" in README
    kept = json.loads(motion_picture.FINGERPRINTS.read_text("utf-8"))
    assert kept == motion_picture.fingerprints(), "look at these pictures; then draw them anew"

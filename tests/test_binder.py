"""What repo2docker reads from .binder is followed in a fresh environment, and 02 runs in it.

No image is built: repo2docker writes the Dockerfile, and its steps of ours are run here. It lives
in an environment of its own, .venv-binder. REQUIRE_PLACES=1 makes it.
"""

import json
import os
import re
import shutil
from collections.abc import Iterator
from pathlib import Path
from urllib.parse import parse_qs, urlsplit

import pytest
from environments import ROOT, Environment, copy_workbook, run
from packaging.requirements import Requirement

BINDER = Environment(ROOT / ".venv-binder")
READER = BINDER.program("jupyter-repo2docker")
NEEDED = "jupyter-repo2docker==2026.4.0"
PAGE = (ROOT / "docs" / "places.md").read_text("utf-8")
PIP = '${KERNEL_PYTHON_PREFIX}/bin/pip install --no-cache-dir -r "'


def pins() -> dict[str, str]:
    """Return what environment.txt pins for this Python on this system."""
    text = (ROOT / "environment.txt").read_text("utf-8")
    lines = [Requirement(line) for line in re.findall(r"^[\w.-]+==.*$", text, re.MULTILINE)]
    here = [line for line in lines if line.marker is None or line.marker.evaluate()]
    return {line.name: str(line.specifier).removeprefix("==") for line in here}


class Binder:
    """The workbook as Binder has it: a copy, and an environment made by repo2docker's steps."""

    def __init__(self, folder: Path) -> None:
        self.home = copy_workbook(folder / "home")
        self.said = run(READER, "--debug", "--no-build", ".", at=self.home)
        self.environment = Environment(folder / "environment").make()
        copied = self.said.index("COPY --chown=0:0 src/ ")
        for step in re.findall(r"^RUN (.*\.binder/.*)$", self.said[copied:], re.MULTILINE):
            self.follow(step)

    def follow(self, step: str) -> None:
        """Run a step of the Dockerfile; what pip would install, uv may."""
        if step.startswith(PIP):
            self.environment.install("-r", step.removeprefix(PIP).removesuffix('"'), at=self.home)
        else:
            path = f"{self.environment.programs}{os.pathsep}{os.environ['PATH']}"
            run("sh", "-c", step, at=self.home, PATH=path)


def require_binder() -> None:
    """Install Binder's reader if it is asked for; skip where it is neither asked for nor there."""
    if os.environ.get("REQUIRE_PLACES") == "1":
        BINDER.make().install(NEEDED)
    elif not READER.exists():
        pytest.skip(
            f"NOT TESTED as on Binder: there is no {BINDER.folder.name}. To make it: "
            "REQUIRE_PLACES=1 python3 workbook.py test tests/test_binder.py"
        )


@pytest.fixture(scope="module")
def binder(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Binder]:
    require_binder()
    folder = tmp_path_factory.mktemp("binder")
    yield Binder(folder)
    shutil.rmtree(folder)  # half a gigabyte


def test_the_environment_has_exactly_what_is_pinned(binder: Binder) -> None:
    expected = pins()
    assert expected
    installed = binder.environment.versions()
    assert installed.pop("cammotion")
    assert installed == expected


def test_the_python_is_one_that_the_workbook_takes(binder: Binder) -> None:
    (version,) = re.findall(r"conda environment for python=([\d.]+)", binder.said)
    assert f"python-{version}\n" == (ROOT / ".binder" / "runtime.txt").read_text()
    assert tuple(map(int, version.split("."))) >= (3, 11)


def test_jupyter_finds_the_settings_of_the_package(binder: Binder) -> None:
    ours = [path.relative_to(ROOT) for path in (ROOT / "etc").rglob("*.json")]
    assert ours
    for path in ours:
        assert (binder.environment.folder / path).read_bytes() == (ROOT / path).read_bytes()


def test_the_link_opens_a_copy_that_tells_no_result(binder: Binder) -> None:
    (link,) = re.findall(r"https://mybinder\.org/\S+", PAGE)
    (path,) = parse_qs(urlsplit(link).query)["urlpath"]
    opened = path.removeprefix("lab/tree/")
    cells = json.loads((binder.home / opened).read_text("utf-8"))["cells"]
    assert any(cell["cell_type"] == "code" for cell in cells)
    assert not any(cell.get("outputs") for cell in cells)
    lessons = {path.name for path in (ROOT / "notebooks").glob("*.ipynb")}
    assert {path.name for path in (binder.home / opened).parent.glob("*.ipynb")} == lessons


def test_02_runs_there_as_it_is_stored(binder: Binder) -> None:
    options = ("-q", "-p", "no:cacheprovider", "notebooks/02_maximum_acceleration.ipynb")
    said = binder.environment.python("-m", "pytest", *options, at=binder.home)
    assert re.search(r"^\d+ passed", said, re.MULTILINE), said

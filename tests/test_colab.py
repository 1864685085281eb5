"""The install cell for Colab, and 02 after it, with the versions of packages that Colab brings.

Colab's page itself is not here: what it shows of a widget no test of ours sees.
"""

import json
import os
import re
import shutil
import tomllib
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from environments import ROOT, Environment, copy_workbook, run

PAGE = (ROOT / "docs" / "places.md").read_text("utf-8")
ADDRESS = "https://github.com/OWNER/REPOSITORY"
VERSIONS = ROOT / "tests" / "data" / "colab.txt"
# Colab's kernels have imported this; nothing of it is called here.
AS_IN_COLAB = "import sys, types; sys.modules['google.colab'] = types.ModuleType('google.colab')"
WIDGET = "application/vnd.jupyter.widget-view+json"

Cell = dict[str, Any]


def install_cell() -> str:
    (cell,) = re.findall(r"```python\n(!git clone .*?)```", PAGE, re.DOTALL)
    assert ADDRESS in cell
    return str(cell)


def code(number: int, source: str) -> Cell:
    return {
        "cell_type": "code",
        "id": f"first-{number}",
        "metadata": {},
        "execution_count": None,
        "outputs": [],
        "source": source,
    }


class Colab:
    """Notebook 02, run from its install cell on in an environment such as Colab's."""

    def __init__(self, folder: Path) -> None:
        origin = copy_workbook(folder / "origin")
        commit = ["-c", "user.name=nobody", "-c", "user.email=", "commit", "-q", "-m", "A copy"]
        for command in (["init", "-q"], ["add", "--all"], commit):
            run("git", *command, at=origin)
        self.environment = Environment(folder / "environment").make()
        self.environment.install("-r", VERSIONS)
        path = origin / "notebooks" / "02_maximum_acceleration.ipynb"
        notebook = json.loads(path.read_text("utf-8"))
        install = install_cell().replace(ADDRESS, origin.as_uri())
        first = [code(number, text) for number, text in enumerate((AS_IN_COLAB, install, install))]
        notebook["cells"] = first + notebook["cells"]
        opened = folder / "opened.ipynb"
        opened.write_text(json.dumps(notebook), "utf-8")
        home = folder / "home"
        home.mkdir()
        execute = self.environment.program("jupyter-execute")
        own = {"HOME": str(home), "IPYTHONDIR": str(home)}
        run(execute, "--inplace", opened, at=folder, **own)
        cells = json.loads(opened.read_text("utf-8"))["cells"]
        self.cells = [cell for cell in cells if cell["cell_type"] == "code"]

    def shown(self, start: str) -> list[Cell]:
        """Return what the cells show that begin like this."""
        found = [cell for cell in self.cells if "".join(cell["source"]).startswith(start)]
        assert found, start
        return [output for cell in found for output in cell["outputs"]]


@pytest.fixture(scope="module")
def colab(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Colab]:
    if os.environ.get("REQUIRE_PLACES") != "1":
        pytest.skip(
            "NOT TESTED in Colab: that fetches its packages. To do it: "
            "REQUIRE_PLACES=1 python3 workbook.py test tests/test_colab.py"
        )
    folder = tmp_path_factory.mktemp("colab")
    yield Colab(folder)
    shutil.rmtree(folder)  # half a gigabyte


def test_the_cell_says_that_all_is_here_also_when_it_is_run_again(colab: Colab) -> None:
    said = ["".join(output.get("text", "")) for output in colab.shown("!git clone")]
    assert sum("Everything the workbook needs is here." in text for text in said) == 2
    assert any("already exists" in text for text in said)


def test_it_changes_nothing_that_colab_brings(colab: Colab) -> None:
    text = VERSIONS.read_text("utf-8").replace("_", "-")
    brought = dict(re.findall(r"^([\w.-]+)==(.+)$", text, re.MULTILINE))
    installed = colab.environment.versions()
    assert {name: installed[name] for name in brought} == brought


def test_no_cell_fails_and_live_figures_and_questions_are_widgets(colab: Colab) -> None:
    kinds = [output["output_type"] for cell in colab.cells for output in cell["outputs"]]
    assert "error" not in kinds
    for start in ("cm.explore_move(", "cm.choose(", "peak_guess"):
        assert any(WIDGET in output.get("data", {}) for output in colab.shown(start)), start


def test_what_it_installs_is_what_the_package_asks_for() -> None:
    project = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]
    asked = re.findall(r'"([\w.-]+[<>=].*?)"', install_cell())
    assert asked
    assert set(asked) <= set(project["dependencies"])
    brought = set(re.findall(r"^([\w.-]+)==", VERSIONS.read_text("utf-8"), re.MULTILINE))
    names = {re.split(r"[^\w.-]", line)[0] for line in project["dependencies"]}
    assert names <= brought | {re.split(r"[^\w.-]", line)[0] for line in asked}

"""The house stands as it is drawn: who may import whom, and what an import costs."""

import ast
import importlib
import json
import re
import subprocess
import sys
from pathlib import Path

import pytest

import cammotion

ROOT = Path(__file__).parent.parent
PACKAGE = ROOT / "src" / "cammotion"

# Top to bottom: a module imports only what stands above its own line.
FLOORS = [
    {"checks"},
    {"turning"},
    {"laws"},
    {"kinematics"},
    {"arcs"},
    {"segments"},
    {"motions"},
    {"diagram"},
    {"overlap", "tables"},
    {"plots", "setup_check"},
    {"live", "server", "timing_plots"},
    {"animation", "overlap_explorer", "share_explorer"},
]
VIEWS = {"animation", "live", "overlap_explorer", "plots", "share_explorer", "timing_plots"}
VIEW_LIBRARIES = {"matplotlib", "ipywidgets", "anywidget", "drawsvg", "PIL", "IPython"}

MODULES = sorted(path.stem for path in PACKAGE.glob("*.py") if path.stem != "__init__")


def imports(path: Path) -> set[str]:
    """Every module that a file imports, anywhere in it, by its full dotted name."""
    found = set()
    for node in ast.walk(ast.parse(path.read_text("utf-8"))):
        if isinstance(node, ast.Import):
            found |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            assert not node.level, f"{path.name}: relative imports hide where things come from"
            found.add(str(node.module))
    return found


def test_every_module_has_its_floor() -> None:
    assert sorted(set().union(*FLOORS)) == MODULES


@pytest.mark.parametrize("module", MODULES)
def test_imports_run_one_way(module: str) -> None:
    floor = next(n for n, rooms in enumerate(FLOORS) if module in rooms)
    allowed = {f"cammotion.{room}" for rooms in FLOORS[:floor] for room in rooms}
    inside = {name for name in imports(PACKAGE / f"{module}.py") if name.startswith("cammotion")}
    assert inside <= allowed


@pytest.mark.parametrize("module", [name for name in MODULES if name not in VIEWS])
def test_only_views_draw(module: str) -> None:
    libraries = {name.split(".")[0] for name in imports(PACKAGE / f"{module}.py")}
    assert not libraries & VIEW_LIBRARIES


def test_importing_the_package_loads_no_heavy_library() -> None:
    code = "import cammotion, sys, json; print(json.dumps(sorted(sys.modules)))"
    ran = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    loaded = set(json.loads(ran.stdout))
    assert "cammotion" in loaded
    assert not loaded & {"numpy", "sympy", "matplotlib", "ipywidgets", "scipy"}


def test_every_public_name_is_there_and_is_documented() -> None:
    for name in cammotion.__all__:
        thing = getattr(cammotion, name)
        if callable(thing):
            assert thing.__doc__, name


def test_the_notation_table_names_what_exists() -> None:
    """Every code name in notebook 00's table is a public function, or a name of Move or a law."""
    cells = json.loads((ROOT / "notebooks" / "00_start_here.ipynb").read_text("utf-8"))["cells"]
    (table,) = [text for c in cells if "| In code |" in (text := "".join(c["source"]))]
    last_columns = [line.split("|")[-2] for line in table.splitlines() if line.startswith("| $")]
    names = re.findall(r"`([\w.]+)`", " ".join(last_columns))
    assert len(names) > 20
    law = importlib.import_module("cammotion.laws").LAWS["cycloidal"]
    move = cammotion.Move(stroke_mm=50, angle_deg=55, rate_per_hour=2000)
    for name in names:
        holder = law if name.startswith("law.") else move
        last = name.removeprefix("law.")
        assert hasattr(holder, last) or hasattr(cammotion, last), name

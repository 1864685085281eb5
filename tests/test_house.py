"""The house stands as it is drawn: who may import whom, and what an import costs."""

import ast
import dataclasses
import importlib
import json
import re
import subprocess
import sys
from functools import cache
from graphlib import TopologicalSorter
from pathlib import Path

import pytest

import cammotion
import cammotion.exchange

ROOT = Path(__file__).parent.parent
PACKAGE = ROOT / "src" / "cammotion"

MOST_LINES, MOST_LINES_OF_A_FILE = 3000, 300
VIEW_LIBRARIES = {"matplotlib", "mpl_toolkits", "ipywidgets", "anywidget", "drawsvg", "PIL"}


def name_of(path: Path) -> str:
    """Return a module's name within the package, a folder's for its `__init__`."""
    parts = path.relative_to(PACKAGE).with_suffix("").parts
    return ".".join(part for part in parts if part != "__init__")


MODULES = {
    name_of(path): path
    for path in PACKAGE.rglob("*.py")
    if path.parent != PACKAGE or path.stem != "__init__"
}


def room_of(module: str) -> str:
    """Return the room in which a module lives: a folder, or a module beside the folders."""
    return module.split(".")[0]


def declared() -> dict[str, set[str]]:
    """Return what each room may import, as README's table of the rooms says it."""
    text = (ROOT / "README.md").read_text("utf-8")
    _, _, table = text.partition("| Room | What lives there | It may import |")
    rows = [line.split("|")[1:-1] for line in table.split("\n\n")[0].splitlines()[2:]]
    return {
        room: set(re.findall(r"`(\w+)", imported))
        for rooms, _, imported in rows
        for room in re.findall(r"`(\w+)", rooms)
    }


ROOMS = declared()
VIEWS = {"views", "teaching", "site"}


@cache
def imports(path: Path) -> set[str]:
    """Every module that a file imports, anywhere in it, by its full dotted name."""
    found = set()
    for node in ast.walk(ast.parse(path.read_text("utf-8"))):
        if isinstance(node, ast.Import):
            found |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            assert not node.level, f"{path.name}: relative imports hide where things come from"
            base = str(node.module)
            found |= {
                f"{base}.{alias.name}" if is_module(f"{base}.{alias.name}") else base
                for alias in node.names
            }
    return found


def is_module(name: str) -> bool:
    return name.removeprefix("cammotion.") in MODULES and name.startswith("cammotion.")


def own_imports(module: str) -> set[str]:
    """Return the modules of the package that one of them imports."""
    inside = {name for name in imports(MODULES[module]) if name.split(".")[0] == "cammotion"}
    return {name.removeprefix("cammotion.") for name in inside}


def test_every_module_is_in_a_room_of_the_table() -> None:
    assert {room_of(module) for module in MODULES} == set(ROOMS)


def test_the_table_runs_one_way() -> None:
    above: set[str] = set()
    for room, imported in ROOMS.items():
        assert imported <= above, room
        above.add(room)


@pytest.mark.parametrize("module", sorted(MODULES))
def test_a_room_imports_only_what_the_table_says(module: str) -> None:
    room = room_of(module)
    assert {room_of(name) for name in own_imports(module)} <= ROOMS[room] | {room}


def test_no_module_imports_itself_by_a_detour() -> None:
    order = TopologicalSorter({module: own_imports(module) for module in MODULES})
    assert set(order.static_order()) == set(MODULES)


@pytest.mark.parametrize("module", sorted(name for name in MODULES if room_of(name) not in VIEWS))
def test_only_views_draw(module: str) -> None:
    libraries = {name.split(".")[0] for name in imports(MODULES[module])}
    assert not libraries & VIEW_LIBRARIES


def test_importing_the_package_loads_no_heavy_library() -> None:
    code = "import cammotion, sys, json; print(json.dumps(sorted(sys.modules)))"
    ran = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    loaded = set(json.loads(ran.stdout))
    assert "cammotion" in loaded
    assert not loaded & {"numpy", "sympy", "matplotlib", "ipywidgets", "scipy"}


def test_what_a_lesson_loads_is_not_scipy() -> None:
    """A second and 40 MB for each student of a class server: paid by those who solve something."""
    code = (
        "import cammotion, sys; every = [getattr(cammotion, n) for n in cammotion.__all__]; "
        "assert 'sympy' in sys.modules; assert 'scipy' not in sys.modules"
    )
    ran = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert ran.returncode == 0, ran.stderr


def test_the_list_of_names_is_what_is_imported_there() -> None:
    """A checker of types sees the list; what is loaded is what is imported."""
    tree = ast.parse((PACKAGE / "__init__.pyi").read_text("utf-8"))
    imports = [node for node in tree.body if isinstance(node, ast.ImportFrom)]
    (names,) = (ast.literal_eval(node.value) for node in tree.body if isinstance(node, ast.Assign))
    assert sorted(each.name for node in imports for each in node.names) == sorted(names)


def test_every_public_name_is_there_and_is_documented() -> None:
    for name in cammotion.__all__:
        thing = getattr(cammotion, name)
        if callable(thing):
            assert thing.__doc__, name


def test_the_package_introduces_each_value_that_is_public() -> None:
    values = {name for name in cammotion.__all__ if not callable(getattr(cammotion, name))}
    said = (cammotion.__doc__ or "").partition("names are values: ")[2]
    assert values == {*re.findall(r"`(\w+)`", said)}


def test_the_notation_table_names_what_exists() -> None:
    """Every code name in notebook 00's table is public, or a name of a move, a diagram or a law."""
    cells = json.loads((ROOT / "notebooks" / "00_start_here.ipynb").read_text("utf-8"))["cells"]
    (table,) = [text for c in cells if "| In code |" in (text := "".join(c["source"]))]
    last_columns = [line.split("|")[-2] for line in table.splitlines() if line.startswith("| $")]
    names = re.findall(r"`([\w.]+)`", " ".join(last_columns))
    assert len(names) > 20
    law = cammotion.LAWS["cycloidal"]
    move = cammotion.Move(stroke_mm=50, angle_deg=55, rate_per_hour=2000)
    for name in names:
        last = name.removeprefix("law.")
        holders = [law] if name.startswith("law.") else [move, cammotion.TimingDiagram, cammotion]
        assert any(hasattr(holder, last) for holder in holders), name


def test_records_are_frozen() -> None:
    """What a solver has found nobody changes; a record that is hashed stays what it is."""
    records = [
        item
        for name in MODULES
        for item in vars(importlib.import_module(f"cammotion.{name}")).values()
        if isinstance(item, type) and dataclasses.is_dataclass(item)
    ]
    assert len({*records}) >= 20
    loose = [each.__qualname__ for each in records if each.__setattr__ is object.__setattr__]
    assert not loose, "these records can be changed"


def test_the_largest_room_introduces_its_modules() -> None:
    """Who looks for a file format finds it by the words of the room."""
    named = {*re.findall(r"`(\w+)`", cammotion.exchange.__doc__ or "")}
    assert named == {path.stem for path in (PACKAGE / "exchange").glob("[!_]*.py")}


def test_the_small_shared_package_stays_small() -> None:
    """What a lesson leans on is read in an afternoon: laws and machine together."""
    small = [path for name, path in MODULES.items() if room_of(name) in {"laws", "machine"}]
    lines = {path.name: len(path.read_text("utf-8").splitlines()) for path in small}
    assert sum(lines.values()) <= MOST_LINES, "laws and machine: CONTRIBUTING.md says what to do"
    assert max(lines.values()) <= MOST_LINES_OF_A_FILE, max(lines, key=lines.__getitem__)

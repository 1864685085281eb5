"""The command as a user starts it, and the house of the starter behind it."""

import ast
import re
import shutil
from pathlib import Path

import pytest
from small_workbook import LAUNCHER, STARTER, assert_refused, lay_out, run

import starter

FLOORS = re.findall(r"^(\w+)  +\S", starter.__doc__ or "", re.MULTILINE)


@pytest.fixture
def root(tmp_path: Path) -> Path:
    """Lay out a small workbook."""
    return lay_out(tmp_path)


def imported(module: str) -> set[str]:
    """Name the starter's modules that one of them imports."""
    found = set()
    for node in ast.walk(ast.parse((STARTER / f"{module}.py").read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            assert not any(alias.name.startswith("starter") for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            assert not node.level, f"{module}: relative imports hide where things come from"
            package, _, name = (node.module or "").partition(".")
            if package == "starter":
                found |= {name} if name else {alias.name for alias in node.names}
    return found


def test_an_old_python_can_parse_it() -> None:
    """Python 3.6 must come as far as the sentence about its age."""
    ast.parse(LAUNCHER.read_text(encoding="utf-8"), feature_version=(3, 6))


def test_an_old_python_gets_its_sentence_before_any_other_import() -> None:
    """What else is imported may be in newer syntax."""
    body = ast.parse(LAUNCHER.read_text(encoding="utf-8")).body
    kinds = [type(statement).__name__ for statement in body]
    assert kinds == ["Expr", "Import", "If", "Try", "If"]
    assert "This is Python" in ast.unparse(body[2])


@pytest.mark.parametrize("path", [LAUNCHER, *STARTER.glob("*.py")], ids=lambda path: path.name)
def test_messages_are_plain_ascii(path: Path) -> None:
    """A terminal of any encoding can show them."""
    assert path.read_text(encoding="utf-8").isascii()


def test_every_module_is_introduced() -> None:
    """The package's docstring tells a newcomer what is where."""
    assert sorted(FLOORS) == sorted(path.stem for path in STARTER.glob("[!_]*.py"))


@pytest.mark.parametrize("module", FLOORS)
def test_imports_run_one_way(module: str) -> None:
    """A module imports only from those above it in that docstring."""
    assert imported(module) <= set(FLOORS[: FLOORS.index(module)])


@pytest.mark.parametrize("content", [None, b"", b"\xff\xfe"])
def test_an_incomplete_download_is_refused(root: Path, content: bytes | None) -> None:
    """environment.txt missing, empty or unreadable."""
    (root / "environment.txt").unlink()
    if content is not None:
        (root / "environment.txt").write_bytes(content)
    assert_refused(run(root, "setup"), "environment.txt", "Download it again")


def test_a_download_without_the_servers_switch_is_refused(root: Path) -> None:
    """The installation would fail in the words of the build, or leave the switch out."""
    shutil.rmtree(root / "etc")
    assert_refused(run(root, "setup"), "cammotion.json is missing", "Download it again")


@pytest.mark.parametrize("lacking", ["", "lab.py", "commands.py"])
def test_half_a_starter_is_refused(root: Path, lacking: str) -> None:
    """The folder starter, or a file in it, is missing."""
    if lacking:
        (root / "starter" / lacking).unlink()
    else:
        shutil.rmtree(root / "starter")
    assert_refused(run(root), "The folder starter is not whole", "download the workbook again")


def test_a_broken_python_is_not_called_a_broken_download(root: Path) -> None:
    """What Python itself lacks is said by Python."""
    (root / "starter" / "paths.py").write_text("import no_such_module\n")
    result = run(root)
    assert "no_such_module" in result.stderr
    assert "download the workbook again" not in result.stderr


def test_who_stops_it_while_it_loads_sees_no_traceback(root: Path) -> None:
    """A slow disk needs a while for that."""
    (root / "starter" / "paths.py").write_text("raise KeyboardInterrupt\n")
    assert_refused(run(root, "setup"), "Stopped before anything was done.")


def test_an_unknown_number_lists_the_known(root: Path) -> None:
    """The user sees what there is."""
    assert_refused(run(root, "fresh", "77"), "00_start_here, 02_maximum_acceleration")


def test_it_works_from_another_folder(root: Path) -> None:
    """The copy lands in the workbook, wherever the terminal is."""
    result = run(root, "fresh", "02")
    assert result.returncode == 0, result.stderr
    assert (root / "work" / "02_maximum_acceleration-fresh.ipynb").exists()

"""Copies in any folder: the workbook's own may be a shared one that is only to be read."""

import json
import re
import shlex
import shutil
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest
from small_workbook import change, keep, move_starter, raiser

from starter import commands, copies, environment, folder, inspection, lab, paths, processes
from starter.errors import WorkbookError

LINK = re.compile(r"\]\(([^):#]+)\)")


@pytest.fixture
def root(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Work in a small workbook, whose environment is ready, with all that a lesson leans on."""
    monkeypatch.setattr(environment, "ensure", lambda: None)
    root = move_starter(tmp_path / "shared", monkeypatch)
    for name in ("images/cam.svg", "data/cam.csv"):
        (root / "notebooks" / name).parent.mkdir()
        (root / "notebooks" / name).write_text(name)
    return root


@pytest.fixture
def start(capsys: pytest.CaptureFixture[str]) -> Callable[..., list[str]]:
    """Return a function that starts the workbook and returns the lines that it says."""

    def start(*arguments: str) -> list[str]:
        assert commands.run([*arguments]) == 0
        return capsys.readouterr().out.splitlines()

    return start


def test_copies_lie_anywhere_and_the_workbook_stays_as_it_is(
    root: Path, tmp_path: Path, start: Callable[..., list[str]]
) -> None:
    """What is said names the folder, so that it can be typed again; nothing is overwritten."""
    before, mine = keep(root), tmp_path / "home" / "my cäm"
    option = f'--work "{mine}"'
    copied, ready = start("setup", "--work", str(mine))
    assert copied == f"Copied all 2 notebooks to {mine}/, which is yours to write in."
    assert ready.endswith(f" {option}")
    assert sorted(path.name for path in mine.iterdir()) == [
        *("00_start_here.ipynb", "02_maximum_acceleration.ipynb", "data", "notebooks")
    ]
    assert (mine / "notebooks" / "images" / "cam.svg").read_text() == "images/cam.svg"
    assert (mine / "data" / "cam.csv").read_text() == "data/cam.csv"
    assert keep(root) == before
    copy = mine / "02_maximum_acceleration.ipynb"
    change(copy, "my answer")
    (mine / "data" / "cam.csv").write_text("mine")
    change(root / "notebooks" / copy.name, "better")
    laid = keep(mine)
    news, _ready = start("setup", "--work", str(mine))
    assert "Yours is untouched" in news
    command = news.split("`")[1]
    assert command.endswith(f" fresh 02 {option}")
    fresh = mine / "02_maximum_acceleration-fresh.ipynb"
    assert start(*shlex.split(command)[2:]) == [f"A fresh copy: {fresh}"]
    assert laid.items() <= keep(mine).items()
    assert set(keep(mine)) - set(laid) == {fresh.name}


def test_every_link_of_the_real_notebooks_leads_on_from_elsewhere(tmp_path: Path) -> None:
    """Pictures, solutions, and from a solution back to the learner's own copy."""
    copies.lay_missing(tmp_path)
    laid = list(tmp_path.rglob("*.ipynb"))
    assert {path.parent for path in laid} == {tmp_path, tmp_path / "notebooks" / "solutions"}
    found = set()
    for path in laid:
        for cell in json.loads(path.read_text("utf-8"))["cells"]:
            if cell["cell_type"] == "markdown":
                for link in LINK.findall("".join(cell["source"])):
                    assert (path.parent / link).is_file(), (path.name, link)
                    assert (path.parent / link).resolve().is_relative_to(tmp_path)
                    found.add(Path(link).suffix)
    assert found == {".ipynb", ".svg"}


@pytest.mark.parametrize("wanted", ["work-anna", "my cäm", "~/my cäm", "~/cam-class"])
def test_the_commands_of_copies_ask_for_their_folder(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, wanted: str
) -> None:
    """Those of notebooks 00 and 12 can be typed as they stand, a path with a space too.

    One in the home is named from there: a class gets these copies, in homes of its own.
    """
    for variable in ("HOME", "USERPROFILE"):
        monkeypatch.setenv(variable, str(tmp_path / "home"))
    work = tmp_path / wanted if wanted == "my cäm" else folder.path_of(wanted)
    told = "".join(
        "".join(cell["source"])
        for path in paths.NOTEBOOKS.glob("[01][02]_*.ipynb")
        for cell in copies.copy_of(path, work)["cells"]
        if cell["cell_type"] == "markdown"
    )
    typed = [shlex.split(words)[2:] for words in re.findall(r"`(python3 workbook[^`]+)`", told)]
    name = folder.shown(work)
    assert sorted(typed) == [
        ["--work", name],
        ["class", "FOLDER"],
        ["fresh", "02", "--work", name],
        ["report", f"{name}/data/pad_press.csv", "--work", name],
    ]
    assert f"your own copies, in the folder `{name}`" in told
    assert "`work`" not in told
    assert (str(tmp_path) in told) is (wanted == "my cäm")


@pytest.mark.usefixtures("root")
def test_what_is_closed_repeats_the_command(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr("os.access", lambda *_: False)
    for given in ("", " setup", " fresh 02", ' report "my press.csv"'):
        assert commands.run(shlex.split(given)) == 1
        assert f"example: {paths.START}{given} --work ~/cam\n" in capsys.readouterr().err


def test_a_name_is_in_the_workbook_and_all_else_is_a_path(
    root: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A path is from where the user is; what leads back into the workbook is a name there."""
    home, here = tmp_path / "home", tmp_path / "here"
    here.mkdir()
    monkeypatch.chdir(here)
    for name in ("HOME", "USERPROFILE"):
        monkeypatch.setenv(name, str(home))
    for wanted, path in {
        "work": root / "work",
        "work-anna": root / "work-anna",
        "~/cam": home / "cam",
        "./cam": here / "cam",
        "../cam/": tmp_path / "cam",
        ".": here,
        str(tmp_path / "a" / "b"): tmp_path / "a" / "b",
        str(root / "work-bert"): root / "work-bert",
    }.items():
        assert folder.find(wanted) == path
        assert path.is_dir()
        assert folder.is_inside(path) == path.name.startswith("work")


@pytest.mark.skipif(sys.platform == "win32", reason="links need rights")
def test_a_link_into_the_workbook_leads_into_it(root: Path, tmp_path: Path) -> None:
    """No other folder can be made there by a detour."""
    (tmp_path / "link").symlink_to(root)
    assert folder.find(str(tmp_path / "link" / "work-anna")) == root / "work-anna"
    with pytest.raises(WorkbookError, match="outside of the workbook"):
        folder.find(str(tmp_path / "link" / "anna"))


def test_the_lab_shows_the_folder_of_the_copies_and_nothing_else(
    root: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, start: Callable[..., list[str]]
) -> None:
    """In the workbook it shows all of it, as solutions and pictures are there."""
    seen = []

    def note(*arguments: object) -> "subprocess.Popen[str]":
        seen.append(arguments[2])
        return subprocess.Popen([sys.executable, "-c", ""], text=True)

    monkeypatch.setattr(lab, "start", note)
    mine = tmp_path / "my cäm"
    pages = [
        next(line for line in start("--no-browser", "--work", work) if "ready: " in line)
        for work in ("work", str(mine))
    ]
    assert seen == [root, mine]
    opened = [page.split("/lab/tree/")[1] for page in pages]
    assert opened[0].startswith("work/00_start_here.ipynb?")
    assert opened[1].startswith("00_start_here.ipynb?")
    assert f"--ServerApp.root_dir={mine}" in lab.command(8888, mine, [])


# Run what follows while the folder $1 is only to be read.
ONLY_TO_BE_READ = """
mount --bind "$1" "$1" && mount -o remount,bind,ro "$1" && shift && exec "$@"
"""
START = """
import sys
sys.path.insert(0, sys.argv[1])
from starter import commands, environment
if sys.argv[2] == "ready":
    environment.ensure = lambda: None
sys.exit(commands.run(["setup", *sys.argv[3:]]))
"""
UNSHARE = ["unshare", "-Urm", "sh", "-c", ONLY_TO_BE_READ, "sh"]


def start_shared(root: Path, *arguments: str) -> "subprocess.CompletedProcess[str]":
    """Start a small workbook that is only to be read, its environment ready or not."""
    python = [sys.executable, "-P", "-c", START, str(root), *arguments]
    return subprocess.run(
        [*UNSHARE, str(root), *python], capture_output=True, text=True, check=False
    )


def can_bind() -> bool:
    """Tell whether we may make a folder that is only to be read, for ourselves alone."""
    unshare = shutil.which("unshare") if sys.platform == "linux" else None
    command = [str(unshare), "-Urm", "mount", "--bind", "/tmp", "/tmp"]  # noqa: S108
    return unshare is not None and subprocess.run(command, check=False).returncode == 0


@pytest.mark.skipif(not can_bind(), reason="no folder can be made here that is only to be read")
def test_a_shared_folder_that_is_only_to_be_read(root: Path, tmp_path: Path) -> None:
    """The learner works elsewhere; without that, or without an environment, it is said."""
    mine = tmp_path / "home"
    (root / ".venv").mkdir()
    well = start_shared(root, "ready", "--work", str(mine))
    assert (well.returncode, well.stderr) == (0, "")
    assert (mine / "00_start_here.ipynb").is_file()
    refused = start_shared(root, "ready")
    assert refused.returncode == 1
    assert refused.stderr == (
        f"You may not write in {root / 'work'}: give the path of a folder of your own for your "
        f"copies, for example: {paths.START} setup --work ~/cam\n"
    )
    bare = start_shared(root, "bare", "--work", str(mine))
    assert bare.returncode == 1
    assert "is not ready (its installation was not completed), and you may not" in bare.stderr
    assert f"has to run `{paths.START} setup` there" in bare.stderr


def test_an_environment_is_not_made_where_one_may_not_write(
    root: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Its reason is said, and nothing is tried."""
    monkeypatch.undo()
    move_starter(root.parent.parent / "closed", monkeypatch)
    monkeypatch.setattr(inspection, "judge", lambda _: ("changed", "environment.txt changed"))
    monkeypatch.setattr("os.access", lambda *_: False)
    monkeypatch.setattr(processes, "only_one_in", raiser(AssertionError("nothing is tried")))
    with pytest.raises(WorkbookError, match=r"not ready \(environment.txt changed\).* setup`"):
        environment.ensure()

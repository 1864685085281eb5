"""The launcher: set-up decisions, the learner's copies, ports, and a sentence for each failure."""

import ast
import errno
import importlib
import importlib.util
import json
import os
import shutil
import signal
import socket
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any, NoReturn

import pytest

REPOSITORY = Path(__file__).resolve().parent.parent


def notebook(*sources: str, **output: Any) -> dict[str, Any]:
    """Make a notebook of code cells."""
    cells: list[dict[str, Any]] = [
        {
            "cell_type": "code",
            "id": f"cell-{number}",
            "metadata": {},
            "execution_count": None,
            "outputs": [output] if output else [],
            "source": [source],
        }
        for number, source in enumerate(sources)
    ]
    return {"cells": cells, "metadata": {}, "nbformat": 4, "nbformat_minor": 5}


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """Lay out a small workbook in a folder with a space and an umlaut in its name."""
    root = tmp_path / "wörk book"
    (root / "src" / "cammotion").mkdir(parents=True)
    (root / "notebooks").mkdir()
    shutil.copy(REPOSITORY / "workbook.py", root)
    shutil.copytree(REPOSITORY / "starter", root / "starter")
    (root / "environment.txt").write_text("-e .\nno-such-package==1.0\n")
    (root / "pyproject.toml").write_text("[project]\nname = 'cammotion'\nversion = '0'\n")
    for name in ("00_start_here", "02_maximum_acceleration"):
        (root / "notebooks" / f"{name}.ipynb").write_text(json.dumps(notebook(name)))
    return root


@pytest.fixture
def starter(folder: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Any]:
    """Load the small workbook's own starter, with all its modules."""
    before, handler = dict(sys.modules), signal.getsignal(signal.SIGTERM)
    monkeypatch.syspath_prepend(folder)
    for name in [name for name in sys.modules if name.split(".")[0] == "starter"]:
        del sys.modules[name]
    importlib.import_module("starter.commands")
    yield sys.modules["starter"]
    for name in [name for name in sys.modules if name.split(".")[0] == "starter"]:
        del sys.modules[name]
    sys.modules.update({name: before[name] for name in before if name.startswith("starter")})
    signal.signal(signal.SIGTERM, handler)


def change(path: Path, source: str) -> None:
    """Change the first cell of a notebook and nothing else."""
    content = json.loads(path.read_text())
    content["cells"][0]["source"] = [source]
    path.write_text(json.dumps(content))


def run(folder: Path, *arguments: str, **environment: str) -> subprocess.CompletedProcess[str]:
    """Start the launcher as a user would, from another folder."""
    return subprocess.run(
        [sys.executable, str(folder / "workbook.py"), *arguments],
        cwd="/",
        env={**os.environ, **environment},
        capture_output=True,
        encoding="utf-8",
        timeout=60,
        check=False,
    )


def assert_refused(result: subprocess.CompletedProcess[str], *words: str) -> None:
    """Check that a run failed with a sentence and without a traceback."""
    assert result.returncode != 0
    assert "Traceback" not in result.stderr
    for word in words:
        assert word in result.stderr


def raiser(error: BaseException) -> Callable[..., NoReturn]:
    """Make a function that raises."""

    def fail(*_arguments: object, **_options: object) -> NoReturn:
        raise error

    return fail


def environment(starter: Any, **changes: Any) -> Any:
    """Describe a sound environment, but for the changes."""
    sound = starter.inspection.Environment(
        files={"environment.txt": "a"},
        python="3.11",
        prefix="/here/.venv",
        package="/here/src/cammotion",
        versions={"numpy": "2.4.6", "six": "1.17.0"},
    )
    return sound._replace(**changes)


def test_an_old_python_can_parse_it() -> None:
    """Python 3.6 must come as far as the sentence about its age."""
    ast.parse((REPOSITORY / "workbook.py").read_text("utf-8"), feature_version=(3, 6))


def test_messages_are_plain_ascii() -> None:
    """A terminal of any encoding can show them."""
    for path in (REPOSITORY / "workbook.py", *(REPOSITORY / "starter").glob("*.py")):
        assert path.read_text("utf-8").isascii(), path.name


@pytest.mark.parametrize(
    ("changes", "state", "reason"),
    [
        ({}, "ready", ""),
        ({"versions": {"numpy": "2.4.6", "six": "1.17.0", "own": "1"}}, "ready", ""),
        ({"versions": {"numpy": "2.4.6"}}, "changed", "six is missing"),
        (
            {"versions": {"numpy": "2.5.5", "six": "1.17.0"}},
            "changed",
            "numpy is 2.5.5 instead of 2.4.6",
        ),
        ({"files": {"environment.txt": "new"}}, "changed", "environment.txt changed"),
        ({"python": "3.12"}, "broken", "3.12"),
        ({"prefix": "/there/.venv"}, "broken", "moved"),
        ({"package": ""}, "broken", "moved"),
    ],
)
def test_the_environment_is_judged(
    starter: Any, changes: dict[str, Any], state: str, reason: str
) -> None:
    """Each difference between environment and stamp has its verdict."""
    verdict = starter.inspection.compare(environment(starter), environment(starter, **changes))
    assert verdict[0] == state
    assert reason in verdict[1]


def test_without_stamp_or_python_it_is_broken(starter: Any) -> None:
    """A half-made environment is not trusted."""
    assert starter.inspection.compare(None, environment(starter))[0] == "broken"
    assert starter.inspection.compare(environment(starter), None)[0] == "broken"
    assert starter.inspection.judge()[0] == "missing"
    starter.paths.VENV.mkdir()
    starter.inspection.STAMP.write_text('{"files": ')
    assert starter.inspection.judge()[0] == "broken"


def test_a_foreign_environment_is_kept_aside(
    starter: Any, capsys: pytest.CaptureFixture[str]
) -> None:
    """What the user made by hand is renamed, what the launcher made is removed."""
    for name in (".venv-old", ".venv-old-2"):
        starter.paths.VENV.mkdir()
        (starter.paths.VENV / "mine.txt").write_text("mine")
        starter.environment.clear_the_way()
        assert (starter.paths.ROOT / name / "mine.txt").exists()
        assert f"kept as {name}." in capsys.readouterr().out
    starter.paths.VENV.mkdir()
    starter.environment.MARKER.touch()
    starter.environment.clear_the_way()
    assert not starter.paths.VENV.exists()
    assert not (starter.paths.ROOT / ".venv-old-3").exists()


@pytest.mark.parametrize("error", [OSError(errno.ENOSPC, "full"), KeyboardInterrupt()])
def test_nothing_half_made_stays(
    starter: Any, monkeypatch: pytest.MonkeyPatch, error: BaseException
) -> None:
    """A new environment that cannot be completed is removed."""
    monkeypatch.setattr(starter.environment, "create", starter.paths.VENV.mkdir)
    monkeypatch.setattr(starter.installer, "install_packages", raiser(error))
    with pytest.raises(type(error)):
        starter.environment.ensure()
    assert not starter.paths.VENV.exists()


def test_an_update_that_touched_nothing_leaves_the_stamp(
    starter: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Without network the environment stays good for the next start; half-updated it does not."""
    starter.paths.VENV.mkdir()
    monkeypatch.setattr(
        starter.installer, "install_packages", raiser(starter.errors.WorkbookError("no network"))
    )
    for versions, kept in (({"numpy": "2.4.6", "six": "1.17.0"}, True), ({"six": "1.17.0"}, False)):
        starter.inspection.write_stamp(environment(starter))
        now = environment(starter, versions=versions)
        monkeypatch.setattr(starter.inspection, "inspect", lambda now=now: now)
        with pytest.raises(starter.errors.WorkbookError):
            starter.environment.update("environment.txt changed")
        assert starter.inspection.STAMP.exists() == kept


@pytest.mark.parametrize(
    ("output", "words"),
    [
        ("OSError: [Errno 28] No space left on device", "disk is full"),
        ("failed to copy: No space left on device (os error 28)", "disk is full"),
        ("Failed to establish a new connection: [Errno 111] Connection refused", "no connection"),
        ("[Errno -3] Temporary failure in name resolution", "no connection"),
        ("Cannot connect to proxy. ERROR: No matching distribution found", "no connection"),
        ("cause: dns error", "no connection"),
        ("ERROR: No matching distribution found for numpy==2.4.6", "3.11, 3.12 and 3.13"),
        ("Because numpy has no wheels: No solution found when resolving", "3.11, 3.12 and 3.13"),
        ("something else", "lines above"),
    ],
)
def test_installers_are_understood(starter: Any, output: str, words: str) -> None:
    """What pip and uv say is put into a sentence."""
    assert words in starter.installer.explain(output)


def test_progress_is_read_from_pip(starter: Any) -> None:
    """The line says how many packages, and which is the latest."""
    lines = ["Looking in indexes\n"]
    assert starter.installer.describe_progress(lines, 0, 9) == "looking for packages"
    lines += ["Collecting anyio==4.16.0 (from -r x)\n", "Processing ./files/arrow-1.4.0-py3.whl\n"]
    assert starter.installer.describe_progress(lines, 0, 9) == "fetched 2 of 9: arrow"
    assert starter.installer.describe_progress(lines, 5, 9) == "installed 5 of 9"


def test_a_failing_installer_shows_its_last_lines(starter: Any) -> None:
    """The reader sees what went wrong and where the rest is."""
    script = "print('Collecting six'); print('Connection refused'); raise SystemExit(3)"
    with pytest.raises(starter.errors.WorkbookError) as caught:
        starter.installer.run([sys.executable, "-c", script], lambda _lines: "")
    text = str(caught.value)
    assert "    Connection refused\n" in text
    assert "no connection" in text
    log = Path(text.split("said: ")[1].splitlines()[0])
    assert "Collecting six" in log.read_text()
    log.unlink()


@pytest.mark.parametrize("name", ["venv", "ensurepip"])
def test_a_python_without_its_modules_is_refused(
    starter: Any, monkeypatch: pytest.MonkeyPatch, name: str
) -> None:
    """Debian splits them off; nothing is made before that is known."""
    found = importlib.util.find_spec
    monkeypatch.setattr(
        importlib.util, "find_spec", lambda wanted: None if wanted == name else found(wanted)
    )
    monkeypatch.setattr(shutil, "which", lambda _command: None)
    with pytest.raises(
        starter.errors.WorkbookError, match=r"apt install python3\.\d+-venv(.|\n)*uv"
    ):
        starter.environment.ensure()
    assert not starter.paths.VENV.exists()


def test_too_small_a_disk_is_refused(starter: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    """The free space is looked at before anything is made."""
    monkeypatch.setattr(starter.environment, "MB_FOR_NEW", 10**9)
    with pytest.raises(starter.errors.WorkbookError, match="MB are free"):
        starter.environment.ensure()
    assert not starter.paths.VENV.exists()


@pytest.mark.parametrize(
    ("error", "words"),
    [
        (OSError(errno.ENOSPC, "full"), "disk is full"),
        (PermissionError(errno.EACCES, "no", "/x/work"), "No permission to write /x/work"),
        (OSError(errno.EROFS, "read-only", "/x"), "No permission to write /x"),
        (OSError(errno.EIO, "input/output error"), "refused"),
    ],
)
def test_what_the_system_refuses_is_said_in_words(
    starter: Any,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
    error: OSError,
    words: str,
) -> None:
    """Errors of the operating system end in a sentence and an exit code."""
    monkeypatch.setattr(starter.copies, "work_folder", raiser(error))
    assert starter.commands.main(["setup"]) == 1
    assert words in capsys.readouterr().err


@pytest.mark.parametrize("content", [None, b"", b"\xff\xfe"])
def test_an_incomplete_download_is_refused(folder: Path, content: bytes | None) -> None:
    """environment.txt missing, empty or unreadable."""
    (folder / "environment.txt").unlink()
    if content is not None:
        (folder / "environment.txt").write_bytes(content)
    assert_refused(run(folder, "setup"), "environment.txt", "Download it again")


def test_no_network_takes_seconds(folder: Path) -> None:
    """A real pip without a package index: a sentence, and nothing half-made."""
    (folder / "environment.txt").write_text("no-such-package==1.0\n")
    with socket.socket() as closed:
        closed.bind(("127.0.0.1", 0))
        index = f"http://127.0.0.1:{closed.getsockname()[1]}/simple"
        started = time.monotonic()
        result = run(
            folder,
            "setup",
            PATH="",
            PIP_INDEX_URL=index,
            PIP_FIND_LINKS="",
            PIP_EXTRA_INDEX_URL="",
            PIP_CONFIG_FILE=os.devnull,
            PIP_RETRIES="1",
        )
    assert_refused(result, "no connection to the package index", "start again")
    assert "[2/3] Installing" in result.stdout
    assert not (folder / ".venv").exists()
    assert time.monotonic() - started < 30
    Path(result.stderr.split("said: ")[1].splitlines()[0]).unlink()


def test_copies_survive_edits_and_updates(starter: Any) -> None:
    """The learner's files keep every byte; news are said, and new notebooks are laid."""
    work = starter.copies.work_folder("work-anna")
    starter.copies.lay_missing(work)
    assert not starter.copies.notices(work)
    copy = work / "02_maximum_acceleration.ipynb"
    change(copy, "my answer")
    assert not starter.copies.notices(work)
    change(starter.paths.NOTEBOOKS / copy.name, "better")
    (starter.paths.NOTEBOOKS / "03_overlap.ipynb").write_text(json.dumps(notebook("new")))
    before = {path: path.read_bytes() for path in work.iterdir()}
    starter.copies.lay_missing(work)
    assert {path: path.read_bytes() for path in before} == before
    assert (work / "03_overlap.ipynb").exists()
    (notice,) = starter.copies.notices(work)
    assert notice.startswith("02_maximum_acceleration: the workbook has a newer version")
    assert "fresh 02 --work work-anna" in notice


def test_new_outputs_are_no_new_version(starter: Any) -> None:
    """Only the cells' types and sources count."""
    work = starter.copies.work_folder("work")
    starter.copies.lay_missing(work)
    content = notebook("02_maximum_acceleration", output_type="stream", name="stdout", text="4")
    (starter.paths.NOTEBOOKS / "02_maximum_acceleration.ipynb").write_text(json.dumps(content))
    assert not starter.copies.notices(work)


def test_a_fresh_copy_ends_the_notices(starter: Any, capsys: pytest.CaptureFixture[str]) -> None:
    """`fresh` numbers its copies; any copy with the current version will do."""
    starter.copies.lay_missing(starter.copies.work_folder("work"))
    change(starter.paths.NOTEBOOKS / "02_maximum_acceleration.ipynb", "better")
    for wanted, ending in (
        ("02", "-fresh"),
        ("2", "-fresh-2"),
        ("02_maximum_acceleration", "-fresh-3"),
    ):
        assert starter.commands.main(["fresh", wanted]) == 0
        path = Path("work") / f"02_maximum_acceleration{ending}.ipynb"
        assert str(path) in capsys.readouterr().out
        assert (starter.paths.ROOT / path).exists()
    assert not starter.copies.notices(starter.paths.ROOT / "work")


def test_an_unknown_number_lists_the_known(folder: Path) -> None:
    """The user sees what there is."""
    assert_refused(run(folder, "fresh", "77"), "00_start_here, 02_maximum_acceleration")


def test_strange_copies_are_left_alone(starter: Any) -> None:
    """Unreadable, renamed upstream, or without a note: said in words, not touched."""
    work = starter.copies.work_folder("work")
    starter.copies.lay_missing(work)
    (work / "00_start_here.ipynb").write_text('{"cells": [')
    (work / "02_maximum_acceleration.ipynb").write_text(json.dumps(notebook("my own")))
    (work / "notes.ipynb").write_text(json.dumps(notebook("not of the workbook")))
    (starter.paths.NOTEBOOKS / "01_old.ipynb").write_text(json.dumps(notebook("old")))
    starter.copies.lay_missing(work)
    (starter.paths.NOTEBOOKS / "01_old.ipynb").unlink()
    before = {path: path.read_bytes() for path in work.iterdir()}
    starter.copies.lay_missing(work)
    assert {path: path.read_bytes() for path in work.iterdir()} == before
    unreadable, gone, silent = starter.copies.notices(work)
    assert unreadable.startswith("00_start_here: your copy is not readable")
    assert gone.startswith("01_old: is no longer part of the workbook")
    assert "does not tell its version" in silent


def test_a_killed_start_leaves_no_half_copy(starter: Any) -> None:
    """Killed while it writes, it leaves at most a part file, which the next start removes."""
    work = starter.copies.work_folder("work")
    script = (
        "import os, signal, sys; sys.path.insert(0, sys.argv[1])\n"
        "from starter import copies\n"
        "os.fsync = lambda _: os.kill(os.getpid(), signal.SIGKILL)\n"
        "copies.lay_missing(copies.work_folder('work'))"
    )
    killed = subprocess.run([sys.executable, "-c", script, str(starter.paths.ROOT)], check=False)
    assert killed.returncode == -signal.SIGKILL
    assert [path.name for path in work.iterdir()] == [".00_start_here.ipynb.part"]
    starter.copies.lay_missing(work)
    assert sorted(path.name for path in work.iterdir()) == [
        "00_start_here.ipynb",
        "02_maximum_acceleration.ipynb",
    ]


def test_a_full_disk_leaves_no_half_copy(starter: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    """Nothing stays under the real name, nor under the temporary one."""
    work = starter.copies.work_folder("work")
    monkeypatch.setattr(os, "fsync", raiser(OSError(errno.ENOSPC, "full")))
    with pytest.raises(OSError, match="full"):
        starter.copies.lay_missing(work)
    assert not list(work.iterdir())


@pytest.mark.parametrize("links", [True, False])
def test_a_taken_name_is_not_overwritten(
    starter: Any, monkeypatch: pytest.MonkeyPatch, links: bool
) -> None:
    """Not even by a start that did not see the file come, with and without hard links."""
    if not links:
        monkeypatch.setattr(os, "link", raiser(OSError(errno.EPERM, "no links")))
    source, work = starter.notebooks.originals()[0], starter.copies.work_folder("work")
    taken, free = work / "taken.ipynb", work / "free.ipynb"
    taken.write_text("mine")
    starter.copies.lay(source, taken)
    starter.copies.lay(source, free)
    assert taken.read_text() == "mine"
    assert json.loads(free.read_text())["metadata"]["workbook"]["source"] == source.name
    assert sorted(path.name for path in work.iterdir()) == ["free.ipynb", "taken.ipynb"]


@pytest.mark.parametrize("name", ["workbook.py", "notebooks", "work/x", "../work", "work x", ""])
def test_other_folders_are_refused(starter: Any, name: str) -> None:
    """Only what .gitignore keeps out of commits can hold the learner's copies."""
    with pytest.raises(starter.errors.WorkbookError, match="work-anna"):
        starter.copies.work_folder(name)


def test_a_busy_port_is_avoided_or_refused(
    starter: Any, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """The default port gives way in words; a port that was asked for does not."""
    with socket.socket() as busy:
        busy.bind(("127.0.0.1", 0))
        busy.listen()
        port = busy.getsockname()[1]
        monkeypatch.setattr(starter.lab, "DEFAULT_PORT", port)
        assert starter.lab.choose_port(None) > port
        assert f"Port {port} is in use" in capsys.readouterr().out
        with pytest.raises(starter.errors.WorkbookError, match=f"Port {port} is in use"):
            starter.lab.choose_port(port)
    assert starter.lab.choose_port(port) == port


@pytest.mark.parametrize("port", ["0", "65536", "-1", "x"])
def test_impossible_ports_are_refused(folder: Path, port: str) -> None:
    """The sentence names the range."""
    assert_refused(run(folder, f"--port={port}"), "1 to 65535")


def test_arguments_are_passed_on(starter: Any) -> None:
    """To pytest as they are, to JupyterLab what follows two dashes; lab is the default."""
    assert starter.commands.parse(["test", "-k", "laws"]).passed_on == ["-k", "laws"]
    options = starter.commands.parse(["--no-browser", "--", "--debug"])
    assert (options.command, options.no_browser, options.passed_on) == ("lab", True, ["--debug"])
    assert starter.commands.parse([]).work == "work"


@pytest.mark.parametrize(
    ("variables", "words"),
    [
        ({"SSH_CONNECTION": "a 1 b 22", "DISPLAY": ":0"}, "SSH"),
        ({"DISPLAY": ":0"}, ""),
        ({"WAYLAND_DISPLAY": "wayland-0"}, ""),
        pytest.param(
            {},
            "no screen",
            marks=pytest.mark.skipif(sys.platform != "linux", reason="X11, Wayland"),
        ),
    ],
)
def test_a_browser_is_opened_where_there_is_one(
    starter: Any, monkeypatch: pytest.MonkeyPatch, variables: dict[str, str], words: str
) -> None:
    """Not over SSH and not without a screen, and this is said."""
    for name in ("SSH_CONNECTION", "DISPLAY", "WAYLAND_DISPLAY"):
        monkeypatch.delenv(name, raising=False)
    for name, value in variables.items():
        monkeypatch.setenv(name, value)
    obstacle = starter.browser.find_obstacle(no_browser=False)
    assert words in obstacle if words else not obstacle


@pytest.fixture
def with_this_python(starter: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    """Let the launcher use the environment that runs the tests."""
    for module in (starter.lab, starter.refresh):
        monkeypatch.setattr(module, "VENV_PYTHON", Path(sys.executable))
    monkeypatch.setattr(starter.environment, "ensure", lambda: None)


@pytest.mark.usefixtures("with_this_python")
def test_the_lab_opens_and_ends(starter: Any) -> None:
    """It answers with its token, not without, and is gone after its end."""
    with socket.socket() as chosen:
        chosen.bind(("127.0.0.1", 0))
        port = chosen.getsockname()[1]
    process = starter.lab.start(port, "right", [])
    try:
        assert starter.lab.answers(port, "right")
        assert not starter.lab.answers(port, "wrong")
    finally:
        starter.processes.stop(process)
    assert starter.lab.is_free(port)


def test_a_lab_that_dies_shows_its_last_words(
    starter: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A start that fails does not hang."""
    dying = [sys.executable, "-c", "raise SystemExit('no such option')"]
    monkeypatch.setattr(starter.lab, "command", lambda _port, _passed_on: dying)
    with pytest.raises(
        starter.errors.WorkbookError, match=r"no such option\n.*before it was ready"
    ):
        starter.lab.start(8888, "token", [])


@pytest.mark.usefixtures("with_this_python")
def test_refresh_is_repeatable(starter: Any) -> None:
    """Twice the same bytes, without a trace of when and where."""
    path = starter.notebooks.originals()[0]
    slider = "import ipywidgets\nipywidgets.IntSlider()"
    prints = "print(1, flush=True)\nprint(2, flush=True)"
    path.write_text(json.dumps(notebook(prints, slider)))
    assert starter.commands.main(["refresh", "0"]) == 0
    once = path.read_bytes()
    content = json.loads(once)
    assert content["metadata"] == starter.refresh.NOTEBOOK_METADATA
    assert [cell["execution_count"] for cell in content["cells"]] == [1, 2]
    assert [cell["id"] for cell in content["cells"]] == ["cell-0", "cell-1"]
    assert [output["text"] for output in content["cells"][0]["outputs"]] == [["1\n", "2\n"]]
    assert content["cells"][1]["outputs"][0]["data"].keys() == {"text/plain"}
    assert starter.commands.main(["refresh", "0"]) == 0
    assert path.read_bytes() == once


@pytest.mark.usefixtures("with_this_python")
def test_refresh_replaces_all_or_nothing(
    starter: Any, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """If the second notebook fails, the first is not replaced either."""
    failure = starter.errors.WorkbookError("cell 2 raised ZeroDivisionError")
    results = iter([lambda: notebook("new"), raiser(failure)])
    monkeypatch.setattr(starter.refresh, "execute", lambda _path, _folder: next(results)())
    before = [path.read_bytes() for path in starter.notebooks.originals()]
    assert starter.commands.main(["refresh"]) == 1
    assert "cell 2 raised ZeroDivisionError" in capsys.readouterr().err
    assert [path.read_bytes() for path in starter.notebooks.originals()] == before


def test_the_failing_cell_is_named(starter: Any) -> None:
    """An error that a cell announces by its tag is none."""
    content = notebook("1 / 0", output_type="error", ename="ZeroDivisionError", evalue="by zero")
    assert starter.refresh.first_error(content) == "cell 1 raised ZeroDivisionError: by zero"
    content["cells"][0]["metadata"]["tags"] = ["raises-exception"]
    assert not starter.refresh.first_error(content)

"""The command line: what it reads, and that every foreseen failure ends in a sentence."""

import errno
import subprocess
import sys
from contextlib import nullcontext
from pathlib import Path
from typing import Any

import pytest
from small_workbook import move_starter, raiser

from starter import commands, environment, folder, maintain


@pytest.fixture(autouse=True)
def root(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Work in a small workbook."""
    return move_starter(tmp_path, monkeypatch)


@pytest.mark.parametrize(
    ("error", "words"),
    [
        (OSError(errno.ENOSPC, "full"), "disk is full"),
        (PermissionError(errno.EACCES, "no", "/x/work"), f"to write {Path('/x/work')}. "),
        (OSError(errno.EROFS, "read-only", "/x/.name.part"), f"write {Path('/x')}. "),
        (OSError(errno.EROFS, "read-only", "/x"), f"No permission to write {Path('/x')}. "),
        (OSError(errno.EIO, "input/output error"), "refused"),
        (OSError(errno.ENAMETOOLONG, "File name too long", "/x"), "short path"),
        (OSError(errno.EINVAL, "[WinError 1260] blocked"), "group policy"),
    ],
)
def test_what_the_system_refuses_is_said_in_words(
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
    error: OSError,
    words: str,
) -> None:
    """Errors of the operating system end in a sentence and an exit code."""
    monkeypatch.setattr(folder, "find", raiser(error))
    assert commands.run(["setup"]) == 1
    assert words in capsys.readouterr().err


@pytest.mark.parametrize("port", ["0", "65536", "-1", "x"])
def test_impossible_ports_are_refused(port: str, capsys: pytest.CaptureFixture[str]) -> None:
    """The sentence names the range."""
    with pytest.raises(SystemExit):
        commands.run([f"--port={port}"])
    assert "1 to 65535" in capsys.readouterr().err


def test_arguments_are_passed_on() -> None:
    """To pytest as they are, to JupyterLab what follows two dashes; lab is the default."""
    assert commands.parse(["test", "-k", "laws"]).passed_on == ["-k", "laws"]
    options = commands.parse(["--no-browser", "--", "--debug"])
    assert (options.command, options.no_browser, options.passed_on) == ("lab", True, ["--debug"])
    assert commands.parse([]).work == "work"
    with pytest.raises(SystemExit):
        commands.parse(["setup", "--", "--debug"])
    assert commands.parse(["test", "--fresh", "--help"]).passed_on == ["--fresh", "--help"]


def test_the_folder_of_copies_may_come_before_the_command() -> None:
    """As who has always started with it types it."""
    for before in (["--work", "~/cam"], ["--work=~/cam"]):
        options = commands.parse([*before, "report", "press.csv", "--dxf"])
        assert (options.command, options.work) == ("report", "~/cam")
        assert (options.machine, options.dxf) == ("press.csv", True)
        assert commands.parse([*before, "--no-browser"]).command == "lab"
        with pytest.raises(SystemExit):
            commands.parse([*before, "class", "folder"])
    assert commands.parse(["--work", "report"]).command == "lab"


ALL_TESTS = " ".join(["pytest", *maintain.IN_PARALLEL])


@pytest.mark.parametrize(
    ("arguments", "failing", "code", "steps"),
    [
        ([], "", 0, ["ruff check .", "ruff format --check .", "mypy", ALL_TESTS]),
        ([], "mypy", 1, ["ruff check .", "ruff format --check .", "mypy", ALL_TESTS]),
        (["-k", "laws"], "", 0, ["pytest -k laws"]),
        (["-k", "laws"], "pytest -k laws", 1, ["pytest -k laws"]),
    ],
)
def test_linters_run_before_all_tests(
    monkeypatch: pytest.MonkeyPatch, arguments: list[str], failing: str, code: int, steps: list[str]
) -> None:
    """All steps run even if one fails; with arguments it is pytest alone."""
    ran: list[str] = []

    def run_module(*words: str) -> int:
        ran.append(" ".join(words))
        return int(ran[-1] == failing)

    monkeypatch.setattr(maintain, "run_module", run_module)
    monkeypatch.setattr(maintain, "_compiling_the_tests", nullcontext)
    assert maintain.test(arguments) == code
    assert ran == steps


def test_what_the_tests_compile_is_there_before_they_run(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(maintain, "ROOT", tmp_path)
    monkeypatch.setattr(maintain, "VENV_PYTHON", Path(sys.executable))
    monkeypatch.delenv("PYTHONDONTWRITEBYTECODE", raising=False)
    (tmp_path / "test_small.py").write_text("def test_small(): assert False", "utf-8")
    with maintain._compiling_the_tests():
        pass
    assert [path.name for path in tmp_path.glob("__pycache__/test_small.*pytest*.pyc")]


def test_it_ends_with_what_is_beside_it(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(maintain, "ROOT", tmp_path)
    monkeypatch.setattr(maintain, "VENV_PYTHON", Path(sys.executable))
    (tmp_path / "test_slow.py").write_text("import time; time.sleep(600)", "utf-8")
    started: list[subprocess.Popen[str]] = []
    popen = subprocess.Popen

    def start(*given: Any, **more: Any) -> "subprocess.Popen[str]":
        started.append(popen(*given, **more))
        return started[-1]

    monkeypatch.setattr(subprocess, "Popen", start)
    with pytest.raises(KeyboardInterrupt), maintain._compiling_the_tests():
        raise KeyboardInterrupt
    (loading,) = started
    assert loading.returncode not in (None, 0)


@pytest.mark.skipif(sys.platform == "win32", reason="there are no such signals")
def test_an_end_by_a_signal_is_told_as_a_shell_tells_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(maintain, "ROOT", tmp_path)
    monkeypatch.setattr(maintain, "VENV_PYTHON", Path(sys.executable))
    for code, told in (("os.kill(os.getpid(), 2)", 130), ("exit(3)", 3)):
        script = f"import os, signal; signal.signal(2, signal.SIG_DFL); {code}"
        assert maintain.run_python("-c", script) == told


def test_fresh_runs_machines_and_nothing_else(monkeypatch: pytest.MonkeyPatch) -> None:
    ran: list[tuple[str, ...]] = []

    def run_python(*words: str) -> int:
        ran.append(words)
        return 1

    monkeypatch.setattr(maintain, "run_python", run_python)
    assert maintain.test(["--fresh", "--seconds", "120", "--seed", "7f3a"]) == 1
    assert ran == [(str(maintain.FRESH), "--seconds", "120", "--seed", "7f3a")]
    assert "--fresh" in commands.COMMANDS["test"][1]


def modules_run(monkeypatch: pytest.MonkeyPatch, here: Path, code: int) -> list[tuple[str, ...]]:
    """Run commands from a folder, and keep what they would run; each of it ends with a code."""
    ran: list[tuple[str, ...]] = []

    def run_module(*words: str) -> int:
        ran.append(words)
        return code

    monkeypatch.chdir(here)
    monkeypatch.setattr(environment, "ensure", lambda: ran.append(("ensure",)))
    monkeypatch.setattr(maintain, "run_module", run_module)
    return ran


def test_a_report_is_written_into_the_folder_of_copies_and_its_exit_code_is_passed_on(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    ran = modules_run(monkeypatch, tmp_path, 2)
    work = tmp_path / "copies"
    asked = ["report", "machine.csv", "--work", str(work)]
    assert commands.run(asked) == 2
    monkeypatch.setenv("HOME", str(tmp_path))
    monkeypatch.setenv("USERPROFILE", str(tmp_path))
    asked[1] = "~/machine.csv"  # as in quotes, and in Windows
    assert commands.run([*asked, "--seconds", "60", "--dxf"]) == 2
    made = ("cammotion.report", str(tmp_path / "machine.csv"), f"--folder={work}")
    ensured = ("ensure",)
    assert ran == [ensured, (*made, "--seconds=20.0"), ensured, (*made, "--seconds=60.0", "--dxf")]


def test_the_class_page_is_made_by_the_environment_from_where_the_user_is(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    ran = modules_run(monkeypatch, tmp_path, 3)
    assert commands.run(["class", "7b"]) == 3
    assert commands.run(["class", "7b", "--output", "x/y.html", "--anonymous", "--overwrite"]) == 3
    folder = str(tmp_path / "7b")
    made = ("cammotion.teaching.classroom", folder)
    assert ran == [
        ("ensure",),
        (*made, f"--output={tmp_path / 'class.html'}"),
        ("ensure",),
        (*made, f"--output={tmp_path / 'x' / 'y.html'}", "--anonymous", "--overwrite"),
    ]


def test_the_pages_are_made_by_the_environment_from_where_the_user_is(
    root: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    ran = modules_run(monkeypatch, tmp_path, 3)
    assert commands.run(["site"]) == 3
    assert commands.run(["site", "--folder", "x/pages", "--home", "https://example.org"]) == 3
    made = ("cammotion.site", str(root / "notebooks"))
    assert ran == [
        ("ensure",),
        (*made, str(tmp_path / "site")),
        ("ensure",),
        (*made, str(tmp_path / "x" / "pages"), "--home=https://example.org"),
    ]

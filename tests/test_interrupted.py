"""Ctrl-C while a command loads, reads or computes: a sentence, and the exit code of a shell."""

import importlib
import signal
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
from small_workbook import raiser

from cammotion.terminal import interrupt_held_back

PRESS = Path(__file__).parent.parent / "notebooks" / "data" / "pad_press.csv"
STOPPED = "\nStopped. Nothing was written.\n"
# Runs a module of the package, and interrupts it as soon as it loads what is named.
INTERRUPT = """
import runpy, sys
class Finder:
    def find_spec(self, name, path, target=None):
        if name == loaded:
            raise KeyboardInterrupt
_, module, loaded, *rest = sys.argv
sys.meta_path.insert(0, Finder())
sys.argv[1:] = rest
runpy.run_module(module, run_name="__main__", alter_sys=True)
"""


@pytest.fixture(autouse=True)
def _answered() -> Iterator[None]:
    """Let Python answer an interrupt, which the background of a script ignores."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


@pytest.mark.parametrize("loaded", ["numpy", "cammotion.quantities", "cammotion.files"])
@pytest.mark.parametrize("module", ["cammotion.report", "cammotion.teaching.classroom"])
def test_an_interrupt_while_it_loads_is_answered(tmp_path: Path, module: str, loaded: str) -> None:
    ran = subprocess.run(
        [sys.executable, "-c", INTERRUPT, module, loaded, str(tmp_path)],
        capture_output=True,
        text=True,
    )
    assert (ran.returncode, ran.stderr, ran.stdout) == (130, STOPPED, "")


@pytest.mark.parametrize(
    ("module", "within"),
    [
        ("cammotion.report", "cammotion.exchange.machine_files.read_machine"),
        ("cammotion.report", "cammotion.report.writing.write_report"),
        ("cammotion.teaching.classroom", "cammotion.teaching.classroom.collect.read_class"),
    ],
)
def test_an_interrupt_while_it_works_is_answered(
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
    module: str,
    within: str,
) -> None:
    main = importlib.import_module(f"{module}.__main__").main
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(within, raiser(KeyboardInterrupt()))
    assert main([str(PRESS)]) == 130
    assert capsys.readouterr().err == STOPPED
    assert not [*tmp_path.iterdir()]


@pytest.mark.parametrize(
    ("module", "loaded"),
    [
        ("cammotion.report", "scipy.optimize"),  # before the search
        ("cammotion.teaching.classroom", "cammotion.teaching.classroom.collect"),
    ],
)
def test_an_interrupt_does_not_reach_a_library_that_is_being_loaded(
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
    module: str,
    loaded: str,
) -> None:
    """The solver HiGHS made "initialization failed" of it."""
    reached = []

    class Finder:
        def find_spec(self, name: str, *_: object) -> None:
            if name == loaded:
                try:
                    signal.raise_signal(signal.SIGINT)
                except KeyboardInterrupt:
                    reached.append(name)
                raise ImportError("initialization failed")

    main = importlib.import_module(f"{module}.__main__").main
    monkeypatch.chdir(tmp_path)
    monkeypatch.delitem(sys.modules, loaded, raising=False)
    monkeypatch.setattr(sys, "meta_path", [Finder(), *sys.meta_path])
    assert main([str(PRESS)]) == 130
    assert capsys.readouterr().err == STOPPED
    assert not reached
    assert not [*tmp_path.iterdir()]
    assert signal.getsignal(signal.SIGINT) == signal.default_int_handler


def test_what_is_ignored_in_the_background_of_a_script_stays_so() -> None:
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    with interrupt_held_back():
        assert signal.getsignal(signal.SIGINT) == signal.SIG_IGN

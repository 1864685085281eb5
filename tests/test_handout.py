"""The handouts of the lessons: they need no network, and keep folded what is folded."""

import re
import runpy
import subprocess
import sys
from pathlib import Path

import pytest
from bs4 import BeautifulSoup

ROOT = Path(__file__).parents[1]
LESSONS = sorted(path.stem for path in (ROOT / "notebooks").glob("[0-9]*.ipynb"))
PROGRAM = ROOT / "docs" / "handout.py"


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    made = tmp_path_factory.mktemp("handouts")
    numbers = [name[:2] for name in LESSONS]
    command = [sys.executable, str(PROGRAM), *numbers, f"--folder={made}"]
    result = subprocess.run(command, capture_output=True, text=True, check=False)
    assert result.returncode == 0, result.stderr
    return made


@pytest.mark.parametrize("lesson", LESSONS)
def test_a_handout_needs_no_network_and_no_script(folder: Path, lesson: str) -> None:
    page = BeautifulSoup((folder / f"{lesson}.html").read_text("utf-8"), "html.parser")
    assert not page.select("script, link, img:not([src^='data:'])")
    assert not page.select("img:not([alt]), img[alt^='No description']")
    style = " ".join(tag.get_text() for tag in page.select("style"))
    assert re.search(r'@font-face { font-family: "Workbook Math"; src: url\(data:', style)
    assert re.search(r'math { font-family: [^;]*"Workbook Math"', style)
    for code in page.select("pre, code, style"):
        code.decompose()
    assert not re.search(r"\$|\\frac", page.get_text())


def test_what_is_folded_stays_folded(folder: Path) -> None:
    page = BeautifulSoup((folder / "04_machine_in_motion.html").read_text("utf-8"), "html.parser")
    folded = page.select("details")
    assert not any(details.has_attr("open") for details in folded)
    (answer,) = (details for details in folded if "What you have found" in details.get_text())
    assert "The widest rise is 124.9 degrees" in answer.get_text()
    assert page.get_text().count("The widest rise is") == 1


def test_a_lesson_that_is_not_there_is_named(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(sys, "argv", ["handout.py", "77", f"--folder={tmp_path}"])
    with pytest.raises(SystemExit):
        runpy.run_path(str(PROGRAM), run_name="__main__")
    assert "There is no lesson 77" in capsys.readouterr().err

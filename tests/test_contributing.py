"""What CONTRIBUTING.md names is there: files, the words in them, and commands."""

import re
import shlex
import sys
import tomllib
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent
sys.path.append(str(ROOT))

from starter import commands  # noqa: E402

TEXT = (ROOT / "CONTRIBUTING.md").read_text("utf-8")
NAMES = set(re.findall(r"`([\w/.]+\.(?:py|md|ipynb))`", TEXT))
NEW = {name for name in NAMES if "NN" in name or name.endswith("kind.py")}
ELSEWHERE = {"scene.py", "slide.py"}  # named beside their folder


@pytest.mark.parametrize("name", sorted(NAMES - NEW - ELSEWHERE))
def test_each_file_is_there(name: str) -> None:
    assert (ROOT / name).is_file()


def test_new_files_go_where_their_kind_is() -> None:
    assert NEW
    for name in NEW:
        like = re.sub(r"NN\w*|kind", "*", name)
        assert list(ROOT.glob(like)), name


@pytest.mark.parametrize(
    ("file", "words"),
    [
        ("src/cammotion/laws/catalogue.py", ["_KNOWN"]),
        ("tests/test_laws.py", ["FACTORS", "TORQUE", "test_the_ranking_of_the_example"]),
        ("src/cammotion/views/animation/scene.py", ["KINDS", "class Drawing", "Slide"]),
        ("tests/known_slips.py", ["RIGHT", "SLIPS", "SOURCE"]),
    ],
)
def test_each_word_is_in_its_file(file: str, words: list[str]) -> None:
    text = (ROOT / file).read_text("utf-8")
    for word in words:
        assert word.removeprefix("class ") in TEXT
        assert word in text


def test_each_command_exists() -> None:
    named = re.findall(r"python3 workbook\.py([^`\n]*)", TEXT)
    assert {commands.parse(shlex.split(command)).command for command in named} == {
        "test",
        "refresh",
        "lock",
    }


def test_the_api_page_has_its_extra() -> None:
    project = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]
    assert ".[api]" in TEXT
    assert "api" in project["optional-dependencies"]

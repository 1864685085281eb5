"""What CONTRIBUTING.md names is there: files, the words in them, and commands."""

import re
import shlex
import sys
import tomllib
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent
sys.path.append(str(ROOT))

from cammotion.teaching.lessons import EXERCISES  # noqa: E402
from starter import commands  # noqa: E402

README = (ROOT / "README.md").read_text("utf-8")
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
        ("src/cammotion/__init__.pyi", ["__all__"]),
    ],
)
def test_each_word_is_in_its_file(file: str, words: list[str]) -> None:
    text = (ROOT / file).read_text("utf-8")
    for word in words:
        assert word.removeprefix("class ") in TEXT
        assert word in text


def section(heading: str) -> str:
    """Return what stands below a heading."""
    return TEXT.split(f"\n## {heading}")[1].split("\n## ")[0]


def test_a_law_has_the_lessons_that_go_through_all_laws_run_and_the_pictures_drawn() -> None:
    through_all = re.compile(r"\bin cm\.LAWS\b")
    told = section("A motion law")
    lessons = {p.name[:2]: p.read_text("utf-8") for p in (ROOT / "notebooks").glob("*.ipynb")}
    numbers = sorted(number for number, text in lessons.items() if through_all.search(text))
    assert f"python3 workbook.py refresh {' '.join(numbers)}`" in told
    assert "`python tests/drawn.py`" in told


def test_a_lesson_has_its_sentences_on_the_page_for_teachers() -> None:
    told = section("A lesson with an exercise")
    page = (ROOT / "docs" / "teaching.md").read_text("utf-8")
    shown = sum(bool(getattr(exercise, "shows", None)) for exercise in EXERCISES.values())
    (sentence,) = re.findall(r'the sentence that begins "([^"]+)"', told)
    assert sentence == f"In {shown} of the {len(EXERCISES)} exercises"
    assert f"\n{sentence} " in page
    assert "homework" in told
    for lesson in sorted({number[:2] for number in EXERCISES}):
        numbers = sorted(number for number in EXERCISES if number.startswith(lesson))
        assert f"\n| {lesson} | Exercises {numbers[0]} to {numbers[-1]}." in page


def test_eight_wrong_ways_are_asked_from_05_on() -> None:
    source = (ROOT / "tests" / "test_exercises_answers.py").read_text("utf-8")
    assert 'exercise.number > "05"' in source
    assert "from 05 on at least eight wrong ones" in TEXT


def test_what_needs_more_packages_says_it_for_uv_too() -> None:
    for text in (section("The API page"), README):
        extra = re.findall(r"-m pip install -e '\.\[(\w+)\]'", text)
        assert extra
        assert all(
            f"uv pip install --python .venv/bin/python -e '.[{one}]'" in text for one in extra
        )


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

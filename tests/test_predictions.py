"""The predictions of the lessons: asked as the notebooks ask, and true as the machine has it."""

import ast
import json
import math
import re
from pathlib import Path

import pytest
from bs4 import BeautifulSoup
from machines import RULE, make_diagram

import cammotion as cm
from cammotion.teaching.lessons import PREDICTIONS

NOTEBOOKS = sorted((Path(__file__).parent.parent / "notebooks").glob("*.ipynb"))
LAWS = cm.LAWS
PEAK = cm.peak_acceleration(50, 55, 2000)
AFTER = cm.widest_move(make_diagram(), "die", RULE).diagram
SPRING = cm.FollowerLoad(mass_kg=12, stiffness_N_per_mm=0.5, preload_N=40)


def _stays(angle_deg: float) -> float:
    """Return how far the die on 150 N/mm swings in the second after a move over an angle."""
    move = cm.Move(stroke_mm=50, angle_deg=angle_deg, rate_per_hour=2000)
    swings = cm.MoveResponse(cm.tuned_mass(cm.natural_frequency(150, 12), 0.02), move)
    return swings.peak_deflection_mm(over=(move.time_s, move.time_s + 1)).value


def cells_of(path: Path) -> list[str]:
    """Return the sources of a notebook."""
    return ["".join(cell["source"]) for cell in json.loads(path.read_text("utf-8"))["cells"]]


def reveals_of(path: Path) -> list[tuple[str, BeautifulSoup]]:
    """Return what a notebook stores of its reveals: the plain text, and the page."""
    cells = json.loads(path.read_text("utf-8"))["cells"]
    stored = (out.get("data", {}) for c in cells for out in c.get("outputs", []))
    return [
        ("".join(data["text/plain"]), BeautifulSoup("".join(data["text/html"]), "html.parser"))
        for data in stored
        if "The answer is folded" in "".join(data.get("text/plain", []))
    ]


def test_the_notebooks_ask_for_the_predictions_of_the_lessons_in_their_words() -> None:
    asked = {}
    for cell in (cell for path in NOTEBOOKS for cell in cells_of(path)):
        for words in re.findall(r"\bcm\.predict(\([^)]*\))", cell):
            key, text = ast.literal_eval(words)
            asked[key] = text
    assert asked == {made.key: made.asked for made in PREDICTIONS.values()}


@pytest.mark.parametrize(
    ("key", "value"),
    [
        ("01.half", (360 - 150 / 2 - 100) / 2),
        ("02.fraction", 1 / 4),
        ("02.peak", cm.peak_acceleration(50, 110, 2000)),
        ("02.few", 100 * (1 - cm.peak_acceleration(50, 60, 2000) / PEAK)),
        ("03.share", 100 * LAWS["cycloidal"](0.1)),
        ("03.widest", 70 / (1 - LAWS["cycloidal"].inverse(19 / 50))),
        ("04.start", AFTER.position_mm("die", 360)),
        ("05.best", cm.peak_acceleration(50, 55, 2000, law="modified trapezoid")),
        ("06.spring", 2 / (1 - 2 / 3)),  # up to the velocity 2 in the time that a brake of 3 leaves
        ("06.machine", 31 / 2425 / 1000 / (1.8 / 360) ** 2),
        ("08.plate", 100 * 5.38 / 38.5),
        ("08.backlash", 10 ** (2 / 3)),
        ("08.geneva", 0.69976 * (135 / 180 * math.pi) ** 2 * 8 / (2 * math.pi) / 5.52796),
        ("09.error", 4 * 0.0005 / (4 / 36) ** 2),
        ("09.finer", 4 * 0.0005 / (4 / 360) ** 2),
        ("10.stay", 50),
        ("10.cure", _stays(55) / _stays(cm.EXAMPLE.widest_deg)),
        ("10.jump", max(f.gap_mm for f in cm.follower_flights(cm.EXAMPLE.die, SPRING, 2500))),
        ("11.play", 360 * 0.05 / (math.pi * 40)),
        ("11.errors", len({"E7", "E8", "f6", "f9", "H8", "K6", "p6", "R10"})),
        ("12.rate", 2000 * math.sqrt(PEAK / cm.peak_acceleration(100, 150, 2000))),
        ("12.next", cm.peak_acceleration(120, 45, 2000, law="modified sine")),
        ("12.bound", 4 * 0.090 / (60 / 360 * 1.8) ** 2),
    ],
)
def test_what_is_true(key: str, value: float) -> None:
    assert PREDICTIONS[key].true == pytest.approx(value, rel=2e-3)


@pytest.mark.parametrize(
    ("key", "printed"),
    [
        ("01.half", "92.5 degrees for each way, 37.5 more than before."),
        ("01.harder", "The die, 3.72 times: 4.154 m/s², the mill 1.117."),
        ("01.rate", "Displacement 1, velocity 2, acceleration 4."),
        ("03.harder", "The mill: 1.117 m/s², the die: 0.806 m/s²."),
        ("02.few", "By 16 %."),
        ("03.widest", "The die may move over 124.84 degrees."),
        ("04.start", "30.9 mm: its tip is 10.9 mm below the rim."),
        ("04.collision", "On the way down."),
        ("05.best", "3.232 m/s², with the modified trapezoid."),
        ("06.spring", "6, by the same three lines"),
        ("06.jerk", "It is between 3.34 and 3.44 % above."),  # of 3.3477 to 3.4315
        ("08.plate", "14.0 percent."),
        ("08.backlash", "4.64 times."),
        ("08.geneva", "0.895 times."),
        ("09.error", "0.162 in/s². That is 1 percent of the largest acceleration."),
        ("09.finer", "16.2 in/s², nearly as much as the largest acceleration itself."),
        ("09.place", "Place 8. First are numbers 4, 3 and 1."),
        ("10.stay", "50.0 percent, that is half the stroke."),
        ("10.cure", "10.1 times, 0.058 in place of 0.582 m/s²."),
        ("10.jump", "1.49 mm."),
        ("11.play", "0.143 degrees of cam angle."),
        ("11.press", "40 H7/p6: interference, 1 to 42 µm."),
        ("11.errors", "8 lines: E7 over 315 to 400 mm"),
        ("12.rate", "at 3857 pieces/h the mill meets the acceleration"),
        ("12.next", "13.10 m/s², that of the gripper."),
        ("12.bound", "4.00 m/s²; motions with 4.00 m/s² were found."),
    ],
)
def test_what_is_true_stands_folded_in_the_notebook(key: str, printed: str) -> None:
    (path,) = (path for path in NOTEBOOKS if path.name.startswith(key[:2]))
    (page,) = (page for _, page in reveals_of(path) if printed in page.get_text())
    (folded,) = page("details")
    assert printed in folded.get_text()
    assert not folded.has_attr("open")
    assert key in PREDICTIONS


def test_no_cell_that_reveals_can_be_read_for_the_answer() -> None:
    """It is computed there; a word on the usual guess comes with it and stands in no notebook."""
    for path in NOTEBOOKS:
        cells = cells_of(path)
        for made in (m for m in PREDICTIONS.values() if path.name.startswith(m.key[:2])):
            name = re.findall(rf'(\w+) = cm\.predict\("{made.key}"', "\n".join(cells))[0]
            (cell,) = (cell for cell in cells if f"{name}.reveal(" in cell)
            assert isinstance(made.true, str) or f"{made.true:g}" not in cell
            assert made.why
            assert made.why[:30] not in cell


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem[:2])
def test_each_prediction_is_revealed_once_and_below(path: Path) -> None:
    """What is stored of a reveal says nothing where it is plain text."""
    sources = cells_of(path)
    code = "\n".join(sources)
    asked = {m[1]: m.start() for m in re.finditer(r"^(\w+) = cm\.predict\(", code, re.MULTILINE)}
    revealed = re.findall(r"^(\w+)\.reveal\(", code, re.MULTILINE)
    assert sorted(revealed) == sorted(asked)
    assert all(code.index(f"{name}.reveal(") > at for name, at in asked.items())
    reveals = reveals_of(path)
    assert len(reveals) == len(asked)
    for text, _ in reveals:
        assert text == "The answer is folded: you made no prediction yet."
    assert not any(re.search(r"_guess\.said[})]", source) for source in sources)


def test_the_page_for_teachers_says_what_is_true() -> None:
    page = (NOTEBOOKS[0].parent.parent / "docs" / "teaching.md").read_text("utf-8")
    for lesson in sorted({key[:2] for key in PREDICTIONS}):
        _, _, section = page.partition(f"## {lesson} · ")
        (line,) = re.findall(r"\*\*True\.\*\* (.*)", section.split("\n## ")[0]) or [""]
        assert line, f"docs/teaching.md has no section '## {lesson} · ' with a line '**True.** '"
        numbers = [float(number) for number in re.findall(r"\d+\.?\d*", line)]
        for made in (m for m in PREDICTIONS.values() if m.key.startswith(lesson)):
            if isinstance(made.true, str):
                assert set(re.findall(r"[\d.]+", made.true)) <= set(re.findall(r"[\d.]+", line))
            else:
                assert any(number == pytest.approx(made.true, rel=0.003) for number in numbers)

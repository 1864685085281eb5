"""The predictions of the lessons: asked as the notebooks ask, and true as the machine has it."""

import ast
import json
import re
from pathlib import Path

import pytest

import cammotion as cm
from cammotion.teaching.lessons import PREDICTIONS

NOTEBOOKS = sorted((Path(__file__).parent.parent / "notebooks").glob("*.ipynb"))
LAWS = cm.LAWS


def cells_of(path: Path) -> list[str]:
    """Return the sources and the printed outputs of a notebook."""
    cells = json.loads(path.read_text("utf-8"))["cells"]
    printed = ("".join(out.get("text", [])) for c in cells for out in c.get("outputs", []))
    return [*("".join(cell["source"]) for cell in cells), *printed]


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
        ("01.angle", (360 - 150 - 100) / 2),
        ("02.fraction", 1 / 4),
        ("02.peak", cm.peak_acceleration(50, 110, 2000)),
        ("02.factor", cm.peak_acceleration(50, 55, 2000) / cm.peak_acceleration(50, 220, 2000)),
        ("03.share", 100 * LAWS["cycloidal"](0.1)),
        ("03.widest", 70 / (1 - LAWS["cycloidal"].inverse(19 / 50))),
        ("05.saves", 100 * (1 - LAWS["modified trapezoid"].Ca / LAWS["cycloidal"].Ca)),
        ("06.law", LAWS["constant acceleration"].Ca),
        ("06.machine", 31 / 2425 / 1000 / (1.8 / 360) ** 2),
    ],
)
def test_what_is_true(key: str, value: float) -> None:
    assert PREDICTIONS[key].true == pytest.approx(value, rel=2e-3)


@pytest.mark.parametrize(
    ("key", "printed"),
    [
        ("01.harder", "The die is pushed 3.72 times harder."),
        ("01.rate", "Movement 1, velocity 2, acceleration 4."),
        ("03.harder", "The mill: 1.117 m/s², the die: 0.806 m/s²."),
        ("04.depths", "The die is 19.0, 50.0, 50.0 mm deep."),
        ("04.collision", "(from 126.498 to 134.962 deg the mill is not within 0.65 mm)"),
        ("06.jerk", "It is 3.3 % above."),
    ],
)
def test_what_is_true_stands_in_the_notebook(key: str, printed: str) -> None:
    (path,) = (path for path in NOTEBOOKS if path.name.startswith(key[:2]))
    assert any(printed in cell for cell in cells_of(path))
    assert key in PREDICTIONS

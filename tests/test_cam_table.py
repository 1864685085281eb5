"""A table of a cam is what it says, or it is refused in a sentence."""

from typing import Any

import numpy as np
import pytest

import cammotion as cm

ANGLES = np.arange(0, 360, 10.0)
POSITIONS = 25 - 25 * np.cos(np.radians(ANGLES))


def test_a_table_keeps_copies_that_nobody_changes() -> None:
    positions = POSITIONS.copy()
    table = cm.CamTable(ANGLES, positions, step_mm=0.01, is_cycle=True, said="A cycle in mm.")
    positions[0] = 99
    assert table.position_mm[0] == 0
    assert (table.angle_deg == ANGLES).all()
    assert (table.step_mm, table.said) == (0.01, "A cycle in mm.")
    with pytest.raises(ValueError, match="read-only"):
        table.position_mm[0] = 99
    with pytest.raises(AttributeError):
        table.step_mm = 1.0  # type: ignore[misc]


def test_even_angles_are_told_from_uneven_ones() -> None:
    assert cm.CamTable(ANGLES, POSITIONS, is_cycle=True).even_step_deg == pytest.approx(10)
    assert cm.CamTable(ANGLES[:20], POSITIONS[:20]).even_step_deg == pytest.approx(10)
    third = np.arange(1080) / 3
    assert cm.CamTable(third.round(3), third).even_step_deg is None
    assert cm.CamTable(third, third).even_step_deg == pytest.approx(1 / 3)
    # even, but the step over the end of the turn is another one
    assert cm.CamTable(ANGLES[:20], POSITIONS[:20], is_cycle=True).even_step_deg is None


@pytest.mark.parametrize("span", [90, 130, 179, 180])
def test_what_is_mirrored_is_a_cycle_only_over_half_a_turn(span: int) -> None:
    angles = np.linspace(0, span, 30)
    table = cm.CamTable(angles, angles**2).mirrored()
    assert table.is_cycle == (span == 180)
    assert table.angle_deg.size == (58 if span == 180 else 59)


def test_it_says_what_it_is() -> None:
    said = repr(cm.CamTable(ANGLES[:19], POSITIONS[:19].round(2), step_mm=0.01))
    assert said == "CamTable(19 points every 10 deg, 0 to 180 deg, 0 to 50 mm in steps of 0.01)"


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ({"angle_deg": ANGLES[:5]}, "has 5 angles and 36 positions: give two lists"),
        (
            {"angle_deg": ANGLES[:7], "position_mm": POSITIONS[:7]},
            "has 7 angles and 7 positions: .* at least 8 numbers",
        ),
        (
            {"angle_deg": ANGLES[::-1]},
            r"340 deg \(at position 1\) after 350 deg; it has to rise",
        ),
        (
            {"angle_deg": np.array([0, 1e-14, *ANGLES[2:]])},
            r"1e-14 deg \(at position 1\) after 0 deg; it has to rise by at least 1e-06 deg",
        ),
        (
            {"angle_deg": np.array([*ANGLES[:-1], 360 - 1e-12]), "is_cycle": True},
            "its first point comes again at the end",
        ),
        ({"angle_deg": [*ANGLES[:-1], 340]}, r"is 340 deg \(at position 35\) after 340 deg"),
        ({"angle_deg": [*ANGLES[:-1], 360]}, "goes from 0 to 360 deg; .* leave out the last point"),
        ({"angle_deg": [*ANGLES[:-1], np.nan]}, "cam angle of the table is nan deg"),
        ({"position_mm": ["a"] * 36}, "position of the table has to be a number in mm"),
        ({"step_mm": -0.01}, "step of the positions is -0.01 mm"),
        ({"angle_deg": 10, "position_mm": 5}, "has 1 angles and 1 positions"),
    ],
)
def test_what_is_no_table_is_refused(given: dict[str, Any], said: str) -> None:
    sound: dict[str, Any] = {"angle_deg": ANGLES, "position_mm": POSITIONS, "is_cycle": True}
    with pytest.raises(cm.InputError, match=said):
        cm.CamTable(**(sound | given))

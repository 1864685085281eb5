"""The machine's drawing: every motion is in one picture, and a new kind is one entry in a list."""

from collections.abc import Iterable, Sequence
from typing import Any

import drawsvg as draw
import pytest
from machines import RULE, make_diagram
from test_animation import MACHINES, TWELVE

import cammotion as cm
from cammotion.views.animation import scene
from cammotion.views.animation.scene import KINDS, Scene


def places(made: Scene) -> list[tuple[float, float, list[str]]]:
    return [(round(x), y, [*drawing.names]) for x, y, drawing in made._placed]


@pytest.mark.parametrize(("diagram", "rules"), MACHINES)
def test_every_motion_is_in_one_drawing(diagram: cm.TimingDiagram, rules: Any) -> None:
    made = Scene(diagram, rules, 406)
    names = [name for _, _, drawing in made._placed for name in drawing.names]
    assert sorted(names) == sorted(diagram.names)
    for x, y, drawing in made._placed:
        assert x + drawing.width <= 406 + 1e-9
        assert y + drawing.height <= made.height


def test_a_die_is_drawn_over_its_turret_and_other_motions_in_rows_of_one_length() -> None:
    assert places(Scene(make_diagram(), [RULE], 406)) == [(0, 0, ["mill", "die"])]
    (table, *slides) = places(Scene(TWELVE, [], 400))
    assert table[2] == ["table"]
    assert [x for x, _, _ in slides] == [0, 100, 200, 300] * 2 + [0, 100, 200]
    assert len({y for _, y, _ in slides}) == 3


class Lamp:
    """A kind of its own, for motions with this name."""

    names: Sequence[str] = ("lamp",)
    width: float = 100
    height: float = 50

    @classmethod
    def find(
        cls,
        diagram: cm.TimingDiagram,  # noqa: ARG003
        rules: Iterable[cm.ClearanceRule],  # noqa: ARG003
        left: list[str],
        width: float,  # noqa: ARG003
    ) -> "list[Lamp]":
        """Return one if it is wanted."""
        return [cls()] if "lamp" in left else []

    def draw(self, turn_s: float, broken_arcs: Any) -> Any:  # noqa: ARG002
        """Draw it."""
        return draw.Circle(50, 25, 20, data_part="lamp")


def test_a_new_kind_is_one_entry_in_the_list(monkeypatch: pytest.MonkeyPatch) -> None:
    lamp = cm.motion("lamp", cm.rise(1, over_deg=180), cm.return_(1, over_deg=180))
    diagram = make_diagram(*make_diagram().motions, lamp)
    before = cm.animate(diagram).svg
    monkeypatch.setattr(scene, "KINDS", (Lamp, *KINDS))
    assert 'data-part="lamp"' in cm.animate(diagram).svg
    assert 'data-part="lamp"' not in before
    drawn = [names for _, _, names in places(Scene(diagram, [], 406))]
    assert drawn == [["lamp"], ["mill"], ["die"]]

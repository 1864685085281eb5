"""Where the parts of a moving drawing are in a page, and where the formulas want them."""

import pytest
from playwright.sync_api import Locator
from test_animation import AFTER, BEFORE

DESIGNS = (BEFORE, AFTER)
ANGLES = (0, 75, 140, 205, 255, 330, 359)
TOLERANCE_PX = 0.5

# Where the parts of the drawing are, in the page's pixels, and how large those of the drawing are.
PLACES = """drawing => [...drawing.querySelectorAll('[data-design]')].map(column => {
  const box = part => column.querySelector(part).getBoundingClientRect();
  const frame = drawing.getBoundingClientRect();
  const turret = column.querySelector('[data-part=turret]').getScreenCTM();
  return {
    die: box('[data-part=body][data-motion="1"] rect:nth-of-type(2)').bottom - frame.top,
    cursor: box('[data-part=cursor] > path').x - frame.left,
    mill: Math.atan2(turret.b, turret.a) * 180 / Math.PI,
    scale: drawing.getScreenCTM().a,
    perMm: Number(column.querySelector('[data-part=body]').dataset.pxPerMm),
  };
})"""


def places(drawing: Locator) -> list[dict[str, float]]:
    found: list[dict[str, float]] = drawing.evaluate(PLACES)
    return found


def assert_at(angle: float, now: list[dict[str, float]], at_zero: list[dict[str, float]]) -> None:
    """Assert that both designs stand at a cam angle, as the package's formulas say."""
    for diagram, here, there in zip(DESIGNS, now, at_zero, strict=True):
        way = diagram["die"].position_mm(angle) - diagram["die"].position_mm(0)
        wanted = way * here["perMm"] * here["scale"]
        assert here["die"] - there["die"] == pytest.approx(wanted, abs=TOLERANCE_PX)
        turned = 360 / 24 / 100 * diagram["mill"].position_mm(angle)
        assert here["mill"] == pytest.approx(turned, abs=0.2)
    cursors = [here["cursor"] - there["cursor"] for here, there in zip(now, at_zero, strict=True)]
    assert cursors[0] == pytest.approx(cursors[1], abs=TOLERANCE_PX)

"""The colours of curves are told apart by colour alone, also with one kind of cone missing.

What a picture says by colour it says by dashes, hatching or width as well.
"""

import re
from itertools import combinations
from typing import Any

import numpy as np
import pytest
from colour_vision import SIGHT, Colour, ciede2000, distance, rgb, turned_round

from cammotion.views import paper
from cammotion.views.broken import BROKEN
from cammotion.views.live import page
from cammotion.views.plots import COLOURS, REFERENCE_STYLE, dashes_of

APART = 8  # as CIEDE2000 counts, which calls 1 what is just seen side by side
STYLE = page.style()
ALARM = "red"


def painted() -> dict[str, Colour]:
    """Return the colours of Matplotlib's pictures, and of the machine in motion."""
    codes = {str(number): code for number, code in enumerate(COLOURS)}
    codes |= {"grey": str(REFERENCE_STYLE["color"]), ALARM: str(BROKEN["edgecolor"])}
    return {name: rgb(code) for name, code in codes.items()}


def turned() -> dict[str, Colour]:
    """Return what these are in a dark page, where white paper is turned round."""
    (invert,) = re.findall(r"invert\((\.\d+)\) hue-rotate\(180deg\)", paper.TURNED)
    return {name: turned_round(code, float(invert)) for name, code in painted().items()}


def living(theme: int) -> dict[str, Colour]:
    """Return the colours of live figures, in the light (0) or in the dark (1)."""
    found = {}
    for name in ("1", "2", "3", "4", "5", "ink", "grey", ALARM):
        value, *light = re.findall(rf"--cm-{name}:(light-dark\([^)]*\)|#\w+)", STYLE)
        codes = re.findall(r"#\w+", value)
        assert light == codes[:-1]  # in a browser that does not know light-dark()
        found[name] = rgb(codes[theme % len(codes)])
    return found


PALETTES = {
    "pictures": painted(),
    "pictures in the dark": turned(),
    "live figures": living(0),
    "live figures in the dark": living(1),
}


@pytest.mark.parametrize("sight", SIGHT)
@pytest.mark.parametrize("palette", PALETTES)
def test_any_two_colours_are_apart(palette: str, sight: str) -> None:
    colours = PALETTES[palette]
    assert len(colours) == len(COLOURS) + 2
    for one, other in combinations(colours, 2):
        if palette == "pictures in the dark" and ALARM in (one, other):
            continue  # what is broken there is hatched, see below
        apart = distance(colours[one], colours[other], sight)
        assert apart >= APART, f"{one} and {other}: {apart:.1f}"


def test_what_is_broken_is_also_hatched_and_an_alarm_is_also_wide() -> None:
    assert BROKEN["hatch"]
    (line,) = re.findall(r"\.cm-line\{[^}]*stroke-width:([\d.]+)", STYLE)
    (alarm,) = re.findall(r"\.cm-alarm\{[^}]*stroke-width:([\d.]+)", STYLE)
    assert float(alarm) >= 2 * float(line)


def test_curves_also_differ_in_their_dashes() -> None:
    """Those of one picture, up to twelve, and those of what they are compared with."""
    first, again = ([str(dashes_of(n)) for n in range(at, at + len(COLOURS))] for at in (0, 6))
    assert len({*first}) == len({*again}) == len(COLOURS)
    assert all(one != other for one, other in zip(first, again, strict=True))
    assert REFERENCE_STYLE["linestyle"] == "--"
    drawn = re.findall(r'\["\d", "([\d ]+|none)"\]', page.module())
    assert len({*drawn}) == len(drawn) == len(COLOURS)
    assert re.search(r"\.cm-reference\{[^}]*stroke-dasharray", STYLE)


@pytest.mark.parametrize(
    ("one", "other", "apart"),
    [  # Sharma, Wu and Dalal, Color Research and Application 30 (2005), table 1
        ((50, 2.6772, -79.7751), (50, 0, -82.7485), 2.0425),
        ((50, -1, 2), (50, 0, 0), 2.3669),
        ((50, 2.49, -0.001), (50, -2.49, 0.0009), 7.1792),
        ((50, 2.5, 0), (73, 25, -18), 27.1492),
        ((60.2574, -34.0099, 36.2677), (60.4626, -34.1751, 39.4387), 1.2644),
        ((2.0776, 0.0795, -1.1350), (0.9033, -0.0636, -0.5514), 0.9082),
    ],
)
def test_the_measure_is_the_published_one(one: Any, other: Any, apart: float) -> None:
    assert ciede2000(np.array(one), np.array(other)) == pytest.approx(apart, abs=1e-4)


@pytest.mark.parametrize("sight", SIGHT)
def test_grey_stays_grey_for_every_eye(sight: str) -> None:
    assert SIGHT[sight].sum(axis=1) == pytest.approx([1, 1, 1], abs=1e-5)


def test_red_and_green_look_alike_without_the_cone_for_green() -> None:
    red, green = rgb("#b35900"), rgb("#7d7d00")
    assert distance(red, green, "deuteranopia") < APART
    assert distance(red, green, "all cones") > 2 * APART


def test_paper_is_turned_round_as_a_browser_does() -> None:
    """White becomes JupyterLab's #111, black #eee."""
    assert turned_round(rgb("#fff"), 0.933) * 255 == pytest.approx([17, 17, 17], abs=0.2)
    assert turned_round(rgb("#000"), 0.933) * 255 == pytest.approx([238, 238, 238], abs=0.2)

"""Pictures of up to 24 mechanisms can be read: every name stands whole beside its own curve.

What a text takes on the page is asked of Matplotlib, and of an SVG estimated from its letters.
"""

import warnings
from collections.abc import Iterator
from dataclasses import replace
from itertools import combinations
from typing import Any
from xml.etree import ElementTree

import matplotlib as mpl
import numpy as np
import pytest
from cartons import EIGHT, ODD_NAMES, all_dies, packaging_machine, pusher_rule, tool
from machines import RULE, make_die, make_mill
from matplotlib import pyplot as plt
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.text import Text
from matplotlib.transforms import Bbox

import cammotion as cm
from cammotion.views.animation import svg
from cammotion.views.animation.turret import Turret
from cammotion.views.names import labels, printable, short_names, text_px
from cammotion.views.pictures import PictureFigure, describe
from cammotion.views.plots import colour, dashes_of

mpl.use("agg")

COUNTS = [1, 4, 6, 7, 12, 24]
LONG_NAMES = [f"{'n' * 30} {k:02}" for k in range(24)]
NAMES: list[list[str]] = [[], ODD_NAMES, LONG_NAMES]
MANY = [
    *[(count, []) for count in COUNTS],
    *[(count, ODD_NAMES) for count in (4, 7, 24)],
    *[(count, LONG_NAMES) for count in (1, 6, 24)],
]
PAGE_INCHES = 9.4  # a notebook's page, as wide as its pictures were before
TOUCH_PX = 1.0


@pytest.fixture(autouse=True)
def _no_warning() -> Iterator[None]:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        yield
    plt.close("all")


def boxes(ax: Axes) -> dict[str, Bbox]:
    """Return where each text of the picture is, in px."""
    renderer = FigureCanvasAgg(ax.figure).get_renderer()  # type: ignore[no-untyped-call, arg-type]
    ax.figure.draw(renderer)
    hidden = {id(label) for axes in ax.figure.axes for label in _hidden_ticks(axes)}
    found = ax.figure.findobj(Text)
    seen = [text for text in found if text.get_visible() and id(text) not in hidden]
    return {
        f"{text.get_text()} #{number}": text.get_window_extent()
        for number, text in enumerate(seen)
        if text.get_text()
    }


def _hidden_ticks(axes: Any) -> Iterator[Any]:
    """Yield the numbers of an axis that are out of its range, and not drawn."""
    for axis, ends in ((axes.xaxis, axes.get_xlim()), (axes.yaxis, axes.get_ylim())):
        for tick in axis.get_major_ticks():
            if not min(ends) <= tick.get_loc() <= max(ends):
                yield from (tick.label1, tick.label2)


def over_each_other(found: dict[str, Bbox]) -> list[tuple[str, str]]:
    return [
        (one, other)
        for (one, a), (other, b) in combinations(found.items(), 2)
        if min(a.x1, b.x1) - max(a.x0, b.x0) > TOUCH_PX
        and min(a.y1, b.y1) - max(a.y0, b.y0) > TOUCH_PX
    ]


@pytest.mark.parametrize(("count", "names"), MANY)
def test_no_text_of_a_timing_diagram_lies_over_another(count: int, names: list[str]) -> None:
    diagram = packaging_machine(count, names)
    ax = cm.plot_timing(diagram, rows=["jerk"], rules=pusher_rule(diagram) if count > 4 else ())
    found = boxes(ax)
    assert not over_each_other(found)
    assert isinstance(ax.figure, PictureFigure)
    page = Bbox.union(list(found.values()))
    assert page.width / ax.figure.dpi <= PAGE_INCHES
    shown = labels(diagram.names)
    rows_named = ax.figure.axes[1:2] if count <= 4 else ax.figure.axes
    for axes in rows_named:
        assert [text.get_text() for text in axes.get_yticklabels()] == shown


def test_names_over_curves_stay_in_the_frame() -> None:
    """Also where all curves are one, and so wide names have no room beside each other."""
    moves = cm.rise(50, over_deg=10), cm.dwell(340), cm.return_(50, over_deg=10)
    alike = [cm.motion(f"{letter * 40} {letter}", *moves) for letter in "NOPQ"]
    ax = cm.plot_timing(cm.TimingDiagram(alike, 2000))
    renderer = FigureCanvasAgg(ax.figure).get_renderer()  # type: ignore[no-untyped-call, arg-type]
    ax.figure.draw(renderer)
    frame = ax.get_window_extent(renderer)
    for text in ax.texts:
        box = Text.get_window_extent(text, renderer)
        assert frame.x0 - 1 <= box.x0 <= box.x1 <= frame.x1 + 1, text.get_text()


@pytest.mark.parametrize("count", COUNTS)
def test_a_colour_that_comes_again_has_other_dashes(count: int) -> None:
    ax = cm.plot_timing(packaging_machine(count), rows=["velocity"])
    for axes in (ax, ax.figure.axes[2]):
        lines = [line for line in axes.lines if len(np.atleast_1d(line.get_xdata())) > 2]
        looks = {(line.get_color(), str(vars(line)["_dash_pattern"])) for line in lines}
        assert len(looks) == len(lines) == count
    assert len({(colour(n), str(dashes_of(n))) for n in range(24)}) == 24
    assert len({(s["stroke"], s["stroke_dasharray"]) for s in map(svg.line_style, range(24))}) == 24


@pytest.mark.parametrize("names", NAMES)
def test_the_words_have_every_name_in_full_and_its_range(names: list[str]) -> None:
    diagram = packaging_machine(24, names)
    figure = cm.plot_timing(diagram).figure
    assert isinstance(figure, PictureFigure)
    words = describe(figure)
    for motion in diagram.motions:
        low, high = (end for end in motion.range_mm)
        span = f"{printable(motion.name)} from "
        assert span in words
        if motion.stops is None:
            assert f"{span}{low:.3g} to {high:.3g}" in words


def test_the_bars_of_a_picture_are_labelled_where_there_is_room() -> None:
    narrow = cm.motion(
        "narrow", *[cm.rise(1, over_deg=20.125), cm.dwell(20.125)] * 8, cm.return_(8, over_deg=38)
    )
    ax = cm.plot_timing(cm.TimingDiagram([narrow], 100))
    assert not over_each_other(boxes(ax))


def test_three_alike_are_named_apart() -> None:
    alike = [tool((f"jaw {n}", *EIGHT[3][1:])) for n in range(3)]
    ax = cm.plot_timing(cm.TimingDiagram(alike, 100))
    assert not over_each_other(boxes(ax))
    assert {text.get_text() for text in ax.texts} == {"jaw 0", "jaw 1", "jaw 2"}


def test_more_than_24_get_a_sentence() -> None:
    many = packaging_machine(25)
    said = r"has 25 mechanisms.* 24 that can be read: draw it in parts.*motions\[:24\]"
    for draw in (cm.plot_timing, cm.animate):
        with pytest.raises(cm.InputError, match=said):
            draw(many)
        draw(cm.TimingDiagram(many.motions[:24], many.rate_per_hour))


@pytest.mark.parametrize(("count", "names"), MANY)
def test_no_text_of_curves_bars_and_maps_lies_over_another(count: int, names: list[str]) -> None:
    diagram = packaging_machine(count, names)
    moves = [diagram.moves(name)[0] for name in diagram.names]
    for plot in (cm.plot_curves, cm.plot_peaks):
        found = boxes(plot(moves, labels=diagram.names))
        assert not over_each_other(found)
        written = [text.rsplit(" #", 1)[0] for text in found]
        assert {*labels(diagram.names)} <= {*written}
    if count > 1:
        assert not over_each_other(boxes(cm.plot_clearance(diagram, pusher_rule(diagram))))


def svg_texts(picture: str) -> tuple[dict[str, Bbox], Bbox]:
    """Return where each text of an SVG is, about, and the sheet; none is turned."""
    root = ElementTree.fromstring(picture)  # noqa: S314 - our own
    found: dict[str, Bbox] = {}

    def walk(element: Any, x: float, y: float) -> None:
        way = element.get("transform", "")
        if way.startswith("translate("):
            dx, dy = map(float, way[10:-1].split())
            x, y = x + dx, y + dy
        elif way.startswith("rotate("):
            return
        if element.tag.endswith("}text") and element.text:
            size = float(element.get("font-size"))
            bold = element.get("font-weight") == "bold"
            wide = 0.85 * text_px(element.text, size, bold=bold)  # in a font of the usual width
            left = x + float(element.get("x"))
            left -= {"middle": wide / 2, "end": wide}.get(element.get("text-anchor"), 0)
            base = y + float(element.get("y"))
            key = f"{element.text} #{len(found)}"
            found[key] = Bbox.from_extents(left, base - 0.72 * size, left + wide, base + 1)
        for child in element:
            walk(child, x, y)

    walk(root, 0, 0)
    return found, Bbox.from_bounds(0, 0, float(root.get("width", 0)), float(root.get("height", 0)))


@pytest.mark.parametrize(("count", "names"), MANY)
@pytest.mark.parametrize("has_dies", [False, True])
def test_no_text_of_the_machine_in_motion_lies_over_another(
    count: int, names: list[str], has_dies: bool
) -> None:
    diagram = packaging_machine(count, names)
    rules = all_dies(diagram) if has_dies else ()
    animation = cm.animate(diagram, rules=rules)
    found, sheet = svg_texts(animation.svg)
    assert not over_each_other(found)
    for text, box in found.items():
        assert sheet.x0 <= box.x0, text
        assert box.x1 <= sheet.x1, text
    if not names and not has_dies:  # all of these names are short enough to stand whole
        assert not [text for text in found if "…" in text]
    written = "".join(found).replace(" ", "")
    for shown in short_names(diagram.names):
        assert shown[:6].replace(" ", "") in written


def test_the_sign_of_a_broken_rule_lies_above_the_machine() -> None:
    fingers = [
        cm.motion(
            name,
            *(cm.rise(50, over_deg=55), cm.dwell(90), cm.return_(50, over_deg=55), cm.dwell(160)),
            start_deg=start,
        )
        for name, start in (("folding finger", 100), ("other finger", 20))
    ]
    diagram = cm.TimingDiagram([make_mill(), *fingers], 2000)
    rules = [replace(RULE, when=cm.beyond(each.name, 19)) for each in fingers]
    picture = cm.animate(diagram, rules=rules).svg
    found, _ = svg_texts(picture)
    assert not over_each_other(found)
    (sign,) = (box for text, box in found.items() if text.startswith("RULE BROKEN #"))
    ground = sign.y1 + 6  # the end of the red one
    machine = next(box for text, box in found.items() if text.startswith("other finger #"))
    assert ground <= machine.y0


def test_names_about_a_turret_stand_at_both_sides() -> None:
    diagram = packaging_machine(12)
    found, sheet = svg_texts(cm.animate(diagram, rules=all_dies(diagram)).svg)
    first = {text.partition(" #")[0]: box for text, box in reversed(found.items())}
    dies = [first[name] for name in diagram.names[1:9]]  # the others have columns of their own
    assert sum(box.x1 < sheet.width / 2 for box in dies) == 4
    assert sum(box.x0 > sheet.width / 2 for box in dies) == 4


@pytest.mark.parametrize(("count", "longest"), [(2, 7), (3, 5)])
def test_names_that_have_room_about_a_turret_stand_at_their_dies(count: int, longest: int) -> None:
    """The machine is drawn smaller for them, and with longer ones they stand aside."""
    for letters, stand_aside in ((longest, False), (longest + 3, True)):
        dies = [replace(make_die(), name="m" * letters + str(number)) for number in range(count)]
        diagram = cm.TimingDiagram([make_mill(), *dies], rate_per_hour=2000)
        rules = [RULE.renamed({"mill": "mill", "die": die.name}) for die in dies]
        (turret,) = Turret.find(diagram, rules, ["mill"], 380.0)
        assert turret.is_crowded == stand_aside


def test_the_words_of_the_machine_in_motion_have_the_names_in_full() -> None:
    animation = cm.animate(packaging_machine(14, ODD_NAMES))
    for name, shown in zip(ODD_NAMES, short_names(ODD_NAMES), strict=True):
        assert printable(name) == shown or f"{shown} is {printable(name)}" in animation.description
    assert "no. 3 is a name without letters." in animation.description
    assert len(animation.svg) < 300_000

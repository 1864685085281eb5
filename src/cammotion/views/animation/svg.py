"""What the drawings of the machine in motion are made of: texts that fit, and what moves.

`drawsvg` writes the SVG. It escapes texts and titles but no attributes, so whatever a user has
typed goes into texts and titles only.
"""

import re
from collections.abc import Callable, Iterable
from typing import Any

import drawsvg as draw
from matplotlib.colors import to_hex

from cammotion.machine.arcs import Arc
from cammotion.machine.kinematics import DEG_PER_TURN
from cammotion.quantities import Floats
from cammotion.views import plots
from cammotion.views.animation.keyframes import Trace
from cammotion.views.broken import BROKEN
from cammotion.views.names import cut, printable
from cammotion.views.plots import colour, dashes_of, mixed
from cammotion.views.scales import trimmed

FONT = "DejaVu Sans, Verdana, Arial, sans-serif"
INK, GREY = "#222222", "#777777"
ALARM, PALE_ALARM = BROKEN["edgecolor"], BROKEN["facecolor"]
SMALL, NORMAL, LARGE = 11, 12, 15
STEEL: dict[str, Any] = {"fill": "#dcdcdc", "stroke": "#555555", "stroke_width": 1.5}

# What the reader's wish for less motion stops, unless a player has taken the class cm-still away.
STYLE = """
.cm-drawing text { stroke-linejoin: round; paint-order: stroke }
@media (prefers-reduced-motion: reduce) {
.cm-still .cm-moves { transform: none !important }
.cm-still .cm-off { visibility: hidden !important }
.cm-still .cm-on { visibility: visible !important }
}"""

_DASHES = {"-": (), "--": (3.7, 1.6), "-.": (6.4, 1.6, 1, 1.6), ":": (1, 1.65)}
_HATCH_PX = 7
_LEFTWARDS = "\u0590-\u08ff\ufb1d-\ufdff\ufe70-\ufefc"  # letters of scripts that run to the left
_RUN = re.compile(rf"[{_LEFTWARDS}](?:\W*[{_LEFTWARDS}])*")


def sheet(width: float, height: float, title: str, description: str) -> draw.Drawing:
    """Return an empty drawing on white, in px, with words for who does not see it."""
    drawing = draw.Drawing(
        width,
        height,
        class_="cm-drawing cm-still",
        role="img",
        font_family=FONT,
        style="background: white",
    )
    drawing.append_css(STYLE)
    drawing.append_title(title)
    drawing.append(Description(description))
    drawing.append(box(0, 0, width, height, fill="white"))
    return drawing


class Viewport(draw.DrawingParentElement):  # type: ignore[misc]
    """A rectangle, at whose edges what is drawn in it is cut off; nothing in it may move.

    Chromium gives what moves in it a clock of its own, which no player would reach.
    """

    TAG_NAME = "svg"


class Description(draw.Title):  # type: ignore[misc]
    """The description of a drawing, for those who do not see it."""

    TAG_NAME = "desc"


def px(value: float, digits: int = 2) -> float:
    """Return a rounded number; a tie is rounded one way on every machine."""
    return round(float(value) + 1e-9, digits) or 0.0


def pale(number: int) -> str:
    """Return the colour of a mechanism for areas."""
    return to_hex(mixed(colour(number), "white", 0.78))


def dark(number: int) -> str:
    """Return the colour of a mechanism for text."""
    return to_hex(plots.dark(number))


def line_style(number: int) -> dict[str, Any]:
    """Return colour, width and dashes of the curve of a mechanism."""
    style = dashes_of(number)
    dashes = _DASHES[style] if isinstance(style, str) else style[1]
    pattern = " ".join(f"{px(2 * dash):g}" for dash in dashes)
    return {
        "stroke": colour(number),
        "stroke_width": 2,
        "stroke_dasharray": pattern or None,
        "fill": "none",
    }


def label(
    text: str, x: float, y: float, *, width: float = 1000, size: int = NORMAL, **style: Any
) -> Any:
    """Return a text that is cut, with an ellipsis, where it could be wider than `width`.

    The whole text is then in its title. A white seam keeps it readable over lines.
    """
    whole = printable(text)
    style = {"fill": INK, "stroke": "white", "stroke_width": 3} | style
    shown = cut(whole, width, size, bold=style.get("font_weight") == "bold")
    element = draw.Text(_apart(shown), size, px(x), px(y), **style)
    if shown != whole:
        element.append_title(whole)
    return element


def _apart(text: str) -> str:
    """Return a text whose numbers stay whole and in their places beside a name in Hebrew."""
    return _RUN.sub("\u2068\\g<0>\u2069", text)


def polyline(points: Iterable[tuple[float, float]], **style: Any) -> Any:
    """Return a line through points in px."""
    places = " ".join(f"{_short(x, 1)},{_short(y, 1)}" for x, y in points)
    return draw.Path(d=f"M{places}", **style)


def box(x: float, y: float, width: float, height: float, **style: Any) -> Any:
    """Return a rectangle in px."""
    return draw.Rectangle(px(x), px(y), px(width), px(height), **style)


def placed(x: float, y: float, *children: Any) -> Any:
    """Return a group whose origin is at a place in px."""
    return draw.Group(children, transform=f"translate({_short(x, 3)} {_short(y, 3)})")


def alarm_area(x: float, y: float, width: float, height: float) -> Any:
    """Return a red area with a hatch, which says so without a colour too."""
    area = Viewport(x=px(x), y=px(y), width=px(width), height=px(height))
    area.append(box(0, 0, width, height, fill=PALE_ALARM))
    hatch = draw.Path(stroke=ALARM, stroke_width=1.2, fill="none")
    for left in range(-int(height // _HATCH_PX) * _HATCH_PX - _HATCH_PX, int(width), _HATCH_PX):
        hatch.M(left, px(height)).l(px(height), px(-height))
    area.append(hatch)
    return area


def alarm(during: list[Arc], turn_s: float, at: tuple[float, float, float, float]) -> Iterable[Any]:
    """Yield the alarm over a rectangle (x, y, width, height), seen over these arcs of the turn."""
    if during:
        seen = seen_during(during, turn_s)
        seen.append(alarm_area(*at))
        seen.append(box(*at, fill="none", stroke=ALARM, stroke_width=3.5))
        yield seen


def moving(
    trace: Trace, turn_s: float, direction: str = "y", *, data: dict[str, Any] | None = None
) -> Any:
    """Return a group that is drawn where it is at 0 deg, and moves from there by a trace.

    The trace is in px along "x" or "y", in deg about the origin for "rotate", or for "stretch" how
    many times as high it is.
    """
    ways = trace.values - trace.values[0]
    write: Callable[[float], str] = {
        "x": lambda way: _short(way, 3),
        "y": lambda way: f"0 {_short(way, 3)}",
        "rotate": lambda way: _short(way, 4),
        "stretch": lambda way: f"1 {_short(1 + way, 4)}",
    }[direction]
    kinds = {"rotate": "rotate", "stretch": "scale"}
    group = draw.Group(class_="cm-moves", **{f"data_{key}": v for key, v in (data or {}).items()})
    if ways.any():
        group.append_anim(
            draw.AnimateTransform(
                kinds.get(direction, "translate"),
                f"{turn_s:g}s",
                ";".join(map(write, ways)),
                keyTimes=_key_times(trace.angles_deg),
                repeatCount="indefinite",
            )
        )
    return group


def seen_during(these: list[Arc], turn_s: float) -> Any:
    """Return a group that is seen only over these arcs of the turn."""
    changes = {0.0: "hidden"}
    for start, end in these:
        changes |= {start: "visible"} | ({end: "hidden"} if end < DEG_PER_TURN else {})
    first = changes[0.0]
    group = draw.Group(visibility=first, class_="cm-on" if first == "visible" else "cm-off")
    group.append_anim(
        draw.Animate(
            "visibility",
            f"{turn_s:g}s",
            ";".join(changes.values()),
            calcMode="discrete",
            keyTimes=_key_times(changes),
            repeatCount="indefinite",
        )
    )
    return group


def _key_times(angles_deg: Iterable[float] | Floats) -> str:
    return ";".join(_short(angle / DEG_PER_TURN, 6) for angle in angles_deg)


def _short(value: float, digits: int) -> str:
    return trimmed(px(value, digits), digits)

"""What the pictures of answers are drawn with: a light ground of their own, and SVG in strings."""

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from html import escape
from typing import TypeAlias

from cammotion.teaching.example import MillAndDie
from cammotion.views.animation.still import as_image

WIDTH, HEIGHT = 520, 190  # px
MILL, DIE, ALARM, INK, GREY = "#0072B2", "#D55E00", "#b3001b", "#1b1b1b", "#767676"
PALE_MILL, PALEST_MILL, PALE_DIE = "#cfe3ef", "#eef6fb", "#f8dfcf"
MILL_TEXT, DIE_TEXT = "#00466d", "#8a3c00"

_HATCH = (
    '<defs><pattern id="alarm" width="7" height="7" patternUnits="userSpaceOnUse">'
    f'<path d="M0 7 7 0" stroke="{ALARM}" stroke-width="1.5"/></pattern></defs>'
)

Point: TypeAlias = tuple[float, float]


@dataclass(frozen=True)
class Shown:
    """What an answer would do: a picture, and the same in words."""

    svg: str
    line: str

    @property
    def html(self) -> str:
        """The picture for a page, which a screen reader reads as the line."""
        return as_image(self.svg, self.line)


Measure: TypeAlias = Callable[[MillAndDie], float]
"""A number of a machine."""

Shows: TypeAlias = Callable[[MillAndDie, float], Shown | None]
"""A kind of picture: what an answer, a number, would do in a machine; None where nothing is seen.

It may raise: then nothing is shown.
"""


class Frame:
    """A picture that is drawn part by part, in px."""

    def __init__(self) -> None:
        self._parts: list[str] = []

    def box(self, x: float, y: float, width: float, height: float, fill: str) -> None:
        """Draw a filled rectangle."""
        self._parts.append(
            f'<rect x="{_px(x)}" y="{_px(y)}" width="{_px(max(width, 0))}" '
            f'height="{_px(max(height, 0))}" fill="{fill}"/>'
        )

    def alarm(self, x: float, y: float, width: float, height: float) -> None:
        """Draw the hatch that says collision without its colour too."""
        self.box(x, y, max(width, 4), height, "url(#alarm)")

    def line(
        self, points: Iterable[Point], colour: str = INK, width: float = 2, dashes: str = ""
    ) -> None:
        """Draw a line through points."""
        dashed = f' stroke-dasharray="{dashes}"' if dashes else ""
        self._parts.append(
            f'<path d="M{_path(points)}" fill="none" stroke="{colour}" stroke-width="{width:g}" '
            f'stroke-linejoin="round"{dashed}/>'
        )

    def area(self, points: Iterable[Point], fill: str) -> None:
        """Draw a filled polygon."""
        self._parts.append(f'<path d="M{_path(points)}Z" fill="{fill}"/>')

    def dot(self, x: float, y: float, colour: str = DIE) -> None:
        """Draw a dot."""
        self._parts.append(f'<circle cx="{_px(x)}" cy="{_px(y)}" r="4" fill="{colour}"/>')

    def text(self, x: float, y: float, text: str, colour: str = INK, anchor: str = "start") -> None:
        """Write a text; a white seam keeps it readable over lines."""
        self._parts.append(
            f'<text x="{_px(x)}" y="{_px(y)}" fill="{colour}" text-anchor="{anchor}">'
            f"{escape(text)}</text>"
        )

    def show(self, line: str) -> Shown:
        """Return what was drawn, with its line."""
        svg = (
            f'<svg xmlns="http://www.w3.org/2000/svg" width="{WIDTH}" height="{HEIGHT}" '
            f'viewBox="0 0 {WIDTH} {HEIGHT}" font-size="12" '
            'font-family="DejaVu Sans, Verdana, Arial, sans-serif">'
            f"<title>{escape(line)}</title>{_HATCH}"
            "<style>text{stroke:#fff;stroke-width:3;paint-order:stroke;stroke-linejoin:round}"
            f'</style><rect width="{WIDTH}" height="{HEIGHT}" rx="4" fill="#fff"/>'
            f"{''.join(self._parts)}</svg>"
        )
        return Shown(svg, line)


def _px(value: float) -> str:
    return f"{round(float(value) + 1e-9, 1) or 0.0:g}"  # a tie is rounded one way everywhere


def _path(points: Iterable[Point]) -> str:
    return "L".join(f"{_px(x)} {_px(y)}" for x, y in points)

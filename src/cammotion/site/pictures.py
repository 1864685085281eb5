"""Pictures as a page wants them: files of their own, small, with their size known beforehand."""

import base64
import io
import re
from dataclasses import dataclass, field
from html import escape
from pathlib import Path
from xml.etree import ElementTree

from PIL import Image

from cammotion.quantities import InputError

_COLOURS = 48
_MOVES = "<animate"
_MOVE = re.compile(r"<(animate\w*)\b[^>]*(?:/>|>\s*</\1>)")
_EMBEDDED = re.compile(r'src="data:image/svg\+xml;base64,([^"]+)"')
IMAGES = "images"


@dataclass(frozen=True)
class Pictures:
    """The pictures of a page: its own files by their names, and the drawings that pages share."""

    lesson: str
    drawings: Path
    own: dict[str, bytes] = field(default_factory=dict)
    shared: dict[str, bytes] = field(default_factory=dict)

    def png(self, name: str, content: bytes, words: str) -> str:
        """Return the element of a PNG, which becomes a file with few colours."""
        small, (width, height) = with_palette(content)
        file = f"pictures/{self.lesson}/{name}.png"
        self.own[file] = small
        return (
            f'<img class="cm-paper" src="{file}" alt="{escape(words)}" width="{width}" '
            f'height="{height}" style="--wide:{width}px" loading="lazy" decoding="async">'
        )

    def drawing(self, name: str, words: str, *, is_first: bool = False) -> str:
        """Return the element of a drawing of the workbook; one that moves can be stopped."""
        svg, (width, height) = self._read(name)
        file = f"{IMAGES}/{name}"
        self.shared[file] = svg.encode()
        lazy = ' fetchpriority="high"' if is_first else ' loading="lazy"'
        image = (
            f'<img class="cm-paper" src="{file}" alt="{escape(words)}" width="{width:.0f}" '
            f'height="{height:.0f}"{lazy}>'
        )
        if _MOVES not in svg:
            return image
        still = file.replace(".svg", "-still.svg")
        self.shared[still] = at_rest(svg).encode()
        calm = f'<source media="(prefers-reduced-motion: reduce)" srcset="{still}">'
        return (
            f'<span class="moving" data-still="{still}"><picture>{calm}{image}</picture>'
            '<button type="button" hidden>Stop the motion</button></span>'
        )

    def _read(self, name: str) -> tuple[str, tuple[float, float]]:
        """Return a drawing, and its size in px."""
        path = self.drawings / name
        if path.suffix != ".svg" or not path.is_file():
            raise InputError(
                f"The notebooks show the picture {name}, which is not there as an SVG: lay one "
                f"into the folder {IMAGES}, and show that."
            )
        try:
            svg = path.read_text("utf-8")
            return svg, size_of(svg)
        except (ValueError, KeyError, ElementTree.ParseError):
            raise InputError(
                f"The picture {name} cannot be read: give an SVG in UTF-8 with a viewBox of four "
                'numbers, such as viewBox="0 0 640 480".'
            ) from None


def with_palette(png: bytes) -> tuple[bytes, tuple[int, int]]:
    """Return a PNG with a palette of few colours, a third of its bytes, and its size in px."""
    with Image.open(io.BytesIO(png)) as opened:
        picture = opened.convert("RGB")
    few = picture.quantize(_COLOURS, Image.Quantize.MEDIANCUT, dither=Image.Dither.NONE)
    written = io.BytesIO()
    few.save(written, "PNG", optimize=True)
    return min(written.getvalue(), png, key=len), picture.size


def size_of(svg: str) -> tuple[float, float]:
    """Return the width and the height of a drawing in px."""
    root = ElementTree.fromstring(svg)  # noqa: S314 - our own
    _, _, width, height = map(float, root.attrib["viewBox"].replace(",", " ").split())
    return width, height


def at_rest(svg: str) -> str:
    """Return a drawing as it is without its animation.

    >>> at_rest('<g><animateTransform dur="9s" /></g>')
    '<g></g>'
    """
    return _MOVE.sub("", svg)


def embedded_svg(html: str) -> str:
    """Return the drawing that an output holds in an image, "" if there is none."""
    found = _EMBEDDED.search(html)
    return base64.b64decode(found[1]).decode() if found else ""

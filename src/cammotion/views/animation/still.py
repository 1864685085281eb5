"""What an animation shows, as it stands at one cam angle."""

import base64
import html
from dataclasses import dataclass
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import numpy as np

from cammotion.files import ending, write_new
from cammotion.machine.kinematics import DEG_PER_TURN
from cammotion.views.paper import STYLE
from cammotion.views.scales import trimmed

_SVG = "http://www.w3.org/2000/svg"
ElementTree.register_namespace("", _SVG)


@dataclass(frozen=True)
class Still:
    """A picture of machines at one cam angle; made by `still` of an animation.

    As the last line of a cell it is the picture, with its `description` for those who do not see
    it.
    """

    svg: str
    description: str

    def save(self, path: str | Path, *, overwrite: bool = False) -> Path:
        """Write the SVG to a file that ends in .svg and return its path.

        A file that is there already is left as it is, with an InputError, unless `overwrite` is
        True.
        """
        ending(path, "picture", [".svg"])
        return write_new(path, self.svg, overwrite=overwrite)

    def _repr_mimebundle_(self, **_: Any) -> dict[str, Any]:
        return {"text/html": as_image(self.svg, self.description), "text/plain": self.description}


def as_image(svg: str, description: str) -> str:
    """Return an SVG as an image for a page, with its description in words."""
    picture = base64.b64encode(svg.encode()).decode("ascii")
    return (
        f'{STYLE}<figure style="margin: 0"><img class="cm-paper" alt="{html.escape(description)}" '
        f'style="max-width: 100%" src="data:image/svg+xml;base64,{picture}"></figure>'
    )


def stopped(svg: str, angle_deg: float) -> str:
    """Return an SVG of ours with everything as it is at a cam angle in deg, and nothing moving."""
    root = ElementTree.fromstring(svg)  # noqa: S314 - our own
    at = angle_deg / DEG_PER_TURN
    for group in root.iter(f"{{{_SVG}}}g"):
        group.attrib.pop("class", None)  # the reader's wish for less motion is fulfilled
        for animation in list(group):
            if animation.tag == f"{{{_SVG}}}animateTransform":
                group.set("transform", f"{animation.get('type')}({_between(animation, at)})")
            elif animation.tag == f"{{{_SVG}}}animate":
                times = _key_times(animation)
                place = int(np.searchsorted(times, at % 1, side="right")) - 1  # 360 deg are 0
                group.set("visibility", _values(animation)[place])
            else:
                continue
            group.remove(animation)
    return ElementTree.tostring(root, encoding="unicode")


def _between(animation: ElementTree.Element, at: float) -> str:
    """Return the numbers of a transform at this share of the turn."""
    values = np.array([[float(n) for n in value.split()] for value in _values(animation)])
    now = [np.interp(at, _key_times(animation), column) for column in values.T]
    return " ".join(trimmed(number, 4) for number in now)


def _values(animation: ElementTree.Element) -> list[str]:
    return animation.attrib["values"].split(";")


def _key_times(animation: ElementTree.Element) -> list[float]:
    return [float(time) for time in animation.attrib["keyTimes"].split(";")]

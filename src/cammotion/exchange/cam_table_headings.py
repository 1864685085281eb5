"""What the words over a column of a cam table say: what it is, and in what unit."""

import re
from collections.abc import Iterator, Sequence
from itertools import pairwise
from typing import NamedTuple

from cammotion.measured.inch import MM_PER_INCH
from cammotion.quantities import InputError

ANGLE, TIME, DISTANCE, POSITION = "angle", "time", "distance", "position"
INDEX, OTHER, UNKNOWN = "index", "other", ""

_SURE = {  # tokens that are units wherever they stand
    "deg": ["deg", "degs", "degree", "degrees", "°", "º", "grad"],
    "rad": ["rad", "radian", "radians"],
    "turn": ["turn", "turns", "rev", "revs", "rev.", "revolution", "umdrehung", "normalized"],
    "percent": ["percent", "prozent"],
    "ms": ["ms", "msec"],
    "s": ["sec", "second", "seconds", "sekunden"],
    "mm": ["mm", "millimeter", "millimetre", "millimeters", "millimetres"],
    "cm": ["cm"],
    "um": ["um", "µm", "μm", "micron", "microns", "micrometer", "micrometre"],
    "in": ["inch", "inches", "zoll", '"', "″", "in."],
}
_AT_THE_END = {"s": "s", "m": "m", "in": "in", "%": "percent"}  # units in brackets, or last
_WORDS = {
    INDEX: ["no", "no.", "nr", "nr.", "index", "idx", "point", "points", "punkt", "id", "n", "#"],
    OTHER: [
        *["velocity", "speed", "vel", "v", "acceleration", "accel", "acc", "a", "jerk", "j"],
        *["geschwindigkeit", "beschleunigung", "ruck", "force", "kraft", "torque", "moment"],
        *["pressure", "radius", "curvature", "pulse", "snap", "error", "comment", "type"],
    ],
    TIME: ["time", "zeit", "t"],
    ANGLE: ["angle", "winkel", "theta", "θ", "phi", "φ", "drehwinkel", "nockenwinkel"],
    POSITION: [
        *["position", "pos", "lift", "hub", "displacement", "weg", "stroke", "rise", "travel"],
        *["slave", "follower", "y", "following", "elevation", "lage"],
    ],
    DISTANCE: ["distance", "length"],
}
_MEANT = {token: unit for unit, tokens in _SURE.items() for token in tokens}
_KINDS = {token: kind for kind, tokens in _WORDS.items() for token in tokens}
_RATE = re.compile(r"(?:mm|cm|\bm|in|inch|deg|rad|°)\W*(?:/|\bper\b|·|\bs\^?-)|[²³]|\^[23]")
_SCALED = re.compile(
    r"(?<![\w.])((?:[\d.,^*·×/x-]|1e)*\d\s*(?:mm|cm|[uµμ]m|inch|zoll))\b", re.IGNORECASE
)
_BRACKET = re.compile(r"\[([^\]]*)\]")
_KIND_OF = {"deg": ANGLE, "rad": ANGLE, "turn": ANGLE, "percent": ANGLE, "ms": TIME, "s": TIME}
LENGTHS = {"mm": 1.0, "cm": 10.0, "m": 1000.0, "um": 1e-3, "in": MM_PER_INCH}  # mm


class Heading(NamedTuple):
    """What a column is said to be, in its own words too; both are empty where nobody knows."""

    kind: str
    unit: str
    words: str = ""


def heading_of(words: str) -> Heading:
    """Return what the heading of a column says.

    >>> heading_of("Cam angle [deg]")[:2], heading_of("s in mm")[:2], heading_of("lift_in")[:2]
    (('angle', 'deg'), ('', 'mm'), ('position', 'in'))
    >>> heading_of("velocity in m/s")[:2], heading_of("t [s]")[:2], heading_of("Leitwert (mm)")[:2]
    (('other', ''), ('time', 's'), ('', 'mm'))
    """
    text = re.sub(r'"([^"]*)"', r" \1 ", words.lower())  # a pair of them quotes
    text = re.sub(r"([°º\"″%])", r" \1 ", text.replace("0..1", "turn").replace("_", " "))
    tokens = re.findall(r"[^\s\[\](){}<>,:;=/|]+", text)
    kinds = [_KINDS[token] for token in tokens if token in _KINDS]
    if OTHER in kinds or _RATE.search(text):
        return Heading(OTHER, "", words)
    unit = _unit(text, tokens)
    if INDEX in kinds and not unit and len(kinds) == len(tokens):
        return Heading(INDEX, "", words)
    kind = next((kind for kind in kinds if kind != INDEX), _KIND_OF.get(unit, UNKNOWN))
    return Heading(kind, unit, words)


def odd_unit(heading: Heading) -> str:
    """Return the unit that a heading gives to lengths if it is none of ours, as 1/100 mm; or ''.

    >>> odd_unit(heading_of("lift in 1/100 mm")), odd_unit(heading_of("lift [thou]"))
    ('1/100 mm', 'thou')
    >>> odd_unit(heading_of("lift [mm]")) == odd_unit(heading_of("lift (at the roller)")) == ""
    True
    """
    scaled = _SCALED.search(heading.words.replace("_", " "))
    bracket = None if heading.unit else _BRACKET.search(heading.words)
    found = scaled or bracket
    return found[1].strip() if found else ""


def two_headings(line: str) -> tuple[Heading, Heading]:
    """Return what a line says of an angle and a position if it is not cut as the columns are.

    >>> [heading.unit for heading in two_headings("cam angle in deg lift [inch] v [mm/s]")]
    ['deg', 'in']
    """
    units = [unit for unit in _units_in(line.lower()) if unit]
    masters = [unit for unit in units[:1] if unit in _KIND_OF]
    lengths = [unit for unit in units if unit in LENGTHS]
    if not masters and len(lengths) > 1:  # of the way of the master, and of the position
        masters = [lengths.pop(0)]
    master, length = (masters or [""])[0], (lengths or [""])[0]
    return Heading(_KIND_OF.get(master, UNKNOWN), master), Heading(UNKNOWN, length)


def _units_in(line: str) -> Iterator[str]:
    """Yield the units in a line in turn; '' where there is none, or a rate."""
    words = re.sub(r"[\[(]\s*([^\])]*?)\s*[\])]", r" _\1", line).replace("0..1", "turn").split()
    for before, word in pairwise(["", *words]):
        mark, _, end = word.rpartition("_") if "_" in word else word.rpartition("/")
        if _RATE.search(word):
            yield ""
        elif before == "in" or mark or word.startswith(("_", "/")):
            yield _MEANT.get(end) or _AT_THE_END.get(end, "")
        else:
            yield _MEANT.get(word, "")


def pick(headings: Sequence[Heading]) -> tuple[int, int]:
    """Return which columns are that of the angle, time or distance, and that of the position.

    Raises InputError where the headings name several positions.
    """
    places = range(len(headings))
    useful = [n for n in places if headings[n].kind not in {INDEX, OTHER}]
    if len(useful) < 2:  # noqa: PLR2004 - nothing helps: the first two
        return 0, 1
    masters = [
        n for kind in (ANGLE, TIME, DISTANCE) for n in useful if headings[n].kind == kind
    ] or useful
    first = masters[0]
    others = [n for n in useful if n != first and headings[n].kind not in {ANGLE, TIME}]
    named = [n for n in others if headings[n].kind == POSITION or headings[n].unit in LENGTHS]
    if len(named) > 1:
        listed = ", ".join(f"{n + 1} ({headings[n].words})" for n in named)
        raise InputError(
            f"Several columns are positions by their headings, {listed}: give the two that you "
            f"mean as columns, for example columns=({first + 1}, {named[0] + 1})."
        )
    return first, (named or others or [n for n in useful if n != first])[0]


def _unit(text: str, tokens: list[str]) -> str:
    """Return the unit that a heading names, or ''."""
    in_brackets = re.findall(r"[\[(]\s*([^\s\])]+)\s*[\])]", text)
    for token in [*in_brackets, *tokens]:
        if token in _MEANT and token != "in.":  # noqa: S105 - a word, no secret
            return _MEANT[token]
    last = in_brackets or (tokens[-1:] if tokens != ["s"] else [])  # a symbol of the way, alone
    ends = {**_AT_THE_END, "in.": "in"}
    return next((ends[token] for token in last if token in ends), "")

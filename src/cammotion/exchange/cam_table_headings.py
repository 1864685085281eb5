"""What the words over a column of a cam table say: what it is, and in what unit."""

import re
from collections.abc import Iterator, Sequence
from itertools import pairwise
from typing import NamedTuple

from cammotion.measured.inch import MM_PER_INCH
from cammotion.quantities import InputError

ANGLE, TIME, DISTANCE, POSITION = "angle", "time", "distance", "position"
INDEX, RADIUS, OTHER, UNKNOWN = "index", "radius", "other", ""

_SURE = {  # tokens that are units wherever they stand
    "deg": ["deg", "degs", "degree", "degrees", "°", "º", "grad"],
    "rad": ["rad", "radian", "radians"],
    "turn": ["turn", "turns", "rev", "revs", "rev.", "revolution", "umdrehung", "normalized"],
    "percent": ["percent", "prozent"],
    "ms": ["ms", "msec"],
    "s": ["sec", "second", "seconds", "sekunden"],
    "mm": ["mm", "millimeter", "millimetre", "millimeters", "millimetres"],
    "cm": ["cm", "centimeter", "centimetre", "centimeters", "centimetres", "zentimeter"],
    "m": ["meter", "metre", "meters", "metres"],
    "um": [
        *["um", "µm", "μm", "micron", "microns", "micrometer", "micrometre", "micrometers"],
        *["micrometres", "mikrometer"],
    ],
    "in": ["inch", "inches", "zoll", '"', "″", "in."],
}
_AT_THE_END = {"s": "s", "m": "m", "in": "in", "%": "percent"}  # units in brackets, or last
_WORDS = {
    INDEX: ["no", "no.", "nr", "nr.", "index", "idx", "point", "points", "punkt", "id", "n", "#"],
    OTHER: [
        *["velocity", "speed", "vel", "v", "acceleration", "accel", "acc", "a", "jerk", "j"],
        *["geschwindigkeit", "beschleunigung", "ruck", "force", "kraft", "torque", "moment"],
        *["pressure", "curvature", "pulse", "snap", "error", "comment", "type"],
    ],
    RADIUS: ["radius", "radii"],  # of the pitch curve, where there is no lift
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
_RATE = re.compile(r"(?:mm|cm|\bm|in|inch|deg|rad|°)\W*(?:/|\bper\b|·|\bs(?:\^?-|⁻))|[²³]|\^[23]")
_BRACKET = re.compile(r"\[([^\]]*)\]")
_KIND_OF = {"deg": ANGLE, "rad": ANGLE, "turn": ANGLE, "percent": ANGLE, "ms": TIME, "s": TIME}
LENGTHS = {"mm": 1.0, "cm": 10.0, "m": 1000.0, "um": 1e-3, "in": MM_PER_INCH}  # mm

_HIGH = "⁰¹²³⁴⁵⁶⁷⁸⁹"
_TOKENS = [re.escape(word) for unit in LENGTHS for word in _SURE[unit] if word != "in."]
_LENGTH = rf"(?:{'|'.join(sorted([*_TOKENS, 'm'], key=len, reverse=True))})(?!\w)"
_FACTOR = rf"(?<![\w.,])(?:[\d.,^*·×/x{_HIGH}⁻+-]|\de){{0,30}}[\d{_HIGH}]\s*[x×*·]?\s*"
_TENTHS = (  # what can be nothing but a factor
    r"(?<![\w.,])(?:[x×*·]\s*)?(?:0?[.,]0*1|1\s*/\s*10+|1(?:[.,]0*)?e[+-]?\d+|10\s*(?:\^|\*\*)\s*[+-]?\d+"
    rf"|10⁻?[{_HIGH}]+)\s*[x×*·]?\s*[)\]]?\s*"
)
_PARTS = r"\b(?:tenth|hundredth|thousandth|zehntel|hundertstel|tausendstel)\w*"
_SURELY_SCALED = re.compile(
    rf"{_TENTHS}(?:{_LENGTH}|in\b(?!\.?\s+{_LENGTH}))"
    r"|\b(?:milli|micro)[\s-]*in(?:ch(?:es)?)?(?!\w)"
    rf"|{_PARTS}[\s-]*(?:of\s+)?(?:an?\s+)?(?:{_LENGTH}|in\b|$)"
    rf"|(?<=\bin ){_TENTHS}$"
    r"|(?:[×*]\s*10+|(?<!\w)x\s?100+)(?!\w)|(?<!\w)10+\s*[×*]",
    re.IGNORECASE,
)
_SCALED = re.compile(
    rf"{_FACTOR}(?:{_LENGTH}|in\b(?:\.|(?!\s+\w)))"  # Hub 2 in mm is none
    rf"|(?<!\w)(?:{_LENGTH}[\s)\]]*[x×*·/÷]|in\b[\s.)\]]*[×*·/÷])\s*[\d.,]*\d",
    re.IGNORECASE,
)
_FOREIGN = re.compile(  # units of none of ours
    r"(?<!\w)(?:mils?|thous?|ft|feet|foot|fuß|yd|yards?|dm|de[cz]imet\w+|nm|nanomet\w+|km"
    r"|kilomet\w+|[µμ]|[µμu]in(?:ch\w*)?|counts|cts|increments?|inkremente?|pulses|ticks|units)(?!\w)",
    re.IGNORECASE,
)


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
    >>> heading_of("cam radius, inches")[:2], heading_of("error in µm")[:2]
    (('radius', 'in'), ('other', 'um'))
    """
    text = _unquoted(words.lower())
    text = re.sub(r"([°º\"″%])", r" \1 ", text.replace("0..1", "turn").replace("_", " "))
    tokens = re.findall(r"[^\s\[\](){}<>,:;=/|]+", text)
    kinds = [_KINDS[token] for token in tokens if token in _KINDS]
    if _RATE.search(text):
        return Heading(OTHER, "", words)
    unit = _unit(text, tokens)
    for kind in (OTHER, RADIUS):
        if kind in kinds:
            return Heading(kind, unit, words)
    if INDEX in kinds and not unit and len(kinds) == len(tokens):
        return Heading(INDEX, "", words)
    kind = next((kind for kind in kinds if kind != INDEX), _KIND_OF.get(unit, UNKNOWN))
    return Heading(kind, unit, words)


def odd_unit(heading: Heading) -> str:
    """Return the unit that a heading gives to lengths if it is none of ours, as 1/100 mm; or ''.

    >>> odd_unit(heading_of("lift in 1/100 mm")), odd_unit(heading_of("lift [thou]"))
    ('1/100 mm', 'thou')
    >>> odd_unit(heading_of("lift 1e-3 in")), odd_unit(heading_of("lift, mils"))
    ('1e-3 in', 'mils')
    >>> odd_unit(heading_of("lift [mm]")) == odd_unit(heading_of("lift (at the roller)")) == ""
    True
    """
    words = _unquoted(heading.words.replace("_", " "))
    if scaled := _SURELY_SCALED.search(words) or _SCALED.search(words):
        return scaled[0].strip()
    if heading.unit or is_rate(heading):
        return ""
    if bracket := _BRACKET.search(words):
        return bracket[1].strip()
    foreign = _FOREIGN.search(words)
    return foreign[0] if foreign else ""


def is_rate(heading: Heading) -> bool:
    """Return whether the unit of a column is that of a velocity, or of anything but a length.

    >>> is_rate(heading_of("velocity in mm/s")), is_rate(heading_of("velocity"))
    (True, False)
    """
    return heading.kind == OTHER and bool(_RATE.search(heading.words.lower()))


def two_headings(line: str) -> tuple[Heading, Heading]:
    """Return what a line says of an angle and a position if it is not cut as the columns are.

    >>> [heading.unit for heading in two_headings("cam angle in deg lift [inch] v [mm/s]")]
    ['deg', 'in']
    >>> odd_unit(two_headings("angle in deg lift in 1/100 mm")[1])
    '1/100 mm'
    """
    words = _words_in(line)
    units = [(n, unit) for n, unit in enumerate(_units_of(words)) if unit]
    masters = [each for each in units[:2] if each[1] in _KIND_OF]
    lengths = [each for each in units if each[1] in LENGTHS]
    if not masters and len(lengths) > 1:  # of the way of the master, and of the position
        masters = [lengths.pop(0)]
    at, master = (masters or [(-1, "")])[0]
    end, length = (lengths or [(len(words), "")])[0]
    scaled = _SURELY_SCALED.search(line)
    said = scaled[0] if scaled else ""
    if masters:  # what is said after the length is of something else
        said = " ".join(words[at + 1 if at < end else 0 : end + 1]).replace("_", " ")
    return Heading(_KIND_OF.get(master, UNKNOWN), master), Heading(UNKNOWN, length, said)


def _words_in(line: str) -> list[str]:
    """Return the words of a line; what is in brackets has a _ in front."""
    words = re.sub(r"[\[(]\s*([^\])]*?)\s*[\])]", r" _\1", line.lower())
    return words.replace("0..1", "turn").split()


def _units_of(words: list[str]) -> Iterator[str]:
    """Yield the unit that each word is; '' where it is none, or a rate."""
    for n, (before, word) in enumerate(pairwise(["", *words]), 1):
        mark, _, end = word.rpartition("_") if "_" in word else word.rpartition("/")
        is_last = n == len(words) and word in {"in", "m"}
        if _RATE.search(word):
            yield ""
        elif before == "in" or mark or word.startswith(("_", "/")) or is_last:
            yield _MEANT.get(end) or _AT_THE_END.get(end, "")
        else:
            yield _MEANT.get(word, "")


def pick(headings: Sequence[Heading]) -> tuple[int, int]:
    """Return which columns are that of the angle, time or distance, and that of the position.

    Raises InputError where the headings name several positions.
    """
    useful = [n for n, each in enumerate(headings) if each.kind not in {INDEX, OTHER}]
    if len(useful) < 2:  # noqa: PLR2004 - nothing helps: the first two
        return 0, 1
    masters = [n for kind in (ANGLE, TIME, DISTANCE) for n in useful if headings[n].kind == kind]
    plain = [n for n in useful if headings[n].kind != RADIUS]
    first = (masters or plain or useful)[0]
    others = [n for n in useful if n != first and headings[n].kind not in {ANGLE, TIME}]
    others = [n for n in others if n in plain] or others
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


def _unquoted(words: str) -> str:
    """Return words without pairs of quotation marks; one alone stands for inches."""
    return re.sub(r'"([^"]*)"', r" \1 ", words)

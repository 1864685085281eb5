"""Packaging machines with many mechanisms, and names that a picture could spoil.

The machine of eight erects cartons and closes them; that of 24 also fills, prints and stacks them.
"""

from collections.abc import Sequence
from itertools import cycle, islice

import cammotion as cm
from cammotion.machine.motions import Motion
from cammotion.rules.clearance import ClearanceRule

RATE = 3600  # cartons/h

# name, stroke in mm, cam angle of its start, angles of way out, stay and way back in deg
Row = tuple[str, float, float, float, float, float]
EIGHT: Sequence[Row] = [
    ("blank sucker", 85, 100, 60, 20, 70),
    ("carton erector", 140, 130, 75, 25, 75),
    ("product pusher", 220, 140, 80, 10, 90),
    ("lower flap folder", 32, 95, 45, 130, 45),
    ("upper flap folder", 32, 120, 45, 105, 45),
    ("tuck-in tongue", 58, 180, 50, 15, 50),
    ("ejector", 110, 200, 60, 5, 70),
]
MORE: Sequence[Row] = [
    ("magazine gate", 12, 60, 30, 40, 30),
    ("leaflet folder", 45, 20, 60, 30, 60),
    ("leaflet inserter", 150, 110, 70, 10, 80),
    ("product stop", 18, 300, 30, 200, 30),
    ("product lift", 64, 40, 60, 60, 60),
    ("vacuum slide valve", 6, 95, 15, 90, 15),
    ("left side flap", 40, 150, 40, 100, 40),
    ("right side flap", 40, 155, 40, 95, 40),
    ("glue nozzle", 9, 170, 20, 60, 20),
    ("closing press", 15, 250, 35, 40, 35),
    ("embossing punch", 4, 230, 20, 30, 20),
    ("code stamp", 22, 270, 40, 5, 40),
    ("reject flap", 35, 310, 45, 30, 45),
    ("stacking fork", 180, 200, 90, 20, 110),
    ("outfeed clamp", 25, 20, 40, 170, 40),
]
ODD_NAMES = [
    "n" * 10_000,
    "the lower left one of both hot sealing jaws of the second station, seen from the outfeed",
    "\u200b",  # no space for Python, and nothing to be seen
    "包装機の製品プッシャー",
    "Sto\u0308ßel mit Fu\u0308hrungsla\u0308nge",
    "$\\frac{1}{$",
    "x_1^2",
    '<b>die</b> & "co"',
    "a\tb\nc\r\nd",
    "\x00\x07bell",
    "\u202eright to left",
    "😀" * 30,
    "a" + "\u0301" * 60,
    "𓀀𓀁",
]
"""Long, empty to the eye, of CJK and combining characters, formulas, markup, control characters."""


def carton_turret(name: str = "carton turret") -> Motion:
    """Return the indexing turret that takes a carton from station to station."""
    parts = cm.rise(95, over_deg=110), cm.dwell(250)
    return cm.indexing_motion(name, *parts, stops=8, start_deg=350)


def tool(row: Row) -> Motion:
    """Return a mechanism that goes out, stays, and comes back."""
    name, stroke, start, out, stay, back = row
    return cm.motion(
        name,
        cm.rise(stroke, over_deg=out, law="modified sine"),
        cm.dwell(stay),
        cm.return_(stroke, over_deg=back, law="modified sine"),
        cm.dwell(360 - out - stay - back),
        start_deg=start,
    )


def packaging_machine(mechanisms: int, names: Sequence[str] = ()) -> cm.TimingDiagram:
    """Return a machine of so many mechanisms, with other names for the first of them if given.

    From the 24th on the same come again on another lane.
    """
    rows = [
        (f"{row[0]}, lane {number // 22 + 1}" if number >= 22 else row[0], *row[1:])
        for number, row in enumerate(islice(cycle([*EIGHT, *MORE]), mechanisms - 1))
    ]
    given = dict(enumerate(names))
    tools = [tool((given.get(n + 1, row[0]), *row[1:])) for n, row in enumerate(rows)]
    motions = [carton_turret(given.get(0, "carton turret")), *tools]
    return cm.TimingDiagram(motions, RATE)


def pusher_rule(diagram: cm.TimingDiagram) -> ClearanceRule:
    """Return the rule that the fourth mechanism reaches in only while the turret stands."""
    turret, pusher = diagram.names[0], diagram.names[min(3, len(diagram.names) - 1)]
    return ClearanceRule(cm.beyond(pusher, 15), only_while=cm.within(turret, 0.5))


def all_dies(diagram: cm.TimingDiagram) -> list[ClearanceRule]:
    """Return a rule for each mechanism that reaches into the turret."""
    turret = diagram.names[0]
    return [
        ClearanceRule(cm.beyond(name, 2), only_while=cm.within(turret, 0.5))
        for name in diagram.names[1:]
    ]

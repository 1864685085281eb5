"""What it costs to find collisions, and the widest move that is free of them."""

from itertools import pairwise
from statistics import median

from findings import Finding, say
from package import seconds_of

from cammotion import (
    ClearanceRule,
    TimingDiagram,
    beyond,
    dwell,
    find_violations,
    indexing_motion,
    motion,
    return_,
    rise,
    widest_move,
    within,
)

RATE = 2000
MS = 1000
SOLVES = 1000
CHECKS = 200
MOTIONS, RULES = 12, 20
SIZES = (2, 4, 8, 12, 24)


def measure_overlap() -> list[Finding]:
    """Solve for the widest move of the die, and check diagrams of up to 24 motions."""
    machine, rules = make_machine(MOTIONS), make_rules(MOTIONS, RULES)
    solved, checked = time_widest_move(), time_check(machine, rules)
    say("motions  rules  violations  check")
    for size in SIZES:
        say(describe_check(size))
    return [
        Finding(f"widest move, median of {SOLVES}", solved, 2, "ms"),
        Finding(f"check of {MOTIONS} motions with {RULES} rules, median", checked, 20, "ms"),
    ]


def time_widest_move() -> float:
    """Return the median time in ms of solving for the widest move of the source's die."""
    mill = indexing_motion("mill", rise(100, over_deg=150), dwell(210), stops=24)
    parts = rise(50, over_deg=55), dwell(100), return_(50, over_deg=55), dwell(150)
    diagram = TimingDiagram([mill, motion("die", *parts, start_deg=150)], RATE)
    rule = ClearanceRule(beyond("die", 19), only_while=within("mill", 0.65))
    return MS * median(seconds_of(lambda: widest_move(diagram, "die", rule)) for _ in range(SOLVES))


def time_check(diagram: TimingDiagram, rules: list[ClearanceRule]) -> float:
    """Return the median time in ms of checking a diagram against its rules."""
    return MS * median(seconds_of(lambda: find_violations(diagram, rules)) for _ in range(CHECKS))


def describe_check(motions: int) -> str:
    """Return the row of the table for a machine with as many rules as pairs of neighbours."""
    diagram, rules = make_machine(motions), make_rules(motions, motions)
    found = len(find_violations(diagram, rules))
    return f"{motions:>7}{motions:>7}{found:>12}{time_check(diagram, rules):>8.2f} ms"


def make_machine(motions: int) -> TimingDiagram:
    """Return a machine whose mechanisms do the same one after the other, each a little wider."""
    return TimingDiagram(
        [
            motion(
                f"m{n}",
                *(rise(50, over_deg=50 + n), dwell(100), return_(50, over_deg=50 + n)),
                dwell(160 - 2 * n),
                start_deg=n * 360 / motions,
            )
            for n in range(motions)
        ],
        RATE,
    )


def make_rules(motions: int, number: int) -> list[ClearanceRule]:
    """Return rules between neighbours, each round of them with another limit."""
    names = [f"m{n % motions}" for n in range(number + 1)]
    return [
        ClearanceRule(beyond(one, 5 + n % 40), only_while=within(other, 40 - n % 30))
        for n, (one, other) in enumerate(pairwise(names))
    ]

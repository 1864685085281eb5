"""What it costs to bring a whole machine to its best, and to prove how good any other could be."""

from time import perf_counter

import numpy as np
from findings import Finding, say
from overlap import RATE

from cammotion import (
    Camshaft,
    ClearanceRule,
    FollowerLoad,
    LeastPeak,
    Motion,
    TimingDiagram,
    beyond,
    dwell,
    indexing_motion,
    least_peak,
    motion,
    optimise,
    return_,
    rise,
    within,
)

SIZES = (2, 4, 8, 12, 24)
MOST_S, GAP_OF_TWO, GAP_OF_FOUR = 60, 0.02, 0.05
MOTIONS = 12
KG = 12
Arcs = dict[str, list[tuple[float, float]]]
Machine = tuple[TimingDiagram, list[ClearanceRule], Arcs]


def measure_whole_machine() -> list[Finding]:
    """Optimise machines of 2 to 24 mechanisms, and bound what any motions could reach."""
    two, seconds_of_two = time_bound(mill_and_die(), GAP_OF_TWO)
    four, seconds_of_four = time_bound(machine_of_four(), GAP_OF_FOUR)
    say(f"mill and die, {seconds_of_two:.1f} s: {two}")
    say(f"four mechanisms, {seconds_of_four:.1f} s: {four}")
    torque, seconds_of_torque = time_torque(machine_of_four())
    say(f"four mechanisms, least torque, {seconds_of_torque:.1f} s: {torque.splitlines()[0]}")
    say(torque.splitlines()[1])
    say("mechanisms  rules  optimised        time  bound            gap     time")
    costs = {size: describe_cost(size) for size in SIZES}
    return [
        Finding("mill and die: gap of the certificate", two.gap, GAP_OF_TWO, ""),
        Finding("mill and die: time of the certificate", seconds_of_two, MOST_S, "s"),
        Finding("four mechanisms: gap of the certificate", four.gap, GAP_OF_FOUR, ""),
        Finding("four mechanisms: time of the certificate", seconds_of_four, MOST_S, "s"),
        Finding("four mechanisms: time of the least torque", seconds_of_torque, 20, "s"),
        Finding("12 mechanisms: time of the least torque", time_torque(machine_of(12))[1], 20, "s"),
        Finding(f"{MOTIONS} mechanisms optimised", costs[MOTIONS], 20, "s"),
    ]


def time_bound(machine: Machine, gap: float) -> tuple[LeastPeak, float]:
    """Return what no motions of a machine can be below, and the time in s of finding it."""
    diagram, rules, still = machine
    start = perf_counter()
    found = least_peak(diagram, rules, still=still, gap=gap, seconds=MOST_S)
    return found, perf_counter() - start


def time_torque(machine: Machine) -> tuple[str, float]:
    """Return what is said of the least torque of a machine, and the time in s of finding it."""
    diagram, rules, still = machine
    shaft = Camshaft(diagram, {name: FollowerLoad(mass_kg=KG) for name in diagram.names})
    start = perf_counter()
    found = optimise(shaft, rules, still=still, minimise="torque")
    return repr(found), perf_counter() - start


def describe_cost(count: int) -> float:
    """Show the row of the table for so many mechanisms; return the time of the optimiser in s."""
    diagram, rules, still = machine_of(count)
    start = perf_counter()
    best = optimise(diagram, rules, still=still)
    seconds = perf_counter() - start
    found, more = time_bound((diagram, rules, still), GAP_OF_FOUR)
    say(
        f"{count:>10}{len(rules):>7}{best.reached:>11.4f} m/s2{seconds:>6.2f} s"
        f"{found.bound:>9.4f} m/s2{100 * found.gap:>7.1f} %{more:>7.1f} s"
    )
    return seconds


def mill_and_die() -> Machine:
    """Return the machine of the lessons; the die may go anywhere above the pocket."""
    mill = indexing_motion("mill", rise(100, over_deg=150), dwell(210), stops=24)
    parts = rise(50, over_deg=55), dwell(100), return_(50, over_deg=55), dwell(150)
    diagram = TimingDiagram([mill, motion("die", *parts, start_deg=150)], RATE)
    rule = ClearanceRule(beyond("die", 19), only_while=within("mill", 0.65))
    return diagram, [rule], {"mill": [(205, 305)], "die": [(205, 305)]}


def machine_of_four() -> Machine:
    """Return a mill that is fed, pressed into and emptied, with a rule for each that may collide.

    Feeder, die and ejector reach into the mill's pockets, and feeder and die into each other's way.
    """
    mill = indexing_motion("mill", rise(100, over_deg=130), dwell(230), stops=24)
    feeder = _slide("feeder", 80, (170, 190), 30)
    die = _slide("die", 50, (250, 300), 40)
    ejector = _slide("ejector", 30, (200, 235), 40)
    still: Arcs = {
        "mill": [(200, 290)],
        "feeder": [(170, 190)],
        "die": [(250, 300)],
        "ejector": [(200, 235)],
    }
    rules = [
        ClearanceRule(beyond(name, depth), only_while=within("mill", 0.65))
        for name, depth in (("feeder", 10), ("die", 19), ("ejector", 5))
    ]
    rules.append(ClearanceRule(beyond("die", 30), only_while=within("feeder", 20)))
    return TimingDiagram([mill, feeder, die, ejector], RATE), rules, still


def machine_of(count: int) -> Machine:
    """Return a mill with so many slides less one, at random, each in the way of the one before.

    They go down one after the other, however little time that leaves them.
    """
    rng = np.random.default_rng(count)
    shares = rng.uniform(0.5, 1.5, 3 * count)
    ends = np.cumsum(shares / shares.sum() * 360)
    mill = indexing_motion(
        "mill", rise(100, over_deg=float(ends[2])), dwell(360 - float(ends[2])), stops=24
    )
    motions, rules = [mill], []
    still: Arcs = {"mill": [(float(ends[2]) + 60, float(ends[2]) + 120)]}
    for number in range(1, count):
        down, work, up, end = map(float, ends[3 * number - 1 : 3 * number + 3])
        name, stroke = f"slide {number}", float(rng.uniform(10, 80))
        moves = rise(stroke, over_deg=work - down), return_(stroke, over_deg=end - up)
        parts = moves[0], dwell(up - work), moves[1], dwell(360 - end + down)
        motions.append(motion(name, *parts, start_deg=down))
        still[name] = [(work, up)]
        deep = beyond(name, stroke * float(rng.uniform(0.1, 0.7)))
        rules.append(ClearanceRule(deep, only_while=within("mill", 0.65)))
        if number > 1:
            half = float(np.ptp(motions[-2].range_mm)) / 2
            rules.append(ClearanceRule(deep, only_while=within(f"slide {number - 1}", half)))
    return TimingDiagram(motions, RATE), rules, still


def _slide(name: str, stroke: float, down: tuple[float, float], angle: float) -> Motion:
    work = down[1] - down[0]
    moves = rise(stroke, over_deg=angle), dwell(work), return_(stroke, over_deg=angle)
    rest = dwell(360 - 2 * angle - work)
    return motion(name, *moves, rest, start_deg=down[0] - angle)

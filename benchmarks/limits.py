"""What it costs to find the least peak acceleration of all motions, and how near it comes."""

from statistics import median

from findings import Finding, say
from overlap import RATE
from package import seconds_of

from cammotion import (
    ClearanceRule,
    LeastAcceleration,
    TimingDiagram,
    beyond,
    dwell,
    indexing_motion,
    least_acceleration,
    motion,
    return_,
    rise,
    within,
)

CELLS = 720
SIZES = (90, 180, 360, CELLS, 1440)
TIMES = 3
JERK = 20  # m/s3
TRAVEL = (0, 50)
PROGRAMS: dict[str, tuple[tuple[float, float] | None, float]] = {
    "free": (None, float("inf")),
    "within its travel": (TRAVEL, float("inf")),
    "within its travel, with limited jerk": (TRAVEL, JERK),
}


def measure_limits() -> list[Finding]:
    """Look for the least peak acceleration of the die, on grids of up to 1440 cells."""
    solve("free", CELLS)  # SciPy and the law of the mill are loaded
    say(f"{'the die':<38}cells     time   from below     from above    relative gap")
    seconds = {}
    for name in PROGRAMS:
        for cells in SIZES:
            seconds[name, cells] = time_program(name, cells)
            say(describe_program(name, cells, seconds[name, cells]))
    return [
        Finding(f"least acceleration, {CELLS} cells, {name}", seconds[name, CELLS], 2, "s")
        for name in PROGRAMS
    ]


def time_program(name: str, cells: int) -> float:
    """Return the median time in s of looking for the least peak acceleration of the die."""
    return median(seconds_of(lambda: solve(name, cells)) for _ in range(TIMES))


def describe_program(name: str, cells: int, seconds: float) -> str:
    """Return the row of the table for one program on one grid."""
    found = solve(name, cells)
    gap = found.reached / found.bound - 1
    bracket = f"{found.bound:>9.6f} m/s2 {found.reached:>9.6f} m/s2"
    return f"{name:<38}{cells:>5}{seconds:>7.2f} s{bracket}{gap:>16.1e}"


def solve(name: str, cells: int) -> LeastAcceleration:
    """Look for the least peak acceleration of the source's die."""
    travel, jerk = PROGRAMS[name]
    mill = indexing_motion("mill", rise(100, over_deg=150), dwell(210), stops=24)
    parts = rise(50, over_deg=55), dwell(100), return_(50, over_deg=55), dwell(150)
    diagram = TimingDiagram([mill, motion("die", *parts, start_deg=150)], RATE)
    rule = ClearanceRule(beyond("die", 19), only_while=within("mill", 0.65))
    return least_acceleration(
        diagram,
        "die",
        rule,
        still=[(205, 305)],
        travel_mm=travel,
        jerk_m_per_s3=jerk,
        cells=cells,
    )

"""The explorer of a measured cam: reading errors, smoothing and harmonics, and its acceleration.

All of it is closed: the table is a sum of harmonics, and so are the reading errors; the smoothing
spline divides each by a number of its own, and its second derivative is straight between points.
"""

from collections.abc import Iterator, Sequence
from typing import Any, NamedTuple

import numpy as np
import sympy as sp

from cammotion.arguments import checked
from cammotion.machine.kinematics import DEG_PER_TURN, MM_PER_M, RATE, cycle_time
from cammotion.measured.cam_table import CamTable
from cammotion.measured.differences import differences
from cammotion.measured.harmonics import check_even_cycle
from cammotion.measured.inch import MM_PER_INCH
from cammotion.measured.smoother import EvenCycle
from cammotion.quantities import Floats, InputError, one_of
from cammotion.views.live.explore import explore
from cammotion.views.live.figure import LiveFigure
from cammotion.views.live.parts import REFERENCE, Control, Line, Panel, Say, choice
from cammotion.views.measured_plots import METRES

ERROR, EXPONENT, HARMONICS = sp.symbols("e q n", real=True)
_ANGLE = sp.Symbol("theta", real=True)
_MOST = 72  # points: each is a wave in every formula
_STEPS = 20  # so many errors of half a digit is the largest on the slider
_USUAL_MM = 0.01
_TICK_DEG = 45
_NOTHING = 1e-12
_SLOW = 0.1  # m/s2: below it three decimals are less than three digits


@checked
def explore_measured(table: CamTable, rate_per_hour: float, *, unit: str = "m") -> LiveFigure:
    """Return a live figure of a cam's acceleration: with reading errors, smoothed, few harmonics.

    `table` is a whole turn with an even number of even angles, at most 72; `rate_per_hour` counts
    the turns of its camshaft in an hour. The curve is the acceleration of the smoothing spline, the
    dashed line that of the table's second differences; below is how far the curve is from each
    reading. The controls are the reading error in mm, the exponent of 10 of the amount in rad^4 as
    `smoothed` takes it, and the number of harmonics that are kept; a choice says which readings
    are off. With `unit` "in" lengths are in inches, with SI beside them. Raises InputError for
    another table, rate or unit.

    >>> angles = np.arange(0, 360, 10)
    >>> cam = CamTable(angles, 25 - 25 * np.cos(np.radians(angles)), 0.01, is_cycle=True)
    >>> figure = explore_measured(cam, 900)
    >>> figure.values = {ERROR: 0.1}
    >>> print(figure.text)
    at 180°: −0.159 m/s²
    random errors up to this size: ±0.028 m/s², root mean square
    """
    unit = one_of("unit of length", unit, METRES)
    cycle = _cycle(table, RATE.number(rate_per_hour), unit)
    return explore(
        _panels(cycle),
        (_ANGLE, 0, DEG_PER_TURN),
        _controls(cycle),
        says=_sentences(cycle),
        title="A measured cam",
    )


class _Cycle(NamedTuple):
    """A table as the figure computes it: its waves and the errors', and what each rank becomes.

    By its rank a wave has `kept` of its height when it is smoothed, `bends` is its acceleration
    then, and `chords` that of the second differences. Lengths are in mm or in.
    """

    table: CamTable
    rate_per_hour: float
    unit: str
    number: int
    waves: Sequence[Any]
    kept: Sequence[sp.Expr]
    bends: Sequence[sp.Expr]
    chords: Sequence[float]

    @property
    def is_inch(self) -> bool:
        return self.unit == "in"

    @property
    def mm(self) -> float:
        """How long the unit of its lengths is."""
        return MM_PER_INCH if self.is_inch else 1.0


def _cycle(table: CamTable, rate_per_hour: float, unit: str) -> _Cycle:
    number, turn_s = _checked(table), float(cycle_time(rate_per_hour))
    length_mm = MM_PER_INCH if unit == "in" else 1.0
    scale = (2 * np.pi / turn_s) ** 2 * (1 if unit == "in" else 1 / MM_PER_M)  # of a length/rad2
    smoother, half = EvenCycle(number), number // 2 + 1
    kept = [
        sp.Heaviside(HARMONICS - rank + 0.5) / (1 + 10**EXPONENT * float(mu))
        for rank, mu in enumerate(smoother.eigenvalues[:half])
    ]
    bends = [float(bend) * scale * part for bend, part in zip(smoother.bends, kept, strict=False)]
    chords = -((number / np.pi * np.sin(np.pi * np.arange(half) / number)) ** 2) * scale
    waves = [(sp.Integer(1), _waves(table.position_mm / length_mm)), *_errors(number)]
    return _Cycle(table, rate_per_hour, unit, number, waves, kept, bends, [*chords])


def _panels(cycle: _Cycle) -> list[Panel]:
    """Return the acceleration, and below it how far the curve is from each reading."""
    number, waves = cycle.number, cycle.waves
    missed = [1000 * (part - 1) for part in cycle.kept]
    across: dict[str, Any] = {"x": "cam angle in deg", "x_ticks": _TICK_DEG}
    return [
        Panel(
            lines=[
                Line(y=_joined(waves[:1], cycle.chords, number), role=REFERENCE),
                Line(y=_joined(waves, cycle.bends, number), colour=0),
            ],
            y=f"acceleration in {cycle.unit}/s²",
            height=150,
            **across,
        ),
        Panel(
            lines=[Line(y=_joined(waves, missed, number), colour=1)],
            y=f"difference in {'0.001 in' if cycle.is_inch else 'µm'}",
            **across,
        ),
    ]


def _controls(cycle: _Cycle) -> dict[sp.Symbol, Control]:
    finest, most = (cycle.table.step_mm / 2 or _USUAL_MM) / cycle.mm, cycle.number // 2
    return {
        ERROR: Control(
            low=0,
            high=_STEPS * finest,
            step=finest,
            start=finest,
            name="reading error",
            unit="in" if cycle.is_inch else "mm",
        ),
        EXPONENT: Control(
            low=-7, high=-2, step=0.05, start=-7, name="smoothing, exponent", unit=""
        ),
        HARMONICS: Control(low=1, high=most, step=1, start=most, name="harmonics", unit=""),
    }


def _sentences(cycle: _Cycle) -> Iterator[Say]:
    """Say how large the lowest acceleration is, and what random errors do to all of them."""
    at_this_rate = differences(cycle.table, cycle.rate_per_hour).acceleration  # in m/s2
    lowest = int(np.argmin(at_this_rate))
    low = _sum(cycle.waves, cycle.bends, sp.Integer(lowest))
    is_slow = np.abs(at_this_rate).max() < _SLOW
    si = ".3g" if is_slow else ".3f"
    own, fine = (".1f", ".2f") if cycle.is_inch and not is_slow else (si, si)
    written = f"{{low:{own}}} {cycle.unit}/s²" + f" = {{si:{si}}} m/s²" * cycle.is_inch
    yield Say(
        f"at {cycle.table.angle_deg[lowest]:g}°: {written}",
        {"low": low, "si": low * METRES[cycle.unit]} if cycle.is_inch else {"low": low},
    )
    twice = [*[2] * (len(cycle.bends) - 1), 1]  # but for the last rank, k and -k are two
    squares = sp.Add(*(two * bend**2 for two, bend in zip(twice, cycle.bends, strict=True)))
    yield Say(
        f"random errors up to this size: ±{{by:{fine}}} {cycle.unit}/s², root mean square",
        {"by": ERROR / sp.sqrt(3) * sp.sqrt(squares / cycle.number)},
    )


def _checked(table: CamTable) -> int:
    """Return the number of points of a table that can be drawn."""
    check_even_cycle(table, "the harmonics of the figure")
    number = table.angle_deg.size
    if number % 2 or number > _MOST or abs(table.angle_deg[0]) > _NOTHING:
        raise InputError(
            f"The table has {number} points from {table.angle_deg[0]:g} deg on; the figure draws "
            f"an even number of {_MOST} at most, from 0 deg on: take every second point, or turn "
            "the angles."
        )
    return number


def _waves(values: Floats) -> list[tuple[int, float, float]]:
    """Return rank, amplitude and phase in rad of the harmonics of an even number of values."""
    found = np.fft.rfft(values) / (values.size / 2)
    found[-1] /= 2
    least = _NOTHING * np.abs(found).max()
    return [
        (rank, float(abs(one)), -float(np.angle(one)))
        for rank, one in enumerate(found)
        if rank and abs(one) > least
    ]


def _errors(number: int) -> list[tuple[Any, list[tuple[int, float, float]]]]:
    """Return the errors that can be chosen: how large they are, and the harmonics of a unit."""
    quarter = number // 4
    alternating, single = choice(
        "errors",
        {
            "alternate": (ERROR, sp.Integer(0)),
            f"one, at {quarter * DEG_PER_TURN / number:g}°": (sp.Integer(0), ERROR),
            "all alike": (sp.Integer(0), sp.Integer(0)),
        },
    )
    places = np.arange(number)
    zigzag = np.where(places % 2, -1.0, 1.0)
    return [(alternating, _waves(zigzag)), (single, _waves(np.where(places == quarter, 1.0, 0.0)))]


def _sum(waves: Sequence[Any], factors: Sequence[Any], point: sp.Expr) -> sp.Expr:
    """Return the sum of all harmonics at the number of a point, each rank times its factor."""
    number = 2 * (len(factors) - 1)
    return sp.Add(
        *(
            size * factors[rank] * amplitude * sp.cos(2 * sp.pi * rank * point / number - phase)
            for size, each in waves
            for rank, amplitude, phase in each
        )
    )


def _joined(waves: Sequence[Any], factors: Sequence[Any], number: int) -> sp.Expr:
    """Return it over the cam angle, in straight lines from point to point."""
    place = _ANGLE * number / DEG_PER_TURN
    part = sp.frac(place)
    before, after = (_sum(waves, factors, sp.floor(place) + one) for one in (0, 1))
    return (1 - part) * before + part * after

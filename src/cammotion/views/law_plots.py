"""Pictures of motion laws: what a law is before it has a stroke and a time, and what it costs."""

import math
from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np
from matplotlib.axes import Axes

from cammotion.arguments import checked
from cammotion.laws.catalogue import as_law
from cammotion.laws.motion_law import MotionLaw
from cammotion.quantities import Floats, InputError, as_text, one_of, shorten
from cammotion.views.corners import corners
from cammotion.views.names import add_legend_below, labels, name_line
from cammotion.views.pictures import on_paper
from cammotion.views.plots import COLOURS, style_line, styled

CURVES = {"S": "displacement S", "V": "velocity V", "A": "acceleration A", "J": "jerk J"}
_LONGEST = 60  # columns of a law with its other names
EVEN = np.linspace(0, 1, 1001)  # of the time of a move
_REST = 0.06  # of the time, drawn before the move and after it


@checked
@on_paper
def plot_laws(
    laws: str | MotionLaw | Iterable[str | MotionLaw], *, curve: str = "A", ax: Axes | None = None
) -> Axes:
    """Draw one curve of each law over x = t/tm, from rest to rest, and return the Axes.

    `laws` are laws or their names, `curve` is one of "S", "V", "A" and "J"; no axis has a unit.
    The legend gives each law with its other names. Raises InputError for an unknown law or curve.

    >>> plot_laws(["cycloidal", "modified sine"]).get_ylabel()
    'acceleration A'
    """
    drawn = as_laws(laws)
    curve = one_of("curve", curve, CURVES)
    derivative = [*CURVES].index(curve)
    ax = styled(ax, "x = t/tm", CURVES[curve], (7.5, 4.6), layout="constrained")
    names = [full_name(law) for law in drawn]
    for number, (law, label) in enumerate(zip(drawn, labels(names, _LONGEST), strict=True)):
        places = np.union1d(EVEN, corners(law.curve.derived(derivative)))
        values = law(places, derivative)
        line = ax.plot(*from_rest_to_rest(places, values, int(curve == "S")))[0]
        name_line(style_line(line, number), label, names[number])
    ax.axhline(0, color="#000000", linewidth=0.8)
    ax.margins(x=0)
    add_legend_below(ax, 2)
    return ax


@checked
@on_paper
def plot_ranking(
    peaks: Mapping[str, float],
    *,
    quantity: str = "peak acceleration in m/s²",
    ax: Axes | None = None,
) -> Axes:
    """Draw the peak of a move with each of several laws as a bar, the smallest on top.

    `peaks` are finite peaks by the name of the law, `quantity` says of what and in which unit. The
    bar of a law whose acceleration jumps is hatched, and the axis says so. Returns the Axes;
    raises InputError for an unknown law, for no law, and for a peak that is not finite.

    >>> from cammotion.machine.kinematics import peak_acceleration
    >>> laws = "cycloidal", "constant acceleration"
    >>> ax = plot_ranking({law: peak_acceleration(50, 55, 2000, law=law) for law in laws})
    >>> [label.get_text() for label in ax.get_yticklabels()]
    ['cycloidal', 'constant acceleration']
    """
    if not peaks:
        raise InputError(
            "There is nothing to draw: the peaks are {}. Give each by its law, for example "
            '{"cycloidal": 4.154}.'
        )
    as_laws(peaks)
    said = f"{quantity} (hatched: the acceleration jumps)"
    ax = styled(ax, said, "", (7.5, 4.4), layout="constrained")
    names = sorted(peaks, key=lambda name: peaks[name], reverse=True)
    bars = ax.barh(names, [peaks[name] for name in names], color=COLOURS[0])
    for bar, name in zip(bars, names, strict=True):
        if math.isinf(as_law(name).Cj):
            bar.set(facecolor="white", edgecolor=COLOURS[1], hatch="//", label=f"{name}, hatched")
    values = [as_text(peaks[name], "#.4g") for name in names]
    ax.bar_label(bars, values, padding=4, fontsize=10, color="black")
    ax.margins(x=0.12)
    ax.grid(visible=False, axis="y")
    return ax


def from_rest_to_rest(places: Floats, values: Floats, end: float = 0.0) -> tuple[Floats, Floats]:
    """Return x from before a move to after it, and a curve over it that has `values` at `places`.

    Before the move it is 0, after it the `end`: what is there at once is a jump.
    """
    x = np.concatenate([[-_REST, 0], places, [1, 1 + _REST]])
    return x, np.concatenate([[0, 0], values, [end, end]])


def full_name(law: MotionLaw) -> str:
    """Return the name of a law, with its other names in brackets.

    >>> full_name(as_law("cycloidal"))
    'cycloidal (inclined sine, Bestehorn)'
    """
    others = ", ".join(law.also_called)
    return f"{law.name} ({others})" if others else law.name


def as_laws(laws: Any) -> list[MotionLaw]:
    """Return laws, or one, or their names, as a list; raise InputError for none."""
    several = isinstance(laws, Iterable) and not isinstance(laws, str)
    given = [as_law(law) for law in (laws if several else [laws])]
    if not given:
        raise InputError(
            f"There is nothing to draw: the laws are {shorten(laws)}. Give one or a list, for "
            'example ["cycloidal", "modified sine"].'
        )
    return given

"""The explorer of the SCCA family: every law of it is a point of a triangle."""

from collections.abc import Iterator
from contextlib import contextmanager
from functools import partial
from typing import Any

import ipywidgets
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from cammotion.laws.catalogue import LAWS
from cammotion.laws.motion_law import MotionLaw
from cammotion.laws.scca_family import LEAST_CA, NAMED_PARTS, scca, scca_parts
from cammotion.quantities import Floats, one_of
from cammotion.views.explorers.scca_triangle import draw_triangle, place
from cammotion.views.live import Explorer, LiveFigure, NumberControl
from cammotion.views.plots import COLOURS, style_axes, style_line

_START = "cycloidal"
_TICKS = {"S": (0, 0.5, 1), "V": (0, 1, 2, 3), "A": (-8, -4, 0, 4, 8), "J": (-80, -40, 0, 40, 80)}
_MOST_J = _TICKS["J"][-1]
_PER_ZONE = 31  # places at which a zone is drawn
_ROUNDING = 1e-9


class SccaExplorer(Explorer):
    """A law of the SCCA family, to be changed; made by `explore_scca`.

    The controls are b and c, and d is what they leave. Where they would leave less than nothing,
    the one that is not being moved gives way.
    """

    def __init__(self) -> None:
        self._is_setting = False
        b, c, _ = NAMED_PARTS[_START]
        self.b = NumberControl("sine part b", b, 0, 1, 0.01)
        self.c = NumberControl("constant part c", c, 0, 1, 0.01)
        self.b.on_change(partial(self._give_way, self.c, self.b))
        self.c.on_change(partial(self._give_way, self.b, self.c))
        buttons = ipywidgets.HBox(
            [self._make_button(name) for name in NAMED_PARTS], layout={"flex_flow": "row wrap"}
        )
        figure = Figure(figsize=(8.2, 5.6), dpi=100, facecolor="white")
        moving = [*self._prepare_triangle(figure), *self._prepare_curves(figure)]
        live = LiveFigure(figure, moving, layout={"max_width": "100%", "width": "820px"})
        super().__init__([self.b, self.c], [buttons], live)

    @property
    def parts(self) -> tuple[float, ...]:
        """b, c and d of the law that the controls show."""
        b, c = self.b.value, self.c.value
        return scca_parts(b, c, max(1 - b - c, 0))

    @property
    def law(self) -> MotionLaw:
        """The law that the controls show."""
        name = _name_of(self.parts)
        return scca(*self.parts, name=name, also_called=LAWS[name].also_called if name else ())

    def choose(self, name: str) -> None:
        """Set the controls to a named law of the family; another name raises InputError."""
        b, c, _ = NAMED_PARTS[one_of("law of the SCCA family", name, NAMED_PARTS)]
        with self._setting():
            self.b.value, self.c.value = b, c
        self.update()

    def update(self) -> None:
        """Bring figure and text in line with the controls, unless they are still being set."""
        if not self._is_setting:
            super().update()

    def follow(self) -> str:
        """Draw the law that the controls show; return its name, its factors, and what Ca costs."""
        law = self.law
        self._point.set_data(*np.reshape(place(*self.parts), (2, 1)))
        x, *values = _at_rest_outside(_sample(law))
        for line, heights in zip(self._lines, values, strict=True):
            line.set_data(x, heights)
        self._jumps.set_data(*_impulses(law))
        self._note.set_text(_describe_cut(law))
        return describe(self.parts, law)

    def _give_way(self, other: NumberControl, moved: NumberControl) -> None:
        """Lower the other control to what the moved one leaves."""
        left = 1 - moved.value
        if not self._is_setting and other.value > left:
            with self._setting():
                other.value = left

    @contextmanager
    def _setting(self) -> Iterator[None]:
        """Hold back the figure, and the giving way, while controls are set."""
        self._is_setting = True
        try:
            yield
        finally:
            self._is_setting = False

    def _make_button(self, name: str) -> ipywidgets.Button:
        b, c, d = NAMED_PARTS[name]
        button = ipywidgets.Button(
            description=name, tooltip=f"b = {b:g}, c = {c:g}, d = {d:g}", layout={"width": "auto"}
        )
        button.on_click(lambda _: self.choose(name))
        return button

    def _prepare_triangle(self, figure: Figure) -> list[Any]:
        """Draw the triangle; return the point that moves."""
        ax = figure.add_axes((0.0, 0.0, 0.63, 1.0))
        draw_triangle(ax)
        self._point = ax.plot([], [], "o", color=COLOURS[1], markersize=14)[0]
        self._point.set(markeredgecolor="white", markeredgewidth=1.5)
        return [self._point]

    def _prepare_curves(self, figure: Figure) -> list[Any]:
        """Draw the four small axes; return their lines, and what is said of J."""
        grid = figure.add_gridspec(4, 1, left=0.7, right=0.985, bottom=0.09, top=0.98, hspace=0.22)
        axes: list[Axes] = list(grid.subplots(sharex=True))  # type: ignore[arg-type]
        for ax, (letter, ticks) in zip(axes, _TICKS.items(), strict=True):
            style_axes(ax, "", letter)
            ax.yaxis.label.set(rotation=0, va="center")
            ax.yaxis.set_label_coords(-0.19, 0.5)
            room = 0.06 * (ticks[-1] - ticks[0])
            ax.set_ylim(ticks[0] - room, ticks[-1] + room)
            ax.set_yticks(ticks)
        last = axes[-1]
        last.set_xlabel("x = t/tm", fontsize=11)
        last.set_xlim(-0.03, 1.03)
        last.set_xticks([0, 0.25, 0.5, 0.75, 1], ["0", "0.25", "0.5", "0.75", "1"])
        self._lines = [style_line(ax.plot([], [])[0], 0) for ax in axes]
        self._jumps = last.plot([], [], color=COLOURS[1], linestyle=":", linewidth=2)[0]
        self._note = last.text(
            0.5, 1.02, "", fontsize=9, ha="center", va="bottom", transform=last.transAxes
        )
        return [*self._lines, self._jumps, self._note]


def explore_scca() -> SccaExplorer:
    """Return an explorer of the SCCA family: sine, constant and cosine part of the acceleration.

    Every law of the family is a point of a triangle, and some of them have names. The controls are
    the sine part b and the constant part c, dimensionless; the cosine part d is what is left of 1.
    `explorer.law` is the law the learner has set, `explorer.choose` sets a named one.

    >>> explorer = explore_scca()
    >>> explorer.b.value, explorer.c.value = 0.25, 0.5
    >>> print(explorer.text.splitlines()[0])
    b = 0.25, c = 0.5, d = 0.25: modified trapezoid, also called modified trapezoidal
    """
    return SccaExplorer()


def describe(parts: tuple[float, ...], law: MotionLaw) -> str:
    """Return three lines: the parts and the name of a law, its factors, and Ca against the least.

    >>> print(describe((0, 1, 0), LAWS["constant acceleration"]))
    b = 0, c = 1, d = 0: constant acceleration, also called parabolic
    Cv = 2, Ca = 4, Cj infinite (A jumps at the ends and in the middle), Cq = 8
    Ca is the least that is possible, 4
    """
    b, c, d = parts
    name = _name_of(parts)
    others = " or ".join(law.also_called) if name else ""
    names = (f": {name}" if name else "") + (f", also called {others}" if others else "")
    jerk = f"infinite (A jumps {_jumps(law)})" if _jumps(law) else f"= {law.Cj:.4g}"
    times = law.Ca / LEAST_CA
    price = "" if times < 1 + _ROUNDING else f"{times:.4g} times "
    return (
        f"b = {b:.4g}, c = {c:.4g}, d = {d:.4g}{names}\n"
        f"Cv = {law.Cv:.4g}, Ca = {law.Ca:.4g}, Cj {jerk}, Cq = {law.Cq:.4g}\n"
        f"Ca is {price}the least that is possible, {LEAST_CA}"
    )


def _jumps(law: MotionLaw) -> str:
    """Return in words where A jumps."""
    places = {place for place, _ in law.jerk_impulses}
    where = {"at the ends": 0 in places, "in the middle": 1 / 2 in places}
    return " and ".join(words for words, jumps in where.items() if jumps)


def _describe_cut(law: MotionLaw) -> str:
    """Return what the limits of the picture hide of J."""
    infinite = ["dotted: J infinite"] if _jumps(law) else []
    cut = [f"peak {law.Cj_inside:.4g} cut off"] if law.Cj_inside > _MOST_J else []
    return "; ".join(infinite + cut)


def _impulses(law: MotionLaw) -> Floats:
    """Return the lines, up or down beyond the picture, where A jumps."""
    lines = [
        [(x, 0), (x, np.sign(step) * 2 * _MOST_J), (np.nan, np.nan)]
        for x, step in law.jerk_impulses
    ]
    return np.concatenate(lines or [[(np.nan, np.nan)]]).T


def _sample(law: MotionLaw) -> Floats:
    """Return x, S, V, A and J in every zone, its ends included: (zones, 5, places)."""
    curves = [law.curve.derived(order).pieces for order in range(4)]
    zones = []
    for same_zone in zip(*curves, strict=True):
        x = np.linspace(same_zone[0].low, same_zone[0].high, _PER_ZONE)
        zones.append([x, *(piece.over(x) for piece in same_zone)])
    return np.array(zones)


def _name_of(parts: tuple[float, ...]) -> str:
    """Return the name of a law, or nothing for one that has none."""
    same = (name for name, named in NAMED_PARTS.items() if np.allclose(parts, named, 0, _ROUNDING))
    return next(same, "")


def _at_rest_outside(zones: Floats) -> Floats:
    """Return x, S, V, A and J of all zones in one: A from 0 and to 0, J with a break after each."""
    broken = np.concatenate([zones, zones[:, :, -1:]], axis=2)
    broken[:, 4, -1] = np.nan
    before, after = np.array([[0, 1], [0, 1], [0, 0], [0, 0], [np.nan, np.nan]]).T[:, :, None]
    return np.concatenate([before, *broken, after], axis=1)

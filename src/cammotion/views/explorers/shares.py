"""The explorer of the timing diagram: one turn shared out between two mechanisms, in sequence."""

from typing import Any

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from cammotion.limits.widest import with_angle
from cammotion.machine.diagram import TimingDiagram
from cammotion.machine.kinematics import DEG_PER_TURN
from cammotion.machine.motions import Motion
from cammotion.machine.parts import dwell, motion, return_, rise
from cammotion.quantities import InputError
from cammotion.views.live import Explorer, LiveFigure, NumberControl
from cammotion.views.movement import curve_angles, movement
from cammotion.views.plots import CURVES, style_axes, style_line
from cammotion.views.scales import as_text, drawn_peak, round_up
from cammotion.views.timing_plots import TICK_DEG

_SHARED_DEG = DEG_PER_TURN - 2 * 10  # what is left at least for each way of the tool is 10 deg


class ShareExplorer(Explorer):
    """A mill that indexes, then a die that goes down, works and comes back; by `explore_shares`.

    The die gets what the mill's move and its own work leave of the turn, half of it each way.
    """

    def __init__(self, diagram: TimingDiagram) -> None:
        self._reference = diagram
        self._mill, self._die = diagram.motions
        (index,), (down, up) = self._mill.moves, self._die.moves
        work = up.from_deg - down.to_deg
        most = min(max(_SHARED_DEG / 2, index.angle_deg), _SHARED_DEG - work)
        self.mill_angle = NumberControl(
            f"{self._mill.name}: angle, deg", index.angle_deg, 20, most, 1
        )
        self.work = NumberControl(
            f"{self._die.name}: at work, deg", work, 20, _SHARED_DEG - most, 1
        )
        figure = Figure(figsize=(8.2, 4.8), dpi=100, facecolor="white")
        figure.subplots_adjust(left=0.11, right=0.98, bottom=0.11, top=0.98, hspace=0.14)
        self._axes: list[Axes] = list(figure.subplots(2, 1, sharex=True))
        self._lines = self._prepare()
        moving = [line for lines in self._lines for line in lines]
        live = LiveFigure(figure, moving, layout={"max_width": "100%", "width": "820px"})
        super().__init__([self.mill_angle, self.work], [], live)

    @property
    def diagram(self) -> TimingDiagram:
        """The timing diagram that the controls show."""
        index, (down, up) = self._mill.moves[0], self._die.moves
        mill_deg, work_deg = self.mill_angle.value, self.work.value
        die_deg = (DEG_PER_TURN - mill_deg - work_deg) / 2
        mill = with_angle(self._mill, mill_deg)
        mill = mill.shifted(index.from_deg - mill.start_deg)
        die = motion(
            self._die.name,
            rise(down.change_mm, over_deg=die_deg, law=down.law or "cycloidal"),
            dwell(work_deg),
            return_(-up.change_mm, over_deg=die_deg, law=up.law or "cycloidal"),
            dwell(mill_deg),
            start_deg=index.from_deg + mill_deg,
        )
        return TimingDiagram((mill, die), self._reference.rate_per_hour)

    def follow(self) -> str:
        """Draw the diagram that the controls show; return the angles and the peaks."""
        diagram = self.diagram
        for moved, lines in zip(diagram.motions, self._lines, strict=True):
            angles = curve_angles(moved)
            heights = movement(moved, angles), diagram.acceleration(moved.name, angles)
            for line, values in zip(lines, heights, strict=True):
                line.set_data(angles, values)
        peak = max(map(diagram.peak_acceleration, diagram.names))
        top = round_up(drawn_peak(peak, *(lower.get_ydata() for _, lower in self._lines)))
        self._axes[1].set_ylim(-top, top)
        larger = max(diagram.names, key=diagram.peak_acceleration)
        lines = [self._describe(diagram, moved) for moved in diagram.motions]
        return "\n".join([*lines, f"larger peak: {larger}, {as_text(peak, '.3f')} m/s²"])

    def _describe(self, diagram: TimingDiagram, moved: Motion) -> str:
        angles = " and ".join(f"{segment.angle_deg:.5g}" for segment in moved.moves)
        peak = diagram.peak_acceleration(moved.name)
        return f"{moved.name}: moves over {angles} deg, a_max = {as_text(peak, '.3f')} m/s²"

    def _prepare(self) -> list[list[Any]]:
        """Draw what stays; return a line of each picture for each motion."""
        highest = max(moved.range_mm[1] for moved in self._reference.motions)
        upper, lower = self._axes
        style_axes(upper, "", "movement in mm")
        style_axes(lower, "cam angle in deg", CURVES["acceleration"].replace(" in ", "\nin "))
        upper.set_ylim(-0.06 * highest, 1.1 * highest)
        upper.set_xlim(0, DEG_PER_TURN)
        upper.set_xticks(range(0, DEG_PER_TURN + 1, TICK_DEG))
        lines: list[list[Any]] = []
        for number, moved in enumerate(self._reference.motions):
            lines.append([style_line(ax.plot([], [])[0], number) for ax in self._axes])
            lines[-1][0].set_label(moved.name)
        upper.legend(loc="upper left", fontsize=10)
        return lines


def explore_shares(diagram: TimingDiagram) -> ShareExplorer:
    """Return an explorer of how two mechanisms share out the turn when they move in sequence.

    `diagram` holds an indexing motion with one move and after it a motion that rises and returns
    once. The controls are the angle of the first and the dwell of the second at its far end; its
    two moves get what is left. Raises InputError for another diagram.

    >>> import cammotion as cm
    >>> explorer = explore_shares(cm.EXAMPLE.diagram)
    >>> explorer.mill_angle.value = 100
    >>> print(explorer.text.splitlines()[1])
    die: moves over 80 and 80 deg, a_max = 1.963 m/s²
    """
    motions = diagram.motions if isinstance(diagram, TimingDiagram) else ()
    kinds = [[segment.kind for segment in moved.moves] for moved in motions]
    if kinds != [["rise"], ["rise", "return"]] or not motions[0].is_indexing:
        raise InputError(
            "The turn of this diagram cannot be shared out: give a TimingDiagram of an indexing "
            "motion with one rise and a motion with one rise and one return, in this order."
        )
    (index,), (down, up) = (moved.moves for moved in motions)
    taken = index.angle_deg + up.from_deg - down.to_deg
    if taken > _SHARED_DEG:
        raise InputError(
            f"The move of the {motions[0].name} and the work of the {motions[1].name} take "
            f"{taken:g} deg of the turn: leave 20 deg at least for the two ways of the latter."
        )
    return ShareExplorer(diagram)

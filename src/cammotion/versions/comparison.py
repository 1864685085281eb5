"""Two versions of a machine side by side: what was changed, and what it cost or gained."""

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

from cammotion.arguments import checked
from cammotion.drive.camshaft import Camshaft
from cammotion.drive.rounding import torque_rounding
from cammotion.limits.reserves import reserves
from cammotion.machine.diagram import TimingDiagram
from cammotion.quantities import InputError, as_text, plural
from cammotion.rules.checks import every_rule, find_clearances, find_violations
from cammotion.rules.rule import Rule
from cammotion.shown import as_table
from cammotion.versions.changes import NONE, SAME, Change, changes, pairs

_HEADING = ("of", "what", "before", "after", "change")
_PEAKS = {"velocity": "m/s", "acceleration": "m/s²", "jerk": "m/s³"}


@dataclass(frozen=True)
class Effect:
    """A number of both versions, in a `unit`: a peak, a clearance, a torque.

    `of` is a motion, a rule or "camshaft". What a version lacks is None; what is no more than its
    `rounding` is 0.
    """

    of: str
    what: str
    unit: str
    before: float | None
    after: float | None
    rounding: float = SAME

    @property
    def times(self) -> float | None:
        """How many times what it was it is; None for no number, for infinity, for 0 and below."""
        if self.before is None or self.after is None or self.before <= self.rounding:
            return None
        if self.after < 0:
            return None
        times = self.after / self.before
        return times if math.isfinite(times) and math.isfinite(self.before) else None

    @property
    def is_change(self) -> bool:
        """Whether the two numbers differ by more than rounding."""
        if self.before is None or self.after is None:
            return self.before is not self.after
        return not math.isclose(self.before, self.after, rel_tol=SAME, abs_tol=self.rounding)

    def __str__(self) -> str:
        """Say it in words."""
        before, after = self.said
        return f"{self.of}, {self.what}: {before} → {after} {self.unit}"

    @property
    def shown(self) -> tuple[float | None, float | None]:
        """Both numbers, with 0 for what is no more than rounding."""
        before, after = (
            0.0 if value is not None and abs(value) <= self.rounding else value
            for value in (self.before, self.after)
        )
        return before, after

    @property
    def said(self) -> tuple[str, str]:
        """Both numbers in four digits."""
        before, after = (NONE if value is None else as_text(value, ".4g") for value in self.shown)
        return before, after


@dataclass(frozen=True, repr=False)
class Comparison:
    """Two versions of a machine, `before` and `after`, and how they differ; made by `compare`.

    `changes` are what was changed: the rate, motions that came or went, moves and their laws.
    `effects` are what that cost or gained: each peak that is another one now, what each rule has
    left, and, of two camshafts, forces and torque. A notebook shows both as a table.
    """

    before: TimingDiagram
    after: TimingDiagram
    rules: tuple[Rule, ...]
    changes: tuple[Change, ...]
    effects: tuple[Effect, ...]

    def __repr__(self) -> str:
        said = [plural(len(self.changes) or "no", "change"), self._hardest]
        if self.rules:
            broken = len({found.rule for found in find_violations(self.after, self.rules)})
            said.append(f"{broken or 'no'} rule{'s' if broken > 1 else ''} broken")
        return f"Comparison({'; '.join(said)})"

    def _repr_html_(self) -> str:
        changes = [(c.of, c.what, c.before, c.after, "") for c in self.changes]
        effects = [(e.of, f"{e.what} in {e.unit}", *e.said, _share(e.times)) for e in self.effects]
        return as_table(_HEADING, [*changes, *effects])

    @property
    def _hardest(self) -> str:
        """The largest peak acceleration of both, whose ever it is."""
        peaks = (
            max(diagram.peak_acceleration(name) for name in diagram.names)
            for diagram in (self.before, self.after)
        )
        before, after = (as_text(peak, ".4g") for peak in peaks)
        return f"largest peak acceleration {before} → {after} m/s²"


@checked
def compare(
    before: TimingDiagram | Camshaft,
    after: TimingDiagram | Camshaft,
    rules: Rule | Iterable[Rule] = (),
) -> Comparison:
    """Return how two versions of a machine differ, and what that cost or gained.

    Both are timing diagrams, or camshafts, which know forces and torque too. The `rules` have to be
    about motions that both versions have. Raises InputError for others, and for a diagram beside a
    camshaft.

    >>> import cammotion as cm
    >>> after = cm.widest_move(cm.EXAMPLE.diagram, "die", cm.EXAMPLE.rule).diagram
    >>> found = compare(cm.EXAMPLE.diagram, after, cm.EXAMPLE.rule)
    >>> print(found.changes[0])
    die, rise: 150 to 205 deg, 50 mm, cycloidal → 80.16 to 205 deg, 50 mm, cycloidal
    >>> found
    Comparison(2 changes; largest peak acceleration 4.154 → 1.117 m/s²; no rule broken)
    """
    shafts = [each for each in (before, after) if isinstance(each, Camshaft)]
    if len(shafts) == 1:
        raise InputError(
            "One version is a Camshaft and the other a TimingDiagram, which has no loads: give "
            "both as Camshafts, or shaft.diagram of the one."
        )
    one, other = (each.diagram if isinstance(each, Camshaft) else each for each in (before, after))
    spelled = [every_rule(each, rules) for each in (one, other)]
    effects = [*_peaks(one, other), *_of_rules((one, other), spelled)]
    if shafts:
        effects += _of_shafts(*shafts)
    return Comparison(one, other, spelled[0], tuple(changes(one, other)), tuple(effects))


def _peaks(before: TimingDiagram, after: TimingDiagram) -> Iterator[Effect]:
    """Yield the peaks of the motions that are other ones now."""
    for name, *motions in pairs(before, after):
        for what, unit in _PEAKS.items():
            old, new = (
                getattr(diagram, f"peak_{what}")(motion.name) if motion else None
                for diagram, motion in zip((before, after), motions, strict=True)
            )
            found = Effect(name, f"peak {what}", unit, old, new, 0.0)
            if found.is_change:
                yield found


def _of_rules(
    versions: Sequence[TimingDiagram], rules: Sequence[tuple[Rule, ...]]
) -> Iterator[Effect]:
    """Yield what each rule has left, be it changed or not; each version spells them its own way."""
    both = [*zip(versions, rules, strict=True)]
    rooms = [find_clearances(diagram, spelled) for diagram, spelled in both]
    left = [{found.rule: found.deg for found in reserves(*each)} for each in both]
    for old, new in zip(*rooms, strict=True):
        of = old.rule.name or str(old.rule)
        yield Effect(of, "clearance", "mm", old.clearance_mm, new.clearance_mm)
        yield Effect(of, "reserve", "deg", left[0][old.rule], left[1][new.rule])


def _of_shafts(before: Camshaft, after: Camshaft) -> Iterator[Effect]:
    """Yield the peak forces, and what the shaft is asked."""
    for name, *motions in pairs(before.diagram, after.diagram):
        old, new = (
            abs(shaft.peak_force(motion.name).value)
            if motion and motion.name in shaft.loads
            else None
            for shaft, motion in zip((before, after), motions, strict=True)
        )
        if (old, new) != (None, None):
            yield Effect(name, "peak force", "N", old, new, 0.0)
    both, least = (before, after), max(map(torque_rounding, (before, after)))
    speed = max(shaft.speed_rad_per_s for shaft in both)
    old, new = (abs(shaft.peak_torque().value) for shaft in both)
    yield Effect("camshaft", "peak torque", "N m", old, new, least)
    old, new = (shaft.rms_torque_N_m for shaft in both)
    yield Effect("camshaft", "rms torque", "N m", old, new, least)
    old, new = (shaft.mean_power_W for shaft in both)
    yield Effect("camshaft", "mean power", "W", old, new, least * speed)


def _share(times: float | None) -> str:
    if times is None:
        return ""
    return f"{100 * (times - 1):+.3g} %" if times < 2 else f"{times:.3g} times"  # noqa: PLR2004

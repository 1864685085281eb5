"""The tests from fresh seeds, for some seconds; and that they find what is broken."""

import re
from collections.abc import Callable
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np
import pytest
from fresh.check_machines import is_refused
from fresh.drawing import build, draw
from fresh.runner import CHECKS, examine, main, run
from fresh.sampling import tracks_of

import cammotion as cm
from cammotion import Motion, MotionLaw, TimingDiagram
from cammotion.advice import widening
from cammotion.limits import frame
from cammotion.measured.fits import Through
from cammotion.teaching import again
from cammotion.teaching.number_exercise import NumberExercise

SEED, SOUND = "cam", range(5, -1, -1)  # the quickest first
Patch = tuple[object, str, Callable[[Any], Any]]


def test_a_machine_is_drawn_again_the_same() -> None:
    first, second = draw(SEED, 1), draw(SEED, 1)
    assert first.code == second.code != draw(SEED, 2).code != draw("other", 1).code
    assert first.rng.random() == second.rng.random()


def test_its_code_builds_it() -> None:
    machine = draw(SEED, 3)
    names = build(machine.code)
    angles = np.linspace(0, 360, 50)
    for name in machine.diagram.names:
        again = names["diagram"].position_mm(name, angles)
        assert np.array_equal(again, machine.diagram.position_mm(name, angles))


@pytest.mark.parametrize(
    ("law", "jerk"), [("simple harmonic", np.inf), ("cycloidal", 4 * np.pi**2 * 9 / 0.034**3)]
)
def test_a_jump_is_seen_beside_a_move_that_is_a_million_times_harder(law: str, jerk: float) -> None:
    """By the peak of the jerk, in mm/deg3, of the track that checks and of the motion."""
    parts = cm.rise(9, over_deg=0.034), cm.dwell(79), cm.return_(9, over_deg=168, law=law)
    diagram = TimingDiagram([cm.motion("pin", *parts, cm.dwell(112.966))], 1800)
    track = tracks_of(diagram)["pin"]
    assert track.peak(3, 1) * 1000 == pytest.approx(jerk, rel=1e-3)
    assert diagram["pin"].peak(3) == pytest.approx(jerk, rel=1e-6)


def narrower(solve: Any) -> Callable[..., Any]:
    """Break a solver for the widest move: it leaves a tenth unused."""

    def narrow(diagram: TimingDiagram, name: str, rules: Any, **named: Any) -> Any:
        found = solve(diagram, name, rules, **named)
        angles = tuple(0.9 * angle for angle in found.angles_deg)
        if len(set(angles)) > 1:
            return replace(found, angles_deg=angles)
        changed = diagram.with_motion(cm.with_angle(diagram[name], angles[0]))
        return replace(found, angles_deg=angles, diagram=changed)

    return narrow


def nearer(solve: Any) -> Callable[..., Any]:
    """Break the reserves: a tenth more is left than there is."""

    def more(*given: Any, **named: Any) -> Any:
        return [
            replace(found, late_deg=1.1 * found.late_deg, times=1.1 * found.times)
            for found in solve(*given, **named)
        ]

    return more


def heavier(solve: Any) -> Callable[..., Any]:
    """Break the peak of a torque: it is a hundredth too large."""
    return lambda shaft: solve(shaft)._replace(value=1.01 * solve(shaft).value)


def bounded(solve: Any) -> Callable[..., Any]:
    """Break the least acceleration: it promises too much."""

    def promise(*given: Any, **named: Any) -> Any:
        found = solve(*given, **named)
        return replace(found, bound=1.05 * found.reached)

    return promise


def harsher(ask: Any) -> Callable[..., Any]:
    """Break what to change first: each gain is told larger than it is."""

    def more(machine: cm.Machine) -> cm.Improvements:
        found: cm.Improvements = ask(machine)
        return replace(found, changes=tuple(replace(o, after=0.99 * o.after) for o in found))

    return more


def unchanged(solve: Any) -> Callable[..., Any]:
    """Break the optimiser: it leaves the machine as it is."""

    def leave(*given: Any, **named: Any) -> Any:
        found = solve(*given, **named)
        return replace(found, design=found.diagram) if found.shaft else found

    return leave


def as_it_was(solve: Any) -> Callable[..., Any]:
    """Break the optimiser of peaks: it leaves the machine as it is."""

    def leave(*given: Any, **named: Any) -> Any:
        found = solve(*given, **named)
        return found if found.shaft else replace(found, design=found.diagram)

    return leave


def shifted(read: Any) -> Callable[..., Any]:
    """Break the reader of cam tables, or of profiles: it takes a row for the one before."""

    def shift(*given: Any, **named: Any) -> Any:
        table = read(*given, **named)
        return replace(table, position_mm=np.roll(table.position_mm, 1))

    return shift


def turned(make: Any) -> Callable[..., Any]:
    """Break the motion from a table: it comes a hundredth of a degree late."""
    return lambda *given: make(*given).shifted(0.01)


def restarted(diagram: TimingDiagram) -> TimingDiagram:
    """Break a machine: its motions begin a little later."""
    return replace(diagram, motions=[motion.shifted(1e-5) for motion in diagram.motions])


def scaled(factor: float) -> Callable[[Any], Any]:
    """Break a curve or a peak by a factor."""
    return lambda right: lambda *given, **named: factor * right(*given, **named)


FAULTS: dict[str, Patch] = {
    "positions": (Motion, "position_mm", scaled(1 + 1e-6)),
    "ranges": (TimingDiagram, "overlap", lambda _: lambda *_: []),
    "peaks": (TimingDiagram, "peak_velocity", scaled(1.01)),
    "violations": (cm, "find_violations", lambda right: lambda *given: right(*given)[1:]),
    "widenings": (cm, "with_angle", lambda right: lambda one, angle: right(one, angle * 0.999)),
    "widest": (cm, "widest_move", narrower),
    "each_way": (cm, "widest_move", narrower),
    "reserves": (cm, "reserves", nearer),
    "advised": (cm, "improvements", harsher),
    "distances": (cm, "reserves", nearer),
    "standings": (cm, "find_violations", lambda right: lambda *given: right(*given)[1:]),
    "reserved": (cm, "widest_move", narrower),
    "tables": (cm, "read_segments", lambda right: lambda path: restarted(right(path))),
    "odd_tables": (cm, "read_segments", lambda right: lambda path: restarted(right(path))),
    "values": (MotionLaw, "__call__", scaled(1 + 1e-6)),
    "factors": (MotionLaw, "Ca", lambda right: property(lambda law: 1.01 * right.fget(law))),
    "derived": (MotionLaw, "reversed", lambda _: lambda law: law),
    "inverses": (MotionLaw, "inverse", scaled(1 - 1e-4)),
    "heights": (MotionLaw, "where_above", lambda _: lambda *_: []),
    "cam_tables": (cm, "read_cam_table", shifted),
    "damaged_tables": (cm, "read_cam_table", shifted),
    "profiles": (cm, "lift_from_profile", shifted),
    "differences": (cm.Differences, "acceleration_bound", scaled(1.01)),
    "harmonics": (cm.Harmonics, "rebuilt", scaled(1 + 1e-5)),
    "smoothings": (cm.SmoothedTable, "acceleration_rms", scaled(1.001)),
    "roundings": (Through, "effects", lambda _: lambda *_: 2 * (np.ones(1),)),
    "eccentrics": (cm, "motion_from_table", turned),
    "levelled": (cm, "motion_from_table", turned),
    "noisy": (cm, "motion_from_table", turned),
    "least": (cm, "least_acceleration", bounded),
    "turrets": (cm, "least_acceleration", bounded),
    "whole": (cm, "least_peak", bounded),
    "crowds": (cm, "least_peak", bounded),
    "rests": (cm, "optimise", as_it_was),
    "torques": (cm, "optimise", unchanged),
    "cams": (cm, "smallest_prime_radius", scaled(0.9)),
    "followers": (cm, "smallest_base_radius", scaled(0.9)),
    "contacts": (cm.FollowerLoad, "where_loose", lambda right: lambda *given: right(*given)[1:]),
    "camshafts": (cm.Camshaft, "peak_torque", heavier),
    "indexers": (cm.Indexer, "rms_torque_N_m", scaled(1.01)),
    "responses": (cm.StartResponse, "acceleration", scaled(1 + 1e-7)),
    "answers": (NumberExercise, "solution", scaled(1.01)),
    "questions": (again, "whole_question", lambda _: lambda one, machine: one.question(machine)),
}


@pytest.mark.parametrize("check", CHECKS)
def test_a_planted_fault_is_found(monkeypatch: pytest.MonkeyPatch, check: str) -> None:
    """In a machine in which nothing is found without it."""
    owner, name, broken = FAULTS[check]
    monkeypatch.setattr(owner, name, broken(getattr(owner, name)))
    number = next((number for number in SOUND if examine(SEED, number, (check,))), None)
    assert number is not None
    monkeypatch.undo()
    found = examine(SEED, number, (check,))
    assert not found, found[0]


@pytest.mark.parametrize("kind", ["law", "widen"])
def test_advice_that_is_kept_back_is_found(kind: str, monkeypatch: pytest.MonkeyPatch) -> None:
    ask = cm.improvements

    def silent(machine: cm.Machine) -> cm.Improvements:
        found = ask(machine)
        return replace(found, changes=tuple(one for one in found if one.kind != kind))

    monkeypatch.setattr(cm, "improvements", silent)
    assert any(examine(SEED, number, ("advised",)) for number in SOUND)


def test_moves_beside_a_broken_rule_that_are_not_widened_are_found(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(widening._Search, "_is_stuck", lambda *_: False)
    assert "nothing wider is offered" in str(examine("mut", 7, ("advised",))[0])
    monkeypatch.undo()
    assert not examine("mut", 7, ("advised",))


def test_a_part_that_could_stand_longer_and_so_be_gentler_is_found(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(widening._Search, "_is_best", lambda *_: True)
    (found,) = examine("l73", 0, ("advised",))
    assert "m/s², but 3.692" in str(found)


def test_moves_that_are_torn_apart_are_found(monkeypatch: pytest.MonkeyPatch) -> None:
    slide = cm.motion(
        "slide",
        cm.rise(130, over_deg=200, law=cm.MATCHED),
        cm.return_(130, over_deg=160, law=cm.CONSTANT_VELOCITY),
    )
    ask = partial(cm.with_angle, slide, 100)
    assert is_refused(slide, ask)
    assert not is_refused(cm.EXAMPLE.die, ask)
    monkeypatch.setattr(frame, "hands_over", lambda _: False)
    with pytest.raises(AssertionError, match="slide is torn apart: nothing"):
        is_refused(slide, ask)


def test_the_seed_of_a_finding_is_printed_and_finds_it_again(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(cm, "find_violations", lambda *_: ())
    assert run(SEED, 1, names=("violations",), processes=0) == 1
    printed = capsys.readouterr().out
    again = re.search(r"FOUND: (--seed cam --machine \d+ --check violations)\n", printed)
    assert again
    assert "diagram = cm.TimingDiagram(" in printed
    assert "AssertionError: missed at" in printed
    assert re.fullmatch(r"\d+ machines?, [1-9]\d* findings?", printed.splitlines()[-1])
    assert main(again[1].split()) == 1
    assert "AssertionError: missed at" in capsys.readouterr().out
    monkeypatch.undo()
    assert main(again[1].split()) == 0
    assert capsys.readouterr().out == "1 machine, 0 findings\n"


def test_it_goes_on_by_two_until_the_time_is_up(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["--seconds", "2", "--seed", SEED, "--check", "ranges"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert lines[0] == "seed cam, 2 s"
    assert re.fullmatch(r"\d+ machines, 0 findings", lines[-1])

"""The quickest move, against another program, and against the longest strokes that a time allows.

The other program is ruckig 0.19.4, whose times stand here; it is in no environment of ours.
"""

import math
from pathlib import Path

import numpy as np
import pytest
from scipy.optimize import linprog

import cammotion as cm
from cammotion.limits import quickest
from cammotion.quantities import WrongAnswerError

INF = math.inf
LIMITED = {"velocity_m_per_s": 0.3, "jerk_m_per_s3": 200}
RUCKIG = [  # mm, m/s, m/s2, m/s3 and the time in s
    (50, INF, 4, 200, 0.2444994432064365),
    (50, 0.3, 4, 200, 0.26166666666666666),
    (50, 0.3, 40, 50, 0.3215860005149634),
    (50, INF, 400, 50, 0.31748021039363994),
    (50, 0.3, 4, INF, 0.2416666666666667),
    (50, INF, 4, INF, 0.22360679774997896),
    (1.36, 0.0255, 8.9702, 5.669, 0.1972698934020584),
    (7.509, 0.0971, 0.1493, 188.81, 0.44932107525337084),
    (0.135, 0.1482, 0.162, 6.569, 0.08696172814052809),
    (3.061, 1.7081, 0.2352, 19.113, 0.24079920648858055),
    (15.704, 3.6209, 5.3865, 77.336, 0.18660625041698772),
    (261.152, 0.0134, 37.6188, 32.631, 19.529484346597947),
    (0.32, 0.0208, 0.8423, 2272.178, 0.03935513439369432),
    (0.429, 0.3718, 8.2554, 63.59, 0.05998916475375772),
    (8.262, 0.0148, 0.1509, 16.629, 0.6653959491139783),
    (24.066, 0.1427, 0.8759, 354.378, 0.3340373081647746),
    (3.856, 0.0645, 24.1623, 884.058, 0.07686615550525024),
    (0.715, 0.3556, 3.7635, 3655.79, 0.02861552290303791),
    (35.732, 0.0599, 87.2016, 8.189, 0.7675794729775441),
    (2.907, 1.1073, 0.2857, 162.694, 0.20350619676240214),
]


@pytest.mark.parametrize(("stroke", "velocity", "acceleration", "jerk", "time"), RUCKIG)
def test_another_program_is_as_quick(
    stroke: float, velocity: float, acceleration: float, jerk: float, time: float
) -> None:
    move = cm.quickest_move(
        stroke,
        velocity_m_per_s=velocity,
        acceleration_m_per_s2=acceleration,
        jerk_m_per_s3=jerk,
        rate_per_hour=100,
    )
    assert move.time_s == pytest.approx(time, rel=1e-9)
    assert move.angle_deg == pytest.approx(time * 10)  # a turn takes 36 s
    assert move.peak_velocity <= velocity * (1 + 1e-9)
    assert move.peak_acceleration <= acceleration * (1 + 1e-9)
    assert move.peak_jerk <= jerk * (1 + 1e-9)
    law = cm.as_law(move.law)
    assert law([0, 0.5, 1]) == pytest.approx([0, 0.5, 1], abs=1e-12)
    assert law(0, derivative=1) == law(1, derivative=1) == 0


@pytest.mark.parametrize(
    ("limits", "pieces"),
    [
        ({}, 2),
        ({"velocity_m_per_s": 0.3}, 4),
        ({"jerk_m_per_s3": 200}, 6),
        ({"jerk_m_per_s3": 1}, 4),
        (LIMITED, 8),
    ],
)
def test_segments_that_it_does_not_need_are_left_out(limits: dict[str, float], pieces: int) -> None:
    """Seven, of which the one in the middle is in two halves."""
    move = cm.quickest_move(50, acceleration_m_per_s2=4, rate_per_hour=100, **limits)
    assert len(cm.as_law(move.law).curve.pieces) == pieces


def longest_mm(time: float, velocity: float, acceleration: float, jerk: float) -> float:
    """Return the longest stroke in mm from rest to rest in a time, by a linear program.

    Its jerk is constant in each of 300 cells; the velocity is held to its limit at their ends.
    """
    cells = 300
    step = time / cells
    later = np.tril(np.ones((cells, cells)))  # by the end of each cell what its forerunners did
    a = later * step
    v = later @ a * step - a * step / 2
    s = later @ v * step - (later @ a) * step**2 / 2 + later * step**3 / 6
    scale = 1 / max(1e-9, abs(s[-1]).max())
    bounded = np.vstack([a, -a, v, -v])
    bounds = np.repeat([acceleration, acceleration, velocity, velocity], cells)
    found = linprog(
        -s[-1] * scale,
        A_ub=bounded,
        b_ub=bounds,
        A_eq=np.vstack([a[-1], v[-1]]),
        b_eq=[0, 0],
        bounds=(-jerk, jerk),
        method="highs",
    )
    return float(-found.fun / scale * 1000)


@pytest.mark.parametrize(
    ("velocity", "acceleration", "jerk"),
    [(10, 4, 200), (0.3, 4, 200), (0.3, 40, 50), (10, 400, 50), (0.3, 4, 3000)],
)
def test_in_its_time_no_motion_goes_further(
    velocity: float, acceleration: float, jerk: float
) -> None:
    move = cm.quickest_move(
        50,
        velocity_m_per_s=velocity,
        acceleration_m_per_s2=acceleration,
        jerk_m_per_s3=jerk,
        rate_per_hour=500,
    )
    longest = longest_mm(move.time_s, velocity, acceleration, jerk)
    assert longest == pytest.approx(50, rel=2e-3)


def test_a_cam_with_the_quickest_move(tmp_path: Path) -> None:
    """It goes into a motion and through a table like any law, and its peaks are the limits."""
    move = cm.quickest_move(
        50, velocity_m_per_s=0.35, acceleration_m_per_s2=4, jerk_m_per_s3=200, rate_per_hour=2000
    )
    rest = (360 - 2 * move.angle_deg) / 2
    die = cm.motion(
        "die",
        cm.rise(50, over_deg=move.angle_deg, law=move.law),
        cm.dwell(rest),
        cm.return_(50, over_deg=move.angle_deg, law=move.law),
        cm.dwell(rest),
    )
    machine = cm.TimingDiagram([die], 2000)
    cm.write_segments(machine, tmp_path / "machine.csv")
    for diagram in (machine, cm.read_segments(tmp_path / "machine.csv")):
        assert diagram.peak_velocity("die") == pytest.approx(0.35)
        assert diagram.peak_acceleration("die") == pytest.approx(4)
        assert diagram.peak_jerk("die") == pytest.approx(200)


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ({"acceleration_m_per_s2": 0}, "largest acceleration is 0 m/s2"),
        ({"acceleration_m_per_s2": INF}, "largest acceleration is inf m/s2"),
        ({"velocity_m_per_s": -1}, "largest velocity is -1 m/s"),
        ({"jerk_m_per_s3": math.nan}, "largest jerk is nan m/s3"),
        (
            {"jerk_m_per_s3": 1e30},
            r"largest jerk is 1e\+30 m/s3, which the move needs for less than",
        ),
        (
            {"acceleration_m_per_s2": 1e6, "velocity_m_per_s": 0.001},
            r"acceleration is 1e\+06 m/s2, .* less than a millionth .* for example 18 m/s2",
        ),
        ({"stroke_mm": 0}, "stroke is 0 mm"),
        ({"rate_per_hour": 20_000}, "takes 0.2236 s, and a turn .* only 0.18 s: .* at most 16098"),
    ],
)
def test_what_is_no_move(given: dict[str, float], said: str) -> None:
    with pytest.raises(cm.InputError, match=said):
        cm.quickest_move(
            **{"stroke_mm": 50, "acceleration_m_per_s2": 4, "rate_per_hour": 2000} | given
        )


def test_the_acceleration_that_is_given_for_an_example_will_do() -> None:
    move = cm.quickest_move(50, acceleration_m_per_s2=18, velocity_m_per_s=0.001, rate_per_hour=1)
    assert move.peak_acceleration == pytest.approx(18)
    assert move.peak_velocity == pytest.approx(0.001)


def test_at_the_rate_that_is_advised_the_move_fits() -> None:
    """Rounded up, it would be too long again."""
    for stroke in np.random.default_rng(4).uniform(1, 500, 30):
        fast = {"acceleration_m_per_s2": 4, "rate_per_hour": 1e5}
        with pytest.raises(cm.InputError) as refusal:
            cm.quickest_move(stroke, **fast)
        advised = float(str(refusal.value).split("run at most ")[1].split()[0])
        move = cm.quickest_move(stroke, **fast | {"rate_per_hour": advised})
        assert 359.9 < move.angle_deg <= 360


@pytest.mark.parametrize("share", [0.9, 0.98])
def test_a_move_above_its_limits_is_never_given_out(
    monkeypatch: pytest.MonkeyPatch, share: float
) -> None:
    real = quickest._times
    monkeypatch.setattr(
        quickest, "_times", lambda *given: quickest._Times(*(share * t for t in real(*given)))
    )
    with pytest.raises(WrongAnswerError, match=r"quickest_move.*is above"):
        cm.quickest_move(50, acceleration_m_per_s2=4, rate_per_hour=2000, **LIMITED)

"""Pictures of a follower, without looking at them: what is drawn is what is computed."""

import numpy as np
import pytest

import cammotion as cm
from cammotion.views.pictures import describe

LAWS = ["cycloidal", "modified sine", "simple harmonic"]
RATIOS = np.linspace(0.1, 5, 60)


@pytest.mark.parametrize("damping", [0.0, 0.05])
def test_residuals_as_they_are(damping: float) -> None:
    ax = cm.plot_residual(LAWS, ratios=RATIOS, damping_ratio=damping)
    for law, line in zip(LAWS, ax.lines, strict=False):
        assert line.get_label() == law
        assert line.get_ydata() == pytest.approx(cm.residual_vibration(law, RATIOS, damping))
    other = cm.plot_residual(LAWS, ratios=RATIOS, damping_ratio=damping, quantity="factor")
    assert other.get_yscale() == "linear"
    for law, line in zip(LAWS, other.lines, strict=False):
        assert line.get_ydata() == pytest.approx(cm.dynamic_factor(law, RATIOS, damping))


def test_a_run_as_it_is() -> None:
    die = cm.EXAMPLE.die
    ax = cm.plot_residual(LAWS, ratios=RATIOS, damping_ratio=0.02, motion=die)
    for law, line in zip(LAWS, ax.lines, strict=False):
        known = cm.running_residual(die.with_law(law), RATIOS, 0.02)
        assert line.get_ydata() == pytest.approx(known)


def test_every_law_is_named_once_and_apart() -> None:
    ax = cm.plot_residual(ratios=RATIOS)
    assert sorted(text.get_text() for text in ax.texts) == sorted(cm.LAWS)
    heights = sorted(text.xy[1] for text in ax.texts)  # type: ignore[attr-defined]
    assert heights[0] >= 0
    assert heights[-1] <= 1
    assert np.diff(heights).min() > 0.05
    assert "cycloidal from" in describe(ax.figure)  # type: ignore[arg-type]
    looks = {(str(vars(line)["_dash_pattern"]), str(line.get_color())) for line in ax.lines}
    assert len(looks) == len(cm.LAWS)


def test_a_response_as_it_is() -> None:
    chain = cm.two_masses(8, 2, k1_N_per_mm=40, k2_N_per_mm=20, b1_N_s_per_mm=0.01)
    run = cm.SteadyResponse(chain, cm.EXAMPLE.die, 2000)
    ax = cm.plot_response(run)
    lines = {str(line.get_label()): line for line in ax.lines}
    at = np.asarray(lines["mass 1"].get_xdata())
    assert (at[0], at[-1]) == (150, 510)
    assert lines["mass 2"].get_ydata() == pytest.approx(run.acceleration(at, 2))
    assert lines["cam"].get_ydata() == pytest.approx(run.cam_acceleration(at))
    move = cm.Move(stroke_mm=50, angle_deg=55, rate_per_hour=2000)
    ax = cm.plot_response(cm.MoveResponse(cm.tuned_mass(12, 0.02), move), masses=[1])
    assert ax.get_xlabel() == "time t in s"
    assert [line.get_label() for line in ax.lines][:2] == ["mass", "cam"]
    with pytest.raises(cm.InputError, match="number of the mass is 3"):
        cm.plot_response(run, masses=[3])
    with pytest.raises(cm.InputError, match="quantity 'jerk'"):
        cm.plot_residual("cycloidal", quantity="jerk")


def test_the_worst_from_a_ratio_on() -> None:
    ratios = np.linspace(0.5, 6, 12)
    ax = cm.plot_residual(["cycloidal", "cubic"], ratios=ratios, quantity="worst")
    for line in ax.lines[:2]:
        law, drawn = str(line.get_label()), np.asarray(line.get_ydata())
        for ratio, value in zip(ratios, drawn, strict=True):
            found = cm.residual_vibration(law, np.linspace(ratio, 10, 19001))
            assert value == pytest.approx(np.max(found), rel=0.02)
        assert np.all(np.diff(drawn) <= 0)


def test_the_worst_of_a_running_machine_is_not_drawn() -> None:
    """It would be that of a resonance between two of its ratios, as high as they happen to be."""
    with pytest.raises(cm.InputError, match="single move"):
        cm.plot_residual("cycloidal", quantity="worst", motion=cm.EXAMPLE.die)


def test_ratios_in_any_order() -> None:
    ax = cm.plot_residual("cycloidal", ratios=[[3, 1], [2, 5]])
    assert np.asarray(ax.lines[0].get_xdata()).tolist() == [1, 2, 3, 5]

"""Numbers that stand in the prose of lessons, computed by another way than the lessons do."""

import json
import math
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from scipy.optimize import brentq

import cammotion as cm

LESSONS = Path(__file__).parents[1] / "notebooks"
TURN_S, PER_DEG2 = 1.8, 1 / 1000 / (1.8 / 360) ** 2  # 1 mm/deg² in m/s²
FOUR = ("modified trapezoid", "cycloidal", "3-4-5 polynomial", "modified sine")


def says(lesson: str, words: str) -> bool:
    """Whether words stand in the prose of a lesson."""
    (path,) = LESSONS.glob(f"{lesson}_*.ipynb")
    cells = json.loads(path.read_text(encoding="utf-8"))["cells"]
    return any(words in "".join(c["source"]) for c in cells if c["cell_type"] == "markdown")


def test_the_force_that_holds_an_upright_die() -> None:
    g, hard = 9.80665, 2 * np.pi * 0.050 / 0.275**2
    before, after = 12 * (g + hard), 12 * (g + hard / 5)
    assert (before, after) == pytest.approx((167.5, 127.6), abs=0.05)
    assert 100 * (1 - after / before) == pytest.approx(24, abs=0.5)
    assert 100 * (1 - (after / before) ** 0.5) == pytest.approx(13, abs=0.5)
    assert says("02", "167.5 to 127.6 N")
    assert says("02", "24 percent, not by 80")


def test_what_the_margin_of_a_millimetre_is_worth_in_degrees() -> None:
    """The mill may be so late that it comes to 0.65 mm when the tip comes to the rim."""
    widest = cm.widest_move(cm.EXAMPLE.diagram, "die", _deep(19)).diagram
    (reserve,) = cm.reserves(widest, [_deep(20)])
    assert reserve.deg == pytest.approx(1.3, abs=0.05)
    rim = brentq(lambda at: widest.position_mm("die", at) - 20, 130, 140)
    assert widest["mill"].offset_mm(rim - 1.5) == pytest.approx(0.68, abs=0.005)
    assert says("03", "a millimetre bears a mill that is 1.3 degrees late")
    assert says("03", "the mill still has 0.68 mm to go")


def _deep(limit_mm: float) -> cm.ClearanceRule:
    return cm.ClearanceRule(cm.beyond("die", limit_mm), only_while=cm.within("mill", 0.65))


def test_a_wider_angle_makes_another_cam_under_the_same_roller() -> None:
    """Where the die is set off the cam of 55 deg is hollow, and that of 124.8 deg is not."""
    x, g = 0.25, 9.80665

    def on(angle_deg: float, prime_mm: float, roller_mm: float, a: float) -> tuple[float, float]:
        angle = math.radians(angle_deg)
        r = prime_mm + 50 * (x - 1 / (2 * math.pi))
        slope, bend = 50 / angle, 50 * 2 * math.pi / angle**2
        curvature = (r**2 + 2 * slope**2 - r * bend) / (
            r**2 + slope**2
        ) ** 1.5  # of the pitch curve
        force = 12 * (g + a) * math.hypot(slope, r) / r
        return curvature, math.sqrt(force / (roller_mm * (1 - roller_mm * curvature)))

    for prime_mm in (60, 80, 100, 150, 200, 300):
        for roller_mm in (10, 20):
            hollow, narrow = on(55, prime_mm, roller_mm, 4.154)
            bulge, wide = on(124.84, prime_mm, roller_mm, 0.806)
            assert hollow < 0 < bulge
            assert 0.01 < 1 - wide / narrow < 0.125
    assert says("02", "often less hollow there, and then it falls by less")


def test_the_friction_of_the_table_in_its_flywheel() -> None:
    """The modified sine by its zones, added up over a cycle at the mean power of the friction."""
    x = np.linspace(0, 1, 200_001)
    early = np.minimum(x, 1 - x)
    sine, cosine = np.sin(4 * np.pi * early), np.cos(4 * np.pi / 3 * (early - 1 / 8))
    law = 4 * np.pi**2 / (4 + np.pi) * np.where(early < 1 / 8, sine, cosine) * np.sign(0.5 - x)
    velocity = np.concatenate([[0], np.cumsum(law[1:] + law[:-1]) * x[1] / 2])
    step, time_s = 2 * np.pi / 8, 0.75
    swings = []
    for friction in (0, 10):
        mean = friction * step / (time_s * 360 / 150)
        power = (38.5 * step / time_s**2 * law + friction) * step / time_s * velocity - mean
        done = np.concatenate([[0], np.cumsum(power[1:] + power[:-1]) * x[1] / 2 * time_s])
        swings.append(done.max() - min(done.min(), done[-1] - mean * time_s * 210 / 150))
    assert swings == pytest.approx([65.4, 67.8], abs=0.05)
    assert says("08", "which makes it 67.8 J, 4 percent more")


def test_the_jerks_at_which_play_is_crossed() -> None:
    """Written out: sine and cosine zones turn with so many waves, the polynomial is 10, -15, 6."""
    sine = 4 * math.pi / (4 + math.pi)  # the modified sine's Ca over pi
    trapezoid = 8 / (2 + math.pi)
    middles = {
        "modified trapezoid": 4 * math.pi**2 * trapezoid,
        "cycloidal": 4 * math.pi**2,
        "3-4-5 polynomial": 30,
        "modified sine": 4 * math.pi**2 * sine / 3,
    }
    starts = middles | {"3-4-5 polynomial": 60, "modified sine": 4 * math.pi**2 * sine}
    for name in FOUR:
        found = [abs(float(cm.LAWS[name](x, 3))) for x in (0.5, 0)]
        assert found == pytest.approx([middles[name], starts[name]])
    assert min(middles, key=lambda name: middles[name]) == "modified sine"
    assert max(starts, key=lambda name: starts[name]) == "modified sine"
    assert says("08", "is the largest of the four, 69.5 to the cycloid's 39.5")


def test_the_collision_of_notebook_04() -> None:
    def covered(x: float) -> float:
        return x - math.sin(2 * math.pi * x) / (2 * math.pi)

    at_rim = 65 + 140 * brentq(lambda x: 50 * covered(x) - 20, 0, 1)
    ends = brentq(lambda deg: 100 * (1 - covered(deg / 150)) - 0.65, 120, 140)
    assert at_rim == pytest.approx(127.9, abs=0.05)
    assert 100 * (1 - covered(at_rim / 150)) == pytest.approx(2.0, abs=0.05)
    assert 50 * covered((ends - 65) / 140) - 19 == pytest.approx(6, abs=0.05)
    assert says("04", "the die is 6 mm deeper than the rule allows, and 5 mm below the rim")
    assert says("04", "At 127.9 degrees")
    assert says("04", "2.0 mm to go")


@pytest.mark.parametrize(
    ("line_deg", "parts", "peak"),
    [
        (15, (58.84, 18.18, 0.7045), 0.777),
        (5, (62.8534, 21.1204, 0.74532), 0.750),
        (0, (64.8118, 22.6612, 0.76661), 0.741),
    ],
)
def test_the_proposal_of_the_source(
    line_deg: float, parts: tuple[float, float, float], peak: float
) -> None:
    first_deg, first_mm, slope = parts
    last_deg, last_mm = 130 - line_deg - first_deg, 50 - first_mm - line_deg * slope

    def end(deg: float, height: float) -> np.polynomial.Polynomial:
        rows = [[deg**n, n * deg ** (n - 1), n * (n - 1) * deg ** (n - 2)] for n in (3, 4, 5)]
        found = np.linalg.solve(np.transpose(rows), [height, slope, 0])
        return np.polynomial.Polynomial([0, 0, 0, *found])

    ends = [(end(first_deg, first_mm), first_deg), (end(last_deg, last_mm), last_deg)]
    peaks = [np.abs(s.deriv(2)(np.linspace(0, deg, 4001))).max() * PER_DEG2 for s, deg in ends]
    assert max(peaks) == pytest.approx(peak, abs=6e-4)
    assert all(s(np.linspace(0, deg, 4001)).min() >= 0 for s, deg in ends)
    # 60 deg after its start the mill is 0.645 mm from its stop, and the die at the corner
    place = ends[0][0](60.0) if first_deg > 60 else first_mm + slope * (60 - first_deg)
    assert place == pytest.approx(19, abs=0.01)
    assert says("05", f"{peak:.3f}")


def die_best(away_deg: float) -> tuple[float, float]:
    """Return the least peak of the die in m/s², free and within 50 mm.

    By the three lines of notebook 06, for a mill that is away from its stops so many deg before
    and after its middle.
    """
    corner = 130 - away_deg
    late = max(corner - 65, 0)
    area = 65**2 / 2 + late**2 / 2 + late * (130 - corner) if late else corner**2 / 2
    free = 31 / area * PER_DEG2
    angle = corner / (1 - np.sqrt(19 / 50 / 2))  # of a parabola of 50 mm through the corner
    return free, 200 / angle**2 * PER_DEG2 if angle <= 130 else free


def mill_best(away_deg: float) -> float:
    """Return the least peak of the mill: it may swing by 0.65 mm before it leaves its stop."""
    run_up = math.sqrt(4 * 0.65)
    return (-run_up + math.sqrt(run_up**2 + 2 * 49.35)) ** 2 / away_deg**2 * PER_DEG2


def test_the_front_of_notebook_06() -> None:
    limited = brentq(lambda away: mill_best(away) - 0.7, 50, 80)
    assert die_best(limited) == pytest.approx((0.568, 0.583), abs=5e-4)
    equal = brentq(lambda away: mill_best(away) - die_best(away)[1], 50, 80)
    assert mill_best(equal) == pytest.approx(0.64, abs=2e-3)
    assert says("06", "is 0.568 without")
    assert says("06", "0.583 within")
    assert says("06", "0.64 was reached for both")


@pytest.mark.parametrize("limit", [0.45, 0.75])
def test_bounds_of_the_front_lie_below_the_closed_form_and_motions_above(limit: float) -> None:
    found = cm.least_peak(
        cm.EXAMPLE.diagram,
        cm.ClearanceRule(cm.beyond("die", 19), only_while=cm.within("mill", 0.65)),
        still={"mill": [(205, 305)], "die": [(205, 305)]},
        travel_mm={"die": (0, 50)},
        weights={"mill": 0},
        at_most={"mill": limit},
        gap=0.03,
    )
    least = die_best(brentq(lambda away: mill_best(away) - limit, 40, 90))[1]
    assert found.bound <= least * (1 + 1e-9)
    assert found.reached >= least * (1 - 1e-3)
    assert found.gap < 0.06


def test_the_running_machine_on_a_spring() -> None:
    hertz, running = 4.55, (1.48, 1.18, 1.27, 1.42)
    count, example = 3600, cm.EXAMPLE
    angles = np.arange(count) * 360 / count
    rate, waves = 2 * np.pi * hertz, 2 * np.pi * np.fft.rfftfreq(count, TURN_S / count)
    passed = (0.04j * rate * waves + rate**2) / (rate**2 - waves**2 + 0.04j * rate * waves)
    for name, peak in zip(FOUR, running, strict=True):
        given = example.diagram.with_motion(example.die.with_law(name))
        driven = cm.widest_move(given, "die", example.rule).diagram.acceleration("die", angles)
        swung = np.fft.irfft(np.fft.rfft(driven) * passed, count)
        assert np.abs(swung).max() == pytest.approx(peak, abs=6e-3)
    *first, last = [f"{peak:.2f}" for peak in running]
    assert says("06", f"{', '.join(first)} and {last}")


def test_the_single_rise_on_a_spring_turns_the_ranking() -> None:
    """By a recurrence from step to step, exact for a straight line of the acceleration."""
    for hertz, best, worst in ((12, 0, 3), (4.55, 1, 0), (4, 0, 3)):
        peaks = [single_rise(name, hertz) for name in FOUR]
        assert (int(np.argmin(peaks)), int(np.argmax(peaks))) == (best, worst)
    assert single_rise("modified trapezoid", 12) == pytest.approx(0.815, abs=2e-3)
    assert single_rise("cycloidal", 4.55) == pytest.approx(1.213, abs=2e-3)


def single_rise(law: str, hertz: float) -> float:
    example = cm.EXAMPLE
    found = cm.widest_move(
        example.diagram.with_motion(example.die.with_law(law)), "die", example.rule
    )
    move, rate = found.diagram.moves("die")[0], 2 * np.pi * hertz
    time = np.linspace(0, 4 * move.time_s, 8001)
    driven = np.where(time < move.time_s, move.acceleration(np.minimum(time, move.time_s)), 0)
    damped, decay = rate * np.sqrt(1 - 0.02**2), 0.02 * rate
    step = time[1]
    turn = np.exp((-decay + 1j * damped) * step)
    state, peak = 0j, 0.0  # the swing as a turning arrow: its imaginary part is the stretch
    for early, late in pairwise(driven):
        state = state * turn - step * (early + late) / 2 / damped * np.sqrt(turn)
        stretch, speed = state.imag, (state * (-decay + 1j * damped)).imag
        peak = max(peak, abs(rate**2 * stretch + 2 * decay * speed))
    return peak


def test_a_law_may_pass_all_tests_and_the_peak_and_be_another_one() -> None:
    """A quarter sine, a constant and a quarter cosine of b = d, with the modified sine's peak."""
    sine = 4 * np.pi**2 / (4 + np.pi)
    ends = (np.pi**2 - np.pi - 4) / (2 * np.pi * (np.pi - 2))  # 4 pi²/(pi² - 2 pi (pi - 2) b)
    other = cm.scca(ends, 1 - 2 * ends, ends)
    assert other.Ca == pytest.approx(sine)
    assert other.Cv == pytest.approx(2)  # the modified sine's is 1.76
    assert says("05", "If it passes, $C_v$, $C_j$ or some values of $S$ tell which law it is.")

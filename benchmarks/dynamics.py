"""What a follower's exact response costs, beside SciPy's simulation, and how exact both are."""

from itertools import pairwise
from statistics import median

import numpy as np
from findings import Finding, ratio_of_medians, say
from numpy.typing import NDArray
from package import seconds_of, time_by_turns

import cammotion as cm

MS = 1000
ROUNDS, TURNS, POINTS = 9, 10, 3600
RATIOS = np.linspace(0.05, 20, 200)
RATE = 2000
FOLLOWER = cm.two_masses(
    8, 2, k1_N_per_mm=90, k2_N_per_mm=40, b1_N_s_per_mm=0.02, b2_N_s_per_mm=0.01
)
Array = NDArray[np.float64]


def measure_residuals() -> list[Finding]:
    """Residual and dynamic factor of all laws, each at 200 ratios."""
    laws = [law for law in cm.LAWS.values() if np.isfinite(law.Ca)]

    def both() -> None:
        for law in laws:
            cm.residual_vibration(law, RATIOS)
            cm.dynamic_factor(law, RATIOS)

    spent = median(seconds_of(both) for _ in range(ROUNDS))
    what = f"residual and dynamic factor of {len(laws)} laws at {len(RATIOS)} ratios"
    return [Finding(what, spent, 1, "s")]


def measure_response() -> list[Finding]:
    """Two masses over ten turns, and the same by `scipy.signal.lsim`."""
    from scipy.signal import lsim

    die = cm.EXAMPLE.die
    at = die.start_deg + np.arange(TURNS * POINTS) * 360 / POINTS
    times = (at - die.start_deg) / 360 * 3600 / RATE
    cam = np.asarray(die.derivative(2, at, RATE))
    m, b, k = FOLLOWER.mass_matrix, FOLLOWER.damping_matrix, FOLLOWER.stiffness_matrix
    inverse, ones = np.linalg.inv(m), np.ones((2, 1))
    system = (
        np.block([[np.zeros((2, 2)), np.eye(2)], [-inverse @ k, -inverse @ b]]),
        np.vstack([0 * ones, -ones]),
        np.hstack([-inverse @ k, -inverse @ b])[1:],
        np.zeros((1, 1)),
    )

    def own() -> Array:
        return np.asarray(cm.StartResponse(FOLLOWER, die, RATE).acceleration(at))

    def simulated() -> Array:
        return np.asarray(lsim(system, cam, times)[1])

    exact = _stepped(at)
    spent, theirs = time_by_turns(own, simulated, ROUNDS)
    size = float(np.abs(exact).max())
    off, off_there = (
        float(np.abs(found[:: POINTS // 20] - exact).max()) / size for found in (own(), simulated())
    )
    say(f"{MS * median(spent):.1f} ms, lsim {MS * median(theirs):.1f} ms")
    say(f"off by {off:.1e} of the peak, lsim by {off_there:.1e}")
    what = f"two masses over {TURNS} turns of {POINTS} points"
    return [
        Finding(what, MS * median(spent), 50, "ms"),
        Finding("the same : lsim", ratio_of_medians(spent, theirs), 1, "x"),
        Finding("error of lsim : its error", off_there / off, 1e4, "x", at_least=True),
    ]


def _stepped(at: Array) -> Array:
    """Return the acceleration at every few places, by an integrator in steps of its own."""
    from scipy.integrate import solve_ivp

    m, b, k = FOLLOWER.mass_matrix, FOLLOWER.damping_matrix, FOLLOWER.stiffness_matrix
    die, inverse = cm.EXAMPLE.die, np.linalg.inv(m)
    per_s = 360 * RATE / 3600
    chosen = at[:: POINTS // 20]
    joints = {
        segment.from_deg + 360 * turn for segment in die.segments for turn in range(TURNS + 1)
    }
    stops = sorted({*chosen.tolist(), *(joint for joint in joints if joint < chosen[-1])})
    state, found = np.zeros(4), {stops[0]: np.zeros(4)}
    for low, high in pairwise(stops):
        edge = 1e-10 * (high - low)

        def rate(
            angle: float, state: Array, low: float = low + edge, high: float = high - edge
        ) -> Array:
            given = die.derivative(2, min(max(angle, low), high), RATE)
            pushed = -inverse @ (k @ state[:2] + b @ state[2:])
            return np.concatenate([state[2:], pushed - given]) / per_s

        ran = solve_ivp(rate, (low, high), state, "DOP853", rtol=3e-14, atol=1e-17)
        state = found[high] = ran.y[:, -1]
    states = np.array([found[angle] for angle in chosen])
    return np.asarray(-(states[:, :2] @ (inverse @ k).T + states[:, 2:] @ (inverse @ b).T)[:, 1])

from . import checks, kinematics, laws, live, plots, setup_check
from .checks import InputError
from .kinematics import (
    Move,
    cycle_time,
    indexing_time,
    peak_acceleration,
    peak_jerk,
    peak_velocity,
)
from .laws import LAWS, MotionLaw, as_law, x
from .live import explore_move
from .plots import plot_curves, plot_inverse_square, plot_peaks
from .setup_check import check_setup

__all__ = [
    "LAWS",
    "InputError",
    "MotionLaw",
    "Move",
    "as_law",
    "check_setup",
    "checks",
    "cycle_time",
    "explore_move",
    "indexing_time",
    "kinematics",
    "laws",
    "live",
    "peak_acceleration",
    "peak_jerk",
    "peak_velocity",
    "plot_curves",
    "plot_inverse_square",
    "plot_peaks",
    "plots",
    "setup_check",
    "x",
]

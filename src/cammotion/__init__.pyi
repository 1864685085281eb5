from . import (
    animation,
    arcs,
    checks,
    diagram,
    explorers,
    kinematics,
    laws,
    live,
    motions,
    overlap,
    plots,
    segments,
    setup_check,
    tables,
    timing_plots,
    turning,
)
from .animation import animate
from .checks import InputError
from .diagram import TimingDiagram
from .explorers.move import explore_move
from .explorers.overlap import explore_overlap
from .explorers.shares import explore_shares
from .kinematics import (
    Move,
    cycle_time,
    indexing_time,
    peak_acceleration,
    peak_jerk,
    peak_velocity,
)
from .laws import LAWS, MotionLaw, as_law, x
from .motions import Motion, indexing_motion, motion
from .overlap import (
    ClearanceRule,
    beyond,
    find_clearances,
    find_violations,
    smallest_clearance,
    widest_move,
    with_angle,
    within,
)
from .plots import plot_curves, plot_inverse_square, plot_peaks
from .segments import Segment, dwell, return_, rise
from .setup_check import check_setup
from .tables import read_segments, write_curves, write_segments
from .timing_plots import plot_clearance, plot_timing

__all__ = [
    "LAWS",
    "ClearanceRule",
    "InputError",
    "Motion",
    "MotionLaw",
    "Move",
    "Segment",
    "TimingDiagram",
    "animate",
    "animation",
    "arcs",
    "as_law",
    "beyond",
    "check_setup",
    "checks",
    "cycle_time",
    "diagram",
    "dwell",
    "explore_move",
    "explore_overlap",
    "explore_shares",
    "explorers",
    "find_clearances",
    "find_violations",
    "indexing_motion",
    "indexing_time",
    "kinematics",
    "laws",
    "live",
    "motion",
    "motions",
    "overlap",
    "peak_acceleration",
    "peak_jerk",
    "peak_velocity",
    "plot_clearance",
    "plot_curves",
    "plot_inverse_square",
    "plot_peaks",
    "plot_timing",
    "plots",
    "read_segments",
    "return_",
    "rise",
    "segments",
    "setup_check",
    "smallest_clearance",
    "tables",
    "timing_plots",
    "turning",
    "widest_move",
    "with_angle",
    "within",
    "write_curves",
    "write_segments",
    "x",
]

from . import (
    animation,
    arcs,
    checks,
    clearance,
    curves,
    diagram,
    exercises,
    explorers,
    kinematics,
    law_plots,
    laws,
    limits,
    live,
    motion_law,
    motions,
    overlap,
    plots,
    sampled,
    scca_family,
    segments,
    setup_check,
    tables,
    timing_plots,
    variants,
)
from .animation import animate
from .checks import InputError
from .clearance import (
    ClearanceRule,
    beyond,
    find_clearances,
    find_violations,
    smallest_clearance,
    within,
)
from .curves.zones import x
from .diagram import TimingDiagram
from .exercises import ask, check, choose, hint, predict, progress, variant
from .explorers.move import explore_move
from .explorers.overlap import explore_overlap
from .explorers.scca import explore_scca
from .explorers.shares import explore_shares
from .kinematics import (
    Move,
    cycle_time,
    indexing_time,
    peak_acceleration,
    peak_jerk,
    peak_velocity,
)
from .law_plots import plot_laws
from .laws import LAWS, as_law, fifth_degree_linear, polynomial
from .limits.least import LeastAcceleration, least_acceleration
from .motion_law import MotionLaw
from .motions import Motion, indexing_motion, motion
from .overlap import widest_move, with_angle
from .plots import plot_curves, plot_inverse_square, plot_peaks
from .sampled import law_from_points
from .scca_family import scca
from .segments import Segment, dwell, return_, rise
from .setup_check import check_setup
from .tables import read_segments, write_curves, write_segments
from .timing_plots import plot_clearance, plot_timing

__all__ = [
    "LAWS",
    "ClearanceRule",
    "InputError",
    "LeastAcceleration",
    "Motion",
    "MotionLaw",
    "Move",
    "Segment",
    "TimingDiagram",
    "animate",
    "animation",
    "arcs",
    "as_law",
    "ask",
    "beyond",
    "check",
    "check_setup",
    "checks",
    "choose",
    "clearance",
    "curves",
    "cycle_time",
    "diagram",
    "dwell",
    "exercises",
    "explore_move",
    "explore_overlap",
    "explore_scca",
    "explore_shares",
    "explorers",
    "fifth_degree_linear",
    "find_clearances",
    "find_violations",
    "hint",
    "indexing_motion",
    "indexing_time",
    "kinematics",
    "law_from_points",
    "law_plots",
    "laws",
    "least_acceleration",
    "limits",
    "live",
    "motion",
    "motion_law",
    "motions",
    "overlap",
    "peak_acceleration",
    "peak_jerk",
    "peak_velocity",
    "plot_clearance",
    "plot_curves",
    "plot_inverse_square",
    "plot_laws",
    "plot_peaks",
    "plot_timing",
    "plots",
    "polynomial",
    "predict",
    "progress",
    "read_segments",
    "return_",
    "rise",
    "sampled",
    "scca",
    "scca_family",
    "segments",
    "setup_check",
    "smallest_clearance",
    "tables",
    "timing_plots",
    "variant",
    "variants",
    "widest_move",
    "with_angle",
    "within",
    "write_curves",
    "write_segments",
    "x",
]

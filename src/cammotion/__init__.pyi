from .advice.changes import Improvement
from .advice.ranking import Improvements, improvements
from .drive.camshaft import Camshaft
from .drive.process import ProcessForce
from .drive.rates import RateLimit, rate_limits
from .dynamics.chain import Chain, tuned_mass, two_masses
from .dynamics.contact import Flights, follower_flights
from .dynamics.loads import FollowerLoad
from .dynamics.one_mass import OneMass
from .dynamics.polydyne import Polydyne, polydyne
from .dynamics.residual import (
    dynamic_factor,
    residual_vibration,
    running_factor,
    running_residual,
)
from .dynamics.response import MoveResponse, StartResponse, SteadyResponse
from .dynamics.springs import critical_harmonic, natural_frequency, springs_in_series
from .dynamics.turns import Flight
from .exchange.cam_files import write_cam
from .exchange.cam_tables_in import read_cam_table
from .exchange.cam_tables_out import write_cam_tables
from .exchange.diagram_tables import read_segments, write_curves, write_segments
from .exchange.machine_files import machine_from_text, read_machine, write_machine
from .hardware.contact import hertz_pressure
from .hardware.disc_cam import Undercut
from .hardware.fits import (
    Fit,
    Limits,
    deviation_um,
    grade_um,
    limits_of,
    mean_diameter_mm,
    size_step_mm,
    tolerance_unit,
)
from .hardware.flat_faced_cam import FlatFacedCam
from .hardware.followers import SwingingRoller, TranslatingRoller
from .hardware.geneva import Geneva
from .hardware.indexer import Indexer
from .hardware.inertia import Cross, Cuboid, Disc, OwnInertia, PointMasses, Ring
from .hardware.measured_profile import ProfileLift, lift_from_profile
from .hardware.prime_circle import smallest_base_radius, smallest_prime_radius
from .hardware.roller_cam import RollerCam
from .hardware.rotor import Rotor
from .laws.catalogue import CONSTANT_VELOCITY, LAWS, as_law, fifth_degree_linear, polynomial
from .laws.motion_law import MotionLaw
from .laws.scca_family import scca
from .laws.symbols import x
from .limits.least import LeastAcceleration, least_acceleration
from .limits.quickest import quickest_move
from .limits.reserves import Reserve, reserves
from .limits.widest import WidestMove, widest_move, with_angle
from .machine.diagram import TimingDiagram
from .machine.kinematics import (
    Move,
    arc_mm,
    cycle_time,
    indexing_time,
    peak_acceleration,
    peak_jerk,
    peak_velocity,
    per_minute,
)
from .machine.motions import Motion
from .machine.parts import MATCHED, dwell, indexing_motion, motion, return_, rise
from .machine.segments import Segment
from .measured.cam_table import CamTable
from .measured.differences import Differences, differences
from .measured.from_points import law_from_points, law_from_table
from .measured.from_table import motion_from_table
from .measured.harmonics import Harmonics, harmonics
from .measured.inch import KG_PER_LB, MM_PER_INCH, N_PER_LBF
from .measured.sampled_law import SampledLaw
from .measured.smoothing import SmoothedTable, smoothed
from .own import Machine
from .quantities import InputError, WrongAnswerError
from .report.writing import Report, write_report
from .rules.checks import find_clearances, find_violations, smallest_clearance
from .rules.clearance import ClearanceRule
from .rules.conditions import beyond, moving, standing, within
from .rules.distance import DistanceRule
from .teaching.bug_hunt import SUSPECTS
from .teaching.example import EXAMPLE, MillAndDie
from .teaching.printed_limits import PRINTED_LIMITS, PrintedLimits
from .teaching.session import again, ask, check, choose, hint, predict, progress, variant
from .teaching.setup_check import check_setup
from .versions.comparison import compare
from .views.animation.leaving import FollowerAnimation, animate_follower
from .views.animation.picture import animate
from .views.cam_plots import plot_cam
from .views.camshaft_plots import plot_camshaft
from .views.chart import write_chart
from .views.detour_plots import plot_detour, plot_weight
from .views.explorers.cam import explore_cam
from .views.explorers.follower import explore_follower, explore_residual
from .views.explorers.measured import explore_measured
from .views.explorers.move import explore_move
from .views.explorers.overlap import explore_overlap
from .views.explorers.scca import explore_scca
from .views.explorers.shares import explore_shares
from .views.explorers.ways import explore_ways
from .views.fit_plots import plot_fit
from .views.follower_plots import plot_residual, plot_response
from .views.law_plots import plot_laws, plot_ranking
from .views.limit_plots import plot_front, plot_jerk_price
from .views.live.explore import explore
from .views.live.formulas import inverse, largest, place_of_largest
from .views.live.parts import Box, Button, Control, Line, Panel, Point, Say, choice, pinned
from .views.measured_plots import plot_harmonics, plot_measured
from .views.number_control import NumberControl
from .views.plots import plot_curves, plot_inverse_square, plot_peaks
from .views.timing_plots import plot_clearance, plot_timing
from .views.torque_plots import plot_torque
from .views.version_plots import plot_comparison
from .whole.least_peak import LeastPeak, least_peak
from .whole.optimise import Optimised, optimise

__version__: str

__all__ = [
    "CONSTANT_VELOCITY",
    "EXAMPLE",
    "KG_PER_LB",
    "LAWS",
    "MATCHED",
    "MM_PER_INCH",
    "N_PER_LBF",
    "PRINTED_LIMITS",
    "SUSPECTS",
    "Box",
    "Button",
    "CamTable",
    "Camshaft",
    "Chain",
    "ClearanceRule",
    "Control",
    "Cross",
    "Cuboid",
    "Differences",
    "Disc",
    "DistanceRule",
    "Fit",
    "FlatFacedCam",
    "Flight",
    "Flights",
    "FollowerAnimation",
    "FollowerLoad",
    "Geneva",
    "Harmonics",
    "Improvement",
    "Improvements",
    "Indexer",
    "InputError",
    "LeastAcceleration",
    "LeastPeak",
    "Limits",
    "Line",
    "Machine",
    "MillAndDie",
    "Motion",
    "MotionLaw",
    "Move",
    "MoveResponse",
    "NumberControl",
    "OneMass",
    "Optimised",
    "OwnInertia",
    "Panel",
    "Point",
    "PointMasses",
    "Polydyne",
    "PrintedLimits",
    "ProcessForce",
    "ProfileLift",
    "RateLimit",
    "Report",
    "Reserve",
    "Ring",
    "RollerCam",
    "Rotor",
    "SampledLaw",
    "Say",
    "Segment",
    "SmoothedTable",
    "StartResponse",
    "SteadyResponse",
    "SwingingRoller",
    "TimingDiagram",
    "TranslatingRoller",
    "Undercut",
    "WidestMove",
    "WrongAnswerError",
    "again",
    "animate",
    "animate_follower",
    "arc_mm",
    "as_law",
    "ask",
    "beyond",
    "check",
    "check_setup",
    "choice",
    "choose",
    "compare",
    "critical_harmonic",
    "cycle_time",
    "deviation_um",
    "differences",
    "dwell",
    "dynamic_factor",
    "explore",
    "explore_cam",
    "explore_follower",
    "explore_measured",
    "explore_move",
    "explore_overlap",
    "explore_residual",
    "explore_scca",
    "explore_shares",
    "explore_ways",
    "fifth_degree_linear",
    "find_clearances",
    "find_violations",
    "follower_flights",
    "grade_um",
    "harmonics",
    "hertz_pressure",
    "hint",
    "improvements",
    "indexing_motion",
    "indexing_time",
    "inverse",
    "largest",
    "law_from_points",
    "law_from_table",
    "least_acceleration",
    "least_peak",
    "lift_from_profile",
    "limits_of",
    "machine_from_text",
    "mean_diameter_mm",
    "motion",
    "motion_from_table",
    "moving",
    "natural_frequency",
    "optimise",
    "peak_acceleration",
    "peak_jerk",
    "peak_velocity",
    "per_minute",
    "pinned",
    "place_of_largest",
    "plot_cam",
    "plot_camshaft",
    "plot_clearance",
    "plot_comparison",
    "plot_curves",
    "plot_detour",
    "plot_fit",
    "plot_front",
    "plot_harmonics",
    "plot_inverse_square",
    "plot_jerk_price",
    "plot_laws",
    "plot_measured",
    "plot_peaks",
    "plot_ranking",
    "plot_residual",
    "plot_response",
    "plot_timing",
    "plot_torque",
    "plot_weight",
    "polydyne",
    "polynomial",
    "predict",
    "progress",
    "quickest_move",
    "rate_limits",
    "read_cam_table",
    "read_machine",
    "read_segments",
    "reserves",
    "residual_vibration",
    "return_",
    "rise",
    "running_factor",
    "running_residual",
    "scca",
    "size_step_mm",
    "smallest_base_radius",
    "smallest_clearance",
    "smallest_prime_radius",
    "smoothed",
    "springs_in_series",
    "standing",
    "tolerance_unit",
    "tuned_mass",
    "two_masses",
    "variant",
    "widest_move",
    "with_angle",
    "within",
    "write_cam",
    "write_cam_tables",
    "write_chart",
    "write_curves",
    "write_machine",
    "write_report",
    "write_segments",
    "x",
]

"""What people type by mistake, with the sentence that tells them; and what is no mistake."""

from collections.abc import Callable
from decimal import Decimal
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import sympy
from hypothesis import given
from hypothesis import strategies as st
from IPython.core.interactiveshell import InteractiveShell
from machines import examples
from traitlets.config import Config

import cammotion as cm

ANY: Any = cm  # so that the wrong kinds below are no error of the types
DIAGRAM, DIE, RULE = cm.EXAMPLE.diagram, cm.EXAMPLE.die, cm.EXAMPLE.rule
CYCLOIDAL, TURN = cm.LAWS["cycloidal"], np.arange(0, 360, 10)
LOBE = 25 - 25 * np.cos(np.radians(TURN))
T = sympy.Symbol("t")
NEARLY = cm.MotionLaw("mine", 0.9999999 * cm.x)

MISTAKES: dict[str, tuple[Callable[[], object], str]] = {
    "a name for a motion": (
        lambda: ANY.with_angle("die", 60),
        r"^with_angle is given motion='die': give a motion, .* diagram\['die'\]",
    ),
    "a name for a new motion": (
        lambda: ANY.EXAMPLE.diagram.with_motion("die"),
        r"^with_motion is given motion='die': give a motion, made with",
    ),
    "no result": (
        lambda: ANY.plot_jerk_price([RULE]),
        r"found\[0\]=ClearanceRule.*: give what least_acceleration returned",
    ),
    "a motion for a diagram": (
        lambda: ANY.least_acceleration(DIE, "die", RULE, still=[(205, 305)]),
        r"^The diagram is Motion\('die'.*: give a TimingDiagram",
    ),
    "one motion for several": (
        lambda: ANY.TimingDiagram(DIE, 2000),
        r"motions=Motion.*: give a list, each a motion",
    ),
    "no path": (lambda: ANY.read_segments(None), r"^The path of the file is None: give one like"),
    "a NUL in a path": (
        lambda: cm.read_segments("a\0b.csv"),
        r"^The path 'a\\x00b\.csv' holds a character that no path may have",
    ),
    "too large for a float": (lambda: cm.cycle_time(10**400), r"^The machine rate is inf"),
    "a height in quotes": (
        lambda: ANY.LAWS["cycloidal"].where_above("0.5"),
        r"^The displacement S has to be .*: give it as a number, 0\.5 without quotes",
    ),
    "an angle in quotes": (
        lambda: DIE.position_mm("170"),
        r"^The cam angle has to be .*: give it as a number, 170 without quotes",
    ),
    "no rows": (lambda: ANY.plot_timing(DIAGRAM, rows=None), r"rows=None: give a list, each a tex"),
    "a span below 0": (
        lambda: cm.plot_clearance(DIAGRAM, RULE, span_mm=-5),
        r"^The span of the axis is -5 mm; .* above 0 mm",
    ),
    "half a name": (lambda: cm.LAWS["cycloid"], r"no motion law 'cycloid': did you mean 'cycloid"),
    "a part of a name": (
        lambda: cm.LAWS["sin"],
        "no motion law 'sin': did you mean 'modified sine' or 'simple harmonic'",
    ),
    "without hyphens": (lambda: cm.LAWS["345"], "'345': did you mean '3-4-5 polynomial'"),
    "masked": (
        lambda: cm.cycle_time(np.ma.masked_array([1.0, 2.0], [False, True])),
        r"has masked values.*\.compressed\(\)",
    ),
    "an object": (
        lambda: cm.cycle_time(np.array([2000, None], dtype=object)),
        r"^The machine rate has to be a number in pieces/h, not array",
    ),
    "nearly a law": (
        lambda: NEARLY.check_way(),
        r"S\(1\) = 0\.9999999; a move goes from 0 to 1",
    ),
    "just above 1": (
        lambda: CYCLOIDAL(1.0000000001),
        r"x = t/tm is 1\.0000000001; .* at most 1:",
    ),
    "just more than a turn": (
        lambda: cm.motion("die", *[cm.dwell(120.0000001)] * 3),
        r"add up to 360\.0000003 deg; a cam turn is 360: take away 3e-07 deg",
    ),
    "thirds with seven digits": (
        lambda: cm.scca(0.3333333, 0.3333333, 0.3333333),
        r"0\.3333333 \+ 0\.3333333 \+ 0\.3333333, add up to 0\.9999999: let",
    ),
    "nearly to 1": (
        lambda: cm.polynomial((0, 0, 0), (1.0000001, 0, 0)),
        r"from s = 0 to 1\.0000001; a motion law goes from 0 to 1",
    ),
    "a machine for its diagram": (
        lambda: cm.plot_timing(cm.Machine("press", cm.EXAMPLE.diagram)),  # type: ignore[arg-type]
        r"^plot_timing is given diagram=press.*: give its timing diagram, with \.diagram behind it",
    ),
    "a mass for a chain": (
        lambda: cm.SteadyResponse(cm.OneMass("cycloidal", 3), DIE, 2000),  # type: ignore[arg-type]
        r"^SteadyResponse is given chain=OneMass.*: give a Chain\.$",
    ),
    "a turn back": (
        lambda: cm.Segment(from_deg=0, to_deg=-349.5, from_mm=0, to_mm=5, law="cycloidal"),
        r"ends before it begins: if it goes on over 360 deg, let it end at 10\.5 deg\.$",
    ),
    "a limit that is none": (
        lambda: DIE.where_beyond(float("nan")),
        r"^The limit is nan mm; .* for example 19 mm",
    ),
    "no derivative": (
        lambda: DIE.derivative(-1, 180, 2000),
        r"^The order of the derivative is -1; it has to be a whole number above 0 and at most 3",
    ),
    "an integral": (
        lambda: cm.MotionLaw("mine", sympy.Integral(6 * T * (1 - T), (T, 0, cm.x))),
        r"^The law uses the function Integral, whose turning points cannot be proved",
    ),
    "a function of SymPy": (
        lambda: cm.MotionLaw("mine", sympy.Lambda(T, T)),
        r"'mine' is Lambda.*; it has to be a SymPy expression in cammotion.x alone",
    ),
    "an angle for x": (lambda: CYCLOIDAL(27.5), r"x = t/tm is 27\.5; .* at most 1"),
    "a whole lobe": (
        lambda: cm.law_from_points([*TURN / 360, 1], [*LOBE / 50, 0]),
        r"ends where it begins, at 0; a law is one rise or one return",
    ),
    "a segment over 360 deg": (
        lambda: cm.Segment(from_deg=350, to_deg=10, from_mm=0, to_mm=5, law="cycloidal"),
        r"ends before it begins: if it goes on over 360 deg, let it end at 370 deg\.$",
    ),
    "radians": (
        lambda: cm.CamTable(np.radians(TURN), LOBE, is_cycle=True),
        r"which in radians is a turn: give the cam angles in deg, for example np\.degrees",
    ),
    "a minute for an hour": (
        lambda: ANY.TimingDiagram([DIE], rate_per_minute=90),
        r"no argument 'rate_per_minute': give rate_per_hour=per_minute\(\.\.\.\)",
    ),
    "a rise downwards": (
        lambda: cm.rise(-40, over_deg=50),
        r"^The stroke is -40 mm; .* above 0 mm, and the way down is a return_\(40, over_deg=",
    ),
    "a force over the end of the turn": (
        lambda: cm.ProcessForce(motion="die", from_deg=350, to_deg=20, force_N=80),
        r"goes on over the end of the turn, give to_deg=380\.$",
    ),
    "a hole that is none of ours": (
        lambda: cm.Fit("30 K7/h6"),
        r"no confirmed tolerance zone with the letter 'K': use one of 'F', 'G', 'H'",
    ),
    "an arc for a list of arcs": (
        lambda: ANY.optimise(DIAGRAM, RULE, still={"die": (205, 305)}),
        r"still\['die'\]\[0\]=205: give 2 values, each a finite number",
    ),
    "no expression": (
        lambda: ANY.plot_weight(1, (cm.x, 0, 1)),
        r"weight=1: give an expression of SymPy",
    ),
    "a crankshaft": (lambda: cm.dwell(440), r"is 440 deg, .* or 220 if you count the 720 deg of a"),
    "no overwriting": (
        lambda: ANY.write_segments(DIAGRAM, "machine.csv", overwrite="no"),
        r"overwrite is 'no': give True or False",
    ),
}


@pytest.mark.parametrize("mistake", MISTAKES)
def test_a_mistake_is_told(mistake: str) -> None:
    make, said = MISTAKES[mistake]
    with pytest.raises(cm.InputError, match=said) as refusal:
        make()
    assert len(str(refusal.value)) < 400


@examples(50)
@given(st.integers(1, 10**9), st.integers(1, 10**9))
def test_a_motion_that_lacks_a_dwell_has_it_when_it_does_as_it_is_told(up: int, down: int) -> None:
    """Of angles with many digits too: what is told has all of them."""
    up_deg, down_deg = up / 6e6, down / 6e6
    parts = [cm.rise(up_deg, over_deg=up_deg), cm.return_(up_deg, over_deg=down_deg)]
    with pytest.raises(cm.InputError, match=r"add a dwell of [\d.e-]+ deg\.$") as told:
        cm.motion("die", *parts)
    missing = float(str(told.value).split("add a dwell of ")[1].removesuffix(" deg."))
    assert cm.motion("die", *parts, cm.dwell(missing)).segments[2].to_deg == pytest.approx(360)


def test_laws_of_a_table_are_no_names(tmp_path: Path) -> None:
    path = cm.write_segments(DIAGRAM, tmp_path / "machine.csv")
    with pytest.raises(cm.InputError, match=r"^Among the laws is 'cycloidal': give a list of mot"):
        cm.read_segments(path, laws=["cycloidal"])  # type: ignore[list-item]


def test_another_encoding_is_told_by_the_button_to_press(tmp_path: Path) -> None:
    path = tmp_path / "machine.csv"
    path.write_bytes("Öffnen;1".encode("latin-1"))
    with pytest.raises(cm.InputError, match=r"no character in UTF-8\. Save it .* as 'CSV UTF-8'"):
        cm.read_segments(path)


@pytest.mark.parametrize("angle", [55, 55.0, np.int64(55), np.float32(55), Decimal(55)])
def test_a_number_of_any_kind_is_one(angle: Any) -> None:
    assert ANY.peak_acceleration(Fraction(50), angle, 2000) == cm.peak_acceleration(50, 55, 2000)


@pytest.mark.parametrize("kind", [Fraction, Decimal])
def test_a_number_of_any_kind_can_stand_in_a_sentence(kind: Any) -> None:
    with pytest.raises(cm.InputError, match=r"The quickest move of 50 mm takes 0\.2236 s"):
        cm.quickest_move(kind(50), acceleration_m_per_s2=kind(4), rate_per_hour=kind(20_000))
    with pytest.raises(cm.InputError, match="with 150 deg and 1 mm to spare"):
        cm.widest_move(DIAGRAM, "die", RULE, reserve_deg=kind(150), reserve_mm=kind(1))
    quarter = kind(1) / 4
    assert cm.scca(quarter, 2 * quarter, quarter).name == "SCCA(0.25, 0.5, 0.25)"
    with pytest.raises(cm.InputError, match=r"0\.25 \+ 1 \+ 0\.25, add up to 1\.5"):
        cm.scca(quarter, kind(1), quarter)


def test_an_array_of_objects_that_are_numbers_is_one_of_numbers() -> None:
    given = np.array([50, Fraction(55)], dtype=object)
    assert cm.peak_acceleration(50, given, 2000).tolist() == [
        cm.peak_acceleration(50, angle, 2000) for angle in (50, 55)
    ]


@pytest.mark.parametrize("curve", ["Velocity", "velocity"])
def test_what_is_drawn_may_be_named_in_any_case(curve: str) -> None:
    move = cm.Move(stroke_mm=50, angle_deg=55, rate_per_hour=2000)
    assert cm.plot_curves(move, curve=curve).get_ylabel() == "velocity v in m/s"
    laws = cm.plot_laws("cycloidal", curve=curve[0].lower())
    assert laws.get_ylabel() == "velocity V"
    assert len(cm.plot_timing(DIAGRAM, rows=[curve]).figure.axes) == 3


CELL = """def move(angle_deg):
    return cm.indexing_time(angle_deg, 2000)

move(-5)
"""


def test_a_notebook_shows_the_readers_lines_and_the_sentence(
    capsys: pytest.CaptureFixture[str],
) -> None:
    config = Config(HistoryManager={"enabled": False})
    shell: Any = InteractiveShell(  # type: ignore[no-untyped-call]
        config=config, user_ns={"cm": cm}
    )
    shell.run_cell(CELL)
    shown = capsys.readouterr().out.strip().splitlines()
    assert shown == [
        "line 4: move(-5)",
        "line 2: return cm.indexing_time(angle_deg, 2000)",
        "InputError: The indexing angle is -5 deg; it has to be a finite number above 0 and at "
        "most 360 deg: give for example 55 deg.",
    ]


@pytest.mark.parametrize("answer", [(4, 154), "4,154", "4.154", " 4,154 "])
def test_a_decimal_comma_in_an_answer_is_told(answer: Any) -> None:
    assert "4.154" in str(cm.check("02.1", answer))
    assert "[0]" not in str(cm.check("02.1", answer))

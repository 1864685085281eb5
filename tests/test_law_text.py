"""Laws as text: what is written is the law, and what is read is nothing but a law."""

import ast
import csv
import time
import warnings
from contextlib import suppress
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import sympy
from machines import make_diagram, make_die
from odd_machines import NAMES, draw, pool, worst

import cammotion as cm
from cammotion import InputError, MotionLaw, x
from cammotion.exchange import expression_text
from cammotion.exchange.expression_text import expression_as_text, expression_from_text
from cammotion.exchange.law_text import is_same_law, law_as_text, law_from_text

MACHINES = 25  # more are drawn in tests/fresh


def test_machines_come_back(tmp_path: Path) -> None:
    """Positions to 1e-9 mm and peaks to 1e-9, of machines with 1 to 24 mechanisms."""
    rng = np.random.default_rng(2026)
    for number in range(MACHINES):
        count = 24 if number < 1 else int(rng.choice([1, 1, 1, 2, 2, 3, 5]))
        diagram = draw(rng, count)
        path = cm.write_segments(diagram, tmp_path / "m.csv", overwrite=True)
        off_mm, share = worst(diagram, cm.read_segments(path))
        assert off_mm <= 1e-9
        assert share <= 1e-9


def test_a_solved_motion_comes_back_and_does_not_collide(tmp_path: Path) -> None:
    machine = cm.EXAMPLE
    still = [(205, 305)]
    die = cm.least_acceleration(machine.diagram, "die", machine.rule, still=still, jerk_m_per_s3=70)
    assert len({move.law for move in die.motion.moves}) == 2  # of one name
    diagram = machine.diagram.with_motion(die.motion)
    back = cm.read_segments(cm.write_segments(diagram, tmp_path / "m.csv"))
    assert worst(diagram, back) < (1e-9, 1e-9)
    assert cm.find_violations(back, machine.rule) == cm.find_violations(diagram, machine.rule)


@pytest.mark.parametrize(
    "law",
    [
        cm.scca(0.1, 0.2, 0.7),
        cm.scca(1, 0, 0),
        cm.LAWS["MCV50"],
        *(cm.Geneva(n).law for n in (3, 5)),
    ],
)
def test_a_law_comes_back_to_the_last_bit(law: MotionLaw) -> None:
    back = law_from_text("my", law_as_text(law))
    places = np.linspace(0, 1, 999)
    assert back.name == "my"
    for order in range(4):
        assert back(places, order) == pytest.approx(law(places, order), abs=1e-13, rel=1e-13)


def test_a_family_is_written_with_its_parameters() -> None:
    assert law_as_text(cm.scca(0.1, 0.2, 0.7)) == "scca(0.1, 0.2, 0.7)"
    assert law_as_text(cm.LAWS["3-4-5 polynomial"]) == "S = 6*x**5 - 15*x**4 + 10*x**3"


def test_points_are_written_as_they_are() -> None:
    law = cm.law_from_points([0, 0.3, 0.55, 1], [0, 0.125, 0.6, 1], end_slopes=(0.5, 0))
    assert law_as_text(law) == (
        "law_from_points([0.0, 0.3, 0.55, 1.0], [0.0, 0.125, 0.6, 1.0], end_slopes=(0.5, 0.0), "
        "fit='through', step=0.0)"
    )


def test_a_law_from_points_knows_them_when_it_comes_back() -> None:
    """Its points, their rounding and what that does, however it lies to them."""
    sampled: list[Any] = [law for law in pool() if hasattr(law, "sampled_at")]
    assert {(type(law.fit).__name__, law.amount > 0) for law in sampled} == {
        *(("Through", False), ("Through", True), ("Monotone", False)),
        *(("Periodic", False), ("Periodic", True)),
    }
    for law in sampled:
        back: Any = law_from_text(law.name, law_as_text(law))
        assert repr(back) == repr(law)
        for what in ("sampled_at", "step", "amount", "rounding", "Ca", "Cj"):
            assert getattr(back, what) == pytest.approx(getattr(law, what), rel=1e-12), what


@pytest.mark.parametrize("turned", [False, True], ids=["as points", "as polynomials"])
def test_ten_thousand_points_are_read_in_seconds(tmp_path: Path, turned: bool) -> None:
    places = np.linspace(0, 1, 10_001)
    law: MotionLaw = cm.law_from_points(places, places - np.sin(2 * np.pi * places) / (2 * np.pi))
    law = law.reversed() if turned else law
    start = time.process_time()
    path = cm.write_segments(make_diagram(make_die(law=law)), tmp_path / "m.csv")
    back = cm.read_segments(path)
    assert time.process_time() - start < 10
    assert is_same_law(cm.as_law(back["die"].moves[0].law), law)
    cells = [cell for row in csv.reader(path.open(newline="")) for cell in row]
    assert max(map(len, cells)) <= 30_001  # a spreadsheet cuts after 32,767
    assert not any(cell.startswith(("=", "+", "@", "-")) for cell in cells)
    assert any(cell.startswith("'-") for cell in cells) == turned


def test_laws_that_differ_are_told_apart() -> None:
    """Among all laws of the pool only those of one form are the same."""
    cubic = MotionLaw("a", 3 * x**2 - 2 * x**3)
    assert is_same_law(cubic, MotionLaw("b", x**2 * (3 - 2 * x)))
    assert not is_same_law(cubic, MotionLaw("a", 3 * x**2 - 2 * x**3 + x**2 * (1 - x) ** 2 / 10**9))
    assert not is_same_law(cubic, cm.LAWS["cycloidal"])
    trembling = MotionLaw("a", cubic.s + 1e-14 * sympy.sin(200 * sympy.pi * x))  # 1e-7 of the jerk
    assert not is_same_law(cubic, trembling)


@pytest.mark.parametrize("name", ["cycloidal", "constant velocity", "dwell"])
def test_a_law_that_has_the_name_of_another_one_says_so(tmp_path: Path, name: str) -> None:
    """A cell that is changed by hand must not leave the old law behind a new name."""
    path = cm.write_segments(make_diagram(make_die(law=MotionLaw(name, x**2))), tmp_path / "m.csv")
    rows = [*csv.reader(path.open(newline=""))]
    assert rows[1][6::2] == [name, "own law, S = x**2"]
    assert cm.read_segments(path)["die"].position_mm(150 + 55 / 2) == 12.5
    rows[1][8] = "S = x**2"
    with path.open("w", newline="") as file:
        csv.writer(file).writerows(rows)
    with pytest.raises(InputError, match=rf"^Line 2 of m.csv: The law is called '{name}', but "):
        cm.read_segments(path)


@pytest.mark.parametrize("name", NAMES)
def test_a_name_comes_back_and_is_no_formula(tmp_path: Path, name: str) -> None:
    law = MotionLaw(name, x**2)
    die = cm.motion(name, cm.rise(5.26, over_deg=90, law=law), cm.return_(5.26, over_deg=270))
    path = cm.write_segments(cm.TimingDiagram([die], 2000), tmp_path / "m.csv")
    for row in csv.reader(path.open(encoding="utf-8", newline="")):
        assert not any(cell.startswith(("=", "+", "@", "-", "\t")) for cell in row)
    back = cm.read_segments(path)
    assert back.names == (name,)
    assert cm.as_law(back[name].moves[0].law).name == name


@pytest.mark.parametrize("name", ["\t=1", " x", "\r=1"])
def test_the_name_of_a_law_may_begin_with_a_blank(tmp_path: Path, name: str) -> None:
    path = cm.write_segments(make_diagram(make_die(law=MotionLaw(name, x))), tmp_path / "m.csv")
    assert cm.as_law(cm.read_segments(path)["die"].moves[0].law).name == name


def test_the_heading_of_curves_is_no_formula(tmp_path: Path) -> None:
    diagram = cm.TimingDiagram([cm.motion("=die", cm.dwell(360))], 2000)
    text = cm.write_curves(diagram, tmp_path / "m.csv", step_deg=0.1).read_text()
    assert text.startswith("cam angle in deg,time in s,'=die position in mm,")
    assert "\n0.3," in text


@pytest.mark.parametrize(
    ("law", "match"),
    [
        (MotionLaw("blank ", x), r"^The name of a law is 'blank ', which no cell"),
        (MotionLaw("x" * 10**5, x), r"^The name of a law is 'x{56}\.\.\., which no cell"),
        (MotionLaw("\ud800", x), r"holds half a character, which no file can keep"),
    ],
)
def test_what_cannot_be_written_is_refused_before(
    tmp_path: Path, law: MotionLaw, match: str
) -> None:
    path = tmp_path / "m.csv"
    path.write_text("a week's work")
    with pytest.raises(InputError, match=match):
        cm.write_segments(make_diagram(make_die(law=law)), path, overwrite=True)
    assert path.read_text() == "a week's work"


def test_a_law_that_no_text_gives_back_is_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Whatever goes wrong with the text, it is found before anything is written."""
    wrong = "cammotion.exchange.law_text.expression_as_text"
    monkeypatch.setattr(wrong, lambda _: "x**2 + 1e-9*x*(1 - x)")
    with pytest.raises(InputError, match=r"^The law 'sq' cannot be written into a table, since"):
        cm.write_segments(
            make_diagram(make_die(law=MotionLaw("sq", sympy.sqrt(1 + 3 * x) - 1))), tmp_path / "m"
        )
    assert not [*tmp_path.iterdir()]


def test_a_table_that_would_not_come_back_is_an_error_of_ours(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    for wrong in (str.upper, lambda _: "", lambda name: f"a, {name}\n"):
        monkeypatch.setattr("cammotion.exchange.diagram_tables.name_cell", wrong)
        with pytest.raises(cm.WrongAnswerError, match=r"^write_segments has checked its answer"):
            cm.write_segments(make_diagram(), tmp_path / "m.csv")
    assert not [*tmp_path.iterdir()]


@pytest.mark.parametrize(
    "expression",
    [
        x,
        sympy.Float(0.1) * x,
        1e-300 * x,
        -(2**0.5) * x / 3 + sympy.sqrt(2),
        sympy.exp(-x / 3) + sympy.E**2 + sympy.log(1 + x),
        (1 + x) ** sympy.Rational(7, 3) / sympy.pi,
        sympy.Piecewise((x**2, x <= sympy.Rational(1, 3)), (x, x <= 0.5), (1, True)),
        1 / (1 + x**2),
    ],
)
def test_an_expression_is_read_as_it_was(expression: sympy.Expr) -> None:
    assert expression_from_text(expression_as_text(expression)) == expression


DAMAGE = ["-", "=", "\t", "'", '"', ";", ",", "\n", "1e9", "**", "x", "(", ")", "[", "nan", "S ="]
DAMAGE += [
    "scca",
    "0",
    " ",
    "\0",
    "é",
    "1_0",
    ".",
    "E",
    "sin(",
    "Piecewise((",
    "9" * 20,
    "/0",
    "inf",
]


def test_damaged_tables_are_read_or_refused_in_words(tmp_path: Path) -> None:
    rng, path = np.random.default_rng(4), tmp_path / "m.csv"
    for _ in range(25):
        text = cm.write_segments(draw(rng, 2), path, overwrite=True).read_bytes().decode()[:20_000]
        for _ in range(12):
            damaged = text
            for _ in range(int(rng.integers(1, 4))):
                at, gone = int(rng.integers(len(damaged))), int(rng.choice([0, 1, 1, 3, 30]))
                new = str(rng.choice(DAMAGE))
                damaged = damaged[:at] + new + damaged[at + gone :]
            path.write_bytes(damaged.encode())
            with suppress(InputError):
                assert cm.read_segments(path).motions


def test_a_number_without_a_name_is_written_in_digits() -> None:
    assert expression_as_text(sympy.EulerGamma * x) == "0.5772156649015329*x"


def test_odd_text_brings_no_warning_of_pythons() -> None:
    with warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("always")
        with pytest.raises(InputError):
            law_from_text("my", "S = 1if x else 2")
    assert not said


ATTACKS = [
    *("__import__('os').system('true')", "x.__class__", "().__class__", "[x]", "x if x else x"),
    *("lambda: x", "x := 3", "f'{x}'", "eval('x')", "open('m')", "x[0]", "*x", "sin", "sin()"),
    *("sin(x, x)", "sin(x=x)", "y", "x & x", "x // x", "x % 2", "x @ x", "~x", "not x", "x < 1"),
    *("True", "None", "'x'", "1j", "...", "", "x +", "(" * 10**4, "-" * 10**5 + "x", "9" * 10**5),
    *("9**9**9", "x**10**9", "(((9**999)**999)**999)", "10**(10**5)", "exp(exp(exp(100)))"),
    *(
        "sin(10**900)",
        "(1 + x)**10001",
        "2.0**5000",
        "tan(exp(800))",
        "+".join(["x"] * 10**5),
        "(x+" * 200 + "x" + ")" * 200,
        "x" + "/2" * 400,
        "sin(" * 60 + "x" + ")" * 60,
        "(" * 60 + "x" + "+1)**(1/2)" * 60,
    ),
    *("Piecewise()", "Piecewise((x, True), (x, True))", "2*Piecewise((x, x <= 1/2), (x, True))"),
    *("Piecewise((x, x <= 0.7), (x, x <= 0.2), (x, True))", "Piecewise((x, x**2 <= 0.5), (x, 1))"),
    *("Piecewise((x, x <= x), (x, True))", "Piecewise((x, x <= 2), (x, True))", "1e999*x", "\x00"),
    *("Piecewise((x, x <= 1/0), (x, True))", "import os", "x\nx", "1/0", "log(0)", "sqrt(-1)*x"),
]


@pytest.mark.parametrize("text", ATTACKS, ids=lambda text: text[:30])
def test_what_is_no_law_is_refused_at_once(text: str) -> None:
    start = time.process_time()
    with pytest.raises(InputError, match=r"^The (law|expression|case|polynomial)"):
        law_from_text("evil", f"S = {text}").check_way()
    for form in ("scca({})", "polynomials({})", "{}"):
        with pytest.raises(InputError):
            law_from_text("evil", form.format(text)).check_way()
    assert time.process_time() - start < 3


@pytest.mark.parametrize(
    "text",
    ["(x+" * 200 + "0" + ")" * 200 + "-199*x", "x" + " + x - x" * 12_000],
    ids=["deep", "long"],
)
def test_an_expression_has_an_end(text: str) -> None:
    """Both are x, in too many words."""
    with pytest.raises(
        InputError, match=r"^The expression (has more than 150 levels or|'x \+ x - )"
    ):
        expression_from_text(text)


@pytest.mark.parametrize(
    "text",
    [
        "scca(1, 2, 3)",
        "scca(1)",
        "scca(b=1, c=0, d=0, e=0)",
        "spline(1)",
        "polynomials()",
        "polynomials(([0, 1], [nan]))",
        "polynomials(([0, 1], [1e999]))",
        "polynomials(([0, 0.5], [0], [1]), ([0.6, 1], [0.5], [1]))",
        "polynomials(([0, 0.5, 0.5, 1], [0, 0, 0], [1, 1, 1]))",
        "polynomials(([0, 0.5, 1], [0, 0.5], [1, 1, 1]))",
        "polynomials(([0, 0.6, 0.4, 1], [0, 0.6, 0.4], [1, 1, 1]))",
        "polynomials(([0, 0.5, 1], [0, 0.7], [1, 1]))",
        "polynomials(([0, 0.5, 1], [0, 0.5], [1, 0.9], [0, 0.2]))",
        "polynomials(([0, 0.5, 1], [0, 0.5], [1, 1], [0, 0], [0, 0], [0, 0]))",
        "law_from_points([0, 1], [0, 1])",
        "law_from_points([0, 0.3, 0.6, 1], [0, 0.1, 0.7, 1], fit='best')",
        "law_from_points([0, 0.3, 0.6, 1], [0, 0.1, 0.7, 1], name='other')",
        "law_from_points()",
        "polynomials(([[0, 1]], [0], [1]))",
        f"polynomials(([0, 1], {', '.join(['[1]'] * 40)}))",
        f"polynomials({'(' * 500})",
    ],
    ids=lambda text: text[:60],
)
def test_lists_that_are_no_law_are_refused(text: str) -> None:
    with pytest.raises(InputError):
        law_from_text("my", text)


def test_a_law_that_is_given_takes_the_place_of_none_but_itself(tmp_path: Path) -> None:
    law, same, other = (MotionLaw("my", s) for s in (x**2, x * x, x**3))
    path = cm.write_segments(make_diagram(make_die(law=law)), tmp_path / "m.csv")
    assert cm.read_segments(path, laws=[other, same])["die"].moves[0].law is same
    found = cm.read_segments(path, laws=[other])["die"].moves[0].law
    assert is_same_law(cm.as_law(found), law)


@pytest.mark.parametrize("laws", [["cubic"], "cubic", 3, None, [MotionLaw("a", x), None]])
def test_laws_are_laws(tmp_path: Path, laws: object) -> None:
    path = cm.write_segments(make_diagram(make_die()), tmp_path / "m.csv")
    with pytest.raises(InputError, match=r"^Among the laws is .*: give a list of motion laws, "):
        cm.read_segments(path, laws=laws)  # type: ignore[arg-type]


@pytest.mark.parametrize("path", [None, 3, "a\0b", "\ud800", "", b"m.csv", ["m.csv"]])
def test_a_path_is_a_path(path: object) -> None:
    for use in (cm.read_segments, lambda path: cm.write_segments(cm.EXAMPLE.diagram, path)):
        with pytest.raises(InputError, match=r"^The path .*: give one like 'machine.csv'\.$"):
            use(path)  # type: ignore[arg-type]


def test_every_law_of_the_pool_has_a_text() -> None:
    for law in pool():
        back = law_from_text(law.name, law_as_text(law))
        for mine, theirs in ((law.Cv, back.Cv), (law.Ca, back.Ca), (law.Cj, back.Cj)):
            assert mine == pytest.approx(theirs, rel=1e-9)


def _nested(levels: int) -> ast.expr:
    node = ast.JoinedStr([])
    for _ in range(levels):
        node = ast.JoinedStr([node])
    return node


@pytest.mark.parametrize(
    ("tree", "is_read"),
    [
        (ast.JoinedStr([ast.JoinedStr([])] * 49_999), True),
        (ast.JoinedStr([ast.JoinedStr([])] * 50_000), False),
        (_nested(150), True),
        (_nested(151), False),
    ],
    ids=["most parts", "a part more", "deepest", "deeper"],
)
def test_how_large_an_expression_may_be(tree: ast.expr, *, is_read: bool) -> None:
    if is_read:
        expression_text._check_size(tree)
    else:
        with pytest.raises(cm.InputError, match=r"more than 150 levels or 50000 parts"):
            expression_text._check_size(tree)

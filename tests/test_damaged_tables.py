"""Two hundred damaged tables of a machine: a sentence each, no traceback, nothing written."""

import contextlib
import io
from pathlib import Path

import pytest
from damaged import BOOK, RELATIONS, TABLE, changed, damages, zipped

import cammotion as cm
from cammotion.exchange.rule_text import nameless
from cammotion.report.__main__ import BAD_INPUT, main
from cammotion.rules.rule import Rule


def test_two_hundred_damaged_tables_are_refused_in_sentences(tmp_path: Path) -> None:
    taken, seen, out = [], set(), tmp_path / "work"
    out.mkdir()
    for name, ending, content in damages(tmp_path):
        seen.add(name)
        path = tmp_path / f"machine{ending}"
        path.write_bytes(content)
        said = io.StringIO()
        with contextlib.redirect_stderr(said):
            code = main([str(path), "--folder", str(out)])
        sentence = said.getvalue().strip()
        fine = code == BAD_INPUT and "machine" in sentence and 20 < len(sentence) <= 1000
        if not fine or "Traceback" in sentence or any(out.iterdir()):
            taken.append(f"{name}: {code}, {sentence[:200]}")
    assert not taken, "\n".join(taken)
    assert len(seen) >= 200


def test_all_slips_are_told_at_once(tmp_path: Path) -> None:
    text = TABLE.read_text("utf-8").replace("130,160", "13O,160").replace("0,90,cyc", "0,90,zyc")
    text = text.replace("the mill is within 0.65", "the mull is within 0.65", 1)
    (tmp_path / "m.csv").write_text(text, "utf-8")
    with pytest.raises(cm.InputError) as refusal:
        cm.read_machine(tmp_path / "m.csv")
    lines = str(refusal.value).splitlines()
    assert [line.partition(":")[0] for line in lines] == [
        "Line 10 of m.csv",
        "Line 14 of m.csv",
        "Line 2 of m.csv, 'rule'",
    ]
    assert "'from in deg' is '13O'" in lines[0]
    assert "zycloidal" in lines[1]
    assert "did you mean 'mill'" in lines[2]


def test_very_many_slips_are_told_as_far_as_they_can_be_read(tmp_path: Path) -> None:
    (tmp_path / "m.csv").write_text(TABLE.read_text("utf-8").replace("cycloidal", "x"), "utf-8")
    with pytest.raises(cm.InputError, match=r"And \d+ more: mend these first\.$") as refusal:
        cm.read_machine(tmp_path / "m.csv")
    assert len(str(refusal.value)) <= 1000


def test_a_table_of_more_lines_than_any_machine_is_not_read(tmp_path: Path) -> None:
    (tmp_path / "m.csv").write_bytes(TABLE.read_bytes() + b"x,0\n" * 20_000)
    with pytest.raises(cm.InputError, match=r"m\.csv has 200\d\d lines, and .* at most 20000"):
        cm.read_machine(tmp_path / "m.csv")


@pytest.mark.parametrize("end", ["\n", "\r\n", "\r"])
def test_a_cell_of_several_lines_does_not_shift_the_numbers(tmp_path: Path, end: str) -> None:
    heading, *rows = TABLE.read_text("utf-8").splitlines()
    lines = ['"Press', "", 'of the hall"', f'{heading},"my', 'notes"', *rows]
    lines[7] = lines[7].replace("205", "2O5")
    (tmp_path / "m.csv").write_bytes(end.join(lines).encode())
    with pytest.raises(cm.InputError, match=r"^Line 8 of m\.csv: 'from in deg' is '2O5'"):
        cm.read_machine(tmp_path / "m.csv")


def test_a_rule_is_made_once_and_not_for_each_pair(monkeypatch: pytest.MonkeyPatch) -> None:
    """A thousand rules took half a minute."""
    made: list[Rule] = []

    def counted(rule: Rule) -> Rule:
        made.append(rule)
        return nameless(rule)

    monkeypatch.setattr("cammotion.exchange.machine_rules.nameless", counted)
    more = [f"{',' * 9}die beyond {n} only while mill within 0.65" for n in range(100, 150)]
    machine = cm.machine_from_text("\n".join([TABLE.read_text("utf-8").strip(), *more]))
    assert len(made) == len(machine.rules) > 50


def test_a_workbook_names_rows_as_a_spreadsheet_does(tmp_path: Path) -> None:
    (tmp_path / "m.csv").write_bytes(changed(3, "law", "dwell"))
    book = cm.write_machine(cm.read_machine(tmp_path / "m.csv"), tmp_path / "m.xlsx")
    assert cm.read_machine(book) == cm.read_machine(TABLE).__class__(
        "m", *[getattr(cm.read_machine(TABLE), field) for field in ("diagram", "rules", "still")]
    )


@pytest.mark.parametrize(
    ("name", "said"),
    [
        ("a zip bomb", "unpacks to more than 20 MB"),
        ("50 MB", "more than 10 MB"),
        ("a zip of a text", "is a zip of something else"),
        ("entities of its own", "is damaged"),
        ("an old workbook", "is an old workbook, or one with a password"),
        ("Latin-1", "is no character in UTF-8"),
        ("a rule twice", "stands in Line 2 of m.csv already"),
        ("two rules that forbid all", "forbids that the die is ever beyond 19 mm"),
    ],
)
def test_what_is_refused_is_named(tmp_path: Path, name: str, said: str) -> None:
    (ending, content) = next(rest for one, *rest in damages(tmp_path) if one == name)
    path = tmp_path / f"m{ending}"
    path.write_bytes(content)  # type: ignore[arg-type]
    with pytest.raises(cm.InputError, match=said):
        cm.read_machine(path)


def test_all_parts_of_a_workbook_count_together(tmp_path: Path) -> None:
    """Many sheets, each small enough by itself."""
    sheets = "".join(f'<sheet name="s{n}" r:id="r{n}"/>' for n in range(30))
    office = "http://schemas.openxmlformats.org/officeDocument/2006/relationships"
    parts: dict[str, bytes | str] = {
        BOOK: f'<workbook xmlns:r="{office}">{sheets}</workbook>',
        RELATIONS: "<all>"
        + "".join(f'<one Id="r{n}" Target="worksheets/{n}.xml"/>' for n in range(30))
        + "</all>",
    }
    parts |= {f"xl/worksheets/{n}.xml": "<a>" + " " * 1_000_000 + "</a>" for n in range(30)}
    (tmp_path / "m.xlsx").write_bytes(zipped(parts))
    with pytest.raises(cm.InputError, match="unpacks to more than 20 MB"):
        cm.read_machine(tmp_path / "m.xlsx")


def test_a_table_may_begin_with_any_letters(tmp_path: Path) -> None:
    """PK are those of a zip, too."""
    (tmp_path / "m.csv").write_bytes(b"PKW\n" + TABLE.read_bytes())
    assert cm.read_machine(tmp_path / "m.csv").diagram == cm.read_machine(TABLE).diagram


def test_a_deep_nest_is_no_traceback(tmp_path: Path) -> None:
    nest = "<si>" + "<t>" * 100_000 + "</t>" * 100_000 + "</si>"
    parts = {RELATIONS: "<all/>", BOOK: "<workbook/>", "xl/sharedStrings.xml": f"<sst>{nest}</sst>"}
    (tmp_path / "m.xlsx").write_bytes(zipped(dict(parts)))
    with pytest.raises(cm.InputError, match=r"is (damaged|empty)"):
        cm.read_machine(tmp_path / "m.xlsx")

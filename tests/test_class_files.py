"""The files that a teacher collects, whatever has become of them; and how they are counted."""

import json
import math
import os
import re
import sys
from pathlib import Path
from typing import Any

import pytest
from desk import STRANGERS
from hypothesis import given
from hypothesis import strategies as st
from school import DATA, HOSTILE, collect, put, show, table_of

from cammotion.quantities import InputError
from cammotion.teaching.classroom import histogram
from cammotion.teaching.classroom.clean import clean
from cammotion.teaching.classroom.collect import read_class
from cammotion.teaching.prediction import numbers_in

DONE = {"exercises": {"01.1": {"state": "right", "tries": 1}}}


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """Collect the known files."""
    return collect(tmp_path / "class")


def named(name: str) -> dict[str, object]:
    return {**DONE, "learner": {"variant": {"name": name}}}


@pytest.mark.parametrize("kind", [*STRANGERS, "{}", "another program's", "too large"])
def test_a_file_that_is_none_is_left_out_and_said(folder: Path, kind: str) -> None:
    others = {"{}": b"{}", "another program's": b'{"cells": []}', "too large": b" " * 5_000_001}
    content = (STRANGERS | others)[kind]
    file = folder / "dora" / "progress.json"
    file.parent.mkdir()
    file.write_bytes(content)
    school = read_class(folder)
    if kind in ("a list within", "a number within"):  # not all of it is lost
        assert len(school.students) in (3, 4)
    else:
        assert len(school.students) == 3
        (notice,) = school.notices
        assert notice.startswith("dora/progress.json was left out: it ")
    assert file.read_bytes() == content


def test_a_folder_without_any(tmp_path: Path) -> None:
    said = rf"^There is no progress\.json in the folder {tmp_path.name}, nor .* work\.$"
    with pytest.raises(InputError, match=said):
        read_class(tmp_path)
    for content, lack in (("{", "broken, and cannot be read"), (" \n", "empty")):
        (tmp_path / "x.json").write_text(content)
        said = rf"x\.json was left out: it is {lack}: ask for it anew\.$"
        with pytest.raises(InputError, match=said):
            read_class(tmp_path)


def test_an_archive_is_named_and_not_opened(folder: Path) -> None:
    (folder / "Dora.ZIP").write_bytes(b"PK")
    school = read_class(folder)
    assert school.notices == ("Dora.ZIP was left out: it is an archive: unpack it first.",)


def test_what_is_hidden_or_was_put_aside_is_no_student(folder: Path) -> None:
    for place in (
        "Anna/.ipynb_checkpoints/progress-checkpoint.json",
        "__MACOSX/._progress.json",
        "work-ben/progress-unreadable-1.json",
        "work-ben/.progress.json.abc",
        "work-ben/.progress.lock",
    ):
        put(folder, place, DONE)
    school = read_class(folder)
    assert len(school.students) == 3
    assert not school.notices


def test_a_folder_that_cannot_be_opened_is_said(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    look_into = os.scandir

    def refuse(path: Any) -> Any:
        if Path(path).name == "work-ben":
            raise PermissionError(13, "Permission denied", str(path))
        return look_into(path)

    monkeypatch.setattr(os, "scandir", refuse)
    school = read_class(folder)
    assert [student.name for student in school.students] == ["Anna", "carla"]
    (notice,) = school.notices
    assert notice == ("The folder work-ben was left out: it cannot be opened (Permission denied).")


def test_a_link_to_a_folder_is_not_followed_and_said(folder: Path) -> None:
    try:
        (folder / "work-ben" / "again").symlink_to(folder, target_is_directory=True)
    except OSError:
        pytest.skip("no links here")
    school = read_class(folder)
    assert len(school.students) == 3
    (notice,) = school.notices
    assert notice.startswith("The folder work-ben/again was left out: it is a link")


@pytest.mark.skipif(sys.platform == "win32", reason="there are no such files there")
def test_what_is_no_file_does_not_hold_up(folder: Path) -> None:
    os.mkfifo(folder / "pipe.json")
    (folder / "link.json").symlink_to("/dev/zero")
    (folder / "nowhere.json").symlink_to("nowhere")
    assert len(read_class(folder).notices) == 3


@pytest.mark.parametrize(
    ("place", "name"),
    [
        ("Dora/progress.json", "Dora"),
        ("/".join(["Dora", "work", "progress.json"]), "Dora"),
        ("pc 7/work-dora/progress.json", "dora"),
        ("dora.json", "dora"),
        ("Dora/progress (1).json", "Dora"),
        ("work/progress.json", "the class"),
        ("progress.json", "the class"),
    ],
)
def test_whose_a_file_is_by_where_it_lies(tmp_path: Path, place: str, name: str) -> None:
    put(tmp_path / "the class", place, DONE)
    (student,) = read_class(tmp_path / "the class").students
    assert student.name == name


def names_by_places(folder: Path, *places: str) -> list[str]:
    """Collect files that do not say whose they are, and return the names by their places."""
    for place in places:
        put(folder, f"{place}/progress.json", DONE)
    return [student.name for student in read_class(folder).students]


def test_a_folder_that_several_have_by_this_name_is_nobodys_name(tmp_path: Path) -> None:
    own = ("Fay/cam", "Gert/cam", "Hans/stuff/cam", "Ida/work")
    assert names_by_places(tmp_path / "a", *own) == ["Fay", "Gert", "Ida", "stuff"]
    days = ("monday/Fay", "monday/Gert", "tuesday/Fay", "tuesday/Gert")
    assert names_by_places(tmp_path / "b", *days) == ["Fay", "Fay", "Gert", "Gert"]
    computers = ("pc 1/work-fay", "pc 2/work-fay", "pc 3/work-gert")
    assert names_by_places(tmp_path / "c", *computers) == ["fay", "fay", "gert"]
    assert names_by_places(tmp_path / "d", "Fay/cam") == ["cam"]
    assert names_by_places(tmp_path / "e", "Fay/cam/work", "Fay/cam/Gert") == ["cam", "Gert"]


def test_what_was_done_in_the_solutions_is_no_student(tmp_path: Path) -> None:
    put(tmp_path, "Fay/cam/notebooks/solutions/progress.json", DONE)
    put(tmp_path, "Gert/solutions/progress.json", DONE)
    school = read_class(tmp_path)
    assert [student.place for student in school.students] == ["Gert/solutions/progress.json"]


def test_whose_a_file_is_by_what_it_says(tmp_path: Path) -> None:
    put(tmp_path, "a.json", named("  Dora \n Groß "))
    put(tmp_path, "b.json", {"exercises": {"01.1": {"who": "emil"}, "01.2": {"who": ""}}})
    put(tmp_path, "c.json", named(7))  # type: ignore[arg-type]
    put(tmp_path, "d.json", named("x" * 1000))
    assert [s.name for s in read_class(tmp_path).students] == [
        "c",
        "Dora Groß",
        "emil",
        "x" * 39 + "…",
    ]


def test_two_files_of_one_name_are_both_shown_and_said(folder: Path) -> None:
    put(folder, "old/anna.json", named("ANNA"))
    school = read_class(folder)
    assert len(school.students) == 4
    (notice,) = school.notices
    assert "2 files are of the name" in notice
    assert "Room 1/Anna/progress.json, old/anna.json" in notice
    assert len(table_of(show(school), "Exercises that are right")) == 5


def test_the_same_file_twice_counts_once_if_it_says_whose_it_is(folder: Path) -> None:
    (folder / "again.json").write_bytes((DATA / "anna.json").read_bytes())
    school = read_class(folder)
    assert len(school.students) == 3
    assert "it is the same file as" in school.notices[0]
    for name in ("x/dora", "y/dora"):  # two who have done the same, and have given no name
        put(folder, f"{name}.json", DONE)
    assert len(read_class(folder).students) == 5


@pytest.mark.parametrize("other", ["Bob/progress.json", "emil.json", "zoe.json", "zoe/cam.json"])
def test_who_hands_in_the_file_of_another_is_named(tmp_path: Path, other: str) -> None:
    """Whichever of the two is read first."""
    for place in ("anna/progress.json", other):
        put(tmp_path, place, named("Anna"))
    school = read_class(tmp_path)
    assert [(s.name, s.place) for s in school.students] == [("Anna", "anna/progress.json")]
    (notice,) = school.notices
    same = f"{other} was left out: it is the same file as anna/progress.json"
    assert notice == f"{same}, and bears the name Anna."


def test_who_has_handed_in_no_progress_is_said(folder: Path) -> None:
    copies = [Path("Dora") / "work", Path("Room 1/Fay/cam"), Path("Room 1/Anna/notebooks")]
    others = [Path("Emil/photos/me"), Path("Room 1/photos/all"), Path("__MACOSX/x")]
    for place in (*(each / "01_timing_diagram" for each in copies), *others):
        file = folder / place.with_suffix(".ipynb")
        file.parent.mkdir(parents=True)
        file.touch()
    (folder / "Emil" / "notes.txt").touch()
    (folder / "Gert").mkdir()
    (notice,) = read_class(folder).notices
    assert notice == "No progress in: Dora/work, Emil, Gert, Room 1/Fay/cam."


def test_students_are_sorted_as_a_list_of_names_is(tmp_path: Path) -> None:
    for name in ("Zoë", "Şule", "anna", "Öz", "Ben"):
        put(tmp_path, f"{name}.json", named(name))
    names = [student.name for student in read_class(tmp_path).students]
    assert names == ["anna", "Ben", "Öz", "Şule", "Zoë"]


@pytest.mark.parametrize("encoding", ["utf-8-sig", "utf-16"])
def test_a_file_from_a_windows_editor_is_read(tmp_path: Path, encoding: str) -> None:
    (tmp_path / "a.json").write_bytes(json.dumps(DONE).encode(encoding))
    assert len(read_class(tmp_path).students) == 1


@pytest.mark.parametrize("value", [None, "x", [1], {"a": 1}, True, -3, 2.5, 10**30, HOSTILE])
def test_records_of_a_stranger_make_a_page(tmp_path: Path, value: object) -> None:
    names = ("state", "tries", "hints", "who", "choice", "text", "slips", "name")
    record = dict.fromkeys(names, value)
    kinds = {"exercises": "01.1", "predictions": "01.half", "learner": "variant"}
    put(tmp_path, "a.json", {kind: {key: record} for kind, key in kinds.items()})
    put(tmp_path, "b.json", {kind: {key: value} for kind, key in kinds.items()} | {"else": value})
    put(tmp_path, "c.json", named("c") | {"predictions": value})
    assert len(table_of(show(read_class(tmp_path)), "Exercises that are right")) >= 3


def test_counts_that_nobody_can_have_reached_are_none(tmp_path: Path) -> None:
    record = {"tries": 3, "slips": {"x": int("9" * 4300)}}
    for name in "ab":
        put(tmp_path, f"{name}.json", {"exercises": {"01.1": record}})
    assert "✗ not yet 3 tries" in str(table_of(show(read_class(tmp_path)), "Exercises of"))


@pytest.mark.parametrize(
    ("text", "asked", "number"),
    [
        *[("55", "", 55), (" 55deg ", "", 55), ("55°", "", 55), ("about 5,5", "", 5.5)],
        *[("1.04 m/s2", "", 1.04), ("1.04 m/s^2", "", 1.04), ("1.04 m/s**2", "", 1.04)],
        *[("-3", "", -3), ("−3", "", -3), ("1e-3", "", 0.001), ("x4", "", None), ("4x", "", 4)],
        *[("1/4", "", 0.25), ("1 / 4", "", 0.25), ("1/0", "", None), ("4 times!", "", 4)],
        *[("25 %", "percent", 25), ("25%", "fraction", 0.25), ("25 percent", "percent", 25)],
        *[("50-60", "", None), ("50 or 60", "", None), ("", "", None), ("none", "", None)],
        *[("4,15", "", 4.15), ("0,806", "", 0.806), ("4.154", "", 4.154), ("4,1540", "", 4.154)],
        *[("1,234.5", "", None), ("1.234,5", "", None), ("10,000,000", "", None)],
        *[("1/1,234.5", "", None), ("1/2/3", "", None), ("007,154 mm", "", 7.154)],
        *[("16 % less", "percent less", 16), ("less than 16 %", "percent less", None)],
        *[("6", "the least push", 6), ("at least 6", "the least push", None), (".5", "mm", 0.5)],
        *[("-.5", "mm", -0.5), ("1/.5", "mm", 2), ("2.5.3", "mm", None), ("0.03 m", "mm", None)],
        *[("30 um", "mm", None), ("5 in", "mm", None), ("5 inches", "mm", None), ("5mm", "mm", 5)],
        *[("1 m/s²", "in/s²", None), ("1 in/s²", "in/s²", 1), ("1 inch/sec²", "in/s²", 1)],
        *[("4 m/s²", "peak at 110 deg in m/s²", 4), ("5 in", "peak at 110 deg in m/s²", None)],
        *[("5 in", "depth in mm, at 0 deg", None), ("92 in each way", "degrees for each way", 92)],
        *[(f"3{unit}", "pieces per hour", None) for unit in ("/s", "k", " thousand", " rpm")],
        *[("3/h", "pieces per hour", 3), ("64 pieces per minute", "pieces per hour", None)],
        *[("6.3 mm radius", "mm", 6.3), ("3 gears", "times", None), ("30°", "percent", None)],
        *[("1e999", "", None), ("9" * 400, "", None), ("\u0665", "", 5), ("²", "", None)],
    ],
)
def test_the_number_in_what_was_typed(text: str, asked: str, number: float | None) -> None:
    assert numbers_in(text, asked) == (() if number is None else (number,))


def test_a_comma_before_three_digits_may_part_thousands() -> None:
    assert numbers_in("about 4,154 m/s2", "m/s²") == (4.154, 4154)
    assert numbers_in("−12,500", "deg") == (-12.5, -12500)
    assert numbers_in("1,250 %", "fraction") == (0.0125, 12.5)


@given(st.text())
def test_any_text_is_a_number_or_none(text: str) -> None:
    assert all(math.isfinite(number) for number in numbers_in(text, "deg"))
    clean(text).encode()
    assert len(clean(text)) <= 40


def test_a_text_that_fits_is_whole() -> None:
    assert [clean(text, 4) for text in ("Anna", "Annas")] == ["Anna", "Ann…"]


def test_one_odd_number_does_not_press_the_others_into_one_bar() -> None:
    bars = histogram.count([50, 52, 55, 55, 60, 70, 4154])
    assert (bars.edge(0), bars.step) == (50, 5)
    assert bars.counts == (2, 2, 1, 0, 1)
    assert (bars.below, bars.above) == (0, 1)


@pytest.mark.parametrize("odd", [[-4154], [-4154, -4154]])
def test_what_is_far_below_has_a_bar_of_its_own_before_the_first_edge(odd: list[float]) -> None:
    drawn = histogram.draw([*odd, *2 * [50, 52, 55, 55, 60, 70]], "deg", 60)
    place = {
        words: float(x) for x, words in re.findall(r'<text[^>]* x="([\d.]+)"[^>]*>([^<]+)<', drawn)
    }
    width = place["55"] - place["50"]
    assert place["less"] == pytest.approx(place["50"] - width / 2, abs=0.2)
    assert place["true: 60"] == pytest.approx(place["60"], abs=0.2)


def test_numbers_of_very_different_size() -> None:
    bars = histogram.count([0.0, 0.0, 0.0, 1.8e10, 4.8e-298])
    assert sum(bars.counts) == 4
    assert bars.above == 1


def test_a_value_on_an_edge_belongs_to_the_bar_above() -> None:
    bars = histogram.count([0.1, 0.2, 0.3, 0.7, 1.0])
    assert (bars.first, bars.step) == (1, 0.1)
    assert bars.counts == (1, 1, 1, 0, 0, 0, 1, 0, 0, 1)


numbers = st.floats(-1e12, 1e12)


@given(st.lists(numbers, min_size=1, max_size=40), st.none() | numbers)
def test_every_number_is_counted_once_and_in_its_bar(
    values: list[float], true: float | None
) -> None:
    bars = histogram.count(values, () if true is None else (true,))
    assert sum(bars.counts) + bars.below + bars.above == len(values)
    assert len(bars.counts) <= 12
    if true is not None:
        slack = 1e-6 * bars.step + 1e-6 * abs(true)
        assert bars.edge(0) - slack <= true <= bars.edge(len(bars.counts)) + slack
    drawn = histogram.draw(values, "mm", true)
    assert "nan" not in drawn
    assert drawn.count("<rect") == sum(n > 0 for n in (*bars.counts, bars.below, bars.above))

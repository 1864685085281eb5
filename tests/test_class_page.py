"""The class at a glance: what its page says of files whose content is known."""

import re
from datetime import date
from itertools import pairwise
from pathlib import Path

import pytest
from bs4 import BeautifulSoup, Tag
from school import HOSTILE, collect, find, put, show, table_of, text_of

from cammotion.quantities import InputError
from cammotion.teaching.classroom import page
from cammotion.teaching.classroom.__main__ import main
from cammotion.teaching.classroom.collect import read_class
from cammotion.teaching.lessons import EXERCISES


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """Collect the known files."""
    return collect(tmp_path / "class")


def test_who_has_done_what(folder: Path) -> None:
    soup = show(read_class(folder))
    assert "3 students, 2 March 2026." in text_of(soup.main)
    assert table_of(soup, "Exercises that are right") == [
        ["Student", "01", "02", "File"],
        ["Anna", "✓ 4 of 4", "◐ 0 of 5", "Room 1/Anna"],
        ["ben", "◐ 0 of 4", "– open", "work-ben"],
        ["carla", "◐ 1 of 4", "◐ 1 of 5", "carla.JSON"],
    ]
    assert table_of(soup, "Exercises of notebook 01") == [
        ["Student", "01.1", "01.2", "01.3", "01.4"],
        ["Anna", "✓ right 3 tries, 1 hint", "✓ right", "✓ right", "✓ right 2 tries"],
        ["ben", "✗ not yet 6 tries", "– open", "– open", "– open"],
        ["carla", "✓ right 2 tries", "– open", "– open", "– open"],
        ["right", "2 of 3", "1 of 3", "1 of 3", "1 of 3"],
    ]
    assert [text_of(h) for h in soup("h2")] == ["Notebook 01", "Notebook 02"]


def test_what_was_right_under_a_name_is_right_when_it_was_forgotten_later(tmp_path: Path) -> None:
    record = {"state": "wrong", "who": "", "right": ["anna"], "tries": 2}
    put(tmp_path, "Anna/progress.json", {"exercises": {"01.1": record}})
    (_, (_, first, *_), *_) = table_of(show(read_class(tmp_path)), "Exercises of notebook 01")
    assert first == "✓ right 2 tries"


def test_which_slips_were_made_most_with_the_words_that_the_learner_got(folder: Path) -> None:
    soup = show(read_class(folder))
    both_ways, work_forgotten = (slip.reason for slip in EXERCISES["01.1"].slips[:2])  # type: ignore[attr-defined]
    assert [text_of(item) for item in find(soup, "#lesson-01 ol")("li")] == [
        f"2 students , 3 times: “{both_ways}”",
        f"1 student , 5 times: “{work_forgotten}”",
        "1 student : “A reason of another version of the workbook: a-reason-no-longer-there-0000”",
    ]
    (heading,) = (h for h in soup("h4") if h.get_text() == "02.1")
    assert "What is asked for is one number in m/s²." in text_of(heading.find_next("ol"))
    (heading,) = (h for h in soup("h4") if h.get_text() == "01.4")
    assert "says when, not where" in text_of(heading.find_next("ol"))


def part(soup: BeautifulSoup, key: str) -> Tag:
    """Return the part of the page that a prediction has."""
    (found,) = (p for p in soup(class_="prediction") if text_of(p.h4).startswith(f"{key}: "))
    assert isinstance(found, Tag)
    return found


def test_what_was_predicted_in_numbers(folder: Path) -> None:
    soup = show(read_class(folder))
    angle = part(soup, "01.half")
    assert "3 of 3 students predicted, from 55 to 110." in text_of(angle)
    assert find(angle, "svg")["aria-label"] == (
        "Histogram of 3 predictions, 01.half: degrees for each way. From 50 to below 60: 1. "
        "From 100 to below 110: 1. From 110 to below 120: 1."
    )
    peak = part(soup, "02.peak")
    assert "3 of 3 students predicted, from 1.04 to 2.08." in text_of(peak)
    assert "Histogram of 2 predictions" in str(find(peak, "svg")["aria-label"])
    assert [text_of(item) for item in find(peak, ".words")("li")] == ["half 1"]
    assert "predicted, from 0.25 to 0.5." in text_of(part(soup, "02.fraction"))
    assert text_of(soup.find(id="lesson-02")).count("Nobody has predicted anything.") == 1


def test_what_was_predicted_in_words(folder: Path) -> None:
    harder = part(show(read_class(folder)), "01.harder")
    assert harder.svg is None
    words = [text_of(item) for item in find(harder, ".words")("li")]
    assert words[0] == "die 2"
    assert {"mill 1", "4 1", "times 1"} < {*words}
    assert not {"the 2", "the 1", "it 1"} & {*words}


def test_what_is_true_is_told_only_where_it_is_unfolded(folder: Path) -> None:
    soup = show(read_class(folder))
    for key, true in {"01.half": "92.5", "01.harder": "the die, 3.72 times"}.items():
        (folded,) = (d for d in part(soup, key)("details") if "What is true" in text_of(d.summary))
        assert f"True is: {true}." in text_of(folded)
    assert find(soup, ".true").find_parent("details") is not None
    for folded in soup("details"):
        folded.decompose()
    assert soup.find(class_="true") is None
    assert "rue is" not in str(soup)
    assert "3.72" not in str(soup)


def test_the_page_needs_nothing_else_and_can_be_read_by_all(folder: Path) -> None:
    put(folder, "d.json", {"predictions": {"my.own": {"text": "7"}}})
    text = page.write(read_class(folder), date(2026, 3, 2))
    soup = BeautifulSoup(text, "html.parser")
    assert not soup(["script", "link", "img", "iframe", "object"])
    assert not re.search(r"https?:|url\(|@import|\bsrc=", text)
    assert find(soup, "html")["lang"] == "en"
    assert all(table.caption and table.thead for table in soup("table"))
    assert all(cell.get("scope") in ("row", "col") for cell in soup("th"))
    assert all(svg["role"] == "img" and svg["aria-label"] for svg in soup("svg"))
    ids = [tag["id"] for tag in soup(id=True)]
    assert len(ids) == len({*ids})
    assert all(str(link["href"]).removeprefix("#") in ids for link in soup("a"))
    levels = [int(h.name[1]) for h in soup(re.compile(r"^h\d$"))]
    assert levels[0] == 1
    assert all(b - a <= 1 for a, b in pairwise(levels))
    for word in ("prefers-color-scheme: dark", "@media print"):
        assert word in text


def test_all_that_was_typed_is_shown_and_does_nothing(folder: Path) -> None:
    hostile = {
        "exercises": {
            "01.1": {"state": HOSTILE, "tries": 1, "who": HOSTILE, "slips": {HOSTILE: 2}},
            HOSTILE: {"state": "right", "tries": 1},
        },
        "predictions": {
            "01.half": {"text": HOSTILE},
            "01.harder": {"text": HOSTILE},
            HOSTILE: {"text": HOSTILE},
        },
        "learner": {"variant": {"name": HOSTILE}},
    }
    put(folder, "<b>x&amp;.json", hostile)
    text = page.write(read_class(folder), date(2026, 3, 2))
    text.encode()
    soup = BeautifulSoup(text, "html.parser")
    assert not soup(["script", "img", "b"])
    assert not re.search("[\u202e\x07\ud800]", text)
    assert any("<script>alert" in text_of(head) for head in soup("th"))
    assert "Left out: 1 exercise that" in text_of(soup.main)
    assert len([h for h in soup("h4") if "<script>" in h.get_text()]) == 1


def test_numbers_for_names(folder: Path) -> None:
    put(folder, "Zoë.json", {"learner": {"variant": {"name": "Zoë"}}})
    shown = show(read_class(folder).anonymous())
    rows = table_of(shown, "Exercises that are right")
    assert [row[0] for row in rows] == ["Student", "1", "2", "3", "4"]
    assert not re.search(r"anna|ben\b|carla|zoë|progress\.json", str(shown), re.IGNORECASE)


def test_the_numbers_are_in_no_order_of_the_names(tmp_path: Path) -> None:
    for tries, name in enumerate("abcdefgh", 1):
        put(tmp_path, f"{name}.json", {"exercises": {"01.1": {"tries": tries}}})
    school = read_class(tmp_path)
    named, mixed = (
        [student.exercises["01.1"]["tries"] for student in one.students]
        for one in (school, school.anonymous())
    )
    assert named == sorted(mixed)
    assert mixed not in (named, named[::-1])
    assert school.anonymous() == school.anonymous()


def test_who_knows_the_names_of_all_files_cannot_reckon_out_whose_number_is_whose(
    tmp_path: Path,
) -> None:
    orders = []
    for tries in (1, 100):
        for number in range(12):
            record = {"exercises": {"01.1": {"state": "wrong", "tries": tries + number}}}
            put(tmp_path, f"student {number}.json", record)
        mixed = read_class(tmp_path).anonymous().students
        orders.append([student.exercises["01.1"]["tries"] - tries for student in mixed])
    assert orders[0] != orders[1]


def test_the_command_writes_one_page_and_overwrites_nothing(
    folder: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(folder.parent)
    before = {path: path.read_bytes() for path in folder.rglob("*") if path.is_file()}
    assert main(["class"]) == 0
    assert capsys.readouterr().out == "class.html shows 3 students. Open it in a browser.\n"
    made = Path("class.html").read_text("utf-8")
    assert "carla" in made
    assert main(["class", "--anonymous"]) == 1
    assert (
        "class.html is there already and was left as it is: give another name with --output"
        in capsys.readouterr().err
    )
    assert Path("class.html").read_text("utf-8") == made
    assert main(["class", "--anonymous", "--overwrite"]) == 0
    assert "carla" not in Path("class.html").read_text("utf-8")
    assert main(["class", "--output", "other.html"]) == 0
    assert main(["class", "--output", "nowhere/other.html"]) == 1
    assert "other.html cannot be written" in capsys.readouterr().err
    assert before == {path: path.read_bytes() for path in folder.rglob("*") if path.is_file()}


@pytest.mark.parametrize("name", ["carla.JSON", "page", "link.html"])
def test_the_page_is_written_over_no_progress_file(
    folder: Path, name: str, capsys: pytest.CaptureFixture[str]
) -> None:
    if name == "link.html":
        try:
            (folder / name).symlink_to(folder / "carla.JSON")
        except OSError:
            pytest.skip("no links here")
    before = {path: path.read_bytes() for path in folder.rglob("*") if path.is_file()}
    assert main([str(folder), "--output", str(folder / name), "--overwrite"]) == 1
    assert f"{name}, which is no name of a page: give one that ends in .html" in (
        capsys.readouterr().err
    )
    assert before == {path: path.read_bytes() for path in folder.rglob("*") if path.is_file()}


@pytest.mark.parametrize("overwrite", [[], ["--overwrite"]])
def test_a_page_that_no_file_can_be_is_a_sentence(
    folder: Path, overwrite: list[str], capsys: pytest.CaptureFixture[str]
) -> None:
    loop = folder / "loop.html"
    try:
        loop.symlink_to(loop)
    except OSError:
        pytest.skip("no links here")
    for output in (loop, folder / f"{'x' * 300}.html"):
        assert main([str(folder), "--output", str(output), *overwrite]) == 1
        assert re.fullmatch(
            r"The file .*(there already|cannot be written).*\.\n", capsys.readouterr().err
        )


def test_no_folder_is_a_sentence(
    folder: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    page = folder / "old.html"
    page.touch()
    for wrong in (tmp_path / "nowhere", tmp_path / ("x" * 300)):
        for output in (tmp_path / "x.html", page):  # which is no matter then
            assert main([str(wrong), "--output", str(output)]) == 1
            said = capsys.readouterr().err
            assert re.fullmatch(r"There is no folder .*: give the one into which .*\.\n", said)
    assert main([str(folder / "carla.JSON"), "--output", str(tmp_path / "x.html")]) == 1
    assert re.fullmatch(r".*carla\.JSON is a file: give a folder\.\n", capsys.readouterr().err)
    with pytest.raises(InputError, match="no folder"):
        read_class(tmp_path / "nowhere")
    assert not (tmp_path / "x.html").exists()

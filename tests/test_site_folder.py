"""What is written where: nothing that this command has not made is touched."""

import errno
import io
import json
import re
import sys
from pathlib import Path
from typing import Any

import pytest
from small_workbook import raiser

from cammotion.quantities import InputError
from cammotion.site import __main__ as command
from cammotion.site import folder
from cammotion.site.build import build
from cammotion.site.formulas import mathml
from cammotion.site.lessons import find_lessons
from cammotion.site.pictures import Pictures, at_rest, embedded_svg, size_of
from starter import commands, environment, installer

ROOT = Path(__file__).parents[1]
FILES = {"index.html": b"new", "shared/page.css": b"x"}


def test_a_folder_is_written_and_written_anew(tmp_path: Path) -> None:
    target = tmp_path / "site"
    folder.write(target, {"old.html": b"old"})
    folder.write(target, FILES)
    assert (target / "index.html").read_bytes() == b"new"
    assert (target / "shared" / "page.css").read_bytes() == b"x"
    assert not (target / "old.html").exists()
    assert [path.name for path in tmp_path.iterdir()] == ["site"]


def test_what_somebody_has_laid_into_the_folder_stays(tmp_path: Path) -> None:
    target = tmp_path / "site"
    folder.write(target, FILES | {"old.html": b"old"})
    (target / ".git" / "refs").mkdir(parents=True)
    mine = {"CNAME": b"cams.example.org", "shared/mine.css": b"y", ".git/HEAD": b"ref"}
    for name, content in mine.items():
        (target / name).write_bytes(content)
    for files in (FILES, {**FILES, "index.html": b"newer"}):
        folder.write(target, files)
        found = {path.relative_to(target).as_posix(): path for path in target.rglob("*")}
        held = {name: path.read_bytes() for name, path in found.items() if path.is_file()}
        del held[folder.MARKER]
        assert held == files | mine
        assert ".git/refs" in found
    with pytest.raises(InputError, match=r"^CNAME in site was not written by .*: take it out, or"):
        folder.write(target, FILES | {"CNAME": b"ours"})
    assert (target / "CNAME").read_bytes() == mine["CNAME"]
    assert (target / "index.html").read_bytes() == b"newer"


def test_where_there_is_no_room_for_what_was_laid_into_it_room_is_asked_for(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    target = tmp_path / "site"
    folder.write(target, FILES)
    (target / "CNAME").write_bytes(b"mine")
    monkeypatch.setattr("shutil.copy2", raiser(OSError(errno.ENOSPC, "No space left on device")))
    with pytest.raises(InputError, match=r"site cannot be written \(No space.*: make room on the"):
        folder.write(target, FILES)
    assert (target / "CNAME").read_bytes() == b"mine"


def test_a_folder_of_an_earlier_version_keeps_what_has_another_name(tmp_path: Path) -> None:
    target = tmp_path / "site"
    folder.write(target, FILES)
    (target / folder.MARKER).write_text(f"{folder._MARK}\r\n", newline="")
    (target / "note.txt").write_text("mine")
    folder.write(target, {"index.html": b"newer"})
    assert (target / "index.html").read_bytes() == b"newer"
    assert (target / "note.txt").read_text() == "mine"


def test_an_empty_folder_is_taken(tmp_path: Path) -> None:
    (tmp_path / "site").mkdir()
    folder.write(tmp_path / "site", FILES)
    assert (tmp_path / "site" / folder.MARKER).is_file()


@pytest.mark.parametrize("kind", ["folder", "file", "link", "link to nowhere"])
def test_what_others_have_made_is_left_as_it_is(tmp_path: Path, kind: str) -> None:
    target, thesis = tmp_path / "site", tmp_path / "mine" / "thesis.txt"
    thesis.parent.mkdir()
    thesis.write_text("mine")
    if kind == "folder":
        thesis.parent.rename(target)
        thesis = target / "thesis.txt"
    elif kind == "file":
        target.write_text("mine")
    else:
        target.symlink_to(thesis.parent if kind == "link" else tmp_path / "nowhere")
    with pytest.raises(InputError, match=r"site is there already, .* --folder"):
        folder.write(target, FILES)
    assert thesis.read_text() == "mine"
    assert not list(tmp_path.rglob("index.html"))


def test_the_environment_of_the_workbook_is_no_folder_of_pages(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    made = tmp_path / ".venv"
    monkeypatch.setattr(environment, "VENV", made)
    monkeypatch.setattr(environment, "MARKER", made / environment.MARKER.name)
    monkeypatch.setattr(installer, "find_uv", lambda: "uv")
    environment.create()
    with pytest.raises(InputError, match=r"\.venv is there already, was not made by this command"):
        folder.write(made, FILES)
    assert (made / "pyvenv.cfg").is_file()


def test_a_folder_that_cannot_be_written_is_named(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="The folder site cannot be written"):
        folder.write(tmp_path / "not there" / "site", FILES)
    (tmp_path / "a.txt").touch()
    with pytest.raises(InputError, match=r"^a\.txt is there already, is a file, and was left"):
        folder.check_free(tmp_path / "a.txt")
    with pytest.raises(InputError, match=r"The folder xxx.* cannot be written \("):
        folder.check_free(tmp_path / ("x" * 300))


def test_the_folder_of_before_stays_where_the_new_one_cannot_be_put(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    folder.write(tmp_path / "site", {"index.html": b"old"})
    rename = Path.rename

    def refuse(path: Path, target: Path) -> Path:
        if path.name == "site" and target == tmp_path / "site":
            raise PermissionError(13, "Access is denied")
        return rename(path, target)

    monkeypatch.setattr(Path, "rename", refuse)
    with pytest.raises(InputError, match=r"site cannot be written \(Access is denied\)"):
        folder.write(tmp_path / "site", FILES)
    assert (tmp_path / "site" / "index.html").read_bytes() == b"old"
    assert [path.name for path in tmp_path.iterdir()] == ["site"]


def test_the_command_says_what_is_wrong(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert command.main([str(tmp_path), str(tmp_path / "site")]) == 1
    assert "There are no notebooks in the folder" in capsys.readouterr().err
    cell = {"cell_type": "code", "id": "a", "source": "", "metadata": {}, "outputs": []}
    by_a_script = json.dumps({**notebook(), "cells": [cell]})
    for content, why in (("{", ""), (by_a_script, r" \('execution_count' is a required .*\)")):
        (tmp_path / "00_broken.ipynb").write_text(content)
        assert command.main([str(tmp_path), str(tmp_path / "site")]) == 1
        said = rf"00_broken\.ipynb is no notebook that can be read{why}: take it"
        assert re.match(said, capsys.readouterr().err)
    assert not (tmp_path / "site").exists()


@pytest.fixture
def books(tmp_path: Path) -> Path:
    books = tmp_path / "books"
    (books / "images").mkdir(parents=True)
    drawing = ROOT / "notebooks" / "images" / "motion.svg"
    (books / "images" / "motion.svg").write_text(drawing.read_text("utf-8"), "utf-8")
    (books / "01_one.ipynb").write_text(json.dumps(notebook()), "utf-8")
    return books


def test_the_command_names_a_folder_in_any_terminal(
    books: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    written = io.BytesIO()
    monkeypatch.setattr(sys, "stdout", io.TextIOWrapper(written, encoding="ascii"))
    assert command.main([str(books), str(tmp_path / "Übung")]) == 0
    assert re.search(rb"[/\\]\?bung[/\\]index\.html in a browser", written.getvalue())


def test_the_command_writes_pages(
    books: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """A notebook of anybody's becomes a page, with an exercise, a prediction and its reveal."""
    assert command.main([str(books), str(tmp_path / "site")]) == 0
    assert "2 pages" in capsys.readouterr().out
    made = (tmp_path / "site" / "01_one.html").read_text("utf-8")
    assert "for the lab" not in made
    assert 'data-predicts="01.half"' in made
    assert 'data-reveals="01.half"' in made
    assert 'data-exercise="01.1"' in made
    assert "It is 92.5." in made
    assert "&lt;b&gt;" in made
    assert '<a href="01_one.html#here">One</a>, worked' in made
    assert re.search(r'<span class="together"><math>.*</math>\.</span>', made)


def test_the_pages_say_where_the_workbook_is(
    books: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    home, target = "https://example.org/cams?a=1&b=2", tmp_path / "site"
    assert command.main([str(books), str(target), "--home", home]) == 0
    for name in ("index.html", "01_one.html"):
        made = (target / name).read_text("utf-8")
        assert '<a href="https://example.org/cams?a=1&amp;b=2">the workbook itself</a>' in made
        assert "python3 workbook.py" not in made
    assert command.main([str(books), str(target)]) == 0
    for name in ("index.html", "01_one.html"):
        assert "<code>python3 workbook.py</code> opens it" in (target / name).read_text("utf-8")
    for odd in ("javascript:alert(1)", "example.org", "https://", "https://a b"):
        assert command.main([str(books), str(target), "--home", odd]) == 1
        assert "is no address of a web page: give one that" in capsys.readouterr().err


def notebook() -> dict[str, object]:
    def cell(number: int, kind: str, source: str, *outputs: object, tag: str = "") -> object:
        more = {"outputs": [*outputs], "execution_count": 1} if kind == "code" else {}
        head = {"cell_type": kind, "id": f"c{number}", "metadata": {"tags": [tag] if tag else []}}
        return {**head, "source": source, **more}

    def shown(data: dict[str, str]) -> object:
        return {"output_type": "display_data", "metadata": {}, "data": data}

    reveal = "<div><details><summary>Show</summary><p>It is 92.5.</p></details></div>"
    cells = [
        cell(1, "markdown", "# 01 · One\n\n**How far?** About $x^2$."),
        cell(9, "markdown", "[One](01_one.ipynb#here), [worked](solutions/01_solutions.ipynb)"),
        cell(2, "markdown", "for the lab", tag="lab-only"),
        cell(3, "code", 'guess = cm.predict("01.half", "degrees for each way")\nguess'),
        cell(4, "code", 'guess.reveal("It is 92.5.")', shown({"text/html": reveal})),
        cell(5, "code", 'cm.ask("01.1")'),
        cell(6, "code", "answer_1 = None  # a number"),
        cell(7, "code", 'cm.check("01.1", answer_1)'),
        cell(10, "code", "%matplotlib inline"),
        cell(8, "code", "'<b>'", shown({"text/plain": "<b>"})),
    ]
    return {"cells": cells, "metadata": {}, "nbformat": 4, "nbformat_minor": 5}


def test_a_reveal_without_its_prediction_is_told(tmp_path: Path) -> None:
    book = notebook()
    del book["cells"][2]  # type: ignore[attr-defined]
    (tmp_path / "01_one.ipynb").write_text(json.dumps(book), "utf-8")
    (tmp_path / "images").mkdir()
    assert len(find_lessons(tmp_path)) == 1
    assert command.main([str(tmp_path), str(tmp_path / "site")]) == 1


@pytest.mark.parametrize(
    ("place", "change", "said"),
    [
        (3, {"source": "guess = cm.predict(key, words)"}, "cell c3 asks for a prediction, but not"),
        (4, {"outputs": []}, "cell c4 reveals guess and has 0 outputs in HTML"),
    ],
)
def test_what_a_prediction_lacks_is_told(
    books: Path, place: int, change: dict[str, object], said: str
) -> None:
    book: Any = notebook()
    book["cells"][place].update(change)
    (books / "01_one.ipynb").write_text(json.dumps(book), "utf-8")
    with pytest.raises(InputError, match=said):
        build(books)


def test_a_formula_that_cannot_be_converted_is_named() -> None:
    with pytest.raises(
        InputError, match=r"^The formula '\\\\frac\{1\}' cannot be made MathML: [ -~]+\.$"
    ):
        mathml(r"\frac{1}")
    assert mathml("y''^2").count("<mo>") == 1


def test_a_picture_that_is_not_there_is_named(tmp_path: Path) -> None:
    pictures = Pictures("01", tmp_path)
    for name in ("gone.svg", "../secret.txt"):
        with pytest.raises(InputError, match="which is not there"):
            pictures.drawing(name, "words")


@pytest.mark.parametrize(
    "content",
    [b'<svg width="9" height="9"/>', b'<svg viewBox="0 0 9"/>', b"<svg", b'<svg viewBox="\xe4"/>'],
)
def test_a_drawing_that_cannot_be_read_is_named(tmp_path: Path, content: bytes) -> None:
    (tmp_path / "own.svg").write_bytes(content)
    with pytest.raises(InputError, match=r"The picture own\.svg cannot be read: give an SVG"):
        Pictures("01", tmp_path).drawing("own.svg", "words")


def test_only_the_first_picture_of_a_page_is_fetched_at_once(tmp_path: Path) -> None:
    (tmp_path / "own.svg").write_text('<svg viewBox="0 0 64 48"/>')
    pictures = Pictures("01", tmp_path)
    assert 'loading="lazy"' in pictures.drawing("own.svg", "words")
    assert 'fetchpriority="high"' in pictures.drawing("own.svg", "words", is_first=True)


def test_a_size_may_have_commas_between_its_numbers() -> None:
    assert size_of('<svg viewBox="0,0, 640 480"/>') == (640, 480)


def test_a_drawing_at_rest_has_no_animation_left() -> None:
    moving = '<g><animate dur="9s" values="1;2"/><animateMotion><mpath/></animateMotion><path/></g>'
    assert at_rest(moving) == "<g><animateMotion><mpath/></animateMotion><path/></g>"
    assert embedded_svg("<p>none</p>") == ""


def test_the_workflow_publishes_what_the_command_writes() -> None:
    """It could not be tried on its host; what it calls is there, and what it says stands in it."""
    text = (ROOT / ".github" / "workflows" / "pages.yml").read_text("utf-8")
    (called,) = re.findall(r"run: python3 workbook\.py (.+)", text)
    options = commands.parse(called.split())
    assert options.command == "site"
    assert f"path: {options.folder}\n" in text
    assert options.home == '"$GITHUB_SERVER_URL/$GITHUB_REPOSITORY"'
    assert "could not be tried" in text

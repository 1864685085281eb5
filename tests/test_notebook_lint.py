"""The notebooks pass the lint, and the lint refuses what it should."""

import json
import re
from collections.abc import Callable
from pathlib import Path
from shutil import copytree
from typing import Any

import pytest
from notebook_lint import MAX_BYTES, MAX_CODE_LINES, PROSE_WORDS, RULES, WIDGET, lint

NOTEBOOKS = sorted(
    path
    for path in (Path(__file__).parents[1] / "notebooks").rglob("*.ipynb")
    if ".ipynb_checkpoints" not in path.parts
)
KNOWN = Path(__file__).parent / "data" / "lint"
SVG = '<svg xmlns="http://www.w3.org/2000/svg"><title>Cam</title>{}</svg>'

Edit = Callable[[dict[str, Any]], None]


def markdown(source: str, **changes: object) -> Edit:
    """Append a Markdown cell."""
    cell = {"cell_type": "markdown", "id": "added", "metadata": {}, "source": source} | changes
    return lambda notebook: notebook["cells"].append(cell)


def last_code(**changes: object) -> Edit:
    """Change parts of the last code cell."""

    def edit(notebook: dict[str, Any]) -> None:
        codes = [cell for cell in notebook["cells"] if cell["cell_type"] == "code"]
        codes[-1].update(changes)

    return edit


def code(source: str) -> Edit:
    """Replace the source of the last code cell."""
    return last_code(source=source)


def output(kind: str, **content: object) -> Edit:
    """Replace the output of the last code cell."""
    return last_code(outputs=[{"output_type": kind, **content}])


def shown(data: dict[str, object]) -> Edit:
    """Replace the output of the last code cell by a MIME bundle."""
    return output("display_data", metadata={}, data=data)


def reword(words: dict[str, str]) -> Edit:
    """Replace words in all sources at once."""
    pattern = re.compile("|".join(map(re.escape, words)))

    def edit(notebook: dict[str, Any]) -> None:
        for cell in notebook["cells"]:
            cell["source"] = pattern.sub(lambda old: words[old[0]], "".join(cell["source"]))

    return edit


def without(key: str) -> Edit:
    """Take a key away from the notebook."""
    return lambda notebook: notebook.pop(key)


def with_metadata(**metadata: object) -> Edit:
    """Add to the metadata of the notebook."""
    return lambda notebook: notebook["metadata"].update(metadata)


def stripped(notebook: dict[str, Any]) -> None:
    """Take away outputs and counts, as nbstripout does."""
    for cell in notebook["cells"]:
        if cell["cell_type"] == "code":
            cell.update(execution_count=None, outputs=[])


def widget(text: str) -> Edit:
    """Replace the output of the last code cell by a widget with this text beside it."""
    return shown({WIDGET: {}, "text/plain": text})


FAILS: dict[str, list[Edit]] = {
    "format": [
        without("cells"),
        without("metadata"),
        without("nbformat"),
        lambda notebook: notebook.update(nbformat_minor=4),
        lambda notebook: notebook["cells"][0].pop("id"),
        lambda notebook: notebook["cells"][0].pop("source"),
        lambda notebook: notebook["cells"].append("not a cell"),
    ],
    "unique_ids": [lambda notebook: notebook["cells"][1].update(id="title")],
    "run_order": [stripped, last_code(execution_count=None), last_code(execution_count=3)],
    "error_output": [output("error", ename="ValueError", evalue="no rise", traceback=[])],
    "stderr_output": [output("stream", name="stderr", text="DeprecationWarning")],
    "notebook_metadata": [
        with_metadata(widgets={}),
        with_metadata(authors=[]),
        with_metadata(kernelspec={"name": "conda-env", "display_name": "mine"}),
        lambda notebook: notebook["metadata"].pop("kernelspec"),
    ],
    "cell_metadata": [
        last_code(metadata={"execution": {"iopub.execute_input": "2026-01-01T00:00:00Z"}}),
        last_code(metadata={"ExecuteTime": {}}),
        markdown("## More", metadata={"jp-MarkdownHeadingCollapsed": True}),
    ],
    "file_size": [
        shown({"text/plain": "x" * MAX_BYTES}),
    ],
    "code_length": [code("1\n" * (MAX_CODE_LINES + 1))],
    "one_title": [
        markdown("# A second title"),
        markdown("<h1>A second title</h1>"),
        reword({"# A lesson": "A lesson"}),
    ],
    "heading_levels": [markdown("#### Too deep")],
    "missing_files": [
        markdown("[the answers](gone.ipynb)"),
        markdown("![A cam](../notebooks/images/gone.svg)"),
        markdown('<img src="../notebooks/images/gone.svg" alt="A cam">'),
        shown({"text/html": '<img src="../notebooks/images/gone.svg" alt="A cam">'}),
    ],
    "portable_links": [
        markdown("![A cam](images/cam.svg)"),
        markdown("[a short notebook](../notebooks/passes-short.ipynb)"),
        markdown("[a short notebook](./passes-short.ipynb)"),
        markdown("[how to use it](/README.md)"),
        markdown("[the drawing](file:///cam.svg)"),
        markdown("[another project](../../outside.md)"),
    ],
    "missing_anchors": [
        markdown("[the set-up](#setup)"),
        markdown("[a short notebook](passes-short.ipynb#Gone)"),
        markdown("[how to use it](../README.md#Gone)"),
    ],
    "link_text": [
        markdown("Read [here](passes-short.ipynb)."),
        markdown("[Click here!](passes-short.ipynb)"),
        markdown('<a href="passes-short.ipynb"></a>'),
    ],
    "alt_text": [
        markdown("![](../notebooks/images/cam.svg)"),
        markdown('<img src="../notebooks/images/cam.svg">'),
        markdown('Text <img src="../notebooks/images/cam.svg" alt=" "> around.'),
        shown({"text/html": '<img src="data:image/png;base64,AA==">'}),
        shown({"text/markdown": "![](../notebooks/images/cam.svg)"}),
        shown({"image/png": "AA=="}),
    ],
    "outside_resources": [
        markdown("![A cam](http://example.org/cam.png)"),
        markdown("![A cam](https://example.org/cam.png)"),
        markdown('<img src="//example.org/cam.png" alt="A cam">'),
        shown({"text/html": '<script src="https://example.org/cam.js"></script>'}),
        shown({"text/html": '<link rel="stylesheet" href="https://example.org/cam.css">'}),
    ],
    "last_semicolon": [code("figure;"), code("figure;  # quiet\n"), code("1\nfigure ;\n# done\n")],
    "untestable_widgets": [
        code("interact(draw, angle=60)"),
        code("widgets.interactive(draw, angle=60)"),
        code("@interact\ndef draw(): ..."),
        code("out = Output()"),
        code("from IPython.display import clear_output"),
    ],
    "nbval_markers": [
        code("# NBVAL_SKIP\nfigure"),
        code("figure\n# NBVAL_IGNORE_OUTPUT"),
        last_code(metadata={"tags": ["nbval-ignore-output"]}),
        last_code(metadata={"tags": ["raises-exception"]}),
    ],
    "object_addresses": [
        shown({"text/plain": "<Figure object at 0x7f10a2>"}),
        output("stream", name="stdout", text="<function f at 0x10AB>"),
    ],
    "home_paths": [
        markdown("Look into `/home/ada/cams`."),
        code("open('/Users/ada/cam.csv')"),
        code(r"open('C:\\Users\\ada\\cam.csv')"),
        output("stream", name="stdout", text="/".join(["", "root", "cam.csv"])),
    ],
    "display_maths": [
        markdown("The velocity is\n$$v$$"),
        markdown("$$v$$\nis the velocity."),
        markdown("The velocity $$v$$ is small."),
        markdown("$$v$$\n$$a$$"),
        markdown("$$\nv\n\n= 1\n$$"),
    ],
    "refused_maths": [
        markdown(r"$\newcommand{\v}{v}$"),
        markdown("\\begin{align}\nv &= 1\n\\end{align}"),
        markdown("$$\n\\begin{align*}\nv &= 1\n\\end{align*}\n$$"),
    ],
    "table_maths": [
        markdown("| a | b |\n| --- | --- |\n| $|v|$ | 1 |"),
        markdown("a | b\n--- | ---\n1 | $\\|v\\|$"),
    ],
    "widget_fallback": [
        widget("VBox(children=(FloatSlider(value=60.0), Image(value=b'\\x89PNG')))"),
        widget("<Explorer>"),
        widget(""),
        shown({"text/plain": "IntSlider(value=50, description='drag me')"}),
    ],
    "drawings": [
        markdown("![A cam](../notebooks/images/untitled.svg)"),
        shown({"image/svg+xml": "<svg>"}),
        shown({"image/svg+xml": SVG.format("<script/>")}),
        shown({"image/svg+xml": SVG.format('<g onclick="go()"/>')}),
        shown({"image/svg+xml": SVG.format('<image href="https://example.org/cam.png"/>')}),
        shown({"image/svg+xml": SVG.format("<style>@import 'cam.css';</style>")}),
        shown({"image/svg+xml": SVG.format("<g style=\"fill: url('cam.svg#a')\"/>")}),
    ],
    "skeleton": [
        reword({"can do": "will do"}),
        reword({"Predict": "Guess"}),
        reword({"## Explore": "### Explore"}),
        reword({"Setup": "Explore", "Explore": "Setup", "#Setup": "#Explore"}),
    ],
    "prose_length": [
        lambda notebook: notebook["cells"].pop(),
        markdown("word " * PROSE_WORDS.stop),
    ],
}

PASSES: list[Edit] = [
    markdown("```markdown\n# No title\n$$ no formula\n```"),
    markdown(
        "`$$` and `\\newcommand` are for display, [this page](https://example.org/home/) says."
    ),
    markdown("$$v$$\n\n$$\n\\begin{aligned}\na &= b\n\\end{aligned}\n$$"),
    markdown("| a | b |\n| --- | --- |\n| $v$ | $a$ |\n\n$|v|$"),
    markdown("```text\n" + "word " * PROSE_WORDS.stop + "\n```"),
    markdown("$[v](t)$ is a formula, not a link."),
    markdown("[![A cam](../notebooks/images/cam.svg)](passes-short.ipynb)"),
    markdown("![A cam](data:image/png;base64,AA==) ![A cam](attachment:cam.png)"),
    markdown("[a name with a space](#What-we-learned) and [its half](#What%2Dwe%2Dlearned)"),
    markdown("### Once more\n\n#### In depth\n\n## And up again"),
    code("css = 'color: red;'\nfigure"),
    code("output()\ninteraction(1)"),
    code("1\n" * MAX_CODE_LINES + "\n\n"),
    last_code(source="", execution_count=None, outputs=[]),
    last_code(metadata={"tags": ["solution"], "nbgrader": {"grade": True}}),
    shown({"text/html": '<img src="data:image/png;base64,AA==" alt="A cam">'}),
    shown({"image/svg+xml": SVG.format('<use href="#a"/><g fill="url(\'#a\')"/>')}),
    output(
        "display_data",
        metadata={"image/png": {"alt": "A cam"}},
        data={WIDGET: {}, "image/png": "AA=="},
    ),
]


def lint_lesson(folder: Path, edit: Edit) -> list[str]:
    """Lint a copy of the good lesson, made long enough, after the edit."""
    (folder / "outside.md").touch()
    home = copytree(KNOWN, folder / "house") / "notebooks"
    lesson = json.loads((home / "passes-lesson.ipynb").read_text(encoding="utf-8"))
    markdown("word " * PROSE_WORDS.start)(lesson)
    lesson["cells"][-1]["id"] = "filler"
    edit(lesson)
    (home / "01_lesson.ipynb").write_text(json.dumps(lesson), encoding="utf-8")
    return lint(home / "01_lesson.ipynb")


def test_notebooks_are_found() -> None:
    assert {"00", "02"} <= {path.name[:2] for path in NOTEBOOKS}


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_notebook_has_no_faults(path: Path) -> None:
    faults = lint(path)
    assert not faults, "\n".join(faults)


def test_every_rule_is_proved() -> None:
    assert {"format", *RULES} == FAILS.keys()


@pytest.mark.parametrize("path", sorted(KNOWN.rglob("passes-*.ipynb")), ids=lambda path: path.stem)
def test_good_notebook_passes(path: Path) -> None:
    assert lint(path) == []


@pytest.mark.parametrize("edit", PASSES)
def test_harmless_edit_passes(tmp_path: Path, edit: Edit) -> None:
    assert lint_lesson(tmp_path, edit) == []


@pytest.mark.parametrize(
    ("name", "edit"),
    [
        pytest.param(name, edit, id=f"{name}-{number}")
        for name, edits in FAILS.items()
        for number, edit in enumerate(edits)
    ],
)
def test_broken_notebook_fails_by_its_rule_alone(tmp_path: Path, name: str, edit: Edit) -> None:
    faults = lint_lesson(tmp_path, edit)
    assert {fault.rpartition(" ")[2] for fault in faults} == {f"[{name}]"}
    assert all(re.match(r"notebook: |cell \d+ \(id \S+\): ", fault) for fault in faults)


@pytest.mark.parametrize("content", [b"", b"{", b"[]", b"{}", b"null", b"\xff"])
def test_no_notebook_at_all_is_a_fault(tmp_path: Path, content: bytes) -> None:
    path = tmp_path / "01_lesson.ipynb"
    path.write_bytes(content)
    assert lint(path)


@pytest.mark.parametrize("name", ["00_start.ipynb", "solutions/01_lesson.ipynb"])
def test_only_lessons_need_the_skeleton(tmp_path: Path, name: str) -> None:
    path = tmp_path / "notebooks" / name
    path.parent.mkdir(parents=True)
    path.write_bytes((KNOWN / "notebooks" / "passes-short.ipynb").read_bytes())
    assert lint(path) == []


def test_links_of_solutions_start_at_the_top(tmp_path: Path) -> None:
    """`solutions/` lies one level deeper."""
    copytree(KNOWN, tmp_path, dirs_exist_ok=True)
    short = json.loads((tmp_path / "notebooks" / "passes-short.ipynb").read_text(encoding="utf-8"))
    path = tmp_path / "notebooks" / "solutions" / "01_lesson.ipynb"
    path.parent.mkdir()
    markdown("[the lesson](../../notebooks/passes-lesson.ipynb)")(short)
    path.write_text(json.dumps(short), encoding="utf-8")
    assert lint(path) == []
    reword({"../../notebooks": ".."})(short)
    path.write_text(json.dumps(short), encoding="utf-8")
    assert [fault.rpartition(" ")[2] for fault in lint(path)] == ["[portable_links]"]

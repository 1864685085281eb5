"""Faults of a notebook that its reader, a copy in `work/` or strict nbval would meet.

Each rule is one function. `python tests/notebook_lint.py FILE ...` prints the faults of files.
"""

import os
import re
import sys
from collections import Counter
from collections.abc import Callable, Iterator
from functools import wraps
from pathlib import Path
from urllib.parse import unquote
from xml.etree import ElementTree

import nbval.plugin as nbval  # type: ignore[import-untyped]
from notebook_model import Cell, Notebook, format_faults, read, split_url

# What headings of a lesson contain, in this order, and the deepest level of each.
SKELETON = (
    ("can do", 2),
    ("Setup", 2),
    ("Predict", 3),
    ("Explore", 2),
    ("What we learned", 2),
    ("Next", 2),
)
PROSE_WORDS = range(700, 2501)
MAX_BYTES = 1_000_000
MAX_CODE_LINES = 20
NOTEBOOK_METADATA = {"kernelspec", "language_info"}
CELL_METADATA = {"tags", "nbgrader", "jupyter", "editable", "deletable"}
FOLDED, OPTIONAL = "jp-MarkdownHeadingCollapsed", re.compile(r"^#+ .*if you like", re.MULTILINE)
EMPTY_LINK_TEXTS = {"", "here", "click here", "this", "link", "this link", "more", "read more"}
PORTABLE_SCHEMES = {"", "http", "https", "mailto", "data", "attachment"}
WIDGET = "application/vnd.jupyter.widget-view+json"

DISPLAY_MATHS = re.compile(r"\$\$(?:(?!\$\$).)+\$\$", re.DOTALL)
REFUSED_MATHS = re.compile(r"\\(?:re)?newcommand|\\def\\|\\begin\{align\*?\}")
TABLE_RULE = re.compile(r"^\s*\|?\s*:?-+:?\s*(?:\|\s*:?-+:?\s*)+\|?\s*$", re.MULTILINE)
LAST_SEMICOLON = re.compile(r";\s*(?:#.*\s*)*\Z")
UNTESTABLE_WIDGETS = re.compile(
    r"\b(?:interact(?:ive|_manual|ive_output)?|Output)\s*\(|@interact|\bclear_output\b"
)
WIDGET_REPR = re.compile(r"\w+\(.*\)|<.*>|", re.DOTALL)
WIDGET_CALL = re.compile(r"[A-Z]\w+\((?:children|value|description)=")
OBJECT_ADDRESS = re.compile(r" at 0x[0-9a-fA-F]+")
HOME_PATH = re.compile(r"(?<!\w)/(?:home|root|Users)/|\b[A-Za-z]:[\\/]{1,2}Users\b")
OUTSIDE_STYLE = re.compile(r"@import|url\(\s*(?!['\"]?(?:#|data:))", re.IGNORECASE)

Rule = Callable[[Notebook], Iterator[str]]
RULES: dict[str, Rule] = {}


def rule(check: Rule) -> Rule:
    """Register a rule under its function's name."""
    RULES[check.__name__] = check
    return check


def cell_rule(check: Callable[[Cell], Iterator[str]]) -> Rule:
    """Register a rule that looks at each cell alone."""

    @rule
    @wraps(check)
    def check_cells(notebook: Notebook) -> Iterator[str]:
        return (f"{cell}: {fault}" for cell in notebook.cells for fault in check(cell))

    return check_cells


def lint(path: Path) -> list[str]:
    """Return the faults of a notebook: where, what, and the [rule]."""
    if faults := [f"{fault} [format]" for fault in format_faults(path)]:
        return faults
    notebook = read(path)
    return [f"{fault} [{name}]" for name, check in RULES.items() for fault in check(notebook)]


@rule
def unique_ids(notebook: Notebook) -> Iterator[str]:
    """Refuse an id used twice: graders and diffs know a cell by it."""
    counts = Counter(cell.node.id for cell in notebook.cells)
    return (f"{cell}: the id is not unique" for cell in notebook.cells if counts[cell.node.id] > 1)


@rule
def run_order(notebook: Notebook) -> Iterator[str]:
    """Refuse a stripped notebook: nbval compares no cell without a count and would pass it."""
    for expected, cell in enumerate((cell for cell in notebook.cells if cell.code.strip()), 1):
        count = cell.node.execution_count
        if count != expected:
            yield f"{cell}: run as {count}, not {expected}: restart the kernel and run all cells"
            return


@cell_rule
def error_output(cell: Cell) -> Iterator[str]:
    """Refuse a cell that ended in an exception."""
    for output in cell.outputs:
        if output.output_type == "error":
            yield f"stored an error, {output.ename}: {output.evalue}"


@cell_rule
def stderr_output(cell: Cell) -> Iterator[str]:
    """Refuse a cell that left a warning."""
    for output in cell.outputs:
        if output.get("name") == "stderr":
            yield f"stored a warning: {output.text.strip()[:100]}"


@rule
def notebook_metadata(notebook: Notebook) -> Iterator[str]:
    """Refuse what GitHub trips over (widget state) and what is noise in diffs."""
    metadata = notebook.node.metadata
    for key in sorted(metadata.keys() - NOTEBOOK_METADATA):
        yield f"notebook: metadata '{key}' must not be stored"
    kernel = metadata.get("kernelspec", {}).get("name")
    if kernel != "python3":
        yield f"notebook: the kernel is {kernel}, not python3"


@cell_rule
def cell_metadata(cell: Cell) -> Iterator[str]:
    """Refuse times and folds, which change with each run; what is optional may be folded."""
    allowed = CELL_METADATA | ({FOLDED} if OPTIONAL.search(cell.prose) else set())
    for key in sorted(cell.node.metadata.keys() - allowed):
        yield f"metadata '{key}' must not be stored"


@rule
def file_size(notebook: Notebook) -> Iterator[str]:
    """Refuse large notebooks, which GitHub does not show."""
    size = notebook.path.stat().st_size
    if size > MAX_BYTES:
        yield f"notebook: {size} bytes, more than {MAX_BYTES}"


@cell_rule
def code_length(cell: Cell) -> Iterator[str]:
    """Refuse long code: it belongs in the package."""
    lines = sum(bool(line.strip()) for line in cell.code.splitlines())
    if lines > MAX_CODE_LINES:
        yield f"{lines} lines of code, more than {MAX_CODE_LINES}"


@rule
def one_title(notebook: Notebook) -> Iterator[str]:
    """Ask for one H1, at the start of the page."""
    titles = [heading.cell.number for heading in notebook.headings if heading.level == 1]
    if titles != [1]:
        yield f"notebook: needs one H1, in cell 1; its H1 are in cells {titles}"


@rule
def heading_levels(notebook: Notebook) -> Iterator[str]:
    """Refuse gaps in the outline that a screen reader reads out."""
    above = 1
    for heading in notebook.headings:
        if heading.level > above + 1:
            yield f"{heading.cell}: '{heading.text}' skips from level {above} to {heading.level}"
        above = heading.level


@rule
def missing_files(notebook: Notebook) -> Iterator[str]:
    """Refuse relative links and pictures that lead to no file."""
    for cell, url in notebook.urls:
        file = notebook.file(url)
        if file and not file.is_file():
            yield f"{cell}: there is no file {url.path}"


@rule
def portable_links(notebook: Notebook) -> Iterator[str]:
    """Refuse links that fail from a learner's copy in `work/`."""
    for cell, url in notebook.urls:
        file = notebook.file(url)
        is_absolute = url.path.startswith("/") and not url.netloc
        if is_absolute or url.scheme not in PORTABLE_SCHEMES:
            yield f"{cell}: {url.geturl()} means something on one machine only"
        elif file and unquote(url.path) != (portable := _portable_link(notebook, file)):
            yield f"{cell}: {url.path} fails from a copy in work/: write {portable}"


def _portable_link(notebook: Notebook, file: Path) -> str:
    """Name a notebook of the same folder plainly and any other file from the top."""
    folder = notebook.path.parent
    if file.suffix == ".ipynb" and file.parent == folder:
        return file.name
    if not file.is_relative_to(notebook.top):
        return "a link to a file of this project"
    up = Path(os.path.relpath(notebook.top, folder))
    return (up / file.relative_to(notebook.top)).as_posix()


@rule
def missing_anchors(notebook: Notebook) -> Iterator[str]:
    """Refuse links to headings that are not there, in this notebook or another."""
    for cell, url in notebook.urls:
        file = notebook.file(url) if url.path else notebook.path
        anchor = unquote(url.fragment)
        if anchor and file and not url.netloc and anchor not in _anchors(file):
            yield f"{cell}: no notebook heading #{anchor} in {file.name}"


def _anchors(file: Path) -> set[str]:
    """Return the anchors of a notebook; in other files Lab and GitHub do not agree on them."""
    is_notebook = file.suffix == ".ipynb" and file.is_file() and not any(format_faults(file))
    return {heading.anchor for heading in read(file).headings} if is_notebook else set()


@cell_rule
def link_text(cell: Cell) -> Iterator[str]:
    """Make each link say where it goes, even when read out of its sentence."""
    for link in cell.select("a[href]"):
        alts = [str(image.get("alt", "")) for image in link.select("img")]
        text = " ".join([link.get_text(), *alts]).strip(" \n.:!»→")
        if text.casefold() in EMPTY_LINK_TEXTS:
            yield f"the link to {link['href']} says '{text}', not where it goes"


@cell_rule
def alt_text(cell: Cell) -> Iterator[str]:
    """Ask for a description of each picture, for those who do not see it."""
    for image in cell.select("img"):
        if not str(image.get("alt", "")).strip():
            yield f"picture {str(image.get('src'))[:80]} has no alternative text"
    for output in cell.node.get("outputs", []):
        shown = output.get("metadata", {}).get("image/png", {})
        if "image/png" in output.get("data", {}) and not shown.get("alt", "").strip():
            yield "a PNG output has no alternative text: draw it with the package's functions"


@cell_rule
def outside_resources(cell: Cell) -> Iterator[str]:
    """Load nothing from the internet: a class may have none."""
    for tag in cell.select("[src], link[href]"):
        url = split_url(str(tag.get("src", tag.get("href"))))
        if url.netloc:
            yield f"{url.geturl()} is loaded from outside"


@cell_rule
def last_semicolon(cell: Cell) -> Iterator[str]:
    """Refuse a semicolon that hides the output: nbval does not honour it."""
    if LAST_SEMICOLON.search(cell.code):
        yield "ends in a semicolon: assign the value to _ instead"


@cell_rule
def untestable_widgets(cell: Cell) -> Iterator[str]:
    """Refuse widgets with which nbval fails though nothing changed, or errors are swallowed."""
    if found := UNTESTABLE_WIDGETS.search(cell.code):
        yield f"'{found[0]}' cannot be tested: wire widgets by observe"


@cell_rule
def nbval_markers(cell: Cell) -> Iterator[str]:
    """Refuse marks that take a cell out of nbval's comparison."""
    comments = re.findall(r"^\s*#+\s*(\w+)\s*$", cell.code, re.MULTILINE)
    tags = cell.node.metadata.get("tags", ())
    known = {*nbval.comment_markers, *nbval.metadata_tags}
    for marker in sorted(known.intersection([*comments, *tags])):
        yield f"'{marker}' changes what nbval compares"


@cell_rule
def object_addresses(cell: Cell) -> Iterator[str]:
    """Refuse object addresses, which change with each run."""
    for found in filter(None, map(OBJECT_ADDRESS.search, cell.output_texts)):
        yield f"the output shows an object's address,{found[0]}"


@cell_rule
def home_paths(cell: Cell) -> Iterator[str]:
    """Refuse paths of one machine, which lead nowhere on another."""
    for found in filter(None, map(HOME_PATH.search, [cell.source, *cell.output_texts])):
        yield f"shows a path of one machine, {found[0]}"


@cell_rule
def display_maths(cell: Cell) -> Iterator[str]:
    """Ask for a paragraph of its own for each display formula, or GitHub does not show it."""
    for text in cell.paragraphs:
        if "$$" in text and not DISPLAY_MATHS.fullmatch(text):
            yield f"a $$ formula needs a blank line on both sides: {text[:60]}"


@cell_rule
def refused_maths(cell: Cell) -> Iterator[str]:
    """Refuse TeX that GitHub shows as source."""
    for found in filter(None, map(REFUSED_MATHS.search, cell.paragraphs)):
        yield f"GitHub does not show {found[0]}: write aligned within $$, and no macros"


@cell_rule
def table_maths(cell: Cell) -> Iterator[str]:
    """Refuse a bar in a table's formula: it ends the table's cell."""
    for table in filter(TABLE_RULE.search, cell.paragraphs):
        for formula in re.findall(r"\$[^$\n]+\$", table):
            if "|" in formula:
                yield f"the bar in {formula} ends the table's cell: write \\lvert"


@cell_rule
def widget_fallback(cell: Cell) -> Iterator[str]:
    """Ask for a picture or a text that is shown where no kernel runs."""
    for data in cell.bundles:
        text = data.get("text/plain", "").strip()
        is_widget = WIDGET in data or WIDGET_CALL.match(text)  # refresh drops the view
        if is_widget and "image/png" not in data and WIDGET_REPR.fullmatch(text):
            yield f"without a kernel the widget shows as '{text[:60]}'"


@rule
def drawings(notebook: Notebook) -> Iterator[str]:
    """Ask each SVG for a title, and that it runs and loads nothing."""
    for cell in notebook.cells:
        for name, text in _drawings(notebook, cell):
            yield from (f"{cell}: {name} {fault}" for fault in _svg_faults(text))


def _drawings(notebook: Notebook, cell: Cell) -> Iterator[tuple[str, str | bytes]]:
    """Yield name and text of each SVG file that the cell refers to and of its SVG outputs."""
    for file in filter(None, map(notebook.file, cell.urls)):
        if file.suffix == ".svg" and file.is_file():
            yield file.name, file.read_bytes()
    for bundle in cell.bundles:
        if "image/svg+xml" in bundle:
            yield "an SVG output", bundle["image/svg+xml"]


def _svg_faults(text: str | bytes) -> Iterator[str]:
    try:
        svg = ElementTree.fromstring(text)  # noqa: S314 - our own files
    except ElementTree.ParseError as problem:
        yield f"is not well-formed XML: {problem}"
        return
    if not (svg.findtext("{*}title") or "").strip():
        yield "has no title"
    attributes = [(_local(key), value) for tag in svg.iter() for key, value in tag.items()]
    if any(_local(tag.tag) == "script" for tag in svg.iter()):
        yield "has a script"
    if any(key.startswith("on") for key, _ in attributes):
        yield "has a script in an attribute"
    if any(key == "href" and not value.startswith(("#", "data:")) for key, value in attributes):
        yield "refers to something outside itself"
    styles = [value for _, value in attributes] + [tag.text or "" for tag in svg.iter()]
    if any(map(OUTSIDE_STYLE.search, styles)):
        yield "has a style that loads something from outside"


def _local(name: str) -> str:
    """Drop the namespace."""
    return name.rpartition("}")[2]


@rule
def skeleton(notebook: Notebook) -> Iterator[str]:
    """Ask a lesson for the sections that all lessons share."""
    headings = iter(notebook.headings)
    for phrase, deepest in SKELETON if notebook.is_lesson else ():
        levels = range(2, deepest + 1)
        # `any` uses up the headings to the one it finds: the next phrase has to follow it.
        if not any(heading.level in levels and phrase in heading.text for heading in headings):
            yield f"notebook: section '{phrase}' is missing or out of order"
            return


@rule
def prose_length(notebook: Notebook) -> Iterator[str]:
    """Keep a lesson within 20 to 40 minutes."""
    words = sum(cell.word_count for cell in notebook.cells)
    if notebook.is_lesson and words not in PROSE_WORDS:
        yield f"notebook: {words} words of prose, not {PROSE_WORDS[0]} to {PROSE_WORDS[-1]}"


if __name__ == "__main__":
    found = [f"{name}: {fault}" for name in sys.argv[1:] for fault in lint(Path(name))]
    print("\n".join(found) or "no faults")
    raise SystemExit(bool(found))

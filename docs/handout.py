"""Make a handout of lessons, to be printed: `python docs/handout.py 02` writes `02_....html`.

The pages need no network and run no script: formulas are MathML with their font, and what a lesson
folds away stays folded. Answers to exercises are not in them.
"""

import argparse
import base64
import re
import shutil
from functools import cache
from html import escape, unescape
from pathlib import Path

from bs4 import BeautifulSoup
from nbconvert import HTMLExporter

from cammotion.site.formulas import mathml, style

LESSONS = Path(__file__).parents[1] / "notebooks"
FORMULA = re.compile(r"\$\$(.+?)\$\$|\$([^$]+?)\$", re.DOTALL)
STYLE = """
@page { size: A4; margin: 18mm }
body { font: 11.5pt/1.45 serif; max-width: 44em; margin: auto; padding: 0 }
h1, h2, h3 { break-after: avoid; line-height: 1.2 }
img { max-width: 100%; max-height: 120mm }
table { border-collapse: collapse } th, td { border: 1px solid #999; padding: 2px 6px }
pre { font-size: 9pt; white-space: pre-wrap; margin: 0.6em 0 }
.input pre { background: #f2f2f2; padding: 4px 8px }
pre, img, table, details { break-inside: avoid }
math[display=block] { margin: 0.7em 0 }
.prompt, .anchor-link { display: none }
"""


def as_data(picture: Path) -> str:
    """Return a picture as an address that holds it."""
    kind = {".svg": "svg+xml"}.get(picture.suffix, picture.suffix[1:])
    return f"data:image/{kind};base64," + base64.b64encode(picture.read_bytes()).decode("ascii")


def formula(match: re.Match[str]) -> str:
    """Return a formula of LaTeX as MathML, on a line of its own where it stands so."""
    return mathml(unescape((match[1] or match[2]).strip()), block=bool(match[1]))


@cache
def exporter() -> HTMLExporter:
    """Return nbconvert's exporter, whose templates are read once for all lessons."""
    return HTMLExporter(template_name="classic")  # type: ignore[no-untyped-call]


def handout(lesson: Path) -> str:
    """Return a lesson as one page of HTML, without scripts."""
    html, _ = exporter().from_filename(str(lesson))
    page = BeautifulSoup(html, "html.parser")
    for tag in page.select("script, style, link, .anchor-link, audio, video"):
        tag.decompose()
    for image in page.select("img:not([src^='data:'])"):
        image["src"] = as_data(lesson.parent / str(image["src"]))
    for text in page.find_all(string=FORMULA):
        if not text.find_parent(["pre", "code", "svg", "title"]):
            written = FORMULA.sub(formula, escape(text, quote=False))
            text.replace_with(BeautifulSoup(written, "html.parser"))
    return str(page).replace("</head>", f"<style>{STYLE}{style()}</style></head>", 1)


def main() -> None:
    """Write the handouts of the lessons whose numbers are given."""
    parser = argparse.ArgumentParser(description="Make handouts of lessons, to be printed.")
    parser.add_argument("lessons", nargs="+", metavar="NN", help="the number of a lesson: 02")
    parser.add_argument("--folder", type=Path, default=Path("handouts"), help="where to write")
    given = parser.parse_args()
    given.folder.mkdir(parents=True, exist_ok=True)
    for number in given.lessons:
        found = sorted(LESSONS.glob(f"{number}_*.ipynb"))
        if not found:
            parser.error(f"There is no lesson {number}: give the two digits of one, as 02.")
        page = given.folder / f"{found[0].stem}.html"
        page.write_text(handout(found[0]), encoding="utf-8")
        print(f"wrote {page}")
        for table in sorted((LESSONS / "data").glob("*.csv")):
            if table.name in found[0].read_text("utf-8"):
                (given.folder / "data").mkdir(exist_ok=True)
                shutil.copy(table, given.folder / "data")
                print(f"wrote {given.folder / 'data' / table.name}, which it reads")


if __name__ == "__main__":
    main()

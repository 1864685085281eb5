"""The pictures of a report: the timing diagrams, and the machine in motion."""

from cammotion.machine.diagram import TimingDiagram
from cammotion.quantities import InputError
from cammotion.report.findings import Findings
from cammotion.report.markup import paragraph, picture
from cammotion.views.animation.picture import animate
from cammotion.views.pictures import taken
from cammotion.views.timing_plots import plot_timing

_SVG, _PNG = "image/svg+xml", "image/png"


def designs(found: Findings) -> dict[str, TimingDiagram]:
    """Return the diagrams to be shown, by their titles."""
    today = {"today": found.machine.diagram}
    return today | ({"the design": found.design} if found.best else {})


def moving(found: Findings) -> str:
    """Return the machine in motion, today and as designed by one clock."""
    try:
        shown = animate(designs(found), rules=found.machine.rules)
        return picture(shown.svg.encode(), _SVG, shown.description)
    except InputError as wrong:
        return paragraph(f"It is not shown. {wrong}")


def timing(found: Findings) -> str:
    """Return a timing diagram of today, and of the design."""
    parts = []
    for title, diagram in designs(found).items():
        try:
            ax = plot_timing(diagram, rules=found.machine.rules, rows=["acceleration"])
        except InputError as wrong:
            return paragraph(f"It is not drawn. {wrong}")
        parts.append(f"<h3>{title[0].upper()}{title[1:]}</h3>\n")
        png, words = taken(ax)
        parts.append(picture(png, _PNG, words))
    return "".join(parts)

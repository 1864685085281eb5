"""The pictures of a report: the timing diagrams, and the machine in motion."""

from typing import cast

from matplotlib import pyplot as plt

from cammotion.machine.diagram import TimingDiagram
from cammotion.quantities import InputError
from cammotion.report.findings import Findings
from cammotion.report.markup import paragraph, picture
from cammotion.views.animation.picture import animate
from cammotion.views.pictures import PictureFigure, describe
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
        figure = cast(PictureFigure, ax.figure)
        parts.append(f"<h3>{title[0].upper()}{title[1:]}</h3>\n")
        parts.append(picture(figure.png(), _PNG, describe(figure)))
        plt.close(figure)
    return "".join(parts)

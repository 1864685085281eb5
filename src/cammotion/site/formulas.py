"""Formulas as MathML, made when a page is built, and the font by which a browser draws them."""

import base64
from functools import cache
from importlib.resources import files

from math_core import LatexError, LatexToMathML
from nbconvert.filters import strip_ansi

from cammotion.quantities import InputError, shorten

_CONVERTER = LatexToMathML()
_DISPLAY = r"\displaystyle"
FONT = files("cammotion.site") / "fonts" / "formulas.woff"
# The reader's own fonts first: where there is one, ours is not asked for
_STYLE = """\
@font-face { font-family: "Workbook Math"; src: url(ADDRESS) format("woff"); font-display: swap }
math { font-family: "STIX Two Math", "Latin Modern Math", "Cambria Math", "Workbook Math", math;
  font-size: 1.06em }
"""


@cache
def mathml(tex: str, *, block: bool = False) -> str:
    """Return a formula of LaTeX as MathML, in its line or as a block of its own.

    Raises InputError for a formula that cannot be converted.

    >>> mathml("t_m")
    '<math><msub><mi>t</mi><mi>m</mi></msub></math>'
    """
    try:
        made: str = _CONVERTER.convert_with_local_state(tex.strip(), displaystyle=block)
    except LatexError as wrong:
        said: str = strip_ansi(str(wrong))  # type: ignore[no-untyped-call]
        why, *_ = said.strip().splitlines()  # below it the place is drawn
        why = why.removeprefix("Error: ").removesuffix(".")
        raise InputError(f"The formula {shorten(tex)} cannot be made MathML: {why}.") from None
    return f'<div class="formula">{made}</div>' if block else made


def shown_formula(latex: str) -> str:
    r"""Return what SymPy shows of an expression as a formula on a line of its own.

    >>> shown_formula(r"$\displaystyle x$")
    '<div class="formula"><math display="block"><mi>x</mi></math></div>'
    """
    return mathml(latex.strip().strip("$").replace(_DISPLAY, "", 1), block=True)


def style(font: str = "") -> str:
    """Return the style of formulas; `font` is the address of their font, "" to hold it itself.

    >>> "url(formulas.woff)" in style("formulas.woff"), "url(data:font/woff;base64," in style()
    (True, True)
    """
    held = base64.b64encode(FONT.read_bytes()).decode("ascii")
    return _STYLE.replace("ADDRESS", font or f"data:font/woff;base64,{held}")

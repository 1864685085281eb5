"""Formulas as MathML, made when a page is built: a browser draws it with no script and no font."""

from functools import cache

from math_core import LatexError, LatexToMathML
from nbconvert.filters import strip_ansi

from cammotion.quantities import InputError, shorten

_CONVERTER = LatexToMathML()
_DISPLAY = r"\displaystyle"


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

"""Cam motion and machine timing: the helper package of the workbook.

Every public name is listed once, in ``__init__.pyi``, and its module is loaded when the name is
first used. So ``import cammotion`` costs next to nothing, and a lesson pays for SymPy, Matplotlib
or ipywidgets only when it draws or derives something.

Nine names are values: `LAWS`, the motion laws by their names; `x`, the symbol in which a law is
written; `MATCHED`, the law of a move that goes on as its neighbours do; `EXAMPLE`, the machine of
the lessons; `SUSPECTS`, the six laws of the bug hunt; `PRINTED_LIMITS`, a table of limits with
errors in it; and `MM_PER_INCH`, `KG_PER_LB` and `N_PER_LBF`, the inch, the pound and its weight.
"""

from typing import Any

import lazy_loader

__version__ = "0.2.0"

_load, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)


def __getattr__(name: str) -> Any:
    """Return what a name stands for; a public one refuses calls that do not fit in a sentence."""
    thing = _load(name)
    if name in __all__ and callable(thing):
        from cammotion.arguments import called

        thing = globals()[name] = called(thing)
    return thing

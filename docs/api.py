"""Write the API page, all public names with their docstrings, into a folder that needs no network.

Needs the extra `api`; see CONTRIBUTING.md.
"""

import inspect
import sys
from pathlib import Path
from typing import Any

import pdoc
import pdoc.render
from numpy.typing import ArrayLike

from cammotion.quantities import Floats

# Python spells such types out, over ten lines in each signature.
NAMES: dict[Any, str] = {
    ArrayLike: "ArrayLike",
    ArrayLike | None: "ArrayLike | None",
    Floats: "Floats",
}
SHORT = {long: type(name, (), {"__module__": "builtins"}) for long, name in NAMES.items()}

_format_signature = pdoc.render.env.filters["format_signature"]


def with_short_types(signature: inspect.Signature, colon: bool) -> Any:
    """Return a signature as HTML, with the types above under their names."""
    parameters = [
        parameter.replace(annotation=_short(parameter.annotation))
        for parameter in signature.parameters.values()
    ]
    returned = _short(signature.return_annotation)
    short = signature.replace(parameters=parameters, return_annotation=returned)
    return _format_signature(short, colon)


def _short(annotation: Any) -> Any:
    return SHORT.get(annotation, annotation) if annotation.__hash__ else annotation


if __name__ == "__main__":
    folder = Path(sys.argv[1] if len(sys.argv) > 1 else "api")
    pdoc.render.env.filters["format_signature"] = with_short_types
    pdoc.render.configure(show_source=False, search=False)
    pdoc.pdoc("cammotion", output_directory=folder)
    print(f"The API page is {folder / 'cammotion.html'}.")

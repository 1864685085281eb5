"""Is this Python the workbook's own, with everything it needs? The answer in words."""

import sys
from collections.abc import Callable, Iterator
from importlib import metadata

from packaging.requirements import Requirement

_REPAIR = (
    "Close JupyterLab and start the workbook again with `python3 workbook.py`; if this stays, "
    "delete the folder .venv first, it is made anew."
)
_OLDEST_PYTHON = (3, 11)


def check_setup() -> None:
    """Print whether everything that the workbook needs is here, and if not, what to do.

    >>> check_setup()
    Everything the workbook needs is here.
    """
    print("\n".join(setup_problems()) or "Everything the workbook needs is here.")


def setup_problems(
    installed: Callable[[str], str] = metadata.version,
    python: tuple[int, int] = sys.version_info[:2],
) -> list[str]:
    """Return a sentence for each thing that is wrong, and one with the remedy; [] if all is well.

    `installed` gives the version of a package and raises PackageNotFoundError where there is
    none, `python` is the version of Python; tests put in their own.
    """
    problems = [*_wrong_python(python), *_wrong_packages(installed)]
    return [*problems, _REPAIR] if problems else []


def _wrong_python(python: tuple[int, int]) -> Iterator[str]:
    if python < _OLDEST_PYTHON:
        yield f"This is Python {python[0]}.{python[1]}; the workbook needs 3.11 or later."


def _wrong_packages(installed: Callable[[str], str]) -> Iterator[str]:
    for needed_by in ("cammotion", "ipywidgets"):
        for requirement in _requirements(needed_by):
            try:
                version = installed(requirement.name)
            except metadata.PackageNotFoundError:
                yield _missing(requirement, needed_by)
            else:
                if not requirement.specifier.contains(version, prereleases=True):
                    yield _unfit(requirement, needed_by, version)


def _requirements(package: str) -> Iterator[Requirement]:
    """Yield what the package needs on this machine to run in JupyterLab."""
    for line in metadata.requires(package) or []:
        requirement = Requirement(line)
        if requirement.marker is None or requirement.marker.evaluate({"extra": "lab"}):
            yield requirement


def _missing(requirement: Requirement, needed_by: str) -> str:
    sentence = f"The package {requirement.name} is missing; {needed_by} needs it."
    return sentence + _what_it_does(requirement)


def _unfit(requirement: Requirement, needed_by: str, version: str) -> str:
    sentence = (
        f"The package {requirement.name} is here in version {version}, but {needed_by} needs "
        f"{requirement.specifier}: the two are out of step."
    )
    return sentence + _what_it_does(requirement)


def _what_it_does(requirement: Requirement) -> str:
    if requirement.name.replace("-", "_").lower() != "jupyterlab_widgets":
        return ""
    return " Without it sliders show as 'Error displaying widget' in JupyterLab."

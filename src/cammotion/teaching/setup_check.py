"""Does this Python have everything that the workbook needs? The answer in words.

It is asked in the workbook's own environment, on a hub, in a Notebook 7 and in a plain Python.
What a Jupyter server in another environment has cannot be seen from a kernel.
"""

import importlib
import json
import sys
from collections.abc import Callable, Iterator
from contextlib import suppress
from importlib import metadata
from pathlib import Path
from types import ModuleType
from typing import NamedTuple

from packaging.requirements import Requirement
from packaging.specifiers import SpecifierSet
from packaging.version import InvalidVersion, Version

_ALL_WELL = "Everything the workbook needs is here."
_REPAIR = (
    "Close JupyterLab and start the workbook again with `python3 workbook.py`; if this stays, "
    "delete the folder .venv first, it is made anew."
)
_INSTALL = (
    "Run `%pip install {}` in a cell and restart the kernel; where the environment is not yours, "
    "as on a hub, ask whoever looks after it."
)
_ELSEWHERE = (
    "What shows this page runs in another environment than this kernel. If sliders show as 'Error "
    "displaying widget', jupyterlab_widgets is missing there, or older than 3."
)
_NO_JUPYTER = (
    "There is no Jupyter in this environment: for the notebooks, install jupyterlab or notebook."
)
_OLDEST_PYTHON = (3, 11)
_MODULES = {"ipython": "IPython", "scipy": "scipy.optimize"}  # others are called as their package
_OF_THE_SERVER = {"jupyterlab", "jupyterlab_widgets", "widgetsnbextension"}
# Colab's page shows the widgets of ipywidgets 7 alone; the notebooks run with what it brings.
_IN_COLAB = {"ipywidgets": SpecifierSet(">=7.7.1,<8"), "matplotlib": SpecifierSet(">=3.10")}


class _Finding(NamedTuple):
    """What is wrong, and what pip would have to install to mend it, if it can."""

    sentence: str
    wanted: str = ""


def check_setup() -> None:
    """Print whether everything that the workbook needs is here, and if not, what to do.

    Packages are imported, since one that is installed may be broken, or hidden by another.

    >>> check_setup()
    Everything the workbook needs is here.
    """
    print("\n".join(setup_problems() or [_ALL_WELL, *_remarks()]))


def setup_problems(
    installed: Callable[[str], str] = metadata.version,
    python: tuple[int, int] = sys.version_info[:2],
    load: Callable[[str], ModuleType] = importlib.import_module,
) -> list[str]:
    """Return a sentence for each thing that is wrong, and one with the remedy; [] if all is well.

    `installed` gives the version of a package and raises PackageNotFoundError where there is
    none, `python` is the version of Python, `load` imports a module; tests put in their own.
    """
    found = [
        *_wrong_python(python),
        *_wrong_package(installed, load),
        *_wrong_needs(installed, load),
    ]
    sentences = [each.sentence for each in found]
    wanted = dict.fromkeys(f'"{each.wanted}"' for each in found if each.wanted)
    if found and _is_at_home():
        sentences.append(_REPAIR)
    elif wanted:
        sentences.append(_INSTALL.format(" ".join(wanted)))
    return sentences


def _is_at_home() -> bool:
    """Tell whether this Python is the one that the workbook has made for itself."""
    return (Path(sys.prefix).parent / "workbook.py").is_file()


def _is_in_colab() -> bool:
    """Tell whether this is a notebook of Google Colab."""
    return "google.colab" in sys.modules


def _is_here(package: str) -> bool:
    with suppress(metadata.PackageNotFoundError):
        return bool(metadata.version(package))
    return False


def _remarks() -> Iterator[str]:
    """Say what cannot be seen from here."""
    if not _is_here("jupyter_server"):
        yield _ELSEWHERE if "ipykernel" in sys.modules else _NO_JUPYTER


def _wrong_python(python: tuple[int, int]) -> Iterator[_Finding]:
    if python < _OLDEST_PYTHON:
        yield _Finding(f"This is Python {python[0]}.{python[1]}; the workbook needs 3.11 or later.")


def _wrong_package(
    installed: Callable[[str], str], load: Callable[[str], ModuleType]
) -> Iterator[_Finding]:
    """Look whether the cammotion that is imported is the one that is installed."""
    imported = load("cammotion")
    folder = Path(imported.__file__ or "").parent
    here = f"cammotion {imported.__version__} is imported from {folder}"
    advice = "take the folder above it out of the variable PYTHONPATH, and restart the kernel."
    try:
        version = installed("cammotion")
    except metadata.PackageNotFoundError:
        yield _Finding(f"{here}, and is not installed: install it, or {advice}")
    else:
        if version != imported.__version__:
            yield _Finding(f"{here}, but {version} is installed: {advice}")


def _wrong_needs(
    installed: Callable[[str], str], load: Callable[[str], ModuleType]
) -> Iterator[_Finding]:
    """Look at what the package needs, and at what shows its sliders."""
    for needed_by in ("cammotion", "ipywidgets"):
        for requirement in _requirements(needed_by):
            try:
                version = installed(requirement.name)
            except metadata.PackageNotFoundError:
                yield _wrong_need(requirement, f"is missing; {needed_by} needs it.")
                continue
            if not requirement.specifier.contains(version, prereleases=True):
                yield _wrong_need(
                    requirement,
                    f"is here in version {version}, but {needed_by} needs "
                    f"{requirement.specifier}: the two are out of step.",
                )
            elif _name(requirement) not in _OF_THE_SERVER:
                yield from _wrong_module(requirement, version, load)


def _requirements(package: str) -> Iterator[Requirement]:
    """Yield what the package needs on this machine, as far as this environment has to have it."""
    lines: list[str] = []
    with suppress(metadata.PackageNotFoundError):  # this has been said
        lines = metadata.requires(package) or []
    extra = "lab" if _is_at_home() else ""
    for requirement in map(Requirement, lines):
        if requirement.marker and not requirement.marker.evaluate({"extra": extra}):
            continue
        if _is_in_colab():
            requirement.specifier = _IN_COLAB.get(requirement.name, requirement.specifier)
        if _name(requirement) not in _OF_THE_SERVER or _is_of_this_server():
            yield requirement


def _is_of_this_server() -> bool:
    """Tell whether the Jupyter server that shows the page may run in this environment."""
    return _is_here("jupyter_server") and not _is_in_colab()


def _name(requirement: Requirement) -> str:
    return requirement.name.replace("-", "_").lower()


def _wrong_need(requirement: Requirement, said: str) -> _Finding:
    sentence = f"The package {requirement.name} {said}"
    if _name(requirement) == "jupyterlab_widgets":
        sentence += " Without it sliders show as 'Error displaying widget'."
    return _Finding(sentence, _in_words_of_pip(requirement))


def _in_words_of_pip(requirement: Requirement) -> str:
    return f"{requirement.name}{requirement.specifier}"


def _wrong_module(
    requirement: Requirement, version: str, load: Callable[[str], ModuleType]
) -> Iterator[_Finding]:
    """Import what is installed, and look whether it comes from there, and in that version."""
    name = _MODULES.get(_name(requirement), _name(requirement))
    try:
        module = load(name)
        file = Path(module.__file__ or "").resolve()
    except Exception as error:  # what a broken package raises can be anything
        reason = ": ".join([type(error).__name__, *str(error).splitlines()[:1]])
        sentence = f"The package {requirement.name} cannot be imported ({reason})."
        yield _Finding(sentence, _in_words_of_pip(requirement))
        return
    loaded = getattr(module, "__version__", version)
    if not _are_equal(loaded, version):
        yield _Finding(
            f"The package {requirement.name} is loaded in version {loaded}, and {version} is "
            "installed since: restart the kernel."
        )
    elif not _is_anywhere(requirement.name) and not file.is_relative_to(_place(requirement.name)):
        yield _Finding(
            f"The package {requirement.name} is installed, but hidden by {file}: rename that file "
            "if it is yours, or take its folder out of the variable PYTHONPATH, and restart the "
            "kernel."
        )


def _are_equal(loaded: str, installed: str) -> bool:
    with suppress(InvalidVersion):
        return Version(loaded) == Version(installed)
    return loaded == installed


def _place(package: str) -> Path:
    return Path(str(metadata.distribution(package).locate_file(""))).resolve()


def _is_anywhere(package: str) -> bool:
    """Tell whether a package was installed where its author works on it."""
    with suppress(ValueError, AttributeError):
        origin = json.loads(metadata.distribution(package).read_text("direct_url.json") or "{}")
        return bool(origin.get("dir_info", {}).get("editable"))
    return False

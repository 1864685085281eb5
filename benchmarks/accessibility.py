"""What axe-core finds in the outputs of all lessons in JupyterLab, after a run, dark and light."""

import shutil
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any

from findings import Finding, say
from live import ROOT, running_workbook
from playwright.sync_api import Browser

sys.path.append(str(ROOT / "tests"))

from lab import LabPage, running_browser

AXE = "axe-core@4.14.1"  # a tool of Deque's, on npm since 2015, without dependencies
RULES = ["wcag2a", "wcag2aa", "wcag21a", "wcag21aa", "wcag22aa", "best-practice"]
OUTPUTS = ".jp-OutputArea-output"
RUN = """async ([outputs, rules]) => {
  const found = await axe.run({include: [[outputs]]}, {runOnly: rules});
  return found.violations.flatMap(({id, nodes}) => nodes.map(({html}) => [id, html]));
}"""
# What others draw: the handle of ipywidgets' slider has no name (notebook 00 tries it).
OF_OTHERS = [("aria-input-field-name", '<div class="noUi-handle')]
RUN_ALL = "() => jupyterapp.commands.execute('notebook:run-all-cells')"
THEME = "theme => jupyterapp.commands.execute('apputils:change-theme', {theme})"
THEMES = ("JupyterLab Dark", "JupyterLab Light")


def measure_accessibility() -> list[Finding]:
    """Run every lesson in JupyterLab and look at its outputs with axe-core (asks npm for it)."""
    axe = fetch_axe()
    lessons = sorted(path.name for path in (ROOT / "notebooks").glob("[0-9]*.ipynb"))
    with running_browser() as browser:
        return [
            Finding(f"axe-core, outputs of {name[:2]}", len(_ours(browser, name, axe)), 0, "")
            for name in lessons
        ]


def fetch_axe() -> str:
    """Return the source of axe-core."""
    npm = shutil.which("npm")
    if npm is None:
        sys.exit("axe-core comes from npm, which is not on the PATH: install Node.js.")
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run(
            [npm, "install", "--silent", "--no-save", "--prefix", folder, AXE], check=True
        )
        return (Path(folder) / "node_modules/axe-core/axe.min.js").read_text("utf-8")


def _ours(browser: Browser, name: str, axe: str) -> list[list[str]]:
    """Return what is found in the outputs of a lesson, but for what is JupyterLab's own."""
    with running_workbook(browser, name) as lab:
        lab.page.evaluate(RUN_ALL)
        found = [each for theme in THEMES for each in _look(lab, axe, theme)]
    ours = [[rule, html] for rule, html in found if not _is_of_others(rule, html)]
    for rule, html in ours:
        say(f"{name[:2]}: {rule}: {html[:150]}")
    say(f"{name[:2]}: {len(found) - len(ours)} findings in what JupyterLab and ipywidgets draw")
    return ours


def _is_of_others(rule: str, html: str) -> bool:
    return any(rule == known and html.startswith(begins) for known, begins in OF_OTHERS)


def _look(lab: LabPage, axe: str, theme: str) -> Any:
    lab.page.evaluate(THEME, theme)
    lab.settle()
    lab.page.evaluate(axe)  # a script tag would be refused
    return lab.page.evaluate(RUN, [OUTPUTS, RULES])

"""The keys, as somebody without a mouse uses them in JupyterLab."""

from lab import LabPage
from playwright.sync_api import Locator

MOST_PRESSES = 150
RUNS = """() => [...document.querySelectorAll(".jp-InputPrompt")]
  .some((prompt) => prompt.textContent.includes("*"))"""
ACTIVE = "() => jupyterapp.shell.currentWidget.content.activeCellIndex"
STAND = """(source) => {
  const { content } = jupyterapp.shell.currentWidget;
  content.activeCellIndex = content.widgets.findIndex(
    (cell) => cell.model.sharedModel.source.includes(source));
  content.activate();
}"""
HAS_FOCUS = "(element) => element.contains(document.activeElement)"


class Keyboard:
    """A keyboard, and nothing else."""

    def __init__(self, lab: LabPage) -> None:
        self.lab = lab
        self.press = lab.page.keyboard.press
        self.type = lab.page.keyboard.type

    def until(self, key: str, wanted: Locator, is_so: str = HAS_FOCUS) -> None:
        """Press a key until something has the focus, or is so otherwise."""
        if key.endswith("Tab"):
            wanted.first.wait_for()  # what is not drawn yet would be passed by
        for _ in range(MOST_PRESSES):
            if wanted.count() and wanted.first.evaluate(is_so):
                return
            before = self.lab.page.evaluate(ACTIVE)
            self.press(key)
            if key == "Shift+Enter":
                self.lab.page.wait_for_function(f"(before) => ({ACTIVE})() > before", arg=before)
                self.lab.page.wait_for_function(f"() => !({RUNS})()")
        raise AssertionError(f"{MOST_PRESSES} times {key} did not lead to {wanted}")

    def run_to(self, source: str) -> Locator:
        """Run one cell after the other, this one too, and stand on it."""
        cell = self.lab.notebook.locator(".jp-CodeCell", has_text=source)
        self.until("Shift+Enter", cell)
        self.press("Shift+Enter")
        self.lab.page.wait_for_function(f"() => !({RUNS})()")
        self.until("ArrowUp", cell)
        return cell

    def stand_on(self, source: str) -> None:
        """Stand on a cell, where many times ArrowDown would lead: each takes JupyterLab long."""
        self.lab.page.evaluate(STAND, source)

"""A walk through a notebook as a learner takes it, in any front end and browser.

It finds whatever can be moved by what it is, not by its name, and returns what was found wrong.
"""

from collections import Counter
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from windows import DESK, PHONE, Window, complaints

WALK = Path(__file__).with_name("walk.js").read_text("utf-8")
KEPT = "# kept by the walk"
PATIENCE_SECONDS = 180  # a machine may be busy with much else
IN_TIME = """given => Promise.race([
  (async () => { %s; return walk.%s(given); })(),
  new Promise((_, fail) => setTimeout(() => fail(new Error("%s takes too long")), %d)),
])"""
ARROWS = ("ArrowUp", "ArrowRight", "ArrowDown", "ArrowLeft")
OF_OTHERS = (
    "noUi-handle",  # of ipywidgets' slider, which only the setup check of 00 shows: has no name
    "Canceled future for",  # JupyterLab, of what it still asked a kernel that has ended
    "Could not restore the debugger state",  # likewise, where there is none, as on a hub of ours
)
OF_NOTEBOOK_7 = (  # 7.6.5 says it on its home page too, in an empty folder, in Chromium and Firefox
    "Cannot read properties of undefined (reading 'schema')",
    'can\'t access property "schema"',
)


@dataclass
class Walk:
    """Somebody at a notebook of the server at `address`; `moved` counts controls by their kind."""

    window: Window
    address: str
    path: str
    is_one_page: bool = False  # JupyterLab is loaded once, and opens one notebook after the other
    findings: list[str] = field(default_factory=list)
    moved: Counter[str] = field(default_factory=Counter)
    living: int = 0  # figures

    def call(self, step: str, given: Any = None) -> Any:
        """Call a function of walk.js in the page."""
        return self.window.evaluate(IN_TIME % (WALK, step, step, PATIENCE_SECONDS * 1000), given)

    def expect(self, is_so: bool, finding: str) -> None:
        """Keep a finding unless all is well."""
        if not is_so:
            self.findings.append(finding)

    def _note(self, what: str, texts: list[str]) -> None:
        others = OF_OTHERS if "/lab/" in self.address else OF_OTHERS + OF_NOTEBOOK_7
        ours = [text for text in texts if not any(known in text for known in others)]
        self.findings += [f"{what}: {text}" for text in ours]

    def open(self) -> None:
        """Load the page with the notebook, and wait for its kernel."""
        if self.is_one_page:
            self.call("openHere", self.path)
        else:
            self.window.goto(self.address)
        self.call("isReady", self.path)

    def take(self) -> list[str]:
        """Do all of it, and return what was found."""
        for step in (self.open, self.run, self.move, self.fit, self.keep):
            step()
        self.call("end")
        return self.findings

    def run(self) -> None:
        """Run all cells."""
        self.call("command", "notebook:run-all-cells")
        self.look("after the run")

    def look(self, when: str) -> None:
        """Find errors, in the outputs and on the console, and what was asked from elsewhere."""
        self._note(when, [*self.call("troubles"), *complaints(self.window, self.address)])
        self.window.errors.clear()
        self.window.asked.clear()

    def move(self) -> None:
        """Play every animation, and move whatever can be moved."""
        controls = self.call("controls")
        self.living = self.call("living")
        self._note("no name", self.call("nameless"))
        for control in sorted(controls, key=lambda control: control["kind"] != "clock"):
            number, kind = control["number"], control["kind"]
            what = f"{kind} {control['name']!r}"
            self.expect(self.call("focus", number), f"{what} takes no focus")
            self.expect(getattr(self, f"_{kind}")(number), f"{what} moves nothing")
            self.moved[kind] += 1
            if control["isFirst"]:
                self.expect(self._leaves(number), f"{what}: Tab does not lead out of its figure")
        self.look("after moving")

    def _press(self, *keys: str) -> None:
        for key in keys:
            self.window.press(key)

    def _clock(self, number: int) -> bool:
        """Play an animation and stop it, by its button; some play at first."""
        plays_at_first = self.call("word", number) == "Pause"
        if not plays_at_first:
            self._press("Space")
        has_played = self.call("says", [number, "Pause"]) and self.call("hasMoved", number)
        self._press("Space")
        return bool(
            has_played and self.call("says", [number, "Play"]) and self.call("stands", number)
        )

    def _slider(self, number: int) -> bool:
        self._press("ArrowLeft" if self.call("isAtEnd", number) else "ArrowRight")
        return bool(self.call("hasMoved", number))

    def _choice(self, number: int) -> bool:
        self._press("ArrowUp" if self.call("isAtEnd", number) else "ArrowDown")
        return bool(self.call("hasMoved", number))

    def _field(self, number: int) -> bool:
        self._press(*self.call("another", number), "Enter")
        return bool(self.call("hasMoved", number))

    def _pad(self, number: int) -> bool:
        self._press(*ARROWS[:2])
        return bool(self.call("hasMoved", number))

    def _option(self, number: int) -> bool:
        self._press("Space")
        return bool(self.call("hasMoved", number))

    def _leaves(self, number: int) -> bool:
        for _ in range(self.call("stops", number) + 1):
            self._press("Tab")
            if not self.call("isInside", number):
                return True
        return False

    def keep(self) -> None:
        """Write into a cell, save, load the page anew: what was written and drawn is there."""
        figures = self.call("figures")
        self.expect(self.call("edit"), "no cursor in a cell")
        self._press(*KEPT, "Enter")
        self.call("command", "docmanager:save")
        self.open()
        self.expect(any(KEPT in source for source in self.call("sources")), "nothing was saved")
        self.expect(self.call("areThere", figures), f"not {figures} figures after opening anew")
        self.look("opened anew")

    def fit(self) -> None:
        """Find what a small laptop and a telephone cut off."""
        for size in (DESK, PHONE):
            self.window.resize(*size)
            self.call("clear")
            self._note(f"cut at {size[0]} px", self.call("cut"))
        self.window.resize(*DESK)
        self.look("after the telephone")

"""The player's clock, in a real Firefox and in a Chromium that is as strict.

Firefox gives a drawing its clock when it comes into a page, and passes over what was set before.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from typing import Any

import pytest
from firefox import running_firefox
from lab import require_chromium, running_browser
from machines import RULE
from moving_drawing import PLACES, assert_at
from test_animation import AFTER, BEFORE

from cammotion.views.animation.picture import animate

PLAYER = animate({"no overlap": BEFORE, "overlap": AFTER}, rules=RULE).player()
TRAITS = ("svg", "turn_s", "cycle_s", "speeds", "speed")
ROUNDS = 20
WHILE_MS = 40  # a clock that runs on turns 1.6 deg
LABEL_DEG = 0.55  # the label is rounded to 1 deg, Firefox's clock to 1 ms
PAGE = """<!DOCTYPE html>
<meta charset="utf-8">
<title>player</title>
<div id="one"></div>
<div id="two"></div>"""

STRICT = """() => {
  for (const name of ["pauseAnimations", "setCurrentTime"]) {
    const real = SVGSVGElement.prototype[name];
    SVGSVGElement.prototype[name] = function (...given) {
      if (this.isConnected) real.apply(this, given);
    };
  }
}"""
RENDER = """async ({script, state, wantsCalm}) => {
  window.matchMedia = () => ({matches: wantsCalm});
  const url = URL.createObjectURL(new Blob([script], {type: "text/javascript"}));
  const {default: player} = await import(url);
  const heard = new Set();
  const model = {
    get: name => state[name],
    set: (name, value) => { state[name] = value; },
    save_changes: () => {},
    on: (name, callback) => heard.add(callback),
    off: (name, callback) => heard.delete(callback),
  };
  const el = document.createElement("div");
  window.view = {el, state, heard, end: player.render({model, el})};
}"""
ATTACH = """async ({place, lateMs}) => {
  await new Promise(resolve => setTimeout(resolve, lateMs));
  document.getElementById(place).append(view.el);
}"""
SET_ANGLE = """degrees => {
  view.state.angle_deg = degrees;
  view.heard.forEach(callback => callback());
}"""
LOOK = f"""() => {{
  const drawing = view.el.querySelector("svg");
  return {{
    button: view.el.querySelector("button").textContent,
    label: Number(view.el.querySelector(".cm-angle").textContent.match(/\\d+/)[0]),
    clock: drawing.getCurrentTime() / view.state.turn_s * 360,
    places: ({PLACES})(drawing),
  }};
}}"""
PLAY_ON = """async () => {
  for (let frame = 0; frame < 4; frame += 1) await new Promise(requestAnimationFrame);
}"""
FRAMES = """async () => {
  const real = window.requestAnimationFrame;
  let asked = 0;
  window.requestAnimationFrame = callback => { asked += 1; return real(callback); };
  await new Promise(resolve => setTimeout(resolve, 200));
  window.requestAnimationFrame = real;
  return asked;
}"""


@dataclass
class Stage:
    """A page in some browser, with a view of the player in it or on its way there."""

    evaluate: Callable[..., Any]
    press: Callable[[str], None]
    at_zero: list[dict[str, float]] = field(default_factory=list)  # where the parts are at 0 deg

    def render(self, *, angle_deg: float = 0, wants_calm: bool = False) -> None:
        """Make a view as a notebook does: outside the page."""
        state = {**PLAYER.get_state(TRAITS), "angle_deg": angle_deg}
        self.evaluate(RENDER, {"script": PLAYER._esm, "state": state, "wantsCalm": wants_calm})

    def attach(self, place: str = "one", late_ms: int = 0) -> None:
        """Put the view into the page, or move it there."""
        self.evaluate(ATTACH, {"place": place, "lateMs": late_ms})

    def end(self) -> None:
        """Take the view away as a notebook does, if there is one."""
        self.evaluate("() => { window.view?.end(); window.view?.el.remove(); }")

    def use(self, part: str, key: str) -> None:
        """Press a key on one of the controls."""
        self.evaluate("part => view.el.querySelector(part).focus()", part)
        self.press(key)

    def standing_at(self) -> float:
        """Return the cam angle where label, clock and drawing are, and stay."""
        look = self.evaluate(LOOK)
        self.evaluate("ms => new Promise(resolve => setTimeout(resolve, ms))", WHILE_MS)
        assert self.evaluate(LOOK) == look
        assert look["button"] == "Play"
        assert look["clock"] == pytest.approx(look["label"], abs=LABEL_DEG)
        assert_at(look["clock"], look["places"], self.at_zero)
        return float(look["clock"])


@pytest.fixture(scope="module", params=["firefox", "strict chromium"])
def open_stage(
    request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory
) -> Iterator[Stage]:
    """Open a page in each browser."""
    folder = tmp_path_factory.mktemp("player")
    file = folder / "page.html"
    file.write_text(PAGE, "utf-8")
    if request.param == "firefox":
        with running_firefox(folder) as firefox:
            firefox.goto(file.as_uri())
            yield prepared(Stage(firefox.evaluate, firefox.press))
    else:
        require_chromium()
        with running_browser() as chromium:
            page = chromium.new_page()
            page.goto(file.as_uri())
            page.evaluate(STRICT)
            yield prepared(Stage(page.evaluate, page.keyboard.press))


def prepared(stage: Stage) -> Stage:
    """See where the parts are at 0 deg."""
    stage.render(wants_calm=True)
    stage.attach()
    stage.evaluate("() => view.el.querySelector('svg').pauseAnimations()")
    stage.evaluate("() => view.el.querySelector('svg').setCurrentTime(0)")
    stage.at_zero += stage.evaluate(LOOK)["places"]
    stage.end()
    return stage


@pytest.fixture
def stage(open_stage: Stage) -> Iterator[Stage]:
    """Give the page, in which no view is left afterwards."""
    yield open_stage
    open_stage.end()


def test_pause_and_scrub_stop_the_drawing_at_the_label(stage: Stage) -> None:
    for number in range(ROUNDS):
        stage.render()
        stage.attach(late_ms=number % 4 * 20)
        stage.evaluate(PLAY_ON)
        stage.use("button", "Space")
        paused = stage.standing_at()
        assert paused > 0
        stage.use("button", "Space")
        stage.use("input", "PageUp")
        assert stage.standing_at() > paused + 35
        stage.end()


def test_a_view_that_is_not_to_play_stands_wherever_it_comes_into_a_page(stage: Stage) -> None:
    stage.render(angle_deg=137, wants_calm=True)
    stage.attach(late_ms=200)
    assert stage.standing_at() == pytest.approx(137, abs=0.1)
    stage.attach("two")
    assert stage.standing_at() == pytest.approx(137, abs=0.1)
    stage.evaluate("() => view.el.remove()")
    stage.evaluate(SET_ANGLE, 255)
    stage.attach()
    assert stage.standing_at() == pytest.approx(255, abs=0.1)


def test_the_seam_of_a_label_lies_under_its_letters(stage: Stage) -> None:
    """Drawn over them it leaves white blobs."""
    stage.render()
    stage.attach()
    order = "() => getComputedStyle(view.el.querySelector('svg text')).paintOrder"
    assert stage.evaluate(order).startswith("stroke")


def test_of_a_view_that_ended_nothing_runs(stage: Stage) -> None:
    stage.render()
    stage.attach()
    assert stage.evaluate(FRAMES) > 0
    stage.end()
    assert stage.evaluate(FRAMES) == 0
    assert stage.evaluate("() => view.heard.size") == 0

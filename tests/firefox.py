"""A real Firefox, by WebDriver BiDi: the commands of a W3C standard, as JSON over a websocket.

Playwright drives no Firefox but one that it built itself. What a test needs is called as there.
"""

import json
import subprocess
from collections.abc import Iterator
from contextlib import closing, contextmanager
from pathlib import Path
from typing import Any

import websocket
from lab import PATIENCE_SECONDS, require_browser, wait_for_address

FIREFOX = ("firefox-esr", "firefox")
READY = r"WebDriver BiDi listening on (ws://\S+)"
KEYS = {  # as WebDriver writes them
    "Enter": "\ue006",
    "Space": " ",
    "PageUp": "\ue00e",
    "PageDown": "\ue00f",
    "End": "\ue010",
    "Home": "\ue011",
    "ArrowLeft": "\ue012",
    "ArrowUp": "\ue013",
    "ArrowRight": "\ue014",
    "ArrowDown": "\ue015",
    "Tab": "\ue004",
    "Escape": "\ue00c",
    "Shift": "\ue008",
    "Control": "\ue009",
}
EVENTS = ("log.entryAdded", "network.beforeRequestSent")


@contextmanager
def running_firefox(home: Path) -> Iterator["FirefoxPage"]:
    """Start Firefox with a profile of its own in the folder `home`, and give its one page."""
    command = [require_browser(FIREFOX), "--headless", "--no-remote", "--remote-debugging-port=0"]
    log = home / "firefox.log"
    with log.open("w") as output:
        firefox = subprocess.Popen(
            [*command, "--profile", str(home), "about:blank"],
            stdin=subprocess.DEVNULL,
            stdout=output,
            stderr=subprocess.STDOUT,
        )
    try:
        address = wait_for_address(firefox, log, READY)
        socket = websocket.create_connection(
            f"{address}/session", timeout=PATIENCE_SECONDS, suppress_origin=True
        )
        with closing(socket):
            yield FirefoxPage(socket)
    finally:
        firefox.terminate()
        firefox.wait(PATIENCE_SECONDS)


class FirefoxPage:
    """A page in a tab of its own; in the first one the address bar keeps the focus."""

    def __init__(self, socket: websocket.WebSocket) -> None:
        self._socket = socket
        self._sent = 0
        self.errors: list[str] = []
        self.asked: list[str] = []
        self._command("session.new", capabilities={})
        self._page = self._command("browsingContext.create", type="tab")["context"]
        self._command("session.subscribe", events=EVENTS, contexts=[self._page])

    def _command(self, method: str, **params: Any) -> Any:
        """Return the answer to a command; note what Firefox tells before that."""
        self._sent += 1
        self._socket.send(json.dumps({"id": self._sent, "method": method, "params": params}))
        answer: dict[str, Any] = {}
        while answer.get("id") != self._sent:
            answer = json.loads(self._socket.recv())
            if answer["type"] == "event":
                self._note(answer["method"], answer["params"])
        if answer["type"] == "error":
            raise RuntimeError(f"{method}: {answer['error']}: {answer['message']}")
        return answer["result"]

    def _note(self, event: str, told: dict[str, Any]) -> None:
        if event == "network.beforeRequestSent":
            self.asked.append(told["request"]["url"])
        elif told["level"] == "error":
            self.errors.append(str(told["text"]))

    def goto(self, url: str) -> None:
        """Open an address and wait until all of it is loaded."""
        self._command("browsingContext.navigate", context=self._page, url=url, wait="complete")

    def evaluate(self, function: str, given: Any = None) -> Any:
        """Call a JavaScript function in the page; what it takes and returns has to be JSON."""
        call = f"async () => JSON.stringify(await ({function})({json.dumps(given)}) ?? null)"
        said = self._command(
            "script.callFunction",
            functionDeclaration=call,
            target={"context": self._page},
            awaitPromise=True,
        )
        if said["type"] == "exception":
            raise RuntimeError(said["exceptionDetails"]["text"])
        return json.loads(said["result"]["value"])

    def press(self, key: str) -> None:
        """Press a key where the focus is, with others held down as in "Shift+Enter"."""
        codes = [KEYS.get(name, name) for name in key.split("+")] if key != "+" else [key]
        actions = [{"type": "keyDown", "value": code} for code in codes]
        actions += [{"type": "keyUp", "value": code} for code in reversed(codes)]
        keyboard = {"type": "key", "id": "keyboard", "actions": actions}
        self._command("input.performActions", context=self._page, actions=[keyboard])

    def resize(self, width: int, height: int) -> None:
        """Give the page another size, in px."""
        size = {"width": width, "height": height}
        self._command("browsingContext.setViewport", context=self._page, viewport=size)

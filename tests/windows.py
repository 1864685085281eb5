"""A page in some browser, as a test uses it: what it does there, and what goes wrong."""

from typing import Any, Protocol
from urllib.parse import urlsplit

from playwright.sync_api import Browser

DESK, PHONE = (1366, 768), (390, 844)
NO_REQUEST = ("data:", "blob:", "about:", "chrome:", "resource:", "moz-extension:")


class Window(Protocol):
    """A page; `errors` are what it says on its console, `asked` the addresses it asks for."""

    errors: list[str]
    asked: list[str]

    def goto(self, url: str) -> object:
        """Open an address and wait until the page is loaded."""

    def evaluate(self, function: str, given: Any = None) -> Any:
        """Call a JavaScript function in the page; what it takes and returns has to be JSON."""

    def press(self, key: str) -> object:
        """Press a key where the focus is, with others held down as in "Shift+Enter"."""

    def resize(self, width: int, height: int) -> object:
        """Give the page another size, in px."""


class ChromiumWindow:
    """A page of its own in a Chromium that Playwright drives."""

    def __init__(self, browser: Browser, **options: Any) -> None:
        width, height = DESK
        options = {"viewport": {"width": width, "height": height}} | options
        self.page = browser.new_context(**options).new_page()
        self.errors: list[str] = []
        self.asked: list[str] = []
        self.page.on(
            "console", lambda said: self.errors.append(said.text) if said.type == "error" else None
        )
        self.page.on("pageerror", lambda error: self.errors.append(str(error)))
        self.page.on("request", lambda request: self.asked.append(request.url))

    def goto(self, url: str) -> None:
        """Open an address and wait until the page is there."""
        self.page.goto(url, wait_until="domcontentloaded")

    def evaluate(self, function: str, given: Any = None) -> Any:
        """Call a JavaScript function in the page; what it takes and returns has to be JSON."""
        return self.page.evaluate(function, given)

    def press(self, key: str) -> None:
        """Press a key where the focus is, with others held down as in "Shift+Enter"."""
        self.page.keyboard.press(key)

    def resize(self, width: int, height: int) -> None:
        """Give the page another size, in px."""
        self.page.set_viewport_size({"width": width, "height": height})


def complaints(window: Window, address: str) -> list[str]:
    """Return what went wrong in a page of the server at `address`, or was asked from elsewhere."""
    own = urlsplit(address)
    here = (f"{own.scheme}://{own.netloc}/", f"ws://{own.netloc}/", *NO_REQUEST)
    return [*window.errors, *(url for url in window.asked if not url.startswith(here))]

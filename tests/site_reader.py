"""Somebody who reads the site in a real Chromium, opened from the disk."""

from dataclasses import dataclass, field

from playwright.sync_api import Browser, Page
from site_pages import written

PHONE, DESK = (390, 844), (1366, 768)
LIVES = """async () => {
  const wait = () => new Promise((resolve) => setTimeout(resolve, 25));
  for (const place of document.querySelectorAll("[data-module]")) {
    place.scrollIntoView(); // what is lazy is loaded
    for (let i = 0; i < 2400 && !("lives" in place.dataset); i++) await wait(); // a minute
  }
  return [...document.querySelectorAll("[data-module]:not([data-lives])")].length;
}"""
TOO_WIDE = """() => document.documentElement.scrollWidth > innerWidth
  && [...document.querySelectorAll("body *")].filter((each) =>
    each.getBoundingClientRect().right > innerWidth + 1
    && !each.closest(".table, .formula, pre, .living, .skip, math, svg"))
    .map((each) => each.outerHTML.slice(0, 120)).concat("the page itself")"""
LOADED = """async () => {
  for (const image of document.images) {
    image.loading = "eager";
    await image.decode();
  }
}"""


@dataclass
class Reader:
    """Somebody with one page of the site; what goes wrong there is collected."""

    page: Page
    complaints: list[str] = field(default_factory=list)

    def note(self, text: str, matters: bool = True) -> None:
        """Keep what went wrong."""
        if matters:
            self.complaints.append(text)

    def open(self, name: str) -> Page:
        """Open a page from the disk."""
        self.complaints.clear()
        self.page.goto((written() / f"{name}.html").as_uri())
        return self.page


def reader_in(browser: Browser, size: tuple[int, int], scheme: str, motion: str) -> Reader:
    context = browser.new_context(
        viewport={"width": size[0], "height": size[1]},
        color_scheme="dark" if scheme == "dark" else "light",
        reduced_motion="reduce" if motion == "reduce" else "no-preference",
    )
    reader = Reader(context.new_page())
    own = (written().as_uri(), "data:", "blob:")
    reader.page.on("console", lambda said: reader.note(said.text, said.type == "error"))
    reader.page.on("pageerror", lambda error: reader.note(str(error)))
    reader.page.on("request", lambda asked: reader.note(asked.url, not asked.url.startswith(own)))
    return reader

"""What the pages of `workbook.py site` weigh, how soon one is seen, and what axe-core finds."""

import gzip
import statistics
import sys
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from functools import partial
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from typing import Any

from accessibility import RULES, fetch_axe
from findings import Finding, say
from live import ROOT
from playwright.sync_api import Browser, Page

sys.path.append(str(ROOT / "tests"))

from lab import running_browser
from site_pages import NOTEBOOKS, PAGES, files, written
from site_reader import LIVES
from test_site import weight

from cammotion.site.build import build

MOST_SECONDS, MOST_BYTES, MOST_IN_ALL, MOST_FIRST_S = 90, 500_000, 5_000_000, 1
PACKED = {".html", ".css", ".js", ".svg"}
BITS_PER_BYTE, MBIT = 8, 1e6
SLOW = {  # what browsers' own tools call a slow 4G, and earlier a fast 3G
    "offline": False,
    "latency": 150,
    "downloadThroughput": 1.6 * MBIT / BITS_PER_BYTE,
    "uploadThroughput": 0.75 * MBIT / BITS_PER_BYTE,
}
FIRST_PICTURE = """async () => {
  const [image] = document.images;
  await image.decode();
  const [entry] = performance.getEntriesByName(image.currentSrc);
  const [{ startTime }] = performance.getEntriesByType("paint").slice(-1);
  return Math.max(entry.responseEnd, startTime) / 1000;
}"""
FINDINGS = """async (rules) => {
  const found = await axe.run({ runOnly: rules });
  return found.violations.flatMap(({ id, nodes }) => nodes.map(({ html }) => [id, html]));
}"""
SIGHTS = [("light", 1366), ("dark", 1366), ("light", 390)]


def measure_site() -> list[Finding]:
    """Build the site, weigh it, and see its first pictures on a slow connection."""
    started = time.monotonic()
    build(NOTEBOOKS)
    built = time.monotonic() - started
    heaviest = max(map(weight, PAGES))
    packed, plain = (first_pictures(is_packed=is_packed) for is_packed in (True, False))
    return [
        Finding("site: built", built, MOST_SECONDS, "s"),
        Finding("site: heaviest page, alone", heaviest / 1e3, MOST_BYTES / 1e3, "kB"),
        Finding("site: all files", sum(map(len, files().values())) / 1e6, MOST_IN_ALL / 1e6, "MB"),
        Finding("site: first picture, slow 4G, latest page", max(packed), MOST_FIRST_S, "s"),
        Finding("site: the same, not packed, median", statistics.median(plain), MOST_FIRST_S, "s"),
    ]


def measure_site_accessibility() -> list[Finding]:
    """Count what axe-core finds in the pages, light, dark and narrow (asks npm for it)."""
    axe = fetch_axe()
    with running_browser() as browser:
        return [
            Finding(f"axe-core, page {name[:5]}", len(findings(browser, name, axe)), 0, "")
            for name in PAGES
        ]


def findings(browser: Browser, name: str, axe: str) -> list[list[str]]:
    """Return what axe-core finds in a page of which every figure lives."""
    found: list[list[str]] = []
    for scheme, width in SIGHTS:
        page = opened(browser, scheme, width)
        page.goto((written() / f"{name}.html").as_uri())
        page.evaluate(LIVES)
        page.evaluate("() => document.querySelectorAll('details').forEach((d) => (d.open = true))")
        page.evaluate(axe)
        found += page.evaluate(FINDINGS, RULES)
        page.context.close()
    for rule, html in found:
        say(f"{name[:5]}: {rule}: {html[:150]}")
    return found


def first_pictures(*, is_packed: bool) -> list[float]:
    """Return when each page's first picture is seen, from a host that packs files or does not."""
    with running_browser() as browser, served(is_packed=is_packed) as address:
        seen = [first_picture(browser, f"{address}/{name}.html") for name in PAGES]
    for name, seconds in zip(PAGES, seen, strict=True):
        say(f"{name}: first picture after {seconds:.2f} s{' (packed)' * is_packed}")
    return seen


def opened(browser: Browser, scheme: Any, width: int) -> Page:
    """Return a new page of that width."""
    return browser.new_context(
        viewport={"width": width, "height": 844}, color_scheme=scheme
    ).new_page()


def first_picture(browser: Browser, address: str) -> float:
    """Return after how many seconds the first picture of a page is seen on a slow connection."""
    page = browser.new_context(viewport={"width": 390, "height": 844}).new_page()
    page.context.new_cdp_session(page).send("Network.emulateNetworkConditions", SLOW)
    page.goto(address)
    seconds = float(page.evaluate(FIRST_PICTURE))
    page.context.close()
    return seconds


class Quiet(SimpleHTTPRequestHandler):
    """Serves files, and says nothing."""

    def log_message(self, *_: Any) -> None:
        """Say nothing."""


class Packing(Quiet):
    """Serves texts packed, as browsers ask for them."""

    def do_GET(self) -> None:
        """Send a file."""
        file = Path(self.translate_path(self.path))
        if file.suffix not in PACKED:
            super().do_GET()
            return
        content = gzip.compress(file.read_bytes())
        self.send_response(200)
        self.send_header("Content-Type", self.guess_type(str(file)))
        self.send_header("Content-Encoding", "gzip")
        self.send_header("Content-Length", str(len(content)))
        self.end_headers()
        self.wfile.write(content)


@contextmanager
def served(*, is_packed: bool) -> Iterator[str]:
    """Serve the site on loopback, texts packed as most hosts of files send them, or not."""
    kind = Packing if is_packed else Quiet
    server = ThreadingHTTPServer(("127.0.0.1", 0), partial(kind, directory=str(written())))
    thread = threading.Thread(target=server.serve_forever, daemon=True)
    thread.start()
    try:
        yield f"http://127.0.0.1:{server.server_port}"
    finally:
        server.shutdown()
        server.server_close()

"""A Chromium for the tests of a file: `pytest_plugins = ["chromium"]` gives them `browser`."""

from collections.abc import Iterator

import pytest
from lab import require_chromium, running_browser
from playwright.sync_api import Browser


@pytest.fixture(scope="module")
def browser() -> Iterator[Browser]:
    """Run a Chromium for a file of tests; skip them where there is none."""
    require_chromium()
    with running_browser() as running:
        yield running

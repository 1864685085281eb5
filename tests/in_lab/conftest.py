"""The JupyterLab of this folder: it is started once, as README says, and one process has it."""

from collections.abc import Iterator

import pytest
from lab import LabPage, opened_notebook, require_chromium, running_browser

WORK = "work-lab-test"


@pytest.fixture(scope="package")
def jupyter(tmp_path_factory: pytest.TempPathFactory) -> Iterator[LabPage]:
    """Give its page, at 00 at first; a file of tests opens its notebook by `open`."""
    require_chromium()
    home = tmp_path_factory.mktemp("jupyter")
    with running_browser() as browser, opened_notebook(browser, home, WORK) as lab:
        yield lab

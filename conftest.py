"""What pytest collects, and what nbval compares."""

import gc
import os
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

import nbval.kernel  # type: ignore[import-untyped]
import pytest
from nbval.plugin import IPyNbCell, IPyNbFile  # type: ignore[import-untyped]

from starter.refresh import keep_as_png

if TYPE_CHECKING:
    from playwright.sync_api import Browser
    from xdist.scheduler import LoadScopeScheduling

collect_ignore = ["tests/data"]
# These take longest. They begin first, a browser beside what reckons, and all end together.
LONG = (
    *("in_lab", "test_live_formulas", "test_browser_site", "test_exercises_shown"),
    *("test_hub", "test_least_peak", "test_nbgrader", "test_any_input"),
    *("test_least_torque", "06_how_good_can_it_get", "test_responses"),
    *("test_browser_animation", "test_exercises_answers", "test_browser_live", "test_again"),
    *("test_colab", "test_fresh", "test_browser_player", "test_binder", "test_report"),
)
TOGETHER = ("tests/in_lab/", "notebooks/solutions/")  # they share what takes long to start
# A kernel begins anew: nothing is named, no picture is open, and of our package nothing is loaded.
BEGIN_ANEW = """\
import sys
from matplotlib import pyplot
pyplot.close("all")
for name in [name for name in sys.modules if name.partition(".")[0] == "cammotion"]:
    del sys.modules[name]
%reset -f
"""
# What a test answers is nobody's progress; in a folder of copies it is kept all the same.
os.environ["CAMMOTION_PROGRESS"] = "off"


def pytest_configure() -> None:
    """Let nbval start a kernel once more that died at once.

    Its ports are chosen before it opens them, and meanwhile a browser may have taken one.
    """
    start = nbval.kernel.start_new_kernel

    def start_or_start_again(*given: Any, **named: Any) -> Any:
        try:
            return start(*given, **named)
        except RuntimeError:
            return start(*given, **named)

    nbval.kernel.start_new_kernel = start_or_start_again


def pytest_collectstart(collector: pytest.Collector) -> None:
    """Leave out LaTeX: SymPy's wording changes, and the plain text beside it is compared."""
    if isinstance(collector, IPyNbFile):
        collector.skip_compare += ("text/latex",)
        if collector.path.parent.name == "solutions":
            SolutionsKernel.lend_to(collector)


class SolutionsKernel:
    """The one kernel of all solutions, each of which computes for less time than one starts."""

    kernel: Any = None

    @classmethod
    def lend_to(cls, notebook: Any) -> None:
        """Let a notebook use the kernel that there is, as one that has just been started."""
        start = notebook.setup

        def setup() -> None:
            if cls.kernel is None or not cls.kernel.is_alive():
                start()
                cls.kernel = notebook.kernel
                return
            notebook.kernel = cls.kernel
            notebook.setup_sanitize_files()
            cls.kernel.await_reply(cls.kernel.execute_cell_input(BEGIN_ANEW), timeout=60)

        notebook.setup, notebook.teardown = setup, lambda: None

    @classmethod
    def stop(cls) -> None:
        """Stop it, if it has been started."""
        if cls.kernel is not None and cls.kernel.is_alive():
            cls.kernel.stop()


def pytest_sessionfinish() -> None:
    """Stop the kernel that no notebook has stopped."""
    SolutionsKernel.stop()


def pytest_itemcollected(item: pytest.Item) -> None:
    """Let a picture be compared as it is stored."""
    if isinstance(item, IPyNbCell):
        compare = item.compare_outputs

        def compare_stored(outputs: list[Any], *rest: Any, **named: Any) -> Any:
            for output in outputs:
                keep_as_png(output)
            return compare(outputs, *rest, **named)

        item.compare_outputs = compare_stored


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Put first what takes longest, a folder or a file."""
    places = {name: place for place, name in enumerate(LONG)}

    def place(path: Path) -> int:
        return min(places.get(name, len(LONG)) for name in (path.parent.name, path.stem))

    items.sort(key=lambda item: place(item.path))


@pytest.hookimpl(optionalhook=True)
def pytest_xdist_make_scheduler(config: pytest.Config, log: Any) -> "LoadScopeScheduling | None":
    """Give each file of tests to one process, and the files of some folders to the same one."""
    from xdist.scheduler import LoadFileScheduling

    class LoadFolderScheduling(LoadFileScheduling):  # type: ignore[misc]
        def _split_scope(self, nodeid: str) -> str:
            return next(filter(nodeid.startswith, TOGETHER), super()._split_scope(nodeid))

    return LoadFolderScheduling(config, log) if config.getoption("dist") == "loadfile" else None


def pytest_collection_finish() -> None:
    """Leave thousands of tests, and all that is loaded, out of the searches for garbage."""
    gc.freeze()
    gc.set_threshold(50_000)


@pytest.fixture(scope="session", autouse=True)
def folder_of_the_run(
    request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory
) -> None:
    """Name the folder in which all processes of this run find what one of them has made."""
    own = tmp_path_factory.getbasetemp()
    is_one_of_many = hasattr(request.config, "workerinput")
    os.environ["WORKBOOK_TESTS_FOLDER"] = str(own.parent if is_one_of_many else own)


@pytest.fixture(scope="module")  # one that stays open lets no other test run a loop of events
def browser() -> "Iterator[Browser]":
    """Run a Chromium for a file of tests; skip them where there is none."""
    from lab import require_chromium, running_browser

    require_chromium()
    with running_browser() as running:
        yield running


def pytest_runtest_setup() -> None:
    """Let a test begin as a kernel does: no name given, no hint shown, whatever ran before."""
    if "cammotion.teaching.session" in sys.modules:
        from desk import restart

        restart()


def pytest_runtest_teardown() -> None:
    """Close the pictures of each test: Matplotlib warns of more than twenty, whoever drew them."""
    if pyplot := sys.modules.get("matplotlib.pyplot"):
        pyplot.close("all")


# in quotes: pytest 8 does not show this name
def pytest_terminal_summary(terminalreporter: "pytest.TerminalReporter") -> None:
    """Say at the end what tests have measured, by `record_property("measured", ...)`."""
    for report in terminalreporter.getreports("passed"):
        for name, value in report.user_properties:
            if name == "measured":
                terminalreporter.write_line(str(value))

"""A plugin of pytest for `covering.py`: it tells tests apart, and runs those that are chosen."""

import json
import time
from collections.abc import Generator
from pathlib import Path

import pytest

_seconds = pytest.StashKey[dict[str, float]]()
_running = pytest.StashKey[str]()


def pytest_addoption(parser: pytest.Parser) -> None:
    """Take the names of two files."""
    parser.addoption("--times", type=Path, help="write there how long each test took, in s")
    parser.addoption("--chosen", type=Path, help="run the tests that stand there, in that order")


def pytest_configure(config: pytest.Config) -> None:
    """Begin with no test."""
    config.stash[_seconds] = {}


@pytest.hookimpl(trylast=True)  # after conftest.py has put its own order
def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Leave the chosen tests, in their order; of a file in which none is found, all."""
    if not (chosen := config.option.chosen):
        return
    places = {name: place for place, name in enumerate(json.loads(chosen.read_text("utf-8")))}
    known = {item.path for item in items if item.nodeid in places}
    kept = [item for item in items if item.nodeid in places or item.path not in known]
    config.hook.pytest_deselected(items=[item for item in items if item not in {*kept}])
    items[:] = sorted(kept, key=lambda item: places.get(item.nodeid, len(places)))


@pytest.hookimpl(wrapper=True)
def pytest_runtest_protocol(item: pytest.Item) -> Generator[None, bool, bool]:
    """Let coverage put down what it sees under the name of the test."""
    item.config.stash[_running] = item.nodeid
    began = time.monotonic()
    _put_down_under(item.nodeid)
    try:
        return (yield)
    finally:
        _put_down_under("")
        item.config.stash[_seconds][item.nodeid] = time.monotonic() - began


@pytest.hookimpl(wrapper=True)
def pytest_fixture_setup(
    fixturedef: pytest.FixtureDef[object], request: pytest.FixtureRequest
) -> Generator[None, object, object]:
    """Put what tests share down under the name of their file."""
    if fixturedef.scope == "function":
        return (yield)
    test = request.config.stash[_running]
    _put_down_under(test.partition("::")[0])
    try:
        return (yield)
    finally:
        _put_down_under(test)


def pytest_sessionfinish(session: pytest.Session) -> None:
    """Write down how long each test took."""
    if times := session.config.option.times:
        times.write_text(json.dumps(session.config.stash[_seconds]), "utf-8")


def _put_down_under(name: str) -> None:
    from coverage import Coverage

    if watching := Coverage.current():
        watching.switch_context(name)

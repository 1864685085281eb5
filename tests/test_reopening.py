"""What the server hands to a page of a notebook whose kernel is gone, or runs, or was saved."""

import asyncio
import copy
import logging
from types import SimpleNamespace
from typing import Any

import pytest

from cammotion.teaching.reopening import INSTEAD, WIDGET_STATE, WIDGET_VIEW, show_pictures

VIEW = {WIDGET_VIEW: {"model_id": "7f3a", "version_major": 2}}
OUTPUTS = [
    {"output_type": "display_data", "data": VIEW | {"image/png": "iVBO", "text/plain": "a curve"}},
    {"output_type": "execute_result", "data": dict(VIEW)},
    {"output_type": "stream", "name": "stdout", "text": "printed"},
]
CONTENT = {"metadata": {}, "cells": [{"cell_type": "code", "outputs": OUTPUTS}, {"source": "text"}]}


def read(
    path: str = "a folder/lesson.ipynb", content: Any = CONTENT, kind: str = "notebook", **has: Any
) -> Any:
    """Read a file by a server with a session for `/a folder/running.ipynb`."""

    async def get(_path: str, **_options: Any) -> dict[str, Any]:
        return {"type": kind, "content": copy.deepcopy(content)}

    async def list_sessions() -> list[dict[str, str]]:
        return [{"path": "a folder/running.ipynb"}]

    sessions = has.get("session_manager", SimpleNamespace(list_sessions=list_sessions))
    server = SimpleNamespace(
        contents_manager=SimpleNamespace(get=get),
        session_manager=sessions,
        log=logging.getLogger("reopening"),
    )
    show_pictures(server)
    return asyncio.run(server.contents_manager.get(path, content=True))["content"]


def data_of(content: Any) -> list[dict[str, Any]]:
    return [output.get("data", {}) for output in content["cells"][0]["outputs"]]


def test_a_dead_widget_gives_way_to_its_picture_and_text() -> None:
    shown, bare, printed = data_of(read())
    assert shown == {"image/png": "iVBO", "text/plain": "a curve"}
    assert bare == {"text/plain": INSTEAD}
    assert printed == {}


def test_of_a_running_notebook_all_stays() -> None:
    """A page that is loaded again finds its widgets alive."""
    assert read("/a folder/running.ipynb") == CONTENT


def test_a_widget_whose_state_was_saved_stays() -> None:
    state: dict[str, Any] = {WIDGET_STATE: {"state": {"7f3a": {}}}}
    saved = CONTENT | {"metadata": {"widgets": state}}
    assert read(content=saved) == saved


@pytest.mark.parametrize(("kind", "content"), [("file", "text"), ("notebook", None)])
def test_what_is_no_notebook_is_left_alone(kind: str, content: Any) -> None:
    assert read(kind=kind, content=content) == content


def test_a_file_is_read_whatever_goes_wrong_with_its_pictures(
    caplog: pytest.LogCaptureFixture,
) -> None:
    assert read(session_manager=None) == CONTENT
    assert "are not left out" in caplog.text

"""A notebook that is opened again without its kernel shows pictures in place of dead widgets.

An output of ours holds a widget's id beside its picture and text. JupyterLab shows the widget,
and where its kernel is gone only the words "model not found". So the id is left out of what the
server hands to a page, unless the notebook's kernel runs or the widget's state was saved with it.
"""

from typing import Any

from jupyter_core.utils import ensure_async

WIDGET_VIEW = "application/vnd.jupyter.widget-view+json"
WIDGET_STATE = "application/vnd.jupyter.widget-state+json"
INSTEAD = "An interactive widget: run the cell to see it."


def show_pictures(server: Any) -> None:
    """Let a server that reads its files asynchronously, as by default, leave dead widgets out."""
    manager, read = server.contents_manager, server.contents_manager.get
    sessions = server.session_manager

    async def get(path: str, *args: Any, **kwargs: Any) -> dict[str, Any]:
        model: dict[str, Any] = await ensure_async(read(path, *args, **kwargs))
        try:
            if model["type"] == "notebook" and model["content"] and not await runs(path):
                leave_out_dead_widgets(model["content"])
        except Exception as error:  # what was read is worth more than its pictures
            server.log.warning("Dead widgets of %s are not left out (%r).", path, error)
        return model

    async def runs(path: str) -> bool:
        running = await ensure_async(sessions.list_sessions())
        return path.strip("/") in {session["path"].strip("/") for session in running}

    manager.get = get


def leave_out_dead_widgets(content: dict[str, Any]) -> None:
    """Remove widgets without a saved state from a notebook's outputs; what else is there stays.

    >>> data = {WIDGET_VIEW: {"model_id": "7f3a"}}
    >>> leave_out_dead_widgets({"metadata": {}, "cells": [{"outputs": [{"data": data}]}]})
    >>> data
    {'text/plain': 'An interactive widget: run the cell to see it.'}
    """
    saved = content["metadata"].get("widgets", {}).get(WIDGET_STATE, {}).get("state", {})
    for cell in content["cells"]:
        for output in cell.get("outputs", []):
            data = output.get("data", {})
            if WIDGET_VIEW in data and data[WIDGET_VIEW].get("model_id") not in saved:
                del data[WIDGET_VIEW]
                data.setdefault("text/plain", INSTEAD)

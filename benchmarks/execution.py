"""Notebooks made and executed for a measure."""

from pathlib import Path

import nbformat
from findings import say
from nbclient import NotebookClient
from nbformat import NotebookNode
from nbformat.v4 import new_code_cell, new_notebook

QUIET = "--IPKernelApp.log_level=ERROR"


def make_notebook(*sources: str) -> NotebookNode:
    """Return a notebook with these cells."""
    kernel = {"name": "python3", "display_name": "Python 3"}
    cells = [new_code_cell(source) for source in sources]  # type: ignore[no-untyped-call]
    made: NotebookNode = new_notebook(cells=cells, metadata={"kernelspec": kernel})  # type: ignore[no-untyped-call]
    return made


def read_notebook(path: Path) -> NotebookNode:
    """Read a notebook."""
    content: NotebookNode = nbformat.read(path, as_version=4)  # type: ignore[no-untyped-call]
    return content


def write_notebook(notebook: NotebookNode, path: Path) -> None:
    """Write a notebook."""
    nbformat.write(notebook, path)  # type: ignore[no-untyped-call]


def execute(notebook: NotebookNode) -> None:
    """Execute a notebook in a kernel of its own."""
    say(f"executing a notebook of {len(notebook.cells)} cells")
    NotebookClient(notebook, extra_arguments=[QUIET]).execute()

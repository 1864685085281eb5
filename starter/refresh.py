"""Execute the workbook's own notebooks anew."""

import re
import subprocess
import tempfile
import time
from pathlib import Path
from typing import Any

from starter import notebooks, processes
from starter.errors import WorkbookError
from starter.paths import NOTEBOOKS, VENV_PYTHON

EXECUTION = ("record_timing=False", "timeout=300")
NOTEBOOK_METADATA = {
    "kernelspec": {"display_name": "Python 3 (ipykernel)", "language": "python", "name": "python3"},
    "language_info": {"name": "python"},
}
WIDGET_VIEW = "application/vnd.jupyter.widget-view+json"
PICTURE = re.compile(r'<img class="cm-paper" [^>]*src="data:image/png;base64,([^"]+)">')


def refresh(paths: list[Path]) -> None:
    """Execute notebooks anew; replace them only if all of them ran without an error."""
    executed = {}
    with tempfile.TemporaryDirectory(prefix="workbook-") as folder:
        for number, path in enumerate(paths, 1):
            print(f"[{number}/{len(paths)}] {name_of(path)} ... ", end="", flush=True)
            started = time.monotonic()
            executed[path] = execute(path, Path(folder))
            print(f"{time.monotonic() - started:.1f} s")
    for path, content in executed.items():
        part = notebooks.part_of(path)
        notebooks.write(part, content)
        part.replace(path)


def execute(path: Path, folder: Path) -> dict[str, Any]:
    """Execute a notebook in a clean kernel; return its content with the new outputs."""
    result = subprocess.run(
        [
            *(str(VENV_PYTHON), "-m", "nbconvert", "--to=notebook", "--execute", "--allow-errors"),
            *(f"--ExecutePreprocessor.{option}" for option in EXECUTION),
            *(f"--output-dir={folder}", f"--output={path.name}", str(path)),
        ],
        env=processes.environ(CAMMOTION_PROGRESS="off"),  # it begins as if nobody had been there
        capture_output=True,
        encoding="utf-8",
        errors="replace",
    )
    if result.returncode != 0:
        last_words = processes.tail(result.stderr.splitlines())
        raise WorkbookError(f"failed\n{last_words}Nothing was replaced.")
    content = notebooks.read_original(folder / path.name).content
    error = first_error(content)
    if error:
        raise WorkbookError(f"failed\n{name_of(path)}: {error}\nNothing was replaced.")
    for cell in content["cells"]:
        remove_traces(cell)
    return {**content, "metadata": NOTEBOOK_METADATA}


def name_of(path: Path) -> str:
    """Return what tells a lesson from its solution: 02_name or solutions/02_name."""
    return path.relative_to(NOTEBOOKS).with_suffix("").as_posix()


def first_error(content: dict[str, Any]) -> str:
    """Describe the first error in an executed notebook that is not there on purpose."""
    for number, cell in enumerate(content["cells"], 1):
        wanted = "raises-exception" in cell["metadata"].get("tags", [])
        for output in [] if wanted else cell.get("outputs", []):
            if output["output_type"] == "error":
                return f"cell {number} raised {output['ename']}: {output['evalue']}"
    return ""


def remove_traces(cell: dict[str, Any]) -> None:
    """Remove from an executed cell what chance and the clock left in it."""
    cell["metadata"].pop("execution", None)
    if "outputs" in cell:
        cell["outputs"] = joined_streams(cell["outputs"])
        for output in cell["outputs"]:
            drop_widget_view(output)
            keep_as_png(output)


def joined_streams(outputs: list[dict[str, Any]]) -> list[dict[str, Any]]:
    """Join what a cell printed: in how many pieces it arrived is chance."""
    joined: list[dict[str, Any]] = []
    for output in outputs:
        if joined and "name" in output and output["name"] == joined[-1].get("name"):
            text = "".join([*joined[-1]["text"], *output["text"]])
            joined[-1]["text"] = text.splitlines(keepends=True)
        else:
            joined.append(output)
    return joined


def drop_widget_view(output: dict[str, Any]) -> None:
    """Drop a widget's random id, of no use without its kernel; the picture and text stay."""
    data = output.get("data", {})
    if data.pop(WIDGET_VIEW, None) and not data:
        data["text/plain"] = ["An interactive widget: run the cell to see it."]


def keep_as_png(output: dict[str, Any]) -> None:
    """Store a picture of the package as a PNG with its words: GitHub shows none within HTML."""
    data = output.get("data", {})
    if found := PICTURE.search("".join(data.get("text/html", ""))):
        del data["text/html"]
        data["image/png"] = found[1]
        output["metadata"]["image/png"] = {"alt": "".join(data["text/plain"])}

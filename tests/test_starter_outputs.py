"""The learner's copies come without outputs: what comes out would give the answers away."""

import json
from pathlib import Path

import pytest
from small_workbook import keep, move_starter, notebook

from starter import copies, folder, notebooks

PROSE = {"cell_type": "markdown", "id": "m", "metadata": {}, "source": "so"}


@pytest.fixture
def original(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Lay out a small workbook; give a notebook of it that was run and has outputs."""
    root = move_starter(tmp_path, monkeypatch)
    content = notebook("2 + 2", output_type="stream", name="stdout", text="4")
    content["cells"][0]["execution_count"] = 7
    content["cells"].append(PROSE)
    path = root / "notebooks" / "02_maximum_acceleration.ipynb"
    path.write_text(json.dumps(content))
    return path


def test_neither_the_first_copy_nor_a_fresh_one_has_outputs(original: Path) -> None:
    """And neither is said to be old."""
    before = original.read_bytes()
    work = folder.find("work")
    copies.lay_missing(work)
    for path in (work / original.name, copies.lay_fresh(original, work)):
        code, prose = json.loads(path.read_text())["cells"]
        assert (code["outputs"], code["execution_count"]) == ([], None)
        assert code["source"] == ["2 + 2"]
        assert prose == PROSE
    assert copies.notices(work) == []
    assert original.read_bytes() == before


def test_a_copy_with_outputs_keeps_them_and_is_not_old(original: Path) -> None:
    """The learner's own outputs, and those of copies that were laid with the workbook's."""
    work = folder.find("work")
    content, version = notebooks.read_original(original)
    note = {"workbook": {"source": original.name, "version": version}}
    (work / original.name).write_text(json.dumps(content | {"metadata": note}))
    mine = keep(work)
    copies.lay_missing(work)
    assert mine.items() <= keep(work).items()
    assert copies.notices(work) == []

"""Motions written as cam tables in some program's form, and read back to the digit."""

from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

import cammotion as cm
from fresh.drawing import Machine
from fresh.sampling import tracks_of
from fresh.written_tables import Written, draw_form, settings_of, write


def cam_tables(machine: Machine) -> None:
    """Write each motion that comes back in a drawn form, whole or in part, and read it."""
    rng = machine.rng
    for name, track in tracks_of(machine.diagram).items():
        if machine.diagram[name].is_indexing:
            continue
        count, shape = int(rng.integers(24, 400)), str(rng.choice(["closed", "open", "part"]))
        places = np.arange(count) / count
        if shape == "closed":
            places = np.append(places, 1.0)
        elif shape == "part":
            places *= rng.uniform(0.1, 0.9)
        written = write(draw_form(rng), places, track.curve(0, 360 * places), rng)
        told = settings_of(written.form, is_part=shape == "part", is_open=shape == "open")
        told |= {"is_cycle": shape != "part"}  # a motion may come back within the last step
        if not written.decides:
            told |= {"decimal": written.form.decimal}
        if written.rises_evenly:
            told |= {"columns": (1, 2)}
        with TemporaryDirectory() as folder:
            path = Path(folder) / "cam.csv"
            path.write_bytes(written.raw)
            _check(cm.read_cam_table(path, **told), written, shape)


def _check(table: cm.CamTable, written: Written, shape: str) -> None:
    wanted = written.position_mm[: -1 if shape == "closed" else None]
    assert table.angle_deg.size == wanted.size, table.said
    assert table.is_cycle == (shape != "part"), table.said
    near = 1e-8 if table.is_cycle else 360 * 1.02 * written.rounding
    off = np.abs(table.angle_deg - 360 * written.places[: wanted.size])
    assert off.max() < near, f"{off.max()} deg off: {table.said}"
    assert np.allclose(table.position_mm, wanted, rtol=1e-14, atol=1e-12), table.said

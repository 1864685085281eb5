"""Write the report of a machine into a new folder: all of it, or nothing."""

import contextlib
import os
import shutil
import tempfile
from collections.abc import Iterator
from dataclasses import dataclass
from datetime import date
from pathlib import Path

from cammotion.arguments import checked
from cammotion.exchange.cam_files import write_cam
from cammotion.exchange.cam_tables_out import write_cam_tables
from cammotion.exchange.machine_files import machine_rows
from cammotion.exchange.xlsx_out import sheets_as_xlsx
from cammotion.files import as_path, is_folder, stems, write_new
from cammotion.hardware.followers import TranslatingRoller
from cammotion.hardware.prime_circle import smallest_prime_radius
from cammotion.hardware.roller_cam import RollerCam
from cammotion.own import Machine
from cammotion.quantities import InputError, Quantity, WrongAnswerError, shorten
from cammotion.report.findings import Findings, Progress, find_all
from cammotion.report.markup import Beside
from cammotion.report.page import write_page
from cammotion.report.sheets import sheets_of

PAGE, BOOK, TABLES, CODESYS, DXF = "report.html", "tables.xlsx", "cam tables", "codesys", "dxf"
ROLLER_MM, PRESSURE_DEG, MARGIN = 10.0, 30.0, 1.02

_INDEXES = (
    "it goes on by a pitch in each turn, and the follower of a disc cam comes back; a turret has "
    "an indexing cam"
)
_SECONDS = Quantity("time for the bound", "s", example=20)
_WRITING = 0.85
_MOST = 1000


@dataclass(frozen=True)
class Report:
    """A report that was written: its folder, the page in it, and whether all rules are kept."""

    folder: Path
    page: Path
    is_kept: bool

    def __str__(self) -> str:
        """Say where it is."""
        return f"The report is in {self.folder}: open {self.page.name} in a browser."


@checked
def write_report(
    machine: Machine,
    folder: str | Path,
    *,
    seconds: float = 20.0,
    dxf: bool = False,
    progress: Progress | None = None,
) -> Report:
    """Write the report of a machine into a new folder within `folder`, and return where it is.

    The new folder is called after the machine, and numbered if there is one of that name: nothing
    is written over. It holds a page that needs no network, an .xlsx workbook with a cam table of
    each mechanism, the tables as CSV and for CODESYS, and with `dxf` a disc cam of each mechanism
    that comes back (a roller of 10 mm, a pressure angle of 30 deg). The tables are those of the
    best design, if still arcs are given, else of the machine as it is. The search for the bound
    takes at most so many `seconds`. An interrupt of the keyboard ends it with the best so far, and
    the one for the best design without one. Either all is written, or nothing. `progress` is told
    the share that is done, and what is being done. Raises InputError for a folder that is not there
    or cannot be written to, and for a law that no table can hold.

    >>> from tempfile import TemporaryDirectory
    >>> import cammotion as cm
    >>> machine = cm.Machine("press", cm.EXAMPLE.diagram, [cm.EXAMPLE.rule])
    >>> with TemporaryDirectory() as folder:
    ...     report = write_report(machine, folder)
    ...     report.page.relative_to(folder).as_posix(), report.is_kept
    ('report-press/report.html', True)
    """
    limit, place = _SECONDS.number(seconds), as_path(folder)
    tell = _silent if progress is None else progress
    if not is_folder(place) or not os.access(place, os.W_OK | os.X_OK):
        raise InputError(
            f"The folder {shorten(place.name or str(place))} is not there, or you may not write in "
            "it: give one of your own."
        )
    machine_rows(machine)  # refuses a law that no table can hold, before it takes long
    found = find_all(machine, limit, tell)
    tell(_WRITING, "writing")
    with _part(place) as part:
        files = [_book(found), *_write_tables(found, part)]
        files += _write_cams(found, part) if dxf else []
        write_new(part / BOOK, sheets_as_xlsx(sheets_of(found)))
        write_new(part / PAGE, write_page(found, date.today(), files))
        tell(1.0, "done")  # before it is there: an interrupt here means that nothing is
        target = _move(part, place, f"report-{next(stems([machine.name]))}")
    return Report(target, target / PAGE, not machine.violations)


def _silent(_: float, __: str) -> None:
    """Tell nobody."""


def _book(found: Findings) -> Beside:
    both = " and of the design" if found.best else ""
    said = f"of today's machine{both}: its table, peaks and clearances, and the cam tables"
    return Beside(said, [BOOK])


def _whose(found: Findings) -> str:
    """Return in words whose cams are written."""
    return "of the design, not of today's machine" if found.best else "of today's machine"


def _write_tables(found: Findings, part: Path) -> list[Beside]:
    said = []
    for name, form, how in (
        (TABLES, "plain", "CSV with semicolons, each degree"),
        (CODESYS, "codesys", "as CODESYS SoftMotion imports it"),
    ):
        (part / name).mkdir()
        paths = write_cam_tables(found.design, part / name, step_deg=1, form=form)
        files = [path.relative_to(part).as_posix() for path in paths.values()]
        said.append(Beside(f"{_whose(found)}: position over cam angle, {how}", files))
    return said


def _write_cams(found: Findings, part: Path) -> list[Beside]:
    """Write a disc cam of each mechanism that comes back; return what was written, and what not."""
    (part / DXF).mkdir()
    said = []
    roller = TranslatingRoller(ROLLER_MM)
    for number, motion in enumerate(found.design.motions, 1):
        if motion.is_indexing or not motion.moves:
            why = _INDEXES if motion.is_indexing else "it stands all the turn"
            said.append(Beside(f"no DXF of the {motion.name}: {why}"))
            continue
        file = f"{DXF}/{number} {next(stems([motion.name]))}.dxf"
        try:
            least = smallest_prime_radius(motion, roller, pressure_angle_deg=PRESSURE_DEG)
            radius = max(MARGIN * least, 2 * ROLLER_MM)
            write_cam(RollerCam(motion, roller, prime_radius_mm=radius), part / file)
            what = f"radius of the prime circle {radius:.4g} mm, of the roller {ROLLER_MM:g} mm"
            said.append(Beside(f"{_whose(found)}: disc cam, {what}", [file]))
        except (InputError, WrongAnswerError) as wrong:
            said.append(Beside(f"no DXF of the {motion.name}: {wrong}"))
    return said


@contextlib.contextmanager
def _part(place: Path) -> Iterator[Path]:
    """Make a hidden folder to write in; it is gone afterwards, whatever happened."""
    part = Path(tempfile.mkdtemp(prefix=".report-", dir=place))
    try:
        yield part
    finally:
        shutil.rmtree(part, ignore_errors=True)


def _move(part: Path, place: Path, name: str) -> Path:
    """Give a folder that is complete the first free name."""
    part.chmod(0o755)
    for number in range(1, _MOST):
        target = place / (name if number == 1 else f"{name}-{number}")
        if not target.exists():
            try:
                return part.rename(target)
            except OSError as wrong:
                if not target.exists():  # else another report has just taken it
                    raise InputError(
                        f"The report cannot be called {target.name} ({wrong.strerror}): close what "
                        "has its files open, and ask again."
                    ) from None
    raise InputError(f"There are {_MOST - 1} folders {name} already: delete some.")

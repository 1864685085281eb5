"""What a class costs on a server: memory, time to the first result, failures, by its size."""

import sys
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from statistics import median

from findings import Finding, say

ROOT = Path(__file__).parent.parent
sys.path[:0] = [str(ROOT / "tests"), str(ROOT)]

from hub import Hub, running_hub  # noqa: E402
from hub_environment import installed  # noqa: E402
from hub_lesson import make_course, work_at_once  # noqa: E402
from hub_student import KERNEL, SERVER, Student  # noqa: E402

CLASSES = (1, 5, 10, 20)
MOST_MB, MOST_OURS_MB = 300, 20
STEPS = {
    "the kernel alone": "",
    "NumPy": "import numpy",
    "SymPy": "import sympy",
    "Matplotlib": "from matplotlib import pyplot",
    "ipywidgets and anywidget": "import ipywidgets, anywidget",
    "cammotion": "import cammotion as cm; cm.predict, cm.check, cm.explore_move, cm.plot_curves",
}
"""What a kernel loads for notebook 02, one after the other."""


def measure_hub() -> list[Finding]:
    """Run notebook 02 with 1, 5, 10 and 20 students at once on a real JupyterHub (needs root)."""
    findings = _parts()
    for size in CLASSES:
        with _hub(size) as hub:
            findings += _class(hub, size)
    return findings


@contextmanager
def _hub(students: int) -> Iterator[Hub]:
    with (
        tempfile.TemporaryDirectory() as folder,
        running_hub(installed(), make_course(Path(folder)), students) as hub,
    ):
        yield hub


def _parts() -> list[Finding]:
    """Say what of a student's memory is whose, step by step in a kernel of its own."""
    with _hub(1) as hub:
        student = Student(hub, hub.accounts[0])
        student.log_in()
        path = student.pull()
        with student.kernel(path) as kernel:
            before = 0.0
            for what, code in STEPS.items():
                kernel.run(code)
                now = student.memory_mb()[KERNEL]
                say(f"{what}: {now - before:.0f} MB")
                before, ours = now, now - before
    return [Finding("memory of a kernel that cammotion takes", ours, MOST_OURS_MB, "MB")]


def _class(hub: Hub, size: int) -> list[Finding]:
    works = work_at_once(hub)
    failed = sum(bool(work.errors) for work in works)
    memory = [work.student.memory_mb() for work in works]
    servers, kernels = (median(each[part] for each in memory) for part in (SERVER, KERNEL))
    first = sorted(work.first_result_s for work in works)
    say(f"{size} students: server {servers:.0f} MB, kernel {kernels:.0f} MB of each")
    busy = median(work.student.processor_s() for work in works)
    say(f"  a processor is busy for {busy:.1f} s with each")
    say(f"  hub and proxy: {hub.memory_mb():.0f} MB")
    say(f"  first result after {first[0]:.0f} to {first[-1]:.0f} s, median {median(first):.0f} s")
    say(f"  the lesson to its end: {max(work.seconds for work in works):.0f} s, failures: {failed}")
    what = f"{size} students on a hub"
    return [
        Finding(f"{what}: memory of each", servers + kernels, MOST_MB, "MB"),
        Finding(f"{what}: until the last one has a result", first[-1], 30 + 5 * size, "s"),
        Finding(f"{what}: failures", failed, 0, ""),
    ]

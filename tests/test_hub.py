"""Three students at once on a real JupyterHub, set up by docs/classroom.md.

The hub lives in an environment of its own, .venv-hub. REQUIRE_HUB=1 makes it.
"""

import json
import os
import re
import signal
import time
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from pathlib import Path
from statistics import median
from typing import Any

import pytest
import requests
import websocket
from answering import answering, changed, numbers_of, read
from environments import ROOT, run
from hub import PATIENCE_SECONDS, Hub, running_hub
from hub_environment import PAGE, require_hub
from hub_lesson import IGNORED_LATER, LESSON, Work, make_course, publish, run_cells, work_at_once
from hub_student import KERNEL, SERVER

STUDENTS, AT_ONCE = 3, 2
MOST_MB = 350  # a student; the page says how much it is
ORIGINAL = next((ROOT / "notebooks").glob(f"{LESSON}_*.ipynb"))
OTHER_LESSON = "01_timing_diagram.ipynb"
TELL = "import os, urllib.request as web\n"
TRIED = """
try:
    print("got in", repr({attempt})[:40])
except OSError as refusal:
    print("refused", getattr(refusal, "code", refusal.strerror))
"""
LISTEN = """
import pwd, zmq
uid, listens = str(pwd.getpwnam("{name}").pw_uid), "0A"
lines = [line.split() for line in open("/proc/net/tcp").readlines()[1:]]
ports = [int(line[1].split(":")[1], 16) for line in lines if line[7] == uid and line[3] == listens]
heard = zmq.Context.instance().socket(zmq.SUB)
heard.subscribe(b"")
for port in ports:
    heard.connect(f"tcp://127.0.0.1:{{port}}")
print(len(ports), "ports:", "overheard" if heard.poll(2000) else "silence")
heard.close(0)
"""


@pytest.fixture(scope="module")
def course(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return the repository of the class."""
    require_hub()
    return make_course(tmp_path_factory.mktemp("teacher"))


@pytest.fixture(scope="module")
def hub(course: Path) -> Iterator[Hub]:
    """Run a hub."""
    with running_hub(require_hub(), course, STUDENTS, AT_ONCE) as running:
        try:
            yield running
        finally:
            print(running.log.read_text("utf-8")[-20_000:])  # shown where something fails


@pytest.fixture(scope="module")
def works(hub: Hub) -> list[Work]:
    """Let the students work through the lesson, all at once."""
    return work_at_once(hub)


def test_each_student_runs_the_lesson_to_its_end(
    works: list[Work], record_property: Callable[[str, object], None]
) -> None:
    memory = [sum(work.student.memory_mb().values()) for work in works]
    first, all_ = (
        max(s) for s in zip(*((w.first_result_s, w.seconds) for w in works), strict=True)
    )
    busy = median(work.student.processor_s() for work in works)
    record_property(
        "measured",
        f"{STUDENTS} students on a hub: {median(memory):.0f} MB each, a processor busy for "
        f"{busy:.0f} s with each, first result after at most {first:.0f} s, all of {LESSON} after "
        f"{all_:.0f} s",
    )
    assert [work.errors for work in works] == [[]] * STUDENTS
    assert max(memory) < MOST_MB


def test_the_results_are_those_of_the_workbook(works: list[Work]) -> None:
    """What is printed is in print, but for the exercises, which have other numbers."""
    stored = printed(read(ORIGINAL))
    assert len(stored) > 5
    for work in works:
        assert stored.items() <= printed(work.notebook).items()


def printed(notebook: Any) -> dict[str, str]:
    """Return what each cell printed."""
    return {
        cell["id"]: "".join("".join(output["text"]) for output in streams)
        for cell in notebook["cells"]
        if (streams := [each for each in cell.get("outputs", []) if "text" in each])
    }


def test_each_student_has_answered_rightly(works: list[Work]) -> None:
    for work in works:
        kept = progress(work)["exercises"]
        states = {number: kept[number]["state"] for number in numbers_of(LESSON)}
        assert set(states.values()) == {"right"}
        assert {kept[number]["who"] for number in states} == {work.student.account.name}


def progress(work: Work) -> Any:
    """Return what a student's server says is in the file beside the notebooks."""
    return json.loads(work.student.read(str(Path(work.path).with_name("progress.json"))))


def test_figures_follow_while_cells_run(works: list[Work]) -> None:
    for work in works:
        assert work.moved > 20
        assert work.followed == work.moved


def test_who_comes_when_too_many_start_waits_and_gets_in(works: list[Work]) -> None:
    assert sum(work.student.told_to_wait > 0 for work in works) == STUDENTS - AT_ONCE


def test_the_servers_have_our_settings(hub: Hub, works: list[Work]) -> None:
    """They lie in the environment, and no administrator has to know of them."""
    said = "cammotion.teaching.extension | extension was successfully loaded"
    assert hub.log.read_text("utf-8").count(said) >= STUDENTS
    for plugin, name, usual in [
        ("@jupyter-widgets/jupyterlab-manager:plugin", "saveState", False),
        ("@jupyterlab/apputils-extension:notification", "fetchNews", "false"),
    ]:
        settings = works[0].student.ask(f"lab/api/settings/{plugin}")
        assert settings["schema"]["properties"][name]["default"] == usual


@pytest.mark.parametrize(
    ("attempt", "refusal"),
    [
        ("open('{home}/{path}').read()", "Permission denied"),
        ("os.listdir('{home}')", "Permission denied"),
        ("open('{home}/cam-class/progress.json', 'a')", "Permission denied"),
        ("open('/proc/{server}/environ').read()", "Permission denied"),
        ("os.kill({server}, 0)", "Operation not permitted"),
        ("web.urlopen(web.Request('{hub}/user/{name}/api/contents/{path}', None, {token}))", "403"),
        ("web.urlopen(web.Request('{hub}/hub/api/users/{name}', None, {token}))", "404"),
    ],
)
def test_no_student_reaches_another(works: list[Work], attempt: str, refusal: str) -> None:
    """Tried from a notebook, where the same succeeds with what is one's own."""
    mine, other = works[1], works[2]
    assert tried(mine, attempt, of=mine).startswith("got in")
    assert tried(mine, attempt, of=other) == f"refused {refusal}\n"


def tried(who: Work, attempt: str, of: Work) -> str:
    """Let a student try something in a notebook, and return what it prints."""
    other = of.student.account
    told = attempt.format(
        home=other.home,
        path=of.path,
        name=other.name,
        server=other.processes(SERVER)[0],
        hub=of.student.hub.address,
        token="{'Authorization': 'token ' + os.environ['JUPYTERHUB_API_TOKEN']}",  # noqa: S106
    )
    return said_in(who, TELL + TRIED.format(attempt=told))


def said_in(work: Work, code: str) -> str:
    """Run code in the kernel of a student's notebook, and return what it prints."""
    with work.student.kernel(work.path) as kernel:
        outputs = kernel.run(code)
    return "".join(str(output.get("text", output)) for output in outputs)


def test_no_student_opens_the_page_of_another(works: list[Work]) -> None:
    """With the cookies of a browser that is logged in."""
    mine, other = works[1].student, works[2].student
    page = mine.browser.get(
        f"{mine.hub.address}{other.base}api/contents/{works[2].path}", timeout=PATIENCE_SECONDS
    )
    assert page.status_code in (requests.codes.forbidden, requests.codes.not_found)


def test_no_student_overhears_the_kernel_of_another(works: list[Work]) -> None:
    """Its ports are open to all accounts; what it says there is encrypted."""
    mine, other = works[1], works[2]
    talk = "import time\nfor _ in range(40):\n    print('mine')\n    time.sleep(0.1)"
    with ThreadPoolExecutor(1) as pool, other.student.kernel(other.path) as kernel:
        talking = pool.submit(kernel.run, talk)
        heard = said_in(mine, LISTEN.format(name=other.student.account.name))
        talking.result()
    ports, _, verdict = heard.strip().partition(" ports: ")
    assert int(ports) > 1
    assert verdict == "silence"


def test_no_kernel_has_a_debugger(works: list[Work]) -> None:
    """It would let in whoever comes to its port."""
    features = 'get_ipython().kernel.kernel_info["supported_features"]'
    assert said_in(works[0], f"print('debugger' in {features})") == "False\n"


def test_the_link_brings_what_is_new_and_keeps_the_answers(course: Path, works: list[Work]) -> None:
    work = works[1]
    original = next(course.glob(f"{LESSON}_*.ipynb"))
    title, better = read(original)["cells"][0]["source"].splitlines()[0], "# A better title"
    original.write_text(original.read_text("utf-8").replace(title, better), "utf-8")
    publish(course)
    before = work.student.read(work.path)
    assert work.student.pull() == work.path
    after = work.student.read(work.path)
    assert sources(after) == [source.replace(title, better) for source in sources(before)]
    assert f"answer_1 = {answer(work)}" in sources(after)
    assert progress(work)["exercises"].keys() >= set(numbers_of(LESSON))


def sources(notebook: Any) -> list[str]:
    return ["".join(cell["source"]) for cell in notebook["cells"]]


def answer(work: Work) -> str:
    """Return the student's answer to the first exercise."""
    change = answering(work.student.account.name, numbers_of(LESSON))
    return str(change("answer_1 = None")).partition(" = ")[2]


def test_what_was_saved_survives_the_server(works: list[Work]) -> None:
    """A server is killed while a cell of another lesson runs."""
    work = works[0]
    student, path = work.student, str(Path(work.path).with_name(OTHER_LESSON))
    name, lesson = student.account.name, OTHER_LESSON[:2]
    notebook = changed(student.read(path), answering(name, numbers_of(lesson)))
    with suppress(websocket.WebSocketException, OSError), student.kernel(path) as kernel:
        for cell in run_cells(kernel, notebook):
            if cell["source"].startswith(f'cm.check("{lesson}.1"'):
                break
        student.save(path, notebook)
        (server,) = student.account.processes(SERVER)
        with ThreadPoolExecutor(1) as pool:
            endless = pool.submit(kernel.run, "while True:\n    pass")
            os.kill(server, signal.SIGKILL)
            endless.result()
    assert student.pull() == work.path  # the link, once more
    assert sources(student.read(path)) == sources(notebook)
    kept = progress(work)["exercises"]
    assert kept[f"{lesson}.1"]["state"] == "right"
    assert set(numbers_of(LESSON)) <= kept.keys()
    assert said_in(work, "print(6 * 7)") == "42\n"
    assert ends(student.account, kernels=1), "the kernel of the dead server goes on"


def ends(account: Any, kernels: int) -> bool:
    """Wait until an account has no more than so many kernels."""
    end = time.monotonic() + PATIENCE_SECONDS
    while len(account.processes(KERNEL)) > kernels:
        if time.monotonic() > end:
            return False
        time.sleep(0.1)
    return True


def test_what_is_the_teachers_own_does_not_come_to_the_class(tmp_path: Path) -> None:
    course = make_course(tmp_path)
    (course / "progress.json").write_text("{}", "utf-8")
    (course / "02_maximum_acceleration.ipynb").write_text("changed", "utf-8")
    publish(course)
    held = run("git", "-C", course, "ls-files").splitlines()
    assert "00_start_here.ipynb" in held
    assert "notebooks/data/pad_press.csv" in held or "data/pad_press.csv" in held
    assert not [name for name in held if "progress" in name or "solutions" in name]
    assert "changed" in run("git", "-C", course, "show", "HEAD:02_maximum_acceleration.ipynb")
    run("sh", "-c", IGNORED_LATER, at=course)
    publish(course)
    held = run("git", "-C", course, "ls-files").splitlines()
    assert [name for name in held if "solutions" in name]
    assert not [name for name in held if "progress" in name]


def test_the_page_means_one_version() -> None:
    assert len(set(re.findall(r"jupyterhub==[\d.]+", PAGE))) == 1
    assert len(set(re.findall(r"nbgitpuller==[\d.]+", PAGE))) == 1


def test_ci_requires_it() -> None:
    assert "REQUIRE_HUB=1" in (ROOT / ".ci" / "run").read_text("utf-8")

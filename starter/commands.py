"""The command line; every foreseen failure ends in a sentence."""

import argparse
import io
import os
import secrets
import signal
import sys
from collections.abc import Callable
from pathlib import Path

from starter import (
    browser,
    copies,
    environment,
    errors,
    folder,
    lab,
    maintain,
    notebooks,
    processes,
    refresh,
)
from starter.paths import NOTEBOOKS, START


def main(arguments: list[str]) -> int:
    """Do what the command line asks for, in text that any terminal can show."""
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors="replace", line_buffering=True)
    signal.signal(signal.SIGTERM, end_on_sigterm)
    return run(arguments)


def end_on_sigterm(_signal: int, _frame: object) -> None:
    """End our children and clean up, as after Ctrl-C."""
    raise SystemExit(128 + signal.SIGTERM)


def run(arguments: list[str]) -> int:
    """Do what the command line asks for; every foreseen failure ends in a sentence."""
    options = parse(arguments)
    act, _ = COMMANDS[options.command]
    try:
        return act(options)
    except errors.WorkbookError as error:
        print(error, file=sys.stderr)
    except OSError as error:
        print(errors.explain_os_error(error), file=sys.stderr)
    except KeyboardInterrupt:
        print("\nStopped. Nothing half-made stays: start again when you like.", file=sys.stderr)
        return 128 + signal.SIGINT
    return 1


def parse(arguments: list[str]) -> argparse.Namespace:
    """Read the command line; `passed_on` is for pytest or JupyterLab."""
    asks_help = arguments[-1:] in (["-h"], ["--help"]) and "--fresh" not in arguments
    arguments = command_first(arguments)
    if not arguments or (arguments[0].startswith("-") and not asks_help):
        arguments = ["lab", *arguments]
    end = len(arguments)
    if arguments[0] == "test" and not asks_help:
        end = 1
    elif "--" in arguments:
        end = arguments.index("--")
    own, passed_on = arguments[:end], arguments[end:]
    parser = make_parser()
    options = parser.parse_args(own)
    if passed_on and options.command not in ("lab", "test"):
        parser.error(f"{options.command} passes nothing on: leave out --")
    options.passed_on = passed_on[1:] if passed_on[:1] == ["--"] else passed_on
    return options


def command_first(arguments: list[str]) -> list[str]:
    """Take a --work that was typed before the command, too."""
    first = "".join(arguments[:1])
    end = 2 if first == "--work" else int(first.startswith("--work="))
    asked, rest = arguments[:end], arguments[end:]
    return [rest[0], *asked, *rest[1:]] if rest and rest[0] in COMMANDS else arguments


def make_parser() -> argparse.ArgumentParser:
    """Describe the command line."""
    parser = argparse.ArgumentParser(
        prog="workbook.py",
        description="Set up the workbook and open its notebooks in JupyterLab.",
        epilog=f"Without a command: lab. The options of lab: {START} lab --help",
    )
    commands = parser.add_subparsers(dest="command", metavar="command", required=True)
    added = {
        name: commands.add_parser(name, help=text, description=text, allow_abbrev=False)
        for name, (_, text) in COMMANDS.items()
    }
    for name in ("lab", "setup", "fresh", "report"):
        added[name].add_argument(
            "--work",
            default=folder.DEFAULT,
            metavar="FOLDER",
            help="the folder of your copies (work): a name like work-anna, or a path elsewhere",
        )
    added["lab"].add_argument("--port", type=port_number, metavar="N", help="use just this port")
    added["lab"].add_argument("--no-browser", action="store_true", help="only print the address")
    added["refresh"].add_argument("notebooks", nargs="*", metavar="NN", help="such as 02 (all)")
    added["fresh"].add_argument("notebook", metavar="NN", help="such as 02")
    added["class"].add_argument("folder", metavar="FOLDER", help="where the files are collected")
    added["class"].add_argument("--output", default="class.html", metavar="FILE", help="the page")
    added["class"].add_argument("--anonymous", action="store_true", help="numbers for names")
    added["class"].add_argument("--overwrite", action="store_true", help="write over an old page")
    added["report"].add_argument("machine", metavar="MACHINE", help="a table: .csv or .xlsx")
    added["report"].add_argument(
        "--seconds", type=float, default=20.0, metavar="S", help="for the bound, at most (20)"
    )
    added["report"].add_argument("--dxf", action="store_true", help="a disc cam of each mechanism")
    added["site"].add_argument(
        "--folder", default="site", metavar="FOLDER", help="the folder that is written (site)"
    )
    added["site"].add_argument(
        "--home", metavar="URL", help="where the workbook is: each page links to it"
    )
    added["lock"].add_argument("--upgrade", action="store_true", help="take the newest versions")
    return parser


def port_number(text: str) -> int:
    """Read a port number from the command line."""
    if not text.isdecimal() or int(text) not in lab.PORTS:
        raise argparse.ArgumentTypeError(f"{text!r} is no port: give a number from 1 to 65535")
    return int(text)


def open_lab(options: argparse.Namespace) -> int:
    """Set up and open JupyterLab; return when it has been stopped."""
    work = folder.find(options.work)
    port = lab.choose_port(options.port)
    environment.ensure()
    copies.lay_missing(work)
    if lab.is_root():
        print(
            "You are root: the notebooks run with all rights on this machine or container. "
            "Outside of a container, start the workbook as an ordinary user."
        )
    print("Starting JupyterLab ...")
    token = secrets.token_hex(24)
    served = folder.served(work)
    process = lab.start(port, token, served, options.passed_on)
    try:
        page = browser.first_page(work.relative_to(served).as_posix())
        url = f"http://127.0.0.1:{port}{page}?token={token}"
        with browser.private_folder(work) as private:
            browser.welcome(url, port, options.no_browser, private)
            code = processes.wait_for(process)
    finally:
        processes.stop(process)
    if code == 0:
        print(f"JupyterLab has stopped. Your copies are in {folder.shown(work)}/.")
    return code


def set_up(options: argparse.Namespace) -> int:
    """Set up and leave it at that."""
    work = folder.find(options.work, f"{START} setup")
    environment.ensure()
    copies.lay_missing(work)
    print(f"The workbook is ready. Open it with: {START}{folder.option(work)}")
    return 0


def test(options: argparse.Namespace) -> int:
    """Run linters and tests."""
    environment.ensure(whole=True)
    return maintain.test(options.passed_on)


def refresh_notebooks(options: argparse.Namespace) -> int:
    """Execute the workbook's own notebooks anew, with their solutions."""
    environment.ensure()
    lessons = [notebooks.find(wanted) for wanted in options.notebooks]
    numbers = {notebooks.number_of(path.stem) for path in lessons}
    solutions = [
        path
        for path in notebooks.solutions()
        if not lessons or notebooks.number_of(path.stem) in numbers
    ]
    refresh.refresh([*(lessons or notebooks.originals()), *solutions])
    return 0


def lay_fresh_copy(options: argparse.Namespace) -> int:
    """Lay a fresh copy of a notebook beside the learner's."""
    source = notebooks.find(options.notebook)
    work = folder.find(options.work, f"{START} fresh {options.notebook}")
    target = copies.lay_fresh(source, work)
    print(f"A fresh copy: {Path(folder.shown(work)) / target.name}")
    return 0


def show_class(options: argparse.Namespace) -> int:
    """Write a page of what the students' progress files hold; their paths are from here."""
    environment.ensure()
    files, page = (str(Path(path).absolute()) for path in (options.folder, options.output))
    switches = [f"--{name}" for name in ("anonymous", "overwrite") if getattr(options, name)]
    return maintain.run_module("cammotion.teaching.classroom", files, f"--output={page}", *switches)


def report_machine(options: argparse.Namespace) -> int:
    """Write the report of a machine into the folder of copies; its path is from here.

    The exit code is that of `cammotion.report`: 0 if all rules are kept, 3 if one is broken, 2 for
    a table that cannot be read, 130 if it was interrupted with nothing written.
    """
    work = folder.find(options.work, f"{START} report {folder.typed(options.machine)}")
    environment.ensure()
    machine = str(Path(os.path.expanduser(options.machine)).absolute())  # noqa: PTH111 - "~x.csv"
    more = [f"--folder={work}", f"--seconds={options.seconds}", *(["--dxf"] * options.dxf)]
    return maintain.run_module("cammotion.report", machine, *more)


def write_site(options: argparse.Namespace) -> int:
    """Write the stored notebooks as a folder of pages; its path is from here."""
    environment.ensure()
    folder_of_pages = Path(options.folder).absolute()
    home = [f"--home={options.home}"] if options.home else []
    return maintain.run_module("cammotion.site", str(NOTEBOOKS), str(folder_of_pages), *home)


def lock(options: argparse.Namespace) -> int:
    """Write environment.txt anew from pyproject.toml."""
    maintain.lock(options.upgrade)
    return 0


COMMANDS: dict[str, tuple[Callable[[argparse.Namespace], int], str]] = {
    "lab": (open_lab, "set up and open the notebooks; what follows -- goes to JupyterLab"),
    "setup": (set_up, "only set up, to have a computer ready for class"),
    "test": (
        test,
        "run linters and tests; with --fresh, half an hour of machines from fresh seeds; "
        "with other arguments, only pytest with these",
    ),
    "refresh": (refresh_notebooks, "execute the workbook's own notebooks and their solutions anew"),
    "fresh": (lay_fresh_copy, "lay a fresh copy of a notebook beside yours"),
    "class": (show_class, "write a page of what your students' progress files hold"),
    "report": (
        report_machine,
        "write the report of a machine: ends with 0 if its rules are kept, 3 if one is broken, "
        "2 if the table cannot be read",
    ),
    "site": (write_site, "write the notebooks as a folder of web pages, which need no kernel"),
    "lock": (lock, "write environment.txt anew from pyproject.toml (needs uv)"),
}

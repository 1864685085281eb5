"""A port, and JupyterLab on it."""

import os
import socket
import subprocess
import sys
import threading
import time
from http import HTTPStatus
from http.client import HTTPConnection, HTTPException
from pathlib import Path

from starter import processes, reasons
from starter.errors import WorkbookError
from starter.paths import ON_WINDOWS, VENV_PYTHON

DEFAULT_PORT = 8888
PORTS = range(1, 65536)
PATIENCE = 180  # seconds; a network drive that is slow needs one
NO_ANSWER = 0
REFUSED = (HTTPStatus.UNAUTHORIZED, HTTPStatus.FORBIDDEN)
# The token goes before any of the learner's own configuration, and on no command line.
LAUNCH = """
import os, sys
from jupyterlab.labapp import main
sys.argv.append("--IdentityProvider.token=" + os.environ.pop("JUPYTER_TOKEN"))
sys.exit(main())
"""


def choose_port(wanted: int | None) -> int:
    """Return the wanted port, or else the default one or the next that is free."""
    if wanted is not None:
        if not is_free(wanted):
            raise WorkbookError(f"Port {wanted} is in use: choose another, or leave out --port.")
        return wanted
    for port in PORTS[DEFAULT_PORT - 1 :]:
        if is_free(port):
            break
    if port != DEFAULT_PORT:
        print(
            f"Port {DEFAULT_PORT} is in use, perhaps by a workbook you started earlier; "
            f"this one uses {port}."
        )
    return port


def is_free(port: int) -> bool:
    """Tell whether a server could listen on this port."""
    with socket.socket() as listener:
        if not ON_WINDOWS:  # like the server: a port whose connections just closed is free
            listener.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            listener.bind(("127.0.0.1", port))
        except OSError:
            return False
    return True


def start(port: int, token: str, served: Path, passed_on: list[str]) -> "subprocess.Popen[str]":
    """Start JupyterLab and return when it answers; raise if it ends or refuses before that."""
    process = subprocess.Popen(
        command(port, served, passed_on),
        env=processes.environ(JUPYTER_TOKEN=token),
        stderr=subprocess.PIPE,
        encoding="utf-8",
        errors="replace",
    )
    lines: list[str] = []
    ready = threading.Event()
    # What it says while it starts is of interest only if it fails.
    reader = processes.listen(
        process.stderr, lambda line: (sys.stderr.write if ready.is_set() else lines.append)(line)
    )
    try:
        status = wait_for_answer(process, port, token)
        if status != HTTPStatus.OK:
            if process.poll() is not None:
                reader.join(1)
            why = explain(process.poll(), status, port, "".join(lines))
            raise WorkbookError(processes.tail(lines) + why)
    except BaseException:
        processes.stop(process)
        raise
    ready.set()
    return process


def wait_for_answer(process: "subprocess.Popen[str]", port: int, token: str) -> int:
    """Wait until JupyterLab answers, refuses or ends, but not for ever; return its status."""
    status, end = NO_ANSWER, time.monotonic() + PATIENCE

    def is_over() -> bool:
        nonlocal status
        status = ask(port, token)
        known = status in (HTTPStatus.OK, *REFUSED)
        return known or process.poll() is not None or time.monotonic() > end

    processes.wait_until(is_over, lambda: "not ready yet")
    return NO_ANSWER if process.poll() is not None else status


def explain(code: int | None, status: int, port: int, told: str) -> str:
    """Say in words why JupyterLab is not ready, by its exit code and words or its last answer."""
    if code is not None:
        reason = reasons.find(told)
        ended = f"JupyterLab ended (code {code}) before it was ready."
        return f"{ended} {reason}" if reason in reasons.OF_A_START else ended
    if status in REFUSED:
        return (
            f"JupyterLab refuses the token that was made for this start (status {status}): a "
            "Jupyter configuration of your own asks for another way to log in. Start again with "
            "the variable JUPYTER_CONFIG_DIR set to an empty folder, which leaves it aside."
        )
    said = f"answers only with status {status}" if status else "does not answer"
    return (
        f"JupyterLab {said} on port {port} after {PATIENCE} s, and was ended. Start again; if this "
        "stays, ask whether a firewall or a virus scanner keeps programs from talking to 127.0.0.1."
    )


def command(port: int, served: Path, passed_on: list[str]) -> list[str]:
    """Return the command that starts JupyterLab for the folder that it shows."""
    return [
        *(str(VENV_PYTHON), "-P", "-c", LAUNCH, "--no-browser"),
        *(f"--ServerApp.root_dir={served}", "--ServerApp.base_url=/", "--ServerApp.ip=127.0.0.1"),
        *(f"--ServerApp.port={port}", "--ServerApp.port_retries=0", "--ServerApp.log_level=WARN"),
        *("--ServerApp.certfile=", "--ServerApp.keyfile=", "--ServerApp.sock="),
        *(["--allow-root"] if is_root() else []),
        # On Ctrl-C it asks whether to shut down, if there is somebody who can answer.
        *([] if sys.stdin.isatty() else ["--ServerApp.answer_yes=True"]),
        *passed_on,
    ]


def is_root() -> bool:
    """Tell whether this runs with all rights."""
    return sys.platform != "win32" and os.geteuid() == 0


def ask(port: int, token: str) -> int:
    """Return the HTTP status with which our server answers on this port."""
    connection = HTTPConnection("127.0.0.1", port, timeout=2)
    try:
        connection.request("GET", f"/api/status?token={token}")
        return connection.getresponse().status
    except (OSError, HTTPException):
        return NO_ANSWER
    finally:
        connection.close()

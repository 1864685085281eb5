"""A port, and JupyterLab on it."""

import contextlib
import json
import os
import socket
import subprocess
import sys
import threading
from http import HTTPStatus
from http.client import HTTPConnection, HTTPException

from starter import processes
from starter.errors import WorkbookError
from starter.paths import ON_WINDOWS, ROOT, VENV, VENV_PYTHON

DEFAULT_PORT = 8888
PORTS = range(1, 65536)
SETTINGS = VENV / "share" / "jupyter" / "lab" / "settings" / "overrides.json"
DEFAULTS = {
    # A notebook that is opened again the next day shows its sliders as they were left.
    "@jupyter-widgets/jupyterlab-manager:plugin": {"saveState": True},
    # No question about news at the first start, and nothing that needs a network.
    "@jupyterlab/apputils-extension:notification": {
        "fetchNews": "false",
        "checkForUpdates": False,
    },
}


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


def start(port: int, token: str, passed_on: list[str]) -> "subprocess.Popen[str]":
    """Start JupyterLab and return when it answers; raise if it ends before that."""
    write_settings()
    process = subprocess.Popen(
        command(port, passed_on),
        env={**os.environ, "JUPYTER_TOKEN": token},
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
        processes.wait_until(
            lambda: process.poll() is not None or answers(port, token), lambda: "not ready yet"
        )
        if process.poll() is not None:
            reader.join(1)
            reason = f"JupyterLab ended (code {process.returncode}) before it was ready."
            raise WorkbookError(processes.tail(lines) + reason)
    except BaseException:
        processes.stop(process)
        raise
    ready.set()
    return process


def write_settings() -> None:
    """Set JupyterLab's defaults for this environment; the learner can still change them."""
    with contextlib.suppress(PermissionError):  # a .venv that the teacher has closed will do
        SETTINGS.parent.mkdir(parents=True, exist_ok=True)
        SETTINGS.write_text(json.dumps(DEFAULTS, indent=2), encoding="utf-8")


def command(port: int, passed_on: list[str]) -> list[str]:
    """Return the command that starts JupyterLab for this folder."""
    return [
        *(str(VENV_PYTHON), "-m", "jupyterlab", "--no-browser"),
        *(f"--ServerApp.root_dir={ROOT}", "--ServerApp.base_url=/", "--ServerApp.ip=127.0.0.1"),
        *(f"--ServerApp.port={port}", "--ServerApp.port_retries=0", "--ServerApp.log_level=WARN"),
        *(["--allow-root"] if is_root() else []),
        # On Ctrl-C it asks whether to shut down, if there is somebody who can answer.
        *([] if sys.stdin.isatty() else ["--ServerApp.answer_yes=True"]),
        *passed_on,
    ]


def is_root() -> bool:
    """Tell whether this runs with all rights."""
    return sys.platform != "win32" and os.geteuid() == 0


def answers(port: int, token: str) -> bool:
    """Tell whether our server answers on this port."""
    connection = HTTPConnection("127.0.0.1", port, timeout=2)
    try:
        connection.request("GET", f"/api/status?token={token}")
        return connection.getresponse().status == HTTPStatus.OK
    except (OSError, HTTPException):
        return False
    finally:
        connection.close()

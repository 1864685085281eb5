"""How long a page waits for its kernel's answer in a plain JupyterLab."""

import asyncio
import json
import os
import secrets
import subprocess
import sys
import tempfile
import time
import uuid
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from statistics import median
from typing import Any

from findings import Finding, ratio_of_medians, say
from tornado.httpclient import AsyncHTTPClient, HTTPClientError
from tornado.websocket import WebSocketClientConnection, websocket_connect

sys.path.append(str(Path(__file__).parent.parent / "tests"))

from lab import free_port, own_folders

PATIENCE_SECONDS = 60
WARM_UP, ROUNDS = 20, 100
OFF = {"ServerApp": {"jpserver_extensions": {"cammotion.teaching.extension": False}}}
TOKEN = secrets.token_hex(24)


def measure_round_trips() -> list[Finding]:
    """Ask a kernel in a plain JupyterLab, with the package's extension and without, by turns."""
    with running_server({}) as own, running_server(OFF) as rival:
        times = asyncio.run(time_by_turns(own, rival))
    say(f"medians: with the extension {median(times[0]):.1f} ms, without {median(times[1]):.1f} ms")
    what = "round trip in a plain JupyterLab, without the extension : with it"
    return [Finding(what, ratio_of_medians(times[1], times[0]), 3, "x", True)]


@contextmanager
def running_server(config: dict[str, Any]) -> Iterator[str]:
    """Start JupyterLab with nothing of the workbook's starter, and give its address."""
    with tempfile.TemporaryDirectory() as home:
        (Path(home) / "jupyter_server_config.json").write_text(json.dumps(config))
        port = free_port()
        command = [sys.executable, "-m", "jupyterlab", "--no-browser", "--allow-root"]
        server = subprocess.Popen(
            [*command, f"--port={port}", "--Application.log_level=ERROR"],
            env=os.environ
            | own_folders(Path(home))
            | {"JUPYTER_CONFIG_PATH": home, "JUPYTER_TOKEN": TOKEN},
            cwd=home,
            stdout=sys.stderr,
        )
        try:
            yield f"127.0.0.1:{port}"
        finally:
            server.terminate()
            server.wait(PATIENCE_SECONDS)


async def time_by_turns(*servers: str) -> list[list[float]]:
    """Ask a kernel of each server, by turns, and return the times in ms."""
    pages = [await open_page(server) for server in servers]
    times: list[list[float]] = [[] for _ in pages]
    for _ in range(WARM_UP + ROUNDS):
        for page, spent in zip(pages, times, strict=True):
            started = time.perf_counter()
            await asyncio.wait_for(ask(page), PATIENCE_SECONDS)
            spent.append((time.perf_counter() - started) * 1000)
    return [spent[WARM_UP:] for spent in times]


async def open_page(server: str) -> WebSocketClientConnection:
    """Start a kernel as soon as the server answers, and open the socket that leads to it."""
    kernels, headers = f"{server}/api/kernels", {"Authorization": f"token {TOKEN}"}
    end = time.monotonic() + PATIENCE_SECONDS
    while True:
        try:
            started = await AsyncHTTPClient().fetch(
                f"http://{kernels}", method="POST", headers=headers, body="{}"
            )
            break
        except (OSError, HTTPClientError):
            if time.monotonic() > end:
                raise
            await asyncio.sleep(0.1)
    kernel = json.loads(started.body)["id"]
    return await websocket_connect(f"ws://{kernels}/{kernel}/channels?token={TOKEN}")


async def ask(page: WebSocketClientConnection) -> None:
    """Ask the kernel what it is; return when it has answered and rests."""
    number = uuid.uuid4().hex
    header = {"msg_id": number, "msg_type": "kernel_info_request", "session": "", "username": ""}
    question = {"header": header, "parent_header": {}, "metadata": {}, "content": {}}
    await page.write_message(json.dumps({"channel": "shell", **question}))
    awaited = {"kernel_info_reply", "idle"}
    while awaited:
        said = json.loads(await page.read_message() or "{}")
        if said["parent_header"].get("msg_id") == number:
            awaited -= {said["msg_type"], said["content"].get("execution_state")}

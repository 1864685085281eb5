"""A student of a hub, as far as the hub can tell: login form, cookies, kernel's websocket."""

import json
import re
import time
import uuid
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any
from urllib.parse import parse_qs, quote, urlsplit

import requests
import websocket
from hub import PATIENCE_SECONDS, Account, Hub, processor_s, proportional_mb

PAUSE_SECONDS = 0.3
SERVER, KERNEL = "jupyterhub-singleuser", "ipykernel_launcher"
OUTPUTS = ("stream", "display_data", "execute_result", "error")
GONE = (requests.codes.failed_dependency, requests.codes.service_unavailable)
MOVED = 0.999  # a slider, times this


class Student:
    """Somebody who opens the link that the teacher has given."""

    def __init__(self, hub: Hub, account: Account) -> None:
        self.hub, self.account = hub, account
        self.base = f"/user/{account.name}/"
        self.browser = requests.Session()
        self.told_to_wait = 0

    def log_in(self) -> None:
        """Fill in the hub's form of login."""
        page = self.browser.get(f"{self.hub.address}/hub/login", timeout=PATIENCE_SECONDS)
        hidden = re.findall(r'name="_xsrf" value="([^"]+)"', page.text)[0]
        form = {"username": self.account.name, "password": self.account.password}
        page = self.browser.post(page.url, {**form, "_xsrf": hidden}, allow_redirects=False)
        assert page.status_code == requests.codes.found, page.text

    def open(self, address: str) -> str:
        """Open a page of the hub, and wait for the server as a browser does; return its address."""
        asked, end = address, time.monotonic() + PATIENCE_SECONDS
        while time.monotonic() < end:
            page = self.browser.get(asked, timeout=PATIENCE_SECONDS)
            if page.status_code == requests.codes.too_many_requests:
                self.told_to_wait += 1
                time.sleep(float(page.headers["Retry-After"]))
            elif page.status_code in GONE:  # the page has a button that starts it again
                next_ = quote(address.removeprefix(self.hub.address), safe="")
                asked = f"{self.hub.address}/hub/spawn/{self.account.name}?next={next_}"
                time.sleep(PAUSE_SECONDS)
            elif "/spawn-pending/" in page.url:  # it starts, or stops
                time.sleep(PAUSE_SECONDS)
            else:
                page.raise_for_status()
                return page.url
        raise TimeoutError(f"{self.account.name} got no server for {address}")

    def pull(self) -> str:
        """Follow the teacher's link to its end; return the path of the notebook that it opens."""
        asked = urlsplit(self.open(self.hub.link))
        assert asked.path == f"{self.base}git-pull"
        said = self._get(f"git-pull/api?{asked.query}")
        assert '"phase": "finished"' in said.text, said.text
        return parse_qs(asked.query)["urlpath"][0].removeprefix("lab/tree/")

    def ask(self, path: str, method: str = "GET", content: Any = None) -> Any:
        """Ask the student's own server, as its page does."""
        token = self.browser.cookies.get("_xsrf", path=self.base)
        answer = self.browser.request(
            method,
            f"{self.hub.address}{self.base}{path}",
            json=content,
            headers={"X-XSRFToken": str(token)},
            timeout=PATIENCE_SECONDS,
        )
        answer.raise_for_status()
        return answer.json()

    def _get(self, path: str) -> requests.Response:
        return self.browser.get(f"{self.hub.address}{self.base}{path}", timeout=PATIENCE_SECONDS)

    def read(self, path: str) -> Any:
        """Return what a notebook, or another file, holds."""
        return self.ask(f"api/contents/{path}")["content"]

    def save(self, path: str, notebook: object) -> None:
        """Save a notebook, as Ctrl-S does."""
        model = {"type": "notebook", "format": "json", "content": notebook}
        self.ask(f"api/contents/{path}", "PUT", model)

    @contextmanager
    def kernel(self, path: str) -> Iterator["Kernel"]:
        """Start the kernel of a notebook, or find it; connect a page with it."""
        asked = {"path": path, "name": path, "type": "notebook", "kernel": {"name": "python3"}}
        number = self.ask("api/sessions", "POST", asked)["kernel"]["id"]
        socket = websocket.create_connection(
            f"ws{self.hub.address.removeprefix('http')}{self.base}api/kernels/{number}/channels"
            f"?session_id={uuid.uuid4().hex}",
            cookie="; ".join(f"{each.name}={each.value}" for each in self.browser.cookies),
            timeout=PATIENCE_SECONDS,
        )
        try:
            yield Kernel(socket)
        finally:
            socket.close()

    def memory_mb(self) -> dict[str, float]:
        """Return what the student's server and kernels take of the memory, in MB."""
        return {
            command: sum(map(proportional_mb, self.account.processes(command)))
            for command in (SERVER, KERNEL)
        }

    def processor_s(self) -> float:
        """Return how long the student's server and kernels have had a processor, in s."""
        return sum(map(processor_s, self.account.processes()))


class Kernel:
    """A kernel at the other end of a websocket, and the live figures that it has shown."""

    def __init__(self, socket: websocket.WebSocket) -> None:
        self.socket = socket
        self.figures: dict[str, list[float]] = {}
        """The settings of each figure with sliders, by the name of its model."""
        self.followed = 0

    def run(self, code: str) -> list[dict[str, Any]]:
        """Run a cell and return its outputs, as a notebook stores them."""
        content = {"code": code, "silent": False, "store_history": True, "allow_stdin": False}
        said = self._ask("execute_request", content, {"idle", "execute_reply"})
        return [as_output(message) for message in said if message["msg_type"] in OUTPUTS]

    def move_figures(self) -> None:
        """Move the first slider of each figure a little, and wait until Python has followed."""
        for model, settings in self.figures.items():
            settings[0] *= MOVED
            state = {"method": "update", "state": {"settings": settings}, "buffer_paths": []}
            self._ask("comm_msg", {"comm_id": model, "data": state}, {"idle"})

    def _ask(self, kind: str, content: Any, awaited: set[str]) -> list[dict[str, Any]]:
        """Send a message, and return what is said of it until all that is awaited has come."""
        number, said = uuid.uuid4().hex, []
        header = {
            "msg_id": number,
            "msg_type": kind,
            "version": "5.3",
            "session": "",
            "username": "",
        }
        asked = {"header": header, "parent_header": {}, "metadata": {}, "content": content}
        self.socket.send(json.dumps({"channel": "shell", **asked}))
        while awaited:
            heard = self.socket.recv()
            if isinstance(heard, bytes):  # numbers of a widget: nothing that is waited for
                continue
            message = json.loads(heard)
            if message["parent_header"].get("msg_id") == number:
                self._notice(message["msg_type"], message["content"])
                awaited = awaited - {message["msg_type"], message["content"].get("execution_state")}
                said.append(message)
        return said

    def _notice(self, kind: str, content: dict[str, Any]) -> None:
        data = content.get("data", {}) if kind.startswith("comm_") else {}
        settings = data.get("state", {}).get("settings")
        if kind == "comm_open" and settings:
            self.figures[content["comm_id"]] = list(settings)
        self.followed += data.get("method") == "echo_update" and settings is not None


def as_output(message: dict[str, Any]) -> dict[str, Any]:
    """Return what a message shows, as a notebook stores it."""
    content = {key: value for key, value in message["content"].items() if key != "transient"}
    return {"output_type": message["msg_type"], **content}

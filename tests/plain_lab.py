"""Start a plain JupyterLab with a kernel, say how it connects a page with it, and end.

``python tests/plain_lab.py`` with options of `jupyter lab` prints the name of the class, and
whether its socket sends small messages at once.
"""

import asyncio
import json
import socket
import sys
from typing import Any

from jupyter_server.serverapp import ServerApp
from jupyter_server.services.kernels.connection.channels import ZMQChannelsWebsocketConnection
from jupyterlab.labapp import LabApp  # type: ignore[import-untyped]
from tornado.websocket import websocket_connect

OPTIONS = ["--no-browser", "--allow-root", "--port=0", "--ServerApp.ip=127.0.0.1"]


async def connect(server: ServerApp) -> None:
    """Open the socket that a page would open, print how the server treats it, and end both."""
    try:
        kernel = await server.kernel_manager.start_kernel()
        page = await websocket_connect(
            f"ws://127.0.0.1:{server.port}/api/kernels/{kernel}/channels"
            f"?session_id=test&token={server.identity_provider.token}"
        )
        while not ZMQChannelsWebsocketConnection._open_sockets:
            await asyncio.sleep(0.01)
        connection: Any = next(iter(ZMQChannelsWebsocketConnection._open_sockets))
        peer = connection.websocket_handler.ws_connection.stream.socket
        at_once = peer.getsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY) != 0
        print(json.dumps([type(connection).__name__, at_once]))
        page.close()
    finally:
        server.stop()


def main() -> None:
    """Start JupyterLab as its command does."""
    server = LabApp.initialize_server(argv=[*OPTIONS, *sys.argv[1:]])
    server.io_loop.add_callback(connect, server)
    server.start()


if __name__ == "__main__":
    main()

"""What JupyterLab's server does otherwise for the workbook: it sends small messages at once.

The starter names `PromptConnection` to it, as its ``kernel_websocket_connection_class``.
"""

from typing import Any

from jupyter_server.services.kernels.connection.channels import ZMQChannelsWebsocketConnection


class PromptConnection(ZMQChannelsWebsocketConnection):
    """The connection between a page and its kernel, without TCP's wish for larger packets.

    Left to itself TCP holds back a message until the one before it is acknowledged, which costs
    about 40 ms for each tick of a slider.
    """

    def connect(self) -> Any:
        """Connect, and send every message at once from now on."""
        self.websocket_handler.set_nodelay(True)
        return super().connect()

"""What a Jupyter server does otherwise for the workbook: it sends small messages at once.

The extension beside it puts `PromptConnection` in the place of the server's own class.
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
        try:
            self.websocket_handler.set_nodelay(True)
        except Exception as error:  # a slow connection is better than none
            self.log.warning("Small messages of this kernel may be 40 ms late (%r).", error)
        return super().connect()

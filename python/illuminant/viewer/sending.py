"""Pictures on their way to the browser: made, encoded and sent by a thread of their own, the latest alone.

A picture of a million pixels takes a tenth of a second to be shown as codes and encoded. Meanwhile the refiner renders
on, and a change ends its work at once; of pictures that come faster than they are sent the older ones are left out.

PNG as here: each row less the one above (filter 2), then Huffman codes of runs. In noise there is little else to find:
it takes a tenth of the time of the usual search for repetitions, and the file is as large within 1 %.
"""

from __future__ import annotations

import struct
import threading
import zlib
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Codes = NDArray[np.uint8]

__all__ = ["Sender", "background", "encoded"]

_COLOUR_TYPE = {3: 2, 4: 6}
_UP = 2


def encoded(codes: Codes) -> bytes:
    """A picture as PNG, quickly.

    Args:
        codes: (h, w, 3), or with alpha (h, w, 4).

    Example:
        >>> import numpy as np
        >>> encoded(np.zeros((2, 3, 3), np.uint8))[1:4]
        b'PNG'
    """
    import numpy as np

    height, width, channels = codes.shape
    flat = np.ascontiguousarray(codes).reshape(height, width * channels)
    rows = np.empty((height, 1 + width * channels), np.uint8)
    rows[:, 0] = _UP
    rows[0, 1:] = flat[0]
    np.subtract(flat[1:], flat[:-1], out=rows[1:, 1:])
    packer = zlib.compressobj(1, zlib.DEFLATED, 15, 9, zlib.Z_RLE)
    data = packer.compress(rows.tobytes()) + packer.flush()
    header = struct.pack(">IIBBBBB", width, height, 8, _COLOUR_TYPE[channels], 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + _chunk(b"IHDR", header) + _chunk(b"IDAT", data) + _chunk(b"IEND", b"")


def _chunk(name: bytes, data: bytes) -> bytes:
    check = zlib.crc32(data, zlib.crc32(name))
    return struct.pack(">I", len(data)) + name + data + struct.pack(">I", check)


def background(client: Any, png: bytes, depth: NDArray[np.floating[Any]] | None = None) -> None:
    """Show a PNG behind all else; `set_background_image` of viser would encode it by itself, ten times slower.

    Args:
        client: viser's handle of the page.
        png: as `encoded` makes it.
        depth: how far away the picture is (h, w), metres, if it shall hide lines.
    """
    from viser import _messages

    far = None
    if depth is not None:
        import numpy as np

        # As viser's page reads it: hundred-thousandths of a metre in 24 bits, the highest in red.
        steps = np.clip(depth * 100_000, 0, 2**24 - 1).astype("<u4")
        far = encoded(steps[..., None].view(np.uint8)[..., [2, 1, 0, 3]])
    client.scene._websock_interface.queue_message(
        _messages.BackgroundImageMessage(format="png", rgb_data=png, depth_data=far)
    )


class Sender:
    """A thread that does one thing whenever it is asked, and once for all that is asked meanwhile.

    Args:
        send: what it does.
        say: takes a sentence on what went wrong.

    Example:
        >>> done = threading.Event()
        >>> sender = Sender(done.set, print)
        >>> sender.ask()
        >>> done.wait(5.0)
        True
        >>> sender.close()
    """

    def __init__(self, send: Callable[[], object], say: Callable[[str], object]) -> None:
        self._send, self._say = send, say
        self._asked = threading.Event()
        self._closed = False
        self._thread = threading.Thread(target=self._loop, name="illuminant sender", daemon=True)
        self._thread.start()

    def ask(self) -> None:
        """Do it soon; this returns at once."""
        self._asked.set()

    def close(self) -> None:
        """End the thread, after what it is doing."""
        self._closed = True
        self._asked.set()
        if threading.current_thread() is not self._thread:
            self._thread.join(timeout=10.0)

    def _loop(self) -> None:
        from illuminant.errors import Error

        while True:
            self._asked.wait()
            self._asked.clear()
            if self._closed:
                return
            try:
                self._send()
            except Error as error:
                self._say(str(error))
            except Exception as error:  # the page shall show it, and the next picture shall be sent
                self._say(f"{type(error).__name__}: {error}")

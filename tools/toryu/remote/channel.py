"""Messages between a run and a host over two streams: a line of JSON, then as many bytes as it says."""

import contextlib
import json
import os
import select
import threading
import time

PULSE = 1.0  # [s] between signs of life
PIECE = 1 << 18  # [bytes] of a file in one message


class ChannelClosed(Exception):
    """The other end, or what leads to it, is gone."""


class Silence(Exception):
    """Nothing was heard for longer than a living other end is silent."""


class Channel:
    def __init__(self, incoming, outgoing):
        """`incoming` and `outgoing` are file descriptors."""
        self.incoming, self.outgoing = incoming, outgoing
        self.unread = bytearray()
        self.heard = time.monotonic()  # when something came last
        self.sending = threading.Lock()

    def send(self, kind, data=b"", **content):
        """Raises ChannelClosed."""
        head = json.dumps({"kind": kind, "size": len(data), **content}).encode() + b"\n"
        with self.sending:
            left = memoryview(head + data)
            try:
                while left:
                    left = left[os.write(self.outgoing, left):]
            except OSError as error:
                raise ChannelClosed(error.strerror) from error

    def skip_to(self, mark, limit):
        """Passes over what comes before `mark`, within `limit` [s]. Raises as `receive` does."""
        end = time.monotonic() + limit
        while (at := self.unread.find(mark)) < 0:
            self._read_more(max(0.0, end - time.monotonic()))
        del self.unread[:at + len(mark)]

    def receive(self, limit):
        """The next message that is more than a sign of life, and its bytes. Raises Silence after `limit` [s]."""
        while True:
            while (end := self.unread.find(b"\n")) < 0:
                self._read_more(limit)
            message = head_of(bytes(self.unread[:end]))
            while len(self.unread) < end + 1 + message["size"]:
                self._read_more(limit)
            data = bytes(self.unread[end + 1:end + 1 + message["size"]])
            del self.unread[:end + 1 + message["size"]]
            if message["kind"] != "alive":
                return message, data

    def _read_more(self, limit):
        if not select.select([self.incoming], [], [], limit)[0]:
            raise Silence
        piece = os.read(self.incoming, PIECE)
        if not piece:
            raise ChannelClosed("")
        self.unread += piece
        self.heard = time.monotonic()


def head_of(line):
    """Raises ChannelClosed for what is no message: it does not come from who sends them."""
    try:
        message = json.loads(line)
        if isinstance(message["kind"], str) and message["size"] >= 0:
            return message
    except (ValueError, TypeError, KeyError):
        pass
    raise ChannelClosed(f"it said '{line.decode(errors='replace').strip()}'")


def keep_alive(channel):
    """Gives a sign of life now and then, for as long as the channel is there."""
    def pulse():
        with contextlib.suppress(ChannelClosed):
            while True:
                channel.send("alive")
                stop.wait(PULSE)

    stop = threading.Event()
    threading.Thread(target=pulse, daemon=True).start()

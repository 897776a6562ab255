"""A robot's camera: its frames from the server's memory where that is on this machine, else by calls."""

from __future__ import annotations

import mmap
import os
import struct
import time
from typing import TYPE_CHECKING, Iterator

import numpy as np

from . import forks
from . import uchilsim_pb2 as pb
from .errors import Error, NotNow, sentences

if TYPE_CHECKING:
    from .client import Client

_LAYOUT = 1
_HEAD = struct.Struct("=8s4IQ")      #: magic, layout, slots, where the first begins, bytes of one; mark
_SLOT = struct.Struct("=Qqq4I")      #: sequence; number, period; width, height, bytes of rgb, of classes
_SLOT_HEAD = 64
_ASKED_AGAIN_S = 1.0                 # so that the server sees that somebody still looks
_LOOK_S = 0.0005


class Frame:
    """A frame and which it is. picture: array (height, width, 3) of uint8."""

    __slots__ = ("number", "period", "picture")

    def __init__(self, number: int, period: int, picture: np.ndarray):
        self.number, self.period, self.picture = number, period, picture


class SharedFrames:
    """The server's memory with the last frames of a camera, see PictureMemoryReply in uchilsim.proto.

    Raises OSError or ValueError where it cannot be opened or is not what the server said."""

    def __init__(self, file: str, size: int, mark: int, layout: int):
        if layout != _LAYOUT:
            raise ValueError(f"{file}: layout {layout} is not known")
        descriptor = os.open(file, os.O_RDONLY | os.O_CLOEXEC | os.O_NONBLOCK)
        try:
            if os.fstat(descriptor).st_size < size:
                raise ValueError(f"{file}: it is smaller than the server says")
            self._memory = mmap.mmap(descriptor, size, mmap.MAP_SHARED, mmap.PROT_READ)
        finally:
            os.close(descriptor)
        magic, own_layout, self._slots, self._first, self._slot_bytes, own_mark = _HEAD.unpack_from(self._memory, 0)
        if magic != b"UCHIRING" or own_layout != layout or own_mark != mark:
            raise ValueError(f"{file}: it is not what the server said")
        if self._slots < 2 or self._slot_bytes < _SLOT_HEAD or self._first + self._slots * self._slot_bytes > size:
            raise ValueError(f"{file}: its parts are larger than it")
        self._newest = np.frombuffer(self._memory, np.int64, 1, 32)
        self._closed = np.frombuffer(self._memory, np.uint32, 1, 40)
        self._sequences = [np.frombuffer(self._memory, np.uint64, 1, self._first + i * self._slot_bytes)
                           for i in range(self._slots)]
        self.file, self.mark = file, mark

    @property
    def is_open(self) -> bool:
        """False once no more frames come, or the process that wrote them is gone."""
        return not self._closed[0] and os.path.exists(self.file)

    @property
    def newest(self) -> int:
        """The number of the last whole frame; 0 before the first."""
        return int(self._newest[0])

    def frame(self, number: int) -> Frame | None:
        """A copy of a frame; None if it is not there (any more)."""
        slot = number % self._slots
        begin = self._first + slot * self._slot_bytes
        before = int(self._sequences[slot][0])
        _, own, period, width, height, rgb, _ = _SLOT.unpack_from(self._memory, begin)
        if before % 2 == 1 or own != number or rgb != 3 * width * height or rgb > self._slot_bytes - _SLOT_HEAD:
            return None
        picture = np.frombuffer(self._memory, np.uint8, rgb, begin + _SLOT_HEAD).copy()
        if int(self._sequences[slot][0]) != before:
            return None
        return Frame(number, period, picture.reshape(height, width, 3))

    def after(self, number: int) -> Frame | None:
        """The next frame after this one, or the oldest that is sure to stay for a while; the newest after 0."""
        for _ in range(100):  # lapped so often by its writer: later
            newest = self.newest
            if newest <= number:
                break
            oldest = newest if number == 0 else newest - self._slots + 2
            frame = self.frame(max(number + 1, oldest))
            if frame is not None:
                return frame
        return None


class Camera:
    """One robot's camera of a world."""

    def __init__(self, client: "Client", world: str, robot: str):
        self._client, self._world, self._robot = client, world, robot
        self._shared: SharedFrames | None = None
        self._can_share = client.shared_pictures
        self._asked_s = 0.0

    @property
    def is_shared(self) -> bool:
        """True while frames come from the server's memory."""
        return self._shared is not None

    def _memory(self) -> SharedFrames | None:
        """The server's memory; None while it has no frame, or where this client cannot read it."""
        if not self._can_share:
            return None
        now = time.monotonic()
        if self._shared is not None and now - self._asked_s < _ASKED_AGAIN_S and self._shared.is_open:
            return self._shared
        self._asked_s = now
        request = pb.PictureMemoryRequest(world=self._world, robot=self._robot)
        try:
            reply = self._client._call(self._client._worlds.PictureMemory, request)
            if not reply.file:
                self._shared = None
            elif self._shared is None or self._shared.mark != reply.mark:
                self._shared = SharedFrames(reply.file, reply.bytes, reply.mark, reply.layout)
        except (OSError, ValueError, NotNow) as error:
            if isinstance(error, Error) and not isinstance(error, NotNow):
                raise
            self._stop_sharing()  # another machine, user or container
        except Error as error:
            if type(error) is not Error:
                raise
            self._stop_sharing()  # an older server
        return self._shared

    def _stop_sharing(self) -> None:
        self._can_share, self._shared = False, None

    def last(self) -> Frame | None:
        """The last frame; None if there is none yet."""
        shared = self._memory()
        if shared is not None and (frame := shared.after(0)) is not None:
            return frame
        reply = self._client._call(self._client._worlds.Picture,
                                   pb.PictureRequest(world=self._world, robot=self._robot))
        return self._frame(reply) if reply.number else None

    def frames(self) -> Iterator[Frame]:
        """Each new frame as it comes."""
        last = 0
        while True:
            shared = self._memory()
            if not self._can_share:
                yield from self._streamed(last)
                return
            frame = shared.after(last) if shared is not None else None
            if frame is None:
                time.sleep(_LOOK_S if shared is not None else 10 * _LOOK_S)
                continue
            last = frame.number
            yield frame

    def _streamed(self, after: int) -> Iterator[Frame]:
        stream = self._client._worlds.Pictures(
            pb.PictureRequest(world=self._world, robot=self._robot, after=after), metadata=self._client._metadata)
        forks.keep(stream)
        try:
            with sentences(self._client.address):
                for reply in stream:
                    yield self._frame(reply)
        finally:
            stream.cancel()

    @staticmethod
    def _frame(reply) -> Frame:
        picture = np.frombuffer(reply.rgb, np.uint8).reshape(reply.height, reply.width, 3).copy()  # the caller's own
        return Frame(reply.number, reply.period, picture)

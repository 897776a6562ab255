"""Processes that are forked, as multiprocessing does it on Linux by itself. gRPC's threads are not in the new process, and
its locks may be held for ever; its own remedy can stop the old one, too. So a connection stays with the process that made
it, and in one that was forked behind it the next call says what to do instead of waiting without end.
"""

from __future__ import annotations

import ctypes
import os
import weakref
from typing import Any

# Read by gRPC as it begins. Who sets it to 1 has chosen gRPC's remedy.
_SWITCH = "GRPC_ENABLE_FORK_SUPPORT"
_remedied = os.environ.setdefault(_SWITCH, "0").lower() in ("1", "yes", "true")

_connections: weakref.WeakSet = weakref.WeakSet()  # also what is under way on them
_used = False     # in this process
_spoiled = False  # this one was forked from one in which gRPC was at work


def _begin_anew() -> None:
    global _spoiled
    _spoiled = _used and not _remedied
    if _spoiled:
        for each in list(_connections):  # their ends would speak to the server in the old process's name
            ctypes.pythonapi.Py_IncRef(ctypes.py_object(each))


os.register_at_fork(after_in_child=_begin_anew)


def begin() -> None:
    """Before a connection is made. Raises NotNow where it could not work."""
    global _used
    if _spoiled:
        from .errors import NotNow  # which imports gRPC
        raise NotNow("gRPC does not work in a process that was forked from one that uses it; start processes with "
                     "multiprocessing.get_context(\"spawn\"), or before the first Client")
    _used = True


def keep(connection: Any) -> None:
    """A connection, or what is under way on one, that a forked process must not end."""
    _connections.add(connection)


def is_own(process: int) -> bool:
    """process: os.getpid() as a connection was made."""
    return process == os.getpid()


def check(process: int) -> None:
    """Before a connection is used; process: as above."""
    if not is_own(process):
        from .errors import NotNow
        raise NotNow("this client belongs to the process that this one was forked from; make a Client in each process, "
                     "started with multiprocessing.get_context(\"spawn\")")

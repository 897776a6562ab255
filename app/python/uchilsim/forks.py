"""Processes that are forked, as multiprocessing does it on Linux by itself. gRPC can begin anew in one, but only if it was
told so before it was imported; else whatever is asked there waits for ever, and spoils the parent's connection."""

from __future__ import annotations

import os
import sys

_SWITCH = "GRPC_ENABLE_FORK_SUPPORT"
_came_in_time = "grpc" not in sys.modules or _SWITCH in os.environ
_begins_anew = _came_in_time and os.environ.setdefault(_SWITCH, "1").lower() in ("1", "yes", "true")
_forked = False


def _mark() -> None:
    global _forked
    _forked = True


os.register_at_fork(after_in_child=_mark)


def check_new() -> None:
    """Before a connection is made. Raises NotNow where it could not work."""
    if _forked and not _begins_anew:
        from .errors import NotNow  # which imports gRPC
        raise NotNow("gRPC was imported before uchilsim and does not work in a process that was forked; import uchilsim "
                     "first, or start processes with multiprocessing.get_context(\"spawn\")")


def check_made(process: int) -> None:
    """Before a connection is used; process: os.getpid() as it was made."""
    if process != os.getpid():
        from .errors import NotNow
        raise NotNow("this client belongs to the process that this one was forked from; make a Client in each process")

"""What can go wrong, each with the server's one sentence: place, value, what is allowed."""

from __future__ import annotations

import contextlib
from typing import Iterator

import grpc


class Error(RuntimeError):
    """Any call that failed."""


class Refused(Error, ValueError):
    """Something in the call is not allowed."""


class NotFound(Error, LookupError):
    """No such world, run or individual."""


class NoChannel(NotFound, KeyError):
    """A state has no number of that name."""

    __str__ = Exception.__str__  # KeyError's quotes a sentence


class NotNow(Error):
    """Right in itself, but not now."""


class NoAccess(Error, PermissionError):
    """No token, a wrong one, or one whose role may not do this."""


class TooMuch(Error):
    """More than the server allows: calls a second, worlds, bytes."""


class TooLate(Error, TimeoutError):
    """No answer in time."""


class Unreachable(Error, ConnectionError):
    """No server, or the process of a world has ended."""


_KINDS = {
    grpc.StatusCode.INVALID_ARGUMENT: Refused,
    grpc.StatusCode.NOT_FOUND: NotFound,
    grpc.StatusCode.FAILED_PRECONDITION: NotNow,
    grpc.StatusCode.UNAUTHENTICATED: NoAccess,
    grpc.StatusCode.PERMISSION_DENIED: NoAccess,
    grpc.StatusCode.RESOURCE_EXHAUSTED: TooMuch,
    grpc.StatusCode.DEADLINE_EXCEEDED: TooLate,
    grpc.StatusCode.UNAVAILABLE: Unreachable,
}


_NOBODY = ("failed to connect", "DNS resolution failed", "Endpoint closing", "Socket closed", "recvmsg:")

# Somebody is there, but the connection is not made: what gRPC says of it, and what to do.
_NOT_LET_IN = {
    "Socket closed": "who listens there lets nobody in without TLS, or is no server; one with --tls wants certificate=FILE",
    "wrong version number": "the server there does without TLS; leave out certificate",
    "is not in peer certificate": "the server's certificate is for another name; connect to one of its subjectAltName",
    "certificate verify failed": "the server's certificate is another one; copy the file that it has as --tls",
}


def _why_not(details: str) -> str:
    if details.startswith("failed to connect"):
        for said, why in _NOT_LET_IN.items():
            if details.endswith(said):
                return why
    return "no server answers there; start one with btr serve"


def error_of(error: grpc.RpcError, address: str = "") -> Error:
    """The package's error for one of gRPC's. address: of the server, for the sentence that it does not answer."""
    details = error.details() or ""
    if address and error.code() == grpc.StatusCode.UNAVAILABLE and details.startswith(_NOBODY):
        return Unreachable(f"{address}: {_why_not(details)}")
    if error.code() == grpc.StatusCode.DEADLINE_EXCEEDED and details == "Deadline Exceeded":
        return TooLate(f"{address}: no answer in the time that the call had; see timeout")
    if error.code() == grpc.StatusCode.UNIMPLEMENTED and not details:
        return Error(f"{address}: this server does not know this call: it has another version than this package")
    if "channel closed" in details.lower():
        return NotNow("the client was closed while it waited for an answer")
    return _KINDS.get(error.code(), Error)(details or str(error.code()))


def client_closed() -> NotNow:
    return NotNow("the client is closed; make a new Client")


@contextlib.contextmanager
def sentences(address: str = "") -> Iterator[None]:
    """gRPC's errors inside become this package's; see error_of()."""
    try:
        yield
    except grpc.RpcError as error:
        raise error_of(error, address) from None
    except ValueError as error:
        if "closed channel" not in str(error).lower() and "channel closed" not in str(error).lower():
            raise
        raise client_closed() from None

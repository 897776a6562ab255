"""What a caller gave, checked before it is sent: each error is one sentence with place, value and what is allowed."""

from __future__ import annotations

import operator
import pathlib
from typing import Any, Sequence

import numpy as np

from .errors import Refused

_LONGEST = 60  # characters of a value in a sentence


def short(value: Any) -> str:
    """A value as a sentence shows it."""
    text = " ".join(repr(value).split())
    return text if len(text) <= _LONGEST else text[:_LONGEST] + "…"


def _allowed(field) -> str:
    kinds = {field.CPPTYPE_INT32: "a whole number", field.CPPTYPE_INT64: "a whole number",
             field.CPPTYPE_UINT32: "a whole number from 0 on", field.CPPTYPE_UINT64: "a whole number from 0 on",
             field.CPPTYPE_DOUBLE: "a number", field.CPPTYPE_FLOAT: "a number", field.CPPTYPE_BOOL: "True or False",
             field.CPPTYPE_STRING: "a text"}
    kind = kinds.get(field.cpp_type, "a message of the schema")
    if field.label == field.LABEL_REPEATED and field.message_type is None:
        return f"a sequence, each {kind}"
    return "a dictionary" if field.label == field.LABEL_REPEATED else kind


def made(kind, **fields):
    """A message of the schema; Refused with the first field whose value it cannot have."""
    try:
        return kind(**fields)
    except (TypeError, ValueError, OverflowError, AttributeError):
        for name, value in fields.items():
            try:
                kind(**{name: value})
            except (TypeError, ValueError, OverflowError, AttributeError):
                allowed = _allowed(kind.DESCRIPTOR.fields_by_name[name])
                raise Refused(f"{name}: {short(value)} is not allowed; {allowed}") from None
        raise


def numbers(what: str, values: Any, allowed: str) -> np.ndarray:
    """As an array of numbers, of any shape."""
    try:
        if np.iscomplexobj(values):
            raise TypeError
        return np.asarray(values, dtype=float)
    except (TypeError, ValueError):
        raise Refused(f"{what}: {short(values)} is not allowed; {allowed}") from None


def targets(robot: str, values: Any, joints: int | None, periods: int) -> np.ndarray:
    """A row of joints, or one for each period, behind each other. joints: how many the robot has, where that is known."""
    count = "joints" if joints is None else str(joints)
    allowed = f"an array ({count},) or ({periods}, {count})"
    array = numbers(f"targets of {robot}", values, allowed)
    if joints is not None:
        if array.shape not in ((joints,), (periods, joints), (periods * joints,)):
            raise Refused(f"targets of {robot}: shape {array.shape} is not allowed; {allowed}")
    return array.ravel()


def token_of(value: Any) -> str:
    """A token as it is sent; what a file has around it does not count. No sentence shows it."""
    text = value.strip() if isinstance(value, str) else ""
    if not text or not text.isascii() or not text.isprintable() or " " in text:
        raise Refused("token: what was given is not allowed; the text behind the role in the server's token file")
    return text


def certificate_of(file: Any) -> bytes:
    """What a file with a certificate contains."""
    try:
        contents = pathlib.Path(file).read_bytes()
    except (OSError, TypeError) as error:
        raise Refused(f"certificate: {short(file)} is not allowed; a file that can be read ({error})") from None
    if b"BEGIN CERTIFICATE" not in contents:
        raise Refused(f"certificate: {short(file)} is not allowed; a file with a certificate (PEM)")
    return contents


def finite(what: str, value: Any) -> float:
    """One finite number, also as an array of one."""
    try:
        array = numbers(what, value, "a finite number")
        if array.size == 1 and np.isfinite(array).all():
            return float(array.reshape(()))
    except Refused:
        pass
    raise Refused(f"{what}: {short(value)} is not allowed; a finite number")


def names(what: str, values: Any) -> list[str]:
    """A sequence of names; a single text is not one."""
    if isinstance(values, str) or not hasattr(values, "__iter__"):
        raise Refused(f"{what}: {short(values)} is not allowed; a sequence of names")
    return list(values)


def whole(what: str, value: Any, least: int) -> int:
    """A whole number, of any type that is one."""
    try:
        number = operator.index(value)
    except TypeError:
        number = int(value) if isinstance(value, float) and value.is_integer() else None
    if number is None or number < least:
        raise Refused(f"{what}: {short(value)} is not allowed; a whole number from {least} on")
    return number


def seeds(value: Any, count: int) -> Sequence[int | None]:
    """One for each of `count` environments: s, s + 1 … of a single one."""
    if value is None:
        return [None] * count
    if np.ndim(value) == 0:
        first = whole("seed", value, 0)
        return [first + i for i in range(count)]
    given = [None if s is None else whole("seed", s, 0) for s in value]
    if len(given) != count:
        raise Refused(f"seed: {len(given)} numbers is not allowed; one for each of {count} environments")
    return given

"""A number that may be chosen, as the program declares it."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Number:
    """name ends in its unit where it has one; value: what it is now, of a running controller."""

    name: str
    unit: str
    meaning: str
    minimum: float
    maximum: float
    default: float
    integer: bool = False
    choices: tuple[str, ...] = ()
    value: float | None = None

    @staticmethod
    def of(parts, with_value: bool = False) -> "Number":
        return Number(parts.name, parts.unit, parts.meaning, parts.minimum, parts.maximum, parts.by_default,
                      parts.integer, tuple(parts.choices), parts.value if with_value else None)

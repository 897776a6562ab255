"""A number that may be chosen, as the program declares it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Sequence

import numpy as np

from . import checks
from .errors import Refused


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


def lower_of(numbers: Sequence[Number]) -> np.ndarray:
    return np.array([n.minimum for n in numbers])


def upper_of(numbers: Sequence[Number]) -> np.ndarray:
    return np.array([n.maximum for n in numbers])


def clipped(numbers: Sequence[Number], vectors) -> np.ndarray:
    """Vectors (…, parameters) brought within the bounds, and whole where only whole numbers are allowed."""
    allowed = f"an array (…, {len(numbers)})"
    vectors = checks.numbers("vectors", vectors, allowed)
    if vectors.ndim == 0 or vectors.shape[-1] != len(numbers):
        raise Refused(f"vectors: shape {vectors.shape} is not allowed; {allowed}")
    vectors = np.clip(vectors, lower_of(numbers), upper_of(numbers))
    return np.where([n.integer or bool(n.choices) for n in numbers], np.round(vectors), vectors)

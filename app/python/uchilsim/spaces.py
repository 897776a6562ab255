"""Spaces of observations and actions: Gymnasium's own where it is installed, else a Box that does the same."""

from __future__ import annotations

import numpy as np

from .checks import short
from .errors import Refused


class _Box:
    """All arrays x of a shape with low ≤ x ≤ high, number by number."""

    def __init__(self, low, high, shape=None, dtype=np.float32, seed=None):
        self.dtype = np.dtype(dtype)
        if shape is None:
            shape = np.broadcast_shapes(np.shape(low), np.shape(high))
        self.shape = tuple(int(n) for n in shape)
        self.low = np.broadcast_to(np.asarray(low, self.dtype), self.shape).copy()
        self.high = np.broadcast_to(np.asarray(high, self.dtype), self.shape).copy()
        self._random = np.random.default_rng(seed)

    @property
    def np_random(self) -> np.random.Generator:
        return self._random

    @property
    def bounded_below(self) -> np.ndarray:
        return self.low > -np.inf

    @property
    def bounded_above(self) -> np.ndarray:
        return self.high < np.inf

    def is_bounded(self, manner: str = "both") -> bool:
        """manner: "below", "above" or "both"."""
        bounded = {"below": self.bounded_below, "above": self.bounded_above,
                   "both": self.bounded_below & self.bounded_above}
        if manner not in bounded:
            raise Refused(f"manner: {short(manner)} is not allowed; one of {list(bounded)}")
        return bool(np.all(bounded[manner]))

    def seed(self, seed=None):
        self._random = np.random.default_rng(seed)
        return [seed]

    def sample(self) -> np.ndarray:
        """One at random: uniform between finite bounds, exponential beyond one, normal where there is none."""
        low, high = self.low.astype(float), self.high.astype(float)
        below, above = np.isfinite(low), np.isfinite(high)
        x = self._random.normal(size=self.shape)
        tail = self._random.exponential(size=self.shape)
        x = np.where(below & ~above, low + tail, x)
        x = np.where(~below & above, high - tail, x)
        both = below & above
        x = np.where(both, self._random.uniform(np.where(both, low, 0), np.where(both, high, 1)), x)
        return x.astype(self.dtype)

    def contains(self, x) -> bool:
        x = np.asarray(x)
        return bool(np.can_cast(x.dtype, self.dtype, "same_kind") and x.shape == self.shape
                    and np.all(x >= self.low) and np.all(x <= self.high))

    __contains__ = contains

    def __eq__(self, other) -> bool:
        return (isinstance(other, _Box) and self.shape == other.shape and self.dtype == other.dtype
                and np.array_equal(self.low, other.low) and np.array_equal(self.high, other.high))

    def __repr__(self) -> str:
        return f"Box({self.low.min(initial=np.inf)}, {self.high.max(initial=-np.inf)}, {self.shape}, {self.dtype})"


try:
    import gymnasium as _gymnasium
    from gymnasium.spaces import Box
    EnvBase = _gymnasium.Env
    VectorEnvBase = _gymnasium.vector.VectorEnv
except ImportError:
    _gymnasium = None
    Box = _Box
    EnvBase = object
    VectorEnvBase = object


def autoreset_next_step():
    """What a vector environment says of itself: a finished one begins anew with its next step."""
    mode = getattr(getattr(_gymnasium, "vector", None), "AutoresetMode", None)
    return mode.NEXT_STEP if mode else "NextStep"

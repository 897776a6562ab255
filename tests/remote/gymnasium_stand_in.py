"""What Gymnasium documents of the classes that the package builds on (Env, spaces.Box, vector.VectorEnv), for machines
that have no Gymnasium. Written from its documentation: signatures, attributes, and what a base class does by itself."""
import enum
import sys
import types

import numpy as np


class Box:
    """Box(low, high, shape=None, dtype=np.float32, seed=None)."""

    def __init__(self, low, high, shape=None, dtype=np.float32, seed=None):
        self.dtype = np.dtype(dtype)
        if shape is None:
            shape = np.shape(low) or np.shape(high)
        assert isinstance(shape, tuple) and all(isinstance(n, (int, np.integer)) for n in shape), shape
        assert np.shape(low) in ((), shape) and np.shape(high) in ((), shape), (np.shape(low), shape)
        self.shape = shape
        self.low, self.high = (np.full(shape, b, self.dtype) if np.shape(b) == () else np.asarray(b, self.dtype)
                               for b in (low, high))
        self._np_random = np.random.default_rng(seed)

    def seed(self, seed=None):
        self._np_random = np.random.default_rng(seed)
        return seed

    def sample(self, mask=None, probability=None):
        finite = np.isfinite(self.low) & np.isfinite(self.high)
        uniform = self._np_random.uniform(np.where(finite, self.low, 0), np.where(finite, self.high, 1))
        return np.where(finite, uniform, self._np_random.normal(size=self.shape)).astype(self.dtype)

    def contains(self, x):
        return bool(isinstance(x, np.ndarray) and np.can_cast(x.dtype, self.dtype) and x.shape == self.shape
                    and np.all(x >= self.low) and np.all(x <= self.high))

    __contains__ = contains


class _Seeded:
    """np_random and np_random_seed, which both kinds of environments have."""

    _np_random = None
    _np_random_seed = None

    @property
    def np_random_seed(self):
        if self._np_random_seed is None:
            self._np_random, self._np_random_seed = np.random.default_rng(), 0
        return self._np_random_seed

    @property
    def np_random(self):
        if self._np_random is None:
            self._np_random, self._np_random_seed = np.random.default_rng(), 0
        return self._np_random

    @np_random.setter
    def np_random(self, value):
        self._np_random, self._np_random_seed = value, -1

    @property
    def unwrapped(self):
        return self


class Env(_Seeded):
    metadata = {"render_modes": []}
    render_mode = None
    spec = None

    def step(self, action):
        raise NotImplementedError

    def reset(self, *, seed=None, options=None):
        if seed is not None:
            self._np_random, self._np_random_seed = np.random.default_rng(seed), seed

    def render(self):
        raise NotImplementedError

    def close(self):
        pass

    def __enter__(self):
        return self

    def __exit__(self, *args):
        self.close()
        return False


class AutoresetMode(enum.Enum):
    NEXT_STEP = "NextStep"
    SAME_STEP = "SameStep"
    DISABLED = "Disabled"


class VectorEnv(_Seeded):
    metadata = {}
    render_mode = None
    spec = None
    closed = False

    def reset(self, *, seed=None, options=None):
        raise NotImplementedError

    def step(self, actions):
        raise NotImplementedError

    def render(self):
        raise NotImplementedError

    def close(self, **kwargs):
        if self.closed:
            return
        self.close_extras(**kwargs)
        self.closed = True

    def close_extras(self, **kwargs):
        pass

    def __del__(self):
        if not getattr(self, "closed", True):
            self.close()


def install():
    """`import gymnasium` finds this from now on."""
    modules = {name: types.ModuleType(name) for name in ("gymnasium", "gymnasium.spaces", "gymnasium.vector")}
    gymnasium, spaces, vector = modules.values()
    gymnasium.Env, gymnasium.spaces, gymnasium.vector = Env, spaces, vector
    gymnasium.__version__ = "stand-in"
    spaces.Box = Box
    vector.VectorEnv, vector.AutoresetMode = VectorEnv, AutoresetMode
    sys.modules.update(modules)

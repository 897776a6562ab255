"""Reinforcement learning: a robot of a world as an environment with Gymnasium's interface, alone or many at once.

With Gymnasium installed these are gymnasium.Env and gymnasium.vector.VectorEnv; without it they answer alike.
"""

from __future__ import annotations

from typing import Any, Callable, Mapping, Sequence

import numpy as np

from . import checks
from .client import Client
from .errors import NotFound, NotNow, Refused
from .spaces import Box, EnvBase, VectorEnvBase, autoreset_next_step
from .world import State, World

Reward = Callable[[State, State], float]
Terminated = Callable[[State], bool]

_UNLIMITED = 1e6  # a joint without limits says ±1e9
_QUANTITIES = (".position_rad", ".position_m", ".velocity_rad_s", ".velocity_m_s")


def _random_seed(random: np.random.Generator) -> int:
    return int(random.integers(2**31))


class _Task:
    """What is observed, done and rewarded, of one world; the environments share it."""

    def __init__(self, world: World, robot: str | None, joints: Sequence[str] | None,
                 observation: Sequence[str] | None, reward: Reward | None, terminated: Terminated | None):
        name = robot or next(iter(world.robots), None)
        if name not in world.robots:
            raise NotFound(f"robot: {name!r} is not allowed; one of {sorted(world.robots)}")
        self.robot = world.robots[name]
        chosen = checks.names("joints", joints) if joints is not None else list(self.robot.joints)
        for joint in chosen:
            if joint not in self.robot.joints:
                raise NotFound(f"joints: {joint!r} is not allowed; one of {list(self.robot.joints)}")
        self.joints = chosen
        self.at = np.array([self.robot.joints.index(joint) for joint in chosen], dtype=int)
        self.base = [f"{name}.base.{q}" for q in ("x_m", "y_m", "z_m", "qw", "qx", "qy", "qz")]
        self.observed = checks.names("observation", observation) if observation is not None else self._usual(world, name)
        for channel in self.observed:
            if channel not in world.channels:
                raise NotFound(f"observation: {channel!r} is not allowed; a channel of the world")
        self.rewarding = reward or self._forward
        self.ending = terminated or self._fallen
        lower, upper = self.robot.lower[self.at], self.robot.upper[self.at]
        lower = np.where(lower < -_UNLIMITED, -np.pi, lower)
        upper = np.where(upper > _UNLIMITED, np.pi, upper)
        self.action_space = Box(lower.astype(np.float32), upper.astype(np.float32), dtype=np.float32)
        size = (len(self.observed),)
        self.observation_space = Box(-np.inf, np.inf, size, np.float64)
        self.index: np.ndarray | None = None
        self.begun: np.ndarray | None = None  # targets of all joints as the episode began

    @staticmethod
    def _usual(world: World, name: str) -> list[str]:
        own = [c for c in world.channels if c.startswith(name + ".")]
        return [c for c in own if ".base." in c or c.endswith(_QUANTITIES)]

    def begin(self, state: State) -> None:
        self.index = state.indices(self.observed)
        commands = {c.split(".")[1]: i for i, c in enumerate(state.channels)
                    if c.startswith(self.robot.name + ".") and ".command_" in c}
        self.begun = np.array([state.row[commands[j]] if j in commands else 0.0 for j in self.robot.joints])

    def rewarded(self, before: State, now: State) -> float:
        return checks.finite("reward", self.rewarding(before, now))

    def observe(self, state: State) -> np.ndarray:
        return state.row[self.index]

    def targets(self, action) -> dict[str, np.ndarray]:
        action = checks.numbers("action", action, f"an array ({len(self.joints)},)")
        if action.shape != (len(self.joints),):
            raise Refused(f"action: shape {action.shape} is not allowed; ({len(self.joints)},)")
        if not np.all(np.isfinite(action)):
            joint = int(np.argmin(np.isfinite(action)))
            raise Refused(f"action of {self.joints[joint]}: {action[joint]} is not allowed; a finite number")
        all_joints = self.begun.copy()
        all_joints[self.at] = np.clip(action, self.action_space.low, self.action_space.high)
        return {self.robot.name: all_joints}

    def _forward(self, before: State, now: State) -> float:
        """How far the base came along x in this step [m]."""
        return now[self.base[0]] - before[self.base[0]]

    def _fallen(self, state: State) -> bool:
        """Its back is more than 60° from level."""
        if self.base[3] not in state.channels:
            return False
        qx, qy = state[self.base[4]], state[self.base[5]]
        return 1 - 2 * (qx * qx + qy * qy) < 0.5


class _Seeded:
    """An environment's random numbers, from the seed of reset()."""

    _np_random: np.random.Generator | None = None
    _np_random_seed: int | None = None

    @property
    def np_random(self) -> np.random.Generator:
        if self._np_random is None:
            self._np_random = np.random.default_rng()
        return self._np_random

    @np_random.setter
    def np_random(self, value: np.random.Generator) -> None:
        self._np_random, self._np_random_seed = value, -1

    @property
    def np_random_seed(self) -> int | None:
        """The seed of reset(); None: none was given, -1: the numbers were set."""
        return self._np_random_seed

    def _seed(self, seed: int | None) -> None:
        if seed is not None:
            self._np_random_seed = checks.whole("seed", seed, 0)
            self._np_random = np.random.default_rng(self._np_random_seed)


class Env(_Seeded, EnvBase):
    """One robot of one world. step(action): what its joints are told, for frame_skip control periods.

    client: a Client, or the address of a server. game: see Client.open().
    robot: its name; None: the first one of the game. It needs no controller.
    joints: those that an action tells, in this order; None: all that move. Others stay as they begin.
    observation: channels of the world, in this order; None: the robot's base (x, y, z [m], qw, qx, qy, qz) and the
      positions and velocities of its joints [rad, rad/s; m, m/s].
    frame_skip: control periods (8 ms each in most games) of one step.
    max_steps: after so many an episode is truncated.
    reward(before, now) → float; None: how far the base came along x [m].
    terminated(now) → bool; None: the base is tilted by more than 60°. A world that stops with a fault always ends.

    observation_space: Box(-inf, inf, (channels,), float64). action_space: Box(lower, upper, (joints,), float32), the
    joints' limits [rad, m]; actions beyond are clipped.
    """

    metadata: dict[str, Any] = {"render_modes": []}
    render_mode = None
    spec = None

    def __init__(self, client: Client | str = "127.0.0.1:50051", game: str | Mapping = "games/dog.json",
                 robot: str | None = None, joints: Sequence[str] | None = None,
                 observation: Sequence[str] | None = None, frame_skip: int = 1, max_steps: int = 1000,
                 reward: Reward | None = None, terminated: Terminated | None = None, logged: bool = False):
        self.frame_skip = checks.whole("frame_skip", frame_skip, 1)
        self.max_steps = checks.whole("max_steps", max_steps, 1)
        self._own = not isinstance(client, Client)
        self.client = Client(client) if self._own else client  # which says what an address is
        self.world: World | None = None
        try:
            self.world = self.client.open(game, logged=logged)
            self._task = _Task(self.world, robot, joints, observation, reward, terminated)
        except BaseException:  # nobody else could close it
            self.close()
            raise
        self.observation_space = self._task.observation_space
        self.action_space = self._task.action_space
        self._state: State | None = None
        self._steps = 0
        self._begun = 0      # the period in which the episode began
        self._lost = False   # a step was interrupted: the world may have made it or not

    @property
    def unwrapped(self) -> "Env":
        return self

    @property
    def state(self) -> State | None:
        """The whole state of the world after the last step."""
        return self._state

    def reset(self, *, seed: int | None = None, options: Mapping[str, Any] | None = None
              ) -> tuple[np.ndarray, dict[str, Any]]:
        """Begins an episode. The same seed gives the same bits; None: the next one of the environment's own numbers.
        options: {"acts": […]}, what reaches into the world before it begins, see World.act()."""
        if self.world is None:
            raise NotNow("reset() after close(); make a new environment")
        self._seed(seed)
        if options is not None and not isinstance(options, Mapping):
            raise Refused(f"options: {checks.short(options)} is not allowed; a dictionary")
        acts = (options or {}).get("acts", ())
        self._state = self.world.reset(seed=_random_seed(self.np_random), acts=acts)
        self._task.begin(self._state)
        self._steps, self._begun, self._lost = 0, self._state.period, False
        return self._task.observe(self._state), {"time_s": self._state.time_s}

    def _before(self) -> State:
        """Where the next step begins. After one that was interrupted the world is asked."""
        if self.world is None:
            raise NotNow("step() after close(); make a new environment")
        if self._state is None:
            raise Refused("step() before reset()")
        if self._lost:
            self._state = self.world.state()
            self._steps, self._lost = (self._state.period - self._begun) // self.frame_skip, False
        return self._state

    def _interrupted(self) -> None:
        self._lost = True
        self.world.forget_steps()

    def step(self, action) -> tuple[np.ndarray, float, bool, bool, dict[str, Any]]:
        """observation (channels,), reward, terminated, truncated, info with time_s, and fault where the world stopped.
        After one that Ctrl-C interrupted the next one begins where the world is."""
        before, targets = self._before(), self._task.targets(action)
        try:
            self.world.send_step(self.frame_skip, targets)
            now = self._state = self.world.receive_step()
            self._steps += 1
        except BaseException:
            self._interrupted()
            raise
        info: dict[str, Any] = {"time_s": now.time_s}
        if now.fault:
            info["fault"] = now.fault
        terminated = bool(now.fault) or bool(self._task.ending(now))
        return (self._task.observe(now), self._task.rewarded(before, now), terminated,
                self._steps >= self.max_steps, info)

    def render(self) -> None:
        """Nothing: the world has no window. World.watch() and btr live show it."""
        return None

    def close(self) -> None:
        if self.world is not None:
            self.world.__exit__()
            self.world = None
        if self._own:
            self.client.close()

    def __enter__(self) -> "Env":
        return self

    def __exit__(self, *_) -> bool:
        self.close()
        return False

    def __str__(self) -> str:
        return f"<Env of {self._task.robot.name}>"


class VectorEnv(_Seeded, VectorEnvBase):
    """num_envs such environments, each with a world and a process of its own, that step side by side.

    Arrays have the environments first: observations (num_envs, channels), rewards, terminations, truncations
    (num_envs,). One that was terminated or truncated begins anew with its next step(), whose action is not heeded and
    whose reward is 0 (Gymnasium's "next step" autoreset). Further arguments as of Env.
    """

    metadata: dict[str, Any] = {"render_modes": [], "autoreset_mode": autoreset_next_step()}
    render_mode = None
    spec = None
    closed = False

    def __init__(self, num_envs: int, client: Client | str = "127.0.0.1:50051",
                 game: str | Mapping = "games/dog.json", **arguments: Any):
        self.num_envs = checks.whole("num_envs", num_envs, 1)
        self.envs: list[Env] = []
        self._own = not isinstance(client, Client)
        self.client = Client(client) if self._own else client  # which says what an address is
        try:
            for _ in range(self.num_envs):
                self.envs.append(Env(self.client, game, **arguments))
        except BaseException:
            self.close()
            raise
        first = self.envs[0]
        self.single_observation_space, self.single_action_space = first.observation_space, first.action_space
        self.observation_space, self.action_space = map(self._batched, (first.observation_space, first.action_space))
        self._over = np.zeros(self.num_envs, dtype=bool)

    def _batched(self, space) -> Box:
        shape = (self.num_envs,) + space.shape
        return Box(np.broadcast_to(space.low, shape), np.broadcast_to(space.high, shape), shape, space.dtype)

    @property
    def unwrapped(self) -> "VectorEnv":
        return self

    @staticmethod
    def _gathered(infos: list[dict[str, Any]]) -> dict[str, Any]:
        """One array for each key, and "_key" for whom it holds."""
        gathered: dict[str, Any] = {}
        for key in {key for info in infos for key in info}:
            has = np.array([key in info for info in infos])
            values = [info.get(key) for info in infos]
            number = all(isinstance(v, (int, float)) for v in values if v is not None)
            gathered[key] = np.array([0.0 if v is None else v for v in values]) if number else np.array(values, object)
            gathered["_" + key] = has
        return gathered

    def reset(self, *, seed: int | Sequence[int | None] | None = None, options: Mapping[str, Any] | None = None
              ) -> tuple[np.ndarray, dict[str, Any]]:
        """All begin an episode; a seed s means s, s + 1, s + 2, …"""
        if self.closed:
            raise NotNow("reset() after close(); make new environments")
        seeds = checks.seeds(seed, self.num_envs)
        if np.ndim(seed) == 0:
            self._seed(seed)
        results = [env.reset(seed=s, options=options) for env, s in zip(self.envs, seeds)]
        self._over[:] = False
        return np.stack([observation for observation, _ in results]), self._gathered([info for _, info in results])

    def step(self, actions) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray, dict[str, Any]]:
        """actions (num_envs, joints)."""
        if self.closed:
            raise NotNow("step() after close(); make new environments")
        actions = checks.numbers("actions", actions, "an array (num_envs, joints)")
        if actions.shape[:1] != (self.num_envs,):
            raise Refused(f"actions: shape {actions.shape} is not allowed; one row for each of {self.num_envs} "
                          "environments")
        going = [i for i in range(self.num_envs) if not self._over[i]]
        before = {i: self.envs[i]._before() for i in going}
        targets = {i: self.envs[i]._task.targets(actions[i]) for i in going}
        try:
            for i in going:
                self.envs[i].world.send_step(self.envs[i].frame_skip, targets[i])
            for i in going:
                self.envs[i]._state = self.envs[i].world.receive_step()
                self.envs[i]._steps += 1
        except BaseException:
            for i in going:
                self.envs[i]._interrupted()
            raise
        observations: list[Any] = [None] * self.num_envs
        infos: list[dict[str, Any]] = [{} for _ in range(self.num_envs)]
        rewards, terminated = np.zeros(self.num_envs), np.zeros(self.num_envs, dtype=bool)
        truncated = np.zeros(self.num_envs, dtype=bool)
        for i in range(self.num_envs):
            env = self.envs[i]
            if self._over[i]:
                observations[i], infos[i] = env.reset()
                continue
            now = env._state
            infos[i] = {"time_s": now.time_s, **({"fault": now.fault} if now.fault else {})}
            observations[i] = env._task.observe(now)
            rewards[i] = env._task.rewarded(before[i], now)
            terminated[i] = bool(now.fault) or bool(env._task.ending(now))
            truncated[i] = env._steps >= env.max_steps
        self._over = terminated | truncated
        return np.stack(observations), rewards, terminated, truncated, self._gathered(infos)

    def render(self) -> None:
        return None

    def close(self, **_: Any) -> None:
        for env in self.envs:
            env.close()
        self.envs = []
        self.closed = True
        if self._own:
            self.client.close()

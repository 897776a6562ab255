"""A running world and what is done to it."""

from __future__ import annotations

import json
import queue
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Iterable, Iterator, Mapping, Sequence

import grpc
import numpy as np

from . import checks, forks
from . import uchilsim_pb2 as pb
from .checks import made
from .errors import Error, NoChannel, Refused, error_of, sentences
from .numbers import Number
from .pictures import Camera

if TYPE_CHECKING:
    from .client import Client

Vector = Sequence[float] | np.ndarray
_LONGEST_PERIOD = 0.1  # s of real time that a large world may take for one


@dataclass(frozen=True)
class Robot:
    """The parts of a robot in a world."""

    name: str
    joints: tuple[str, ...]       #: those that move, in the order of targets
    lower: np.ndarray             #: (joints,) their limits [rad, m]; ±1e9 where there is none
    upper: np.ndarray
    drives: tuple[str, ...]       #: "servo": targets are positions; "torque": targets are N·m or N; …
    links: tuple[str, ...]
    controller: str               #: "" if it has none, "openr" for a program on an OPEN-R stick
    parameters: tuple[Number, ...] = ()  #: of its controller, with their values


@dataclass(frozen=True)
class Line:
    """What a robot's OPEN-R program said."""

    period: int  #: the control period before which it was said
    robot: str
    object: str  #: of the program; "" of its start and end, and of its camera
    text: str


class State:
    """A world at the end of a control period.

    row: array (channels,), in the units that the channels' names end in; state["red1.base.x_m"] is one of them.
    contacts: array (contacts, 6), x, y, z [m] and force [N] in the world's axes, where they were wanted.
    links: by robot array (links, 7), x, y, z [m], qw, qx, qy, qz, where they were wanted.
    fault: why the world no longer goes on, "" while it does.
    programs: by robot with an OPEN-R stick: "" while its program runs, else why it ended.
    """

    __slots__ = ("world", "channels", "row", "time_s", "period", "episode", "fault", "playing", "score", "_message",
                 "_index")

    def __init__(self, message, channels: Sequence[str], index: Mapping[str, int], world: str):
        self.world = world
        self.channels = channels
        self._index = index
        self._message = message
        self.row = np.array(message.row)
        self.time_s: float = message.time_s
        self.period: int = message.period
        self.episode: int = message.episode
        self.fault: str = message.fault
        self.playing: bool = message.playing
        self.score = (message.score.red, message.score.blue) if message.HasField("score") else None

    def __getitem__(self, channel: str) -> float:
        return float(self.row[self._place(channel)])

    def _place(self, channel: str) -> int:
        try:
            return self._index[channel]
        except (KeyError, TypeError):
            raise NoChannel(f"{checks.short(channel)} is no channel of this state") from None

    def __contains__(self, channel: object) -> bool:
        return channel in self._index

    def __iter__(self) -> Iterator[str]:
        """The channels; dict(state) has them with their values."""
        return iter(self.channels)

    def __len__(self) -> int:
        return len(self.channels)

    def __repr__(self) -> str:
        fault = f", {self.fault}" if self.fault else ""
        return f"<state of {self.world!r} at {self.time_s:g} s, {len(self)} channels{fault}>"

    def keys(self) -> Sequence[str]:
        return self.channels

    def indices(self, channels: Iterable[str]) -> np.ndarray:
        """Where these channels are in the row."""
        return np.array([self._place(channel) for channel in channels], dtype=int)

    @property
    def contacts(self) -> np.ndarray:
        return np.array([(c.x_m, c.y_m, c.z_m, c.fx_n, c.fy_n, c.fz_n) for c in self._message.contacts]).reshape(-1, 6)

    @property
    def programs(self) -> dict[str, str]:
        return {program.robot: program.why for program in self._message.programs}

    @property
    def links(self) -> list[np.ndarray]:
        return [np.array(each.pose).reshape(-1, 7) for each in self._message.links]


class _Steps:
    """A stream of steps: an answer for each request, in their order."""

    def __init__(self, client: "Client"):
        self._address = client.address
        self._requests: queue.SimpleQueue = queue.SimpleQueue()
        self._answers = client._worlds.Steps(iter(self._requests.get, None), metadata=client._metadata)
        forks.keep(self._answers)

    def send(self, request) -> None:
        self._requests.put(request)

    def receive(self):
        try:
            return next(self._answers)
        except grpc.RpcError as error:
            raise error_of(error, self._address) from None
        except StopIteration:
            raise Error("the stream of steps has ended") from None

    def close(self) -> None:
        self._requests.put(None)
        self._answers.cancel()


class PoseStream:
    """A body that somebody else moves: motion capture of a real robot or ball. Put there before the next period.

    A step that the same program asks for right after send() may be made before the pose comes; World.place() waits.
    """

    def __init__(self, world: "World", name: str):
        self._name, self._world = name, world
        self._requests: queue.SimpleQueue = queue.SimpleQueue()
        self._reply = world._client._worlds.Poses.future(iter(self._requests.get, None), metadata=world._client._metadata)
        forks.keep(self._reply)

    def send(self, position_m: Vector, orientation_wxyz: Vector | None = None, velocity_m_s: Vector | None = None,
             spin_rad_s: Vector | None = None, joints: Mapping[str, float] | None = None) -> None:
        """position (3,) [m], orientation (4,), velocity (3,) [m/s], spin (3,) [rad/s] in the world; joints [rad, m]."""
        if self._reply.done():
            self.close()
        self._requests.put(made(
            pb.PoseRequest, world=self._world.name, object=self._name, position_m=position_m,
            orientation_wxyz=() if orientation_wxyz is None else orientation_wxyz,
            velocity_m_s=() if velocity_m_s is None else velocity_m_s,
            spin_rad_s=() if spin_rad_s is None else spin_rad_s, joints=joints or {}))

    def close(self) -> int:
        """How many poses were taken; raises what the server said of one that was not."""
        self._requests.put(None)
        with sentences(self._world._client.address):
            return self._reply.result().taken

    def __enter__(self) -> "PoseStream":
        return self

    def __exit__(self, kind, *_) -> None:
        if kind is None:
            self.close()
        else:
            self._reply.cancel()


@dataclass
class World:
    """A running world of the server. Made by Client.open() and Client.world(); closed by close() or `with`."""

    _client: "Client" = field(repr=False)
    _message: Any = field(repr=False)
    name: str = field(init=False)
    channels: list[str] = field(init=False, repr=False)
    robots: dict[str, Robot] = field(init=False, repr=False)

    def __post_init__(self):
        self._steps: _Steps | None = None
        self._cameras: dict[str, Camera] = {}
        self._last_line = 0
        self._take(self._message)

    def _take(self, message) -> None:
        self.name = message.world
        self.control_period_s: float = message.control_period_s
        self.balls: list[str] = list(message.balls)
        self.obstacles: list[str] = list(message.obstacles)
        #: file of the log below the server's folder, "" if it is not logged
        self.log_file: str = message.log
        self.robots = {r.name: Robot(
            r.name, tuple(j.name for j in r.joints), np.array([j.minimum for j in r.joints]),
            np.array([j.maximum for j in r.joints]), tuple(j.drive for j in r.joints), tuple(r.links), r.controller,
            tuple(Number.of(p, True) for p in r.parameters)) for r in message.robots}
        self._know(list(message.channels), message.channels_version)

    def _know(self, channels: list[str], version: int) -> None:
        self.channels = channels
        self._version = version
        self._index = {channel: i for i, channel in enumerate(channels)}

    def _state(self, message, channels: Sequence[str] | None = None) -> State:
        if message.channels:
            self._know(list(message.channels), message.channels_version)
        if channels:
            return State(message, channels, {channel: i for i, channel in enumerate(channels)}, self.name)
        if len(message.row) != len(self.channels):  # somebody else added or removed something
            self.refresh()
        return State(message, self.channels, self._index, self.name)

    def refresh(self) -> None:
        """Asks again what is in the world: robots, their controllers' numbers, balls, obstacles, channels."""
        self._take(self._client._call(self._client._worlds.Describe, pb.DescribeRequest(world=self.name)))

    # ---- what it is
    def _wanted(self, channels=None, links=False, contacts=False):
        chosen = () if channels is None else checks.names("channels", channels)
        return made(pb.Wanted, channels=chosen, links=links, contacts=contacts, channels_known=self._version)

    def state(self, channels: Sequence[str] | None = None, links: bool = False, contacts: bool = False) -> State:
        """The state now; `channels`: only these."""
        request = made(pb.GetRequest, world=self.name, wanted=self._wanted(channels, links, contacts))
        return self._state(self._client._call(self._client._worlds.Get, request), channels)

    def watch(self, rate_hz: float = 50, channels: Sequence[str] | None = None, links: bool = False,
              contacts: bool = False) -> Iterator[State]:
        """States as they come, at most so many a second, until the world is closed or the caller stops."""
        request = made(pb.WatchRequest, world=self.name, rate_hz=rate_hz, wanted=self._wanted(channels, links, contacts))
        stream = self._client._worlds.Watch(request, metadata=self._client._metadata)
        forks.keep(stream)
        try:
            with sentences(self._client.address):
                for message in stream:
                    yield self._state(message, channels)
        finally:
            stream.cancel()

    def lines(self) -> list[Line]:
        """What robots' OPEN-R programs said since the last call; of many lines the last 1000."""
        wanted = made(pb.Wanted, channels_known=self._version, lines_after=self._last_line)
        request = made(pb.GetRequest, world=self.name, wanted=wanted)
        message = self._client._call(self._client._worlds.Get, request)
        if message.channels:
            self._know(list(message.channels), message.channels_version)
        if message.lines:
            self._last_line = message.lines[-1].number
        return [Line(line.period, line.robot, line.object, line.text) for line in message.lines]

    def type(self, robot: str, text: str) -> None:
        """On the console of a robot's OPEN-R program, which reads it in the next period; a line ends with \\n."""
        self._client._call(self._client._worlds.Type, made(pb.TypeRequest, world=self.name, robot=robot, text=text))

    def game(self) -> dict:
        """The game as it is now, as in a game file, without its state."""
        return json.loads(self._client._call(self._client._worlds.Describe,
                                             pb.DescribeRequest(world=self.name)).game_json)

    def picture(self, robot: str) -> np.ndarray:
        """The last frame of a robot's camera: array (height, width, 3) of uint8, red, green and blue, the upper left
        pixel first. The camera begins to look with the first call; while it has no frame yet the world goes on by a
        control period at a time."""
        while True:
            frame = self._camera(robot).last()
            if frame is not None:
                return frame.picture
            state = self.step(1)
            if state.fault:
                raise Error(f"the world has stopped: {state.fault}")

    def _camera(self, robot: str) -> Camera:
        if robot not in self._cameras:
            self._cameras[robot] = Camera(self._client, self.name, robot)
        return self._cameras[robot]

    def pictures(self, robot: str) -> Iterator[tuple[int, np.ndarray]]:
        """Each new frame as the world goes on, by another client's steps or the server's clock: the control period at
        its end, and the frame as of picture()."""
        for frame in self._camera(robot).frames():
            yield frame.period, frame.picture

    def log(self) -> dict[str, str]:
        """The log so far and the game that it is bound to: texts by file. `btr live GAME --replay LOG` plays it again."""
        files: dict[str, str] = {}
        with sentences(self._client.address):
            for part in self._client._worlds.Log(pb.LogRequest(world=self.name), metadata=self._client._metadata):
                files[part.file] = files.get(part.file, "") + part.text
        return files

    # ---- time
    def _request(self, periods, targets, acts, channels, links, contacts):
        self._client.check_usable()
        request = made(pb.StepRequest, world=self.name, periods=periods, acts=acts)
        if targets is not None and not isinstance(targets, Mapping):
            raise Refused(f"targets: {checks.short(targets)} is not allowed; a dictionary by robot")
        for robot, positions in (targets or {}).items():
            joints = len(self.robots[robot].joints) if robot in self.robots else None
            request.targets.add(robot=str(robot), positions=checks.targets(robot, positions, joints, request.periods))
        request.wanted.CopyFrom(self._wanted(channels, links, contacts))
        return request

    def step(self, periods: int = 1, targets: Mapping[str, Vector] | None = None, acts: Sequence[Any] = (),
             channels: Sequence[str] | None = None, links: bool = False, contacts: bool = False) -> State:
        """Some control periods on.

        targets: by robot an array (joints,), held, or (periods, joints), one row for each period [rad, m; N·m, N].
        acts: what reaches into the world before the first period, see act().
        """
        request = self._request(periods, targets, [self.act(a) for a in acts], channels, links, contacts)
        longest = self._client.timeout + _LONGEST_PERIOD * periods
        return self._state(self._client._call(self._client._worlds.Step, request, timeout=longest), channels)

    def send_step(self, periods: int, targets: Mapping[str, Vector]) -> None:
        """The same on a stream, without waiting: receive_step() has the answer. Several worlds step side by side."""
        request = self._request(periods, targets, (), None, False, False)
        if self._steps is None:
            self._steps = _Steps(self._client)
        self._steps.send(request)

    def receive_step(self) -> State:
        if self._steps is None:
            raise Error("receive_step() without a send_step()")
        try:
            return self._state(self._steps.receive())
        except BaseException:  # Ctrl-C too: an answer that nobody took would be the next one's
            self.forget_steps()
            raise

    def forget_steps(self) -> None:
        """Nothing that send_step() sent is answered any more; state() says what became of it."""
        if self._steps is not None and self._client.is_own:
            self._steps.close()
        self._steps = None

    def reset(self, seed: int | None = None, acts: Sequence[Any] = ()) -> State:
        """The game from its beginning, with another seed if one is given; a log of its own begins."""
        request = made(pb.ResetRequest, world=self.name, seed=seed, acts=[self.act(a) for a in acts], wanted=self._wanted())
        state = self._client._call(self._client._worlds.Reset, request)
        if state.channels:
            self.refresh()
        return self._state(state)

    def play(self, speed: float = 1.0) -> State:
        """Goes on by the server's clock, so many simulated seconds a second; 0 stops it."""
        return self._state(self._client._call(self._client._worlds.Play, made(pb.PlayRequest, world=self.name, speed=speed)))

    # ---- hands
    @staticmethod
    def act(what: Any):
        """An act: a message of the schema, or a dictionary as a line of a log, {"act": "place", "object": "ball", …}."""
        if isinstance(what, pb.Act):
            return what
        if not isinstance(what, Mapping):
            raise Refused(f"act: {checks.short(what)} is not allowed; a dictionary as a line of a log")
        try:
            return pb.Act(json=json.dumps(what))
        except (TypeError, ValueError) as error:
            raise Refused(f"act: {checks.short(what)} is not allowed; what JSON can say ({error})") from None

    def do(self, *acts: Any) -> State:
        """These acts now, without a period."""
        state = self.step(0, acts=acts)
        if state._message.channels:
            self.refresh()
        return state

    def hold(self, robot: str, joint: str, position: float | None) -> State:
        """What a joint is told from now on [rad, m; N·m, N if it is driven by torque]; None: its controller has it again."""
        return self.do(pb.Act(hold=made(pb.Hold, robot=robot, joint=joint, position=position)))

    def place(self, name: str, position_m: Vector, orientation_wxyz: Vector = (1, 0, 0, 0),
              joints: Mapping[str, float] | None = None) -> State:
        """Puts an object somewhere, at rest: position (3,) [m], orientation (4,)."""
        return self.do(pb.Act(place=made(pb.Place, object=name, position_m=position_m, orientation_wxyz=orientation_wxyz,
                                             joints=joints or {})))

    def throw(self, name: str, velocity_m_s: Vector, spin_rad_s: Vector = (0, 0, 0)) -> State:
        """The velocity of an object from now on: (3,) [m/s], spin (3,) [rad/s]."""
        return self.do(pb.Act(throw=made(pb.Throw, object=name, velocity_m_s=velocity_m_s, spin_rad_s=spin_rad_s)))

    def pull(self, name: str, target_m: Vector, link: str = "", point_m: Vector = (0, 0, 0),
             stiffness_n_m: float = 100, most_n: float = 20) -> State:
        """A spring from a point of an object to a place in the world, until let_go()."""
        return self.do(pb.Act(pull=made(pb.Pull, object=name, link=link, point_m=point_m, target_m=target_m,
                                           stiffness_n_m=stiffness_n_m, most_n=most_n)))

    def push(self, name: str, force_n: Vector, at_m: Vector, link: str = "", point_m: Vector = (0, 0, 0)) -> State:
        """A force (3,) [N] in the world's axes at a point of an object that is about at_m, until let_go(): a spring to a
        far place whose strength is limited. As the object moves by d its direction changes by d/50 m."""
        force = checks.numbers("force_n", force_n, "an array (3,) [N]")
        if force.shape != (3,):
            raise Refused(f"force_n: shape {force.shape} is not allowed; (3,)")
        size = float(np.linalg.norm(force))
        if size == 0:
            return self.let_go(name)
        far = checks.numbers("at_m", at_m, "an array (3,) [m]") + 50 * force / size
        return self.pull(name, far, link, point_m, stiffness_n_m=max(100.0, size), most_n=size)

    def let_go(self, name: str) -> State:
        return self.do(made(pb.Act, let_go=name))

    def remove(self, name: str) -> State:
        return self.do(made(pb.Act, remove=name))

    def add(self, **what: Mapping) -> State:
        """add(ball={"name": "ball2", "position_m": [0, 0, 0.1]}); also robot=, obstacle=, as in a scene file."""
        return self.do({"act": "add", **what})

    def set_parameter(self, robot: str, name: str, value: float | None) -> State:
        """One of the numbers of a robot's controller; None: its default."""
        return self.do(pb.Act(parameter=made(pb.Number, robot=robot, name=name, value=value)))

    def set_number(self, name: str, value: float | None, robot: str = "") -> State:
        """One of the simulator's numbers, "friction"; of one robot's own simulator or of all; None: what the scene says."""
        return self.do(pb.Act(number=made(pb.Number, robot=robot, name=name, value=value)))

    def poses(self, name: str) -> PoseStream:
        """A body that is moved from outside; see PoseStream."""
        return PoseStream(self, name)

    # ---- the end
    def save(self, file: str = "") -> dict:
        """The game with its state, which goes on with the same bits; also into a file below the server's folder."""
        return json.loads(self._client._call(self._client._worlds.Save,
                                             made(pb.SaveRequest, world=self.name, file=file)).game_json)

    def close(self) -> str:
        """Ends it. The hash of the trace of its last episode: equal means bit-identical."""
        self.forget_steps()
        return self._client._call(self._client._worlds.Close, pb.CloseRequest(world=self.name)).trace_sha256

    def __enter__(self) -> "World":
        return self

    def __exit__(self, *_) -> None:
        try:
            self.close()
        except Error:
            pass  # it has ended already

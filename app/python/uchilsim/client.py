"""The connection to a server."""

from __future__ import annotations

import contextlib
import json
import os
import pathlib
from dataclasses import dataclass
from typing import Mapping, Sequence

import grpc
import numpy as np

from . import forks
from . import uchilsim_pb2 as pb
from . import uchilsim_pb2_grpc as services
from .checks import certificate_of, made, numbers, short, token_of
from .errors import NotFound, Refused, client_closed, sentences
from .learning import Run
from .numbers import Number, clipped, lower_of, upper_of
from .world import World

_LARGEST = 64 << 20  # of an answer
_LARGEST_POPULATION = 2 << 20  # bytes of one call; a larger one is evaluated by several, with the same bits


@dataclass(frozen=True)
class Info:
    """What a server is and allows."""

    version: str
    schema: str
    role: str                    #: of this client: "watch", "drive" or "administrate"
    largest_message_bytes: int
    calls_per_second: float
    most_worlds: int
    most_periods: int
    has_database: bool
    keeps_logs: bool
    workers: int
    controllers: tuple[str, ...]
    effects: tuple[str, ...]
    most_streams: int = 0        #: at once, of this client: worlds that step side by side, and whoever watches
    most_evaluations: int = 0    #: at once, of this client, those that wait for their turn too


@dataclass(frozen=True)
class Evaluation:
    """What whole trials were worth, one for each vector."""

    fitness: np.ndarray          #: (vectors,), more is better
    outcomes: list[str]          #: "finished", or why one did not
    details: list[str]
    trace_sha256: list[str]      #: equal means bit-identical
    figures: list[dict[str, float]]


def _json(what: str, contents: Mapping) -> str:
    try:
        return json.dumps(contents)
    except (TypeError, ValueError) as error:
        raise Refused(f"{what}: {short(contents)} is not allowed; what JSON can say ({error})") from None


def _experiment_message(experiment: str | Mapping, directory: str):
    if isinstance(experiment, (str, pathlib.Path)):
        return pb.Experiment(file=str(experiment))
    if not isinstance(experiment, Mapping):
        raise Refused(f"experiment: {short(experiment)} is not allowed; a file below the server's folder, or a dictionary")
    return pb.Experiment(json=_json("experiment", experiment), directory=directory)


class Experiment:
    """An experiment of the server: its parameters, and whole trials of vectors of them. Made by Client.experiment()."""

    def __init__(self, client: "Client", experiment: str | Mapping, directory: str = ""):
        self._client = client
        self._message = _experiment_message(experiment, directory)
        reply = client._call(client._learning.Describe, pb.ExperimentRequest(experiment=self._message))
        self.name: str = reply.name
        #: all of it, as a file has it; may be changed and given to Client.experiment() with the same directory
        self.spec: dict = json.loads(reply.json)
        self.genotype: list[Number] = [Number.of(p) for p in reply.genotype]
        self.adapted: list[Number] = [Number.of(p) for p in reply.adapted]
        self.unit: str = reply.unit  #: of the fitness
        self.seed: int = reply.seed
        #: (parameters,) the vector that a search may begin around
        self.start = np.array(reply.start if reply.start else [p.default for p in self.genotype])

    @property
    def lower(self) -> np.ndarray:
        """(parameters,) the smallest values, in the parameters' own units."""
        return lower_of(self.genotype)

    @property
    def upper(self) -> np.ndarray:
        return upper_of(self.genotype)

    def clip(self, vectors) -> np.ndarray:
        """Vectors (…, parameters) brought within the bounds, and whole where only whole numbers are allowed."""
        return clipped(self.genotype, vectors)

    def evaluate(self, population, seed: int | None = None, run: int = 0, timeout: float | None = None) -> Evaluation:
        """Whole trials of a population, array (vectors, parameters), on all the server's cores: the bits that a run of
        this experiment with this seed has. run: in the newest simulator of that run of the server's database."""
        allowed = f"an array (vectors, {len(self.genotype)})"
        population = np.atleast_2d(numbers("population", population, allowed))
        if population.ndim != 2 or population.shape[1] != len(self.genotype):
            raise Refused(f"population: shape {population.shape} is not allowed; {allowed}")
        room = max(1, _LARGEST_POPULATION // (population.shape[1] * population.itemsize))
        trials = [trial for first in range(0, len(population), room)
                  for trial in self._trials(population[first:first + room], seed, run, timeout)]
        return Evaluation(np.array([t.fitness for t in trials]), [t.outcome for t in trials],
                          [t.detail for t in trials], [t.trace_sha256 for t in trials],
                          [dict(t.figures) for t in trials])

    def _trials(self, population: np.ndarray, seed: int | None, run: int, timeout: float | None):
        request = made(pb.EvaluateRequest, experiment=self._message, seed=seed, run=run, vectors=len(population),
                       parameters=population.ravel())
        return self._client._call(self._client._learning.Evaluate, request, timeout=timeout).trials

    def start_run(self, seed: int | None = None, again: bool = False, patience_s: float = 0) -> Run:
        """Starts it as a run in the server's database, or goes on with the one that is there."""
        message = self._client._call(self._client._learning.Start, made(
            pb.StartRequest, experiment=self._message, seed=seed, again=again, patience_s=patience_s))
        return Run(self._client, message)


class Client:
    """A connection to `btr serve`. From one thread, or several.

    address: "127.0.0.1:50051", or "unix:/path" of a Unix socket.
    token: the caller's token, where the server wants one; sent only over TLS, loopback or a Unix socket.
    certificate: file with the certificate (PEM) that the server's is signed by; then the connection is TLS.
    shared_pictures: a camera's frames are read from the server's memory where that is on this machine and of this user;
        where it is not, or if False, they come by calls.
    timeout: the longest time for one call [s]; a step of many periods has more, evaluations as long as they take.
    """

    def __init__(self, address: str = "127.0.0.1:50051", token: str | None = None,
                 certificate: str | pathlib.Path | None = None, timeout: float = 60.0, shared_pictures: bool = True):
        if not isinstance(address, str):
            raise Refused(f"address: {short(address)} is not allowed; \"HOST:PORT\" or \"unix:PATH\"")
        forks.begin()
        self._process = os.getpid()
        options = [("grpc.max_receive_message_length", _LARGEST), ("grpc.enable_http_proxy", 0),
                   # A server that vanishes without a word is noticed, however long a call may take.
                   ("grpc.keepalive_time_ms", 60000), ("grpc.keepalive_timeout_ms", 20000)]
        if certificate is None:
            self._channel = grpc.insecure_channel(address, options)
        else:
            credentials = grpc.ssl_channel_credentials(certificate_of(certificate))
            self._channel = grpc.secure_channel(address, credentials, options)
        forks.keep(self._channel)
        self._closed = False
        self._timeout = timeout
        self.shared_pictures = shared_pictures
        self._metadata = (("authorization", "Bearer " + token_of(token)),) if token else ()
        self._worlds = services.WorldsStub(self._channel)
        self._learning = services.LearningStub(self._channel)
        self.address = address

    @property
    def timeout(self) -> float:
        return self._timeout

    @property
    def is_own(self) -> bool:
        """False in a process that was forked from the one that made this."""
        return forks.is_own(self._process)

    def check_usable(self) -> None:
        """Raises NotNow once it is closed, and in a process that was forked from the one that made this."""
        forks.check(self._process)
        if self._closed:
            raise client_closed()

    def __reduce__(self):
        raise Refused("a Client, and who has one, cannot be copied or sent to another process; make one there")

    def _call(self, method, request, timeout: float | None = ...):
        self.check_usable()
        with sentences(self.address):
            return method(request, timeout=self._timeout if timeout is ... else timeout, metadata=self._metadata)

    # ---- the server
    def info(self) -> Info:
        m = self._call(self._worlds.Info, pb.InfoRequest())
        return Info(m.version, m.schema, m.role, m.largest_message_bytes, m.calls_per_second, m.most_worlds,
                    m.most_periods, m.has_database, m.keeps_logs, m.workers, tuple(m.controllers), tuple(m.effects),
                    m.most_streams, m.most_evaluations)

    def wait(self, timeout: float = 10.0) -> Info:
        """Waits until the server is there; raises Unreachable with why it is not."""
        self.check_usable()
        with contextlib.suppress(grpc.FutureTimeoutError):  # then the call says why
            grpc.channel_ready_future(self._channel).result(timeout)
        return self.info()

    def shut_down(self) -> None:
        """Ends the server; needs the role "administrate"."""
        self._call(self._worlds.ShutDown, pb.ShutDownRequest())

    # ---- worlds
    def open(self, game: str | Mapping, seed: int | None = None, directory: str = "", logged: bool = True,
             without_controller: Sequence[str] = ()) -> World:
        """A world of a game, scene or robot file below the server's folder, or of a game's contents as a dictionary
        (paths in it are relative to `directory` there). without_controller: robots that the caller moves himself;
        their controllers are left out, and need not be on the server."""
        request = made(pb.OpenRequest, seed=seed, unlogged=not logged, without_controller=without_controller)
        if isinstance(game, (str, pathlib.Path)):
            request.game = str(game)
        elif isinstance(game, Mapping):
            request.game_json, request.directory = _json("game", game), directory
        else:
            raise Refused(f"game: {short(game)} is not allowed; a file below the server's folder, or a dictionary")
        self.check_usable()
        with sentences(self.address):
            call = self._worlds.Open.future(request, timeout=self._timeout, metadata=self._metadata)
            try:
                return World(self, call.result())
            except BaseException:  # Ctrl-C: nobody else could close what is still opened
                call.add_done_callback(self._close_opened)
                raise

    def _close_opened(self, call: grpc.Future) -> grpc.Future | None:
        if not call.cancelled() and call.exception() is None:
            return self._worlds.Close.future(pb.CloseRequest(world=call.result().world), metadata=self._metadata)
        return None

    def worlds(self) -> list[str]:
        """Names of all worlds that run."""
        return list(self._call(self._worlds.List, pb.ListWorldsRequest()).worlds)

    def world(self, name: str) -> World:
        """One that runs already."""
        return World(self, self._call(self._worlds.Describe, pb.DescribeRequest(world=name)))

    # ---- learning
    def experiment(self, experiment: str | Mapping, directory: str = "") -> Experiment:
        """An experiment's file below the server's folder, or its contents as a dictionary."""
        return Experiment(self, experiment, directory)

    def runs(self) -> list[Run]:
        """All runs of the server's database."""
        return [Run(self, m) for m in self._call(self._learning.Runs, pb.RunsRequest()).runs]

    def run(self, number: int) -> Run:
        for run in self.runs():
            if run.number == number:
                return run
        raise NotFound(f"run {number}: the database has none of this number")

    # ---- the end
    def close(self) -> None:
        self._closed = True
        if self.is_own:
            self._channel.close()

    def __enter__(self) -> "Client":
        return self

    def __exit__(self, *_) -> None:
        self.close()

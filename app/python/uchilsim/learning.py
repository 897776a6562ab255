"""Runs of the database, learners and robots of one's own."""

from __future__ import annotations

import time
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Callable, Iterator, Protocol

import numpy as np

from . import checks
from . import uchilsim_pb2 as pb
from .checks import made
from .errors import NotNow, Refused
from .numbers import Number, clipped, lower_of, upper_of

if TYPE_CHECKING:
    from .client import Client


class Learner(Protocol):
    """What Run.serve() needs of a learner; state() and restore() let it go on after a break."""

    def ask(self) -> np.ndarray: ...
    def tell(self, vectors: np.ndarray, fitness: np.ndarray) -> None: ...


@dataclass
class Question:
    """The run's learner is asked for its next population.

    told_vectors (k, parameters) and told_fitness (k,): what came of the last one, k = 0 for the first; more is better.
    state: the text that was given with those vectors. After a break these three are told again.
    """

    level: str                   #: "L1", "L2" or "L3"
    parameters: list[Number]
    population: int              #: how many vectors are wanted; 0: as many as the learner likes
    told_vectors: np.ndarray
    told_fitness: np.ndarray
    state: str
    start: np.ndarray            #: (parameters,) to begin around, or (0,)
    _answer: Callable[[np.ndarray, str], None] = field(repr=False)

    @property
    def lower(self) -> np.ndarray:
        return lower_of(self.parameters)

    @property
    def upper(self) -> np.ndarray:
        return upper_of(self.parameters)

    def clip(self, vectors: Any) -> np.ndarray:
        """Vectors (…, parameters) brought within the bounds, and whole where only whole numbers are allowed."""
        return clipped(self.parameters, vectors)

    def answer(self, vectors: Any, state: str = "") -> None:
        """The next population, (vectors, parameters), within the bounds. Raises Refused for what is not allowed: then
        another answer may be given."""
        allowed = f"an array (vectors, {len(self.parameters)})"
        array = np.atleast_2d(checks.numbers("vectors", vectors, allowed))
        if array.ndim != 2 or array.shape[1] != len(self.parameters):
            raise Refused(f"vectors: shape {array.shape} is not allowed; {allowed}")
        self._answer(array, state)


@dataclass
class Task:
    """An individual that waits for real fitness."""

    individual: int
    parameters: np.ndarray       #: (parameters,)
    names: list[str]
    unit: str                    #: of the fitness
    missing: int                 #: how many values are still wanted
    stage: int
    iteration: int               #: of L2, else 0
    _send: Callable[..., list[int]] = field(repr=False)

    def values(self) -> dict[str, float]:
        """The parameters by name."""
        return dict(zip(self.names, self.parameters.tolist()))

    def send(self, *fitness: float, void: bool = False, note: str = "", sure: bool = False) -> list[int]:
        """What was measured, a value for each repeat. void: the trial does not count. Raises Refused for a value that
        cannot be, or that is far from what is expected and not `sure`."""
        return self._send(self.individual, fitness, void, note, sure)


class Run:
    """A run of the server's database."""

    def __init__(self, client: "Client", message):
        self._client = client
        self._take(message)

    def _take(self, m) -> None:
        self.number: int = m.run
        self.experiment: str = m.experiment
        self.seed: int = m.seed
        self.state: str = m.state      #: "ready", "learning", "waiting", "adapting", "finished", "stopped", "failed"
        self.generation: int = m.generation
        self.stage: int = m.stage      #: measurement stages that are over
        self.reality: str = m.reality
        self.message: str = m.message  #: what it waits for, or why it stopped
        self.active: bool = m.active

    def __repr__(self) -> str:
        return f"<run {self.number} of {self.experiment!r}: {self.state}, generation {self.generation}>"

    def refresh(self) -> "Run":
        self.__dict__.update(self._client.run(self.number).__dict__)
        return self

    def generations(self, after: int = 0) -> list[dict[str, float]]:
        """number, best, mean, worst, trials and failed of each generation of L1."""
        reply = self._client._call(self._client._learning.Generations,
                                   made(pb.GenerationsRequest, run=self.number, after=after))
        return [{"number": g.number, "best": g.best, "mean": g.mean, "worst": g.worst, "trials": g.trials,
                 "failed": g.failed} for g in reply.generations]

    def individuals(self, generation: int) -> tuple[np.ndarray, np.ndarray]:
        """Vectors (individuals, parameters) and fitness (individuals,) of one generation."""
        reply = self._client._call(self._client._learning.Individuals,
                                   made(pb.IndividualsRequest, run=self.number, generation=generation))
        return (np.array([list(i.parameters) for i in reply.individuals]),
                np.array([i.fitness for i in reply.individuals]))

    def go_on(self, patience_s: float = 0) -> None:
        """The server works on it until it is finished, waits or stops. patience_s: for one answer of a learner, also of
        a run at work; 0: 600 s, or as it was."""
        self._take(self._client._call(self._client._learning.Continue,
                                      pb.ContinueRequest(run=self.number, patience_s=patience_s)))

    def stop(self) -> None:
        self._take(self._client._call(self._client._learning.Stop, pb.StopRequest(run=self.number)))

    def tasks(self) -> list[Task]:
        """Individuals that wait for real fitness, in the order in which to measure."""
        reply = self._client._call(self._client._learning.Wanted, pb.MeasureRequest(run=self.number))
        names = [p.name for p in reply.parameters]
        return [Task(t.individual, np.array(t.parameters), names, reply.unit, max(1, t.wanted - t.have), t.stage,
                     t.iteration, self._send) for t in reply.tasks]

    def _send(self, individual, values, void, note, sure) -> list[int]:
        request = made(pb.MeasuredRequest, run=self.number, individual=individual, values=values, is_void=void,
                       note=note, sure=sure)
        return list(self._client._call(self._client._learning.Measured, request).measurements)

    def _ask(self, wait_s: float):
        return self._client._call(self._client._learning.Ask, pb.AskRequest(run=self.number, wait_s=wait_s),
                                  timeout=wait_s + 60)

    def _question(self, q) -> Question:
        n = len(q.parameters)

        def answer(vectors: np.ndarray, state: str) -> None:
            self._client._call(self._client._learning.Tell, made(
                pb.TellRequest, run=self.number, number=q.number, vectors=len(vectors), parameters=vectors.ravel(), state=state))

        return Question(q.level, [Number.of(p) for p in q.parameters], q.population,
                        np.array(q.told_parameters).reshape(q.vectors, n), np.array(q.told_fitness), q.state,
                        np.array(q.start), answer)

    def questions(self) -> Iterator[Question]:
        """What the run's learner "remote" is asked, one after another, until the run is finished, waits for real fitness
        or stops; see state and message then."""
        while True:
            q = self._ask(10)
            if q.what == pb.Question.VECTORS:
                yield self._question(q)
            elif q.what != pb.Question.WORKING:
                self.refresh()
                return

    def serve(self, learner: Callable[[Question], Learner] | None = None,
              robot: Callable[[Task], float | None] | None = None, patience_s: float = 0, sure: bool = False) -> "Run":
        """Works for the run until it is finished: as its learner, as its robot, or as both.

        learner: makes a learner for the first question of each level; it has ask() → (vectors, parameters) and
          tell(vectors, fitness), and if it is to go on after a break state() → str, taken after each ask(), and
          restore(str), after which it is told of those vectors.
        robot: measures one trial of a task: its fitness, or None if the trial is void.
        sure: values far from what is expected are right; else the first one raises Refused, and serve() may be called
          again.
        """
        learners: dict[str, Any] = {}
        while True:
            self.go_on(patience_s)
            for question in self.questions():
                if learner is None:
                    raise NotNow(f"run {self.number}: its learner is another program, and none was given")
                fresh = question.level not in learners
                own = learners.setdefault(question.level, None) or learner(question)
                learners[question.level] = own
                if fresh and question.state and hasattr(own, "restore"):
                    own.restore(question.state)
                if len(question.told_fitness):
                    own.tell(question.told_vectors, question.told_fitness)
                vectors = own.ask()
                question.answer(vectors, own.state() if hasattr(own, "state") else "")
            if self.state == "finished":
                return self
            tasks = self.tasks() if self.state == "waiting" else []
            if not tasks or robot is None:
                raise NotNow(f"run {self.number} {self.state}: {self.message}")
            for task in tasks:
                for _ in range(task.missing):
                    value = robot(task)
                    task.send(void=True) if value is None else task.send(value, sure=sure)

    def wait(self, timeout: float = 600.0) -> "Run":
        """Until no process works on it any more."""
        until = time.monotonic() + timeout
        while self.refresh().active:
            if time.monotonic() > until:
                raise TimeoutError(f"run {self.number} is still worked on after {timeout:g} s")
            time.sleep(0.2)
        return self

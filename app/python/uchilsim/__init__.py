"""UCHILSIM from Python: running worlds, whole trials, runs with a learner or a robot of your own.

    import uchilsim
    with uchilsim.Client() as client:                      # a server: btr serve
        world = client.open("games/two-dogs-and-a-ball.json")
        state = world.step(125)                            # a second
        print(state["red1.base.x_m"])

All quantities are SI: m, kg, s, rad, N, N·m; quaternions are w, x, y, z. Needs grpcio, protobuf and numpy.
"""

from . import forks  # noqa: F401  before gRPC

try:
    import google.protobuf  # noqa: F401
    import grpc  # noqa: F401
    import numpy  # noqa: F401
except ImportError as error:
    _missing = {"google": "protobuf", "google.protobuf": "protobuf", "grpc": "grpcio"}.get(error.name, error.name)
    raise ImportError(
        f"uchilsim needs {_missing}, which this Python does not have: install python3-grpcio, python3-protobuf and "
        "python3-numpy and use the system's Python, /usr/bin/python3, or install them for yours"
    ) from error

from .client import Client, Evaluation, Experiment, Info
from .env import Env, VectorEnv
from .errors import Error, NoAccess, NoChannel, NotFound, NotNow, Refused, TooLate, TooMuch, Unreachable
from .learning import Question, Run, Task
from .numbers import Number
from .spaces import Box
from .world import Line, PoseStream, Robot, State, World


def evaluate(population, experiment="experiments/kick-short.json", seed=None, address="127.0.0.1:50051", token=None,
             certificate=None):
    """Fitness of each vector of a population by whole trials on all the server's cores.

    population: array of shape (vectors, parameters), in the experiment's order and units. Returns an array of shape
    (vectors,), more is better. For further results, and for many calls, see Client.experiment().
    """
    with Client(address, token=token, certificate=certificate) as client:
        return client.experiment(experiment).evaluate(population, seed=seed).fitness


__all__ = ["Box", "Client", "Env", "Error", "Evaluation", "Experiment", "Info", "Line", "NoAccess", "NoChannel",
           "NotFound", "NotNow", "Number", "PoseStream", "Question", "Refused", "Robot", "Run", "State", "Task", "TooLate",
           "TooMuch", "Unreachable", "VectorEnv", "World", "evaluate"]

"""The Python package against a server that is started for it.
   python3 test_python.py BTR RESOURCES"""
import itertools
import json
import multiprocessing
import os
import pathlib
import pickle
import queue
import resource
import shutil
import subprocess
import sys
import tempfile
import unittest
from unittest import mock

import numpy as np
import uchilsim

BTR, RESOURCES = sys.argv[1], pathlib.Path(sys.argv[2])
DOG = "robots/ers7.wrl"


class Server:
    """btr serve on a free port, with a folder and a database of its own."""

    def __init__(self, *arguments):
        self.folder = pathlib.Path(tempfile.mkdtemp())
        games = self.folder / "games"
        games.mkdir()
        for name in ("robots", "scenes", "experiments", "fields"):
            shutil.copytree(RESOURCES / name, games / name)
        shutil.copytree(RESOURCES / "games", games / "games")
        self.socket = str(self.folder / "socket")
        self.process = subprocess.Popen(
            [BTR, "--json", "serve", "--port", "0", "--unix", self.socket, "--games", str(games), "--db",
             str(self.folder / "a.db"), "--jobs", "2", *arguments], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        text = ""
        while not text.endswith("}\n"):  # one document, on one line or several
            line = self.process.stdout.readline()
            if not line:
                raise RuntimeError(self.process.stderr.read())
            text += line
        self.said = json.loads(text)
        self.address = f"127.0.0.1:{self.said['port']}"

    def close(self):
        """As Ctrl-C does: it ends cleanly."""
        if self.process.poll() is None:
            self.process.send_signal(2)
        _, errors = self.process.communicate(timeout=30)
        shutil.rmtree(self.folder)
        return self.process.returncode, errors


class WithServer(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.server = Server()
        cls.client = uchilsim.Client(cls.server.address)

    @classmethod
    def tearDownClass(cls):
        cls.client.close()
        code, errors = cls.server.close()
        assert code == 0 and errors == "", (code, errors)


class Worlds(WithServer):
    def test_a_server_says_what_it_is(self):
        info = self.client.wait()
        self.assertEqual(("uchilsim.v1", "drive"), (info.schema, info.role))
        self.assertIn("walk", info.controllers)
        self.assertTrue(info.has_database and info.keeps_logs)

    def test_connections_that_say_nothing_keep_nobody_out(self):
        # btr starts btr-serve in its place: the process is the same.
        soft, hard = resource.prlimit(self.server.process.pid, resource.RLIMIT_NOFILE)
        self.assertGreaterEqual(soft, min(hard, 65536))

    def test_a_walking_dog_moves_and_its_parameters_are_there(self):
        with self.client.open("games/two-dogs-and-a-ball.json") as world:
            before = world.state()["red1.base.x_m"]
            self.assertGreater(abs(world.step(250)["red1.base.x_m"] - before), 0.02)
            robot = world.robots["red1"]
            self.assertEqual("walk", robot.controller)
            number = robot.parameters[0]
            world.set_parameter("red1", number.name, number.minimum)
            world.refresh()
            self.assertEqual(number.minimum, world.robots["red1"].parameters[0].value)

    def test_hands_place_throw_pull_and_add(self):
        with self.client.open(DOG) as world:
            state = world.add(ball={"name": "ball", "position_m": [1, 0, 0.5]})
            self.assertEqual(["ball"], world.balls)
            self.assertAlmostEqual(0.5, state["ball.z_m"])
            world.throw("ball", (0, 1, 0))
            self.assertAlmostEqual(0.08, world.step(10)["ball.y_m"], 6)
            self.assertEqual(2.0, world.place("ball", (2, 0, 0.3))["ball.x_m"])
            world.set_number("friction", 0.3)
            # A force of 0.11 N on 0.055 kg is 2 m/s²; free flight for 80 ms.
            world.place("ball", (1, 0, 1))
            world.push("ball", (0.11, 0, 0), (1, 0, 1))
            self.assertAlmostEqual(2 * 0.08**2 / 2, world.step(10)["ball.x_m"] - 1, delta=0.002)
            world.let_go("ball")
            world.remove("ball")
            self.assertEqual(len(world.channels), len(world.state().row))

    def test_joints_go_where_they_are_told(self):
        with self.client.open(DOG) as world:
            robot = world.robots["robot"]
            targets = np.zeros(len(robot.joints))
            targets[robot.joints.index("HEAD_PAN")] = 0.6
            state = world.step(100, {"robot": np.tile(targets, (100, 1))}, links=True, contacts=True)
            self.assertAlmostEqual(0.6, state["robot.HEAD_PAN.position_rad"], delta=0.05)
            self.assertEqual((len(robot.links), 7), state.links[0].shape)
            self.assertEqual(6, state.contacts.shape[1])
            only = world.state(["robot.HEAD_PAN.position_rad"])
            self.assertEqual(state["robot.HEAD_PAN.position_rad"], only["robot.HEAD_PAN.position_rad"])

    def test_a_log_plays_again_without_the_client(self):
        world = self.client.open(DOG, seed=4)
        random = np.random.default_rng(0)
        for _ in range(20):
            world.step(2, {"robot": random.uniform(-0.2, 0.2, 18)})
        self.assertEqual(2, len(world.log()))
        log = self.server.folder / "games" / world.log_file
        sha = world.close()
        replay = subprocess.run([BTR, "--json", "live", str(log.with_suffix(".json")), "--replay", str(log)],
                                capture_output=True, text=True, check=True)
        result = json.loads(replay.stdout)
        self.assertTrue(result["identical"])
        self.assertEqual(sha, result["trace_sha256"])

    def test_a_ball_that_is_moved_from_outside_is_there(self):
        with self.client.open(DOG) as world:
            world.add(ball={"name": "ball", "position_m": [1, 0, 0.5]})
            with world.poses("ball") as poses:
                for i in range(10):
                    poses.send((0.1 * i, 0, 0.3), velocity_m_s=(0.1, 0, 0))
            self.assertAlmostEqual(0.9, world.state()["ball.x_m"])

    def test_a_playing_world_is_watched(self):
        with self.client.open(DOG) as world:
            world.play(2)
            times = []
            for state in world.watch(rate_hz=100):
                times.append(state.time_s)
                if len(times) == 5:
                    break
            self.assertEqual(sorted(set(times)), times)
            self.assertFalse(world.play(0).playing)

    def test_what_is_wrong_is_said_in_a_sentence(self):
        for call, kind, words in (
                (lambda: self.client.open("../secret.json"), uchilsim.Refused, "below the server's folder"),
                (lambda: self.client.open("/etc/passwd"), uchilsim.Refused, "below the server's folder"),
                (lambda: self.client.world("nobody"), uchilsim.NotFound, "no such world"),
                (lambda: self.client.run(77), uchilsim.NotFound, "run 77"),
                (lambda: self.client.shut_down(), uchilsim.NoAccess, "administrate"),
                (lambda: uchilsim.Client("127.0.0.1:1").wait(0.2), uchilsim.Unreachable, "no server")):
            with self.assertRaisesRegex(kind, words):
                call()
        with self.client.open(DOG) as world:
            with self.assertRaisesRegex(uchilsim.Refused, "18"):
                world.step(1, {"robot": [0.0]})
            with self.assertRaisesRegex(uchilsim.Refused, "a robot of this game"):
                world.step(1, {"cat": [0.0]})


class Mistakes(WithServer):
    """What is wrong is one sentence of the package's own, before it is sent where that can be known."""

    def refused(self, sentence, call, kind=uchilsim.Refused):
        with self.assertRaises(kind) as raised:
            call()
        self.assertRegex(str(raised.exception), sentence)

    def test_targets_of_another_shape(self):
        with self.client.open("games/dog.json") as world:
            n = len(world.robots["dog"].joints)
            world.step(2, {"dog": np.zeros((2, n))})
            self.refused(rf"targets of dog: shape \(5,\) .* an array \({n},\) or \(3, {n}\)",
                         lambda: world.step(3, {"dog": [0.1] * 5}))
            self.refused(r"targets of dog: shape", lambda: world.step(3, {"dog": np.zeros((n, 3))}))
            self.refused(r"targets of dog: \{'HEAD_PAN': 0.3\}", lambda: world.step(1, {"dog": {"HEAD_PAN": 0.3}}))
            self.refused(r"targets: .* a dictionary by robot", lambda: world.step(1, [0.0] * n))

    def test_values_of_another_kind(self):
        self.refused("seed: -1 is not allowed; a whole number from 0 on", lambda: self.client.open(DOG, seed=-1))
        self.refused("game: None is not allowed", lambda: self.client.open(None))
        self.refused("address: None is not allowed", lambda: uchilsim.Client(None))
        with self.client.open("games/dog.json") as world:
            self.refused("periods: 1.5 is not allowed; a whole number", lambda: world.step(1.5))
            self.refused("act: 'explode' is not allowed", lambda: world.do("explode"))
            self.refused("position_m: 'here' is not allowed", lambda: world.place("dog", "here"))

    def test_a_state_knows_its_channels(self):
        with self.client.open("games/dog.json") as world:
            state = world.state()
            self.assertIn("dog.base.x_m", state)
            self.assertNotIn("dog.x", state)
            self.assertEqual((len(state), list(state)), (len(world.channels), world.channels))
            self.assertEqual(state["dog.base.z_m"], dict(state)["dog.base.z_m"])
            for kind in (uchilsim.Error, uchilsim.NotFound, KeyError):
                self.refused("^'nope' is no channel of this state$", lambda: state["nope"], kind)
                self.refused("^'nope' is no channel of this state$", lambda: state.indices(["nope"]), kind)

    def test_populations_of_another_shape_and_of_any_size(self):
        kick = self.client.experiment("experiments/kick-short.json")
        n = len(kick.genotype)
        self.refused(rf"population: shape \(2, {n + 1}\) .* \(vectors, {n}\)", lambda: kick.evaluate(np.zeros((2, n + 1))))
        self.refused(r"population: shape \(2, 2, ", lambda: kick.evaluate(np.zeros((2, 2, n))))
        self.assertEqual((0,), kick.evaluate(np.zeros((0, n))).fitness.shape)
        population = np.tile(kick.start, (3, 1))
        whole = kick.evaluate(population, seed=1)
        with mock.patch("uchilsim.client._LARGEST_POPULATION", 2 * 8 * n):  # two vectors a call
            parts = kick.evaluate(population, seed=1)
        self.assertEqual(whole.trace_sha256, parts.trace_sha256)

    def test_vectors_that_are_clipped_have_one_number_for_each_parameter(self):
        kick = self.client.experiment("experiments/kick-short.json")
        n = len(kick.genotype)
        self.refused(rf"vectors: shape \(1, 3\) is not allowed; an array \(…, {n}\)", lambda: kick.clip([[0.0] * 3]))
        self.refused("vectors: shape", lambda: kick.clip(1.0))
        self.assertEqual((2, 3, n), kick.clip(np.zeros((2, 3, n))).shape)

    def test_rewards_and_names_of_an_environment(self):
        for reward in (None, float("nan"), "much", [1.0, 2.0], 1j):
            with uchilsim.Env(self.client, DOG, reward=lambda before, now: reward) as env:
                env.reset(seed=1)
                self.refused("reward: .* is not allowed; a finite number", lambda: env.step(env.action_space.sample()))
        self.refused("joints: 'LF_J1' is not allowed; a sequence of names", lambda: uchilsim.Env(self.client, DOG, joints="LF_J1"))
        self.refused("address: 50051 is not allowed", lambda: uchilsim.Env(50051, DOG))
        with self.client.open("games/dog.json") as world:
            joints = len(world.robots["dog"].joints)
            self.refused("targets of dog: .* is not allowed", lambda: world.step(1, {"dog": np.zeros(joints, complex)}))

    def test_environments(self):
        for wrong in ({"frame_skip": 0}, {"max_steps": 0.5}):
            self.refused("a whole number from 1 on", lambda: uchilsim.Env(self.client, **wrong))
        self.refused("num_envs: 0 is not allowed", lambda: uchilsim.VectorEnv(0, self.client))
        with uchilsim.Env(self.client) as env:
            self.refused("seed: -1", lambda: env.reset(seed=-1))
            env.reset(seed=np.int64(3))
            action = np.zeros(env.action_space.shape)
            action[3] = np.nan
            self.refused("action of .*: nan is not allowed; a finite number", lambda: env.step(action))
        self.refused("after close", lambda: env.step(action), uchilsim.NotNow)
        self.assertEqual([], self.client.worlds())

    def test_a_client_that_is_closed_and_a_server_that_is_not_there(self):
        client = uchilsim.Client(self.server.address)
        client.close()
        self.refused("the client is closed", client.info, uchilsim.NotNow)
        self.refused("the client is closed", client.wait, uchilsim.NotNow)
        self.refused("127.0.0.1:1: no server answers there", uchilsim.Client("127.0.0.1:1").info, uchilsim.Unreachable)

    def test_tokens_and_certificates(self):
        for token in (5, "two words", "line\nline", "é", " "):
            self.refused("token: what was given is not allowed", lambda: uchilsim.Client(self.server.address, token))
        with uchilsim.Client(self.server.address, "0123456789abcdef\n") as client:  # as a file has it
            self.assertEqual("drive", client.info().role)
        for file in ("/nowhere/cert.pem", __file__, 5):
            self.refused(f"certificate: {file!r}"[:50], lambda: uchilsim.Client("127.0.0.1:1", certificate=file))

    def test_a_server_of_another_version_is_said(self):
        with self.client.open(DOG) as world, mock.patch.object(
                self.client._worlds, "Get", self.client._channel.unary_unary("/uchilsim.v1.Worlds/Foretell", bytes)):
            with mock.patch("uchilsim.world.made", return_value=b""):
                self.refused("127.0.0.1:.*: this server does not know this call: it has another version", world.state,
                             uchilsim.Error)

    def test_channels_are_names(self):
        with self.client.open(DOG) as world:
            self.refused("channels: 'time_s' is not allowed; a sequence of names", lambda: world.state(channels="time_s"))

    def test_what_cannot_be_copied_says_so(self):
        with uchilsim.Env(self.client, DOG) as env:
            for thing in (self.client, env, env.world):
                self.refused("cannot be copied or sent to another process", lambda: pickle.dumps(thing))

    def test_an_answer_that_does_not_come_in_time(self):
        experiment = self.client.experiment("experiments/kick-short.json")
        self.refused("no answer in the time that the call had",
                     lambda: experiment.evaluate(np.tile(experiment.start, (100, 1)), timeout=0.01), uchilsim.TooLate)


class Programs(unittest.TestCase):
    """Robots whose games have an OPEN-R stick in them."""

    @classmethod
    def setUpClass(cls):
        cls.server = Server()
        games = cls.server.folder / "games"
        crashing = cls.server.folder / "crashing"
        shutil.copytree(RESOURCES.parent / "tests/openr/programs/clumsy", crashing)
        source = crashing / "Clumsy/Clumsy.cc"
        source.write_text(source.read_text().replace("switch (readies++", "*(int*)0 = 1;\n  switch (readies++"))
        reading = RESOURCES.parent / "tests/openr/programs/filer"
        for program in (RESOURCES / "openr/PanPath", crashing, reading):
            built = subprocess.run([BTR, "openr", "build", str(program), "--out", str(games / program.name)],
                                   capture_output=True, text=True)
            assert built.returncode == 0, built.stderr
        for name, stick in (("pan", "PanPath"), ("crash", "crashing"), ("read", "filer"), ("none", "nowhere")):
            scene = {"format": "uchilsim-scene-1", "step_s": 0.004, "control_period_s": 0.008, "floor": {"friction": 1},
                     "robots": [{"name": "red1", "model": DOG}]}
            (games / f"{name}.json").write_text(json.dumps(
                {"format": "uchilsim-game-1", "scene": scene,
                 "robots": {"red1": {"controller": {"openr": {"stick": stick}}}}}))
        cls.client = uchilsim.Client(cls.server.address)

    @classmethod
    def tearDownClass(cls):
        cls.client.close()
        cls.server.close()

    def test_a_program_moves_its_robot_as_without_a_server(self):
        with self.client.open("pan.json") as world:
            self.assertEqual("openr", world.robots["red1"].controller)
            state = world.step(250)
            self.assertEqual({"red1": ""}, state.programs)
            said = world.lines()
            self.assertIn("pan gains 8 2 4, 0 ms ahead", [line.text for line in said])
            self.assertEqual([], world.lines())
            world.reset()
            world.step(250)
            self.assertEqual(said, world.lines()[-len(said):])
            trace = world.close()
        alone = subprocess.run([BTR, "--json", "live", str(self.server.folder / "games/pan.json"), "--seconds", "2"],
                               capture_output=True, text=True)
        self.assertEqual(trace, json.loads(alone.stdout)["trace_sha256"])

    def test_a_program_reads_what_is_typed_on_its_console(self):
        with self.client.open("read.json") as world:
            world.type("red1", "Ada\n")
            world.type("red1", "7 dogs\n")
            world.step(5)
            said = [line.text for line in world.lines()]
            self.assertIn("name? hello Ada", said)
            self.assertIn("7 dogs", said)
            with self.assertRaisesRegex(uchilsim.Refused, "robot: .*blue1.* is not allowed"):
                world.type("blue1", "Ada\n")

    def test_without_its_controller_a_robot_has_no_program(self):
        with self.client.open("pan.json", without_controller=["red1"]) as world:
            self.assertEqual(({}, ""), (world.step(2).programs, world.robots["red1"].controller))

    def test_a_crash_is_said_and_the_world_goes_on(self):
        with self.client.open("crash.json") as world:
            state = world.step(3)
            self.assertEqual({"red1": "Clumsy crashed in Ready: it wrote at address 0"}, state.programs)
            self.assertEqual((3, ""), (state.period, state.fault))
            self.assertEqual([("", "the program ended: Clumsy crashed in Ready: it wrote at address 0")],
                             [(line.object, line.text) for line in world.lines()])

    def test_a_stick_that_is_not_there_is_refused(self):
        with self.assertRaisesRegex(uchilsim.Refused, "robots red1/controller/openr: .*nowhere: no folder"):
            self.client.open("none.json")

    def test_a_module_that_cannot_be_loaded_is_said(self):
        games = self.server.folder / "games"
        shutil.copytree(games / "PanPath", games / "nowhere")
        try:
            for module in (games / "nowhere/OPEN-R/MW/OBJS").iterdir():
                module.write_text("no module")
            with self.client.open("none.json") as world:
                said = "PANPATH.BIN is no module"
                self.assertIn(said, world.step(2).programs["red1"])
                self.assertTrue(any(said in line.text for line in world.lines()))
        finally:
            shutil.rmtree(games / "nowhere")


class Cameras(WithServer):
    def setUp(self):
        if not os.path.exists(os.path.join(os.path.dirname(BTR), "btr-camera")):
            self.skipTest("btr-camera was not built")

    def test_a_robots_camera_sees_what_is_before_it(self):
        with self.client.open(DOG) as world:
            before = world.picture("robot")
            self.assertEqual((160, 208, 3), before.shape)
            world.add(ball={"name": "ball", "position_m": [0.5, 0, 0.0425]})
            world.step(10)
            self.assertGreater(np.abs(world.picture("robot").astype(int) - before).max(), 30)
            with self.assertRaisesRegex(uchilsim.Refused, "a robot of this game"):
                world.picture("cat")

    def test_frames_of_a_playing_world_come_as_a_stream(self):
        with self.client.open(DOG) as world:
            world.play(1)
            periods = []
            for period, frame in world.pictures("robot"):
                periods.append(period)
                if len(periods) == 3:
                    break
            self.assertEqual(sorted(set(periods)), periods)

    def test_frames_from_memory_are_those_that_calls_bring(self):
        calling = uchilsim.Client(self.server.address, shared_pictures=False)
        with self.client.open(DOG) as world:
            other = calling.world(world.name)
            world.picture("robot")
            self.assertTrue(world._camera("robot").is_shared)
            for seed in (None, 2):  # and after a reset
                for _ in range(12):
                    world.step(1)
                    np.testing.assert_array_equal(other.picture("robot"), world.picture("robot"))
                self.assertTrue(world._camera("robot").is_shared)
                world.reset(seed)
            self.assertFalse(other._camera("robot").is_shared)
        with self.assertRaises(uchilsim.NotFound):  # not the last frame of a world that has ended
            world.picture("robot")
        calling.close()

    def test_frames_from_memory_come_in_order_while_somebody_else_steps(self):
        stepping = uchilsim.Client(self.server.address)
        with self.client.open(DOG) as world:
            world.picture("robot")
            frames = world._camera("robot").frames()
            first = next(frames)
            other = stepping.world(world.name)
            numbers = []
            for _ in range(6):  # each frame as it comes
                while other.step(1).fault == "" and world._camera("robot").last().number <= first.number + len(numbers):
                    pass
                numbers.append(next(frames).number)
            self.assertEqual([first.number + i for i in range(1, 7)], numbers)
            frames.close()
        stepping.close()

    def test_a_client_that_cannot_read_the_memory_is_sent_frames(self):
        with mock.patch("os.open", side_effect=PermissionError("another user")), self.client.open(DOG) as world:
            self.assertEqual((160, 208, 3), world.picture("robot").shape)
            self.assertFalse(world._camera("robot").is_shared)
            world.play(1)
            self.assertEqual(3, len(list(itertools.islice(world.pictures("robot"), 3))))

    def test_a_frame_is_the_callers_own(self):
        with self.client.open(DOG) as world:
            for shared in (True, False):
                with uchilsim.Client(self.server.address, shared_pictures=shared) as client:
                    picture = client.world(world.name).picture("robot")
                    picture[:] = 0
                    self.assertGreater(client.world(world.name).picture("robot").max(), 0)

    def test_memory_with_frames_is_gone_with_its_world_however_that_ends(self):
        server = Server()
        client = uchilsim.Client(server.address)
        world = client.open(DOG)
        world.picture("robot")
        file = world._camera("robot")._shared.file
        self.assertTrue(os.path.exists(file))
        os.kill(int(file.split("/")[2]), 9)
        with self.assertRaises(uchilsim.Error):
            while True:
                world.picture("robot")
        self.assertFalse(os.path.exists(file))
        client.close()
        server.close()

    def test_the_example_saves_a_picture(self):
        out = self.server.folder / "picture.png"
        subprocess.run([sys.executable, str(RESOURCES / "python" / "camera_picture.py"), self.server.address, str(out)],
                       check=True, capture_output=True)
        self.assertEqual(b"\x89PNG\r\n\x1a\n", out.read_bytes()[:8])


class Environments(WithServer):
    def test_an_environment_keeps_gymnasiums_interface(self):
        with uchilsim.Env(self.client, DOG, max_steps=5) as env:
            self.assertIs(env, env.unwrapped)
            observation, info = env.reset(seed=3)
            self.assertTrue(env.observation_space.contains(observation))
            self.assertIsInstance(info, dict)
            env.action_space.seed(1)
            action = env.action_space.sample()
            self.assertTrue(env.action_space.contains(action))
            for i in range(5):
                observation, reward, terminated, truncated, info = env.step(action)
                self.assertTrue(env.observation_space.contains(observation))
                self.assertIsInstance(reward, float)
                self.assertIsInstance(terminated, bool)
                self.assertEqual(i == 4, truncated)
            self.assertTrue(np.isfinite(observation).all())

    def test_the_same_seed_gives_the_same_bits_and_the_next_one_others(self):
        with uchilsim.Env(self.client, "games/two-dogs-and-a-ball.json", robot="blue1") as env:
            def play(seed):
                rows = [env.reset(seed=seed)[0]]
                actions = np.random.default_rng(1)
                for _ in range(20):
                    rows.append(env.step(actions.uniform(env.action_space.low, env.action_space.high))[0])
                return np.array(rows)
            self.assertTrue(np.array_equal(play(1), play(1)))
            first = env.np_random.integers(1000)
            self.assertNotEqual((env.reset(seed=1), env.np_random.integers(1000))[1],
                                (env.reset(), env.np_random.integers(1000))[1])
            self.assertGreaterEqual(first, 0)

    def test_rewards_ends_joints_and_channels_are_the_callers(self):
        with uchilsim.Env(self.client, DOG, joints=["HEAD_PAN"], observation=["robot.HEAD_PAN.position_rad"], frame_skip=5,
                          reward=lambda before, now: now["robot.HEAD_PAN.position_rad"] - before["robot.HEAD_PAN.position_rad"],
                          terminated=lambda now: now["robot.HEAD_PAN.position_rad"] > 0.3) as env:
            self.assertEqual(((1,), (1,)), (env.observation_space.shape, env.action_space.shape))
            begun, _ = env.reset(seed=1)
            total, terminated, steps = 0.0, False, 0
            while not terminated and steps < 100:
                observation, reward, terminated, _, info = env.step([0.5])
                total += reward
                steps += 1
            self.assertTrue(terminated)
            self.assertAlmostEqual(observation[0] - begun[0], total)
            self.assertAlmostEqual(0.04 * steps, info["time_s"])
            with self.assertRaises(uchilsim.Refused):
                env.step([float("nan")])
            with self.assertRaises(uchilsim.Refused):
                env.step([0, 0])

    def test_a_vector_of_environments_is_each_of_them_alone(self):
        actions = np.random.default_rng(1).uniform(-0.2, 0.2, (6, 3, 18)).astype(np.float32)
        vector = uchilsim.VectorEnv(3, self.client, DOG, max_steps=4)
        self.assertEqual((3, 18), vector.action_space.shape)
        observations, infos = vector.reset(seed=5)
        self.assertTrue(vector.observation_space.contains(observations))
        together = []
        for step in range(6):
            observations, rewards, terminated, truncated, infos = vector.step(actions[step])
            together.append(observations)
            self.assertEqual((3,), rewards.shape)
            self.assertEqual([step == 3] * 3, truncated.tolist())
            if step == 4:  # a new episode, whose first step does nothing
                self.assertEqual([0.0] * 3, rewards.tolist())
                self.assertEqual([0.0] * 3, infos["time_s"].tolist())
        vector.close()
        with uchilsim.Env(self.client, DOG, max_steps=4) as env:
            for i in range(3):
                env.reset(seed=5 + i)
                for step in range(4):
                    self.assertTrue(np.array_equal(together[step][i], env.step(actions[step][i])[0]))

    def test_after_ctrl_c_an_environment_goes_on_where_its_world_is(self):
        def interrupted(env, act):
            """Ctrl-C while the answer to a step is on its way."""
            receive = env.world._steps.receive

            def press():
                receive()  # it was made
                raise KeyboardInterrupt
            env.world._steps.receive = press
            with self.assertRaises(KeyboardInterrupt):
                act()

        actions = np.random.default_rng(1).uniform(-0.2, 0.2, (4, 2, 18))
        with uchilsim.Env(self.client, DOG, max_steps=3) as env, uchilsim.Env(self.client, DOG) as whole:
            env.reset(seed=2)
            whole.reset(seed=2)
            env.step(actions[0][0])
            interrupted(env, lambda: env.step(actions[1][0]))
            observation, _, _, truncated, info = env.step(actions[2][0])
            for i in range(3):
                expected = whole.step(actions[i][0])
            self.assertTrue(np.array_equal(expected[0], observation))
            self.assertEqual(expected[4]["time_s"], info["time_s"])
            self.assertTrue(truncated)  # the interrupted one counts
        vector = uchilsim.VectorEnv(2, self.client, DOG)
        vector.reset(seed=2)
        vector.step(actions[0])
        interrupted(vector.envs[0], lambda: vector.step(actions[1]))
        vector.step(actions[2])
        for env in vector.envs:
            self.assertEqual(env.world.state().period, env.state.period)
        vector.close()

    def test_a_world_that_is_opened_when_ctrl_c_comes_is_closed(self):
        closed = queue.SimpleQueue()
        close_opened = self.client._close_opened

        class Interrupted:
            """Ctrl-C while the answer is on its way."""

            def __init__(self, call):
                self.add_done_callback = call.add_done_callback

            def result(self):
                raise KeyboardInterrupt

        begin = self.client._worlds.Open.future
        before = self.client.worlds()
        closing = mock.patch.object(self.client, "_close_opened", lambda call: closed.put(close_opened(call)))
        with closing, mock.patch.object(self.client._worlds, "Open") as Open, self.assertRaises(KeyboardInterrupt):
            Open.future = lambda *args, **more: Interrupted(begin(*args, **more))
            self.client.open(DOG)
        closed.get(timeout=60).result()
        with closing, mock.patch("uchilsim.client.World", side_effect=KeyboardInterrupt):  # it has just come
            with self.assertRaises(KeyboardInterrupt):
                self.client.open(DOG)
        closed.get(timeout=60).result()
        self.assertEqual(before, self.client.worlds())

    def test_what_cannot_be_made_leaves_no_world_behind(self):
        before = self.client.worlds()
        for make in (lambda: uchilsim.Env(self.client, DOG, joints=["WING"]),
                     lambda: uchilsim.Env(self.server.address, DOG, robot="cat"),
                     lambda: uchilsim.VectorEnv(3, self.client, DOG, observation=["robot.mood"])):
            with self.assertRaises(uchilsim.NotFound):
                make()
        self.assertEqual(before, self.client.worlds())

    def test_a_server_says_how_many_environments_step_side_by_side(self):
        self.assertGreaterEqual(self.client.info().most_streams, self.client.info().most_worlds)

    def test_everybody_knows_the_channels_of_a_world(self):
        with self.client.open(DOG) as world:
            other = self.client.world(world.name)
            world.send_step(1, {})
            world.receive_step()
            third = self.client.world(world.name)
            third.add(ball={"name": "b2", "position_m": [1, 0, 0.5]})
            third.add(ball={"name": "b3", "position_m": [1, 1, 0.5]})
            other.remove("b3")
            # The same number of channels as before would not be told by the row's length.
            other.add(ball={"name": "b4", "position_m": [1, 1, 0.25]})
            self.assertEqual(0.25, world.state()["b4.z_m"])
            world.send_step(1, {})
            self.assertLess(world.receive_step()["b4.z_m"], 0.25)
            self.assertGreater(third.reset(seed=1)["robot.base.qw"], 0.99)
            for each in (world, third, other):
                self.assertNotIn("b4.z_m", each.state().channels)

    def test_a_box_is_a_box(self):
        from uchilsim.spaces import _Box
        box = _Box([-1, 0, -np.inf], [1, np.inf, np.inf], dtype=np.float32, seed=1)
        for _ in range(100):
            self.assertIn(box.sample(), box)
        self.assertFalse(box.contains(np.array([2, 0, 0], np.float32)))
        self.assertFalse(box.contains(np.zeros(2, np.float32)))
        self.assertEqual(box, _Box([-1, 0, -np.inf], [1, np.inf, np.inf], dtype=np.float32))
        self.assertEqual([True, True, False], box.bounded_below.tolist())
        self.assertEqual([True, False, False], box.bounded_above.tolist())
        self.assertEqual([False, False, False], [box.is_bounded(m) for m in ("below", "above", "both")])
        self.assertTrue(_Box(0, 1, (2,)).is_bounded())
        with self.assertRaises(uchilsim.Refused):
            box.is_bounded("sideways")
        self.assertIsInstance(box.np_random, np.random.Generator)

    def test_numbers_of_a_vector_are_those_of_its_seed_and_options_a_dictionary(self):
        with uchilsim.Env(self.client, DOG, joints=[]) as env:
            self.assertEqual((0,), env.action_space.shape)
            env.reset(options={})
            env.step(env.action_space.sample())
            with self.assertRaisesRegex(uchilsim.Refused, "options: .* is not allowed; a dictionary"):
                env.reset(options=[1])
        vector = uchilsim.VectorEnv(1, self.client, DOG)
        vector.reset(seed=3)
        self.assertEqual(3, vector.np_random_seed)
        self.assertEqual(np.random.default_rng(3).integers(1000), vector.np_random.integers(1000))
        vector.close()


def observe_once(address):
    """In another process."""
    with uchilsim.Env(address, DOG) as env:
        env.reset(seed=1)
        return env.step(np.zeros(18))[0].tolist()


class Forks(WithServer):
    """Processes that are forked, as multiprocessing does it by itself."""

    def test_one_that_is_forked_says_what_to_do_and_its_parent_goes_on(self):
        context = multiprocessing.get_context("fork")
        answers = context.SimpleQueue()

        def work(env):
            for use in (lambda: env.step(np.zeros(18)), self.client.info, lambda: observe_once(self.server.address)):
                try:
                    use()
                except uchilsim.NotNow as error:
                    answers.put(str(error))
            env.close()

        with uchilsim.Env(self.client, DOG) as env:
            env.reset(seed=1)
            expected = env.step(np.zeros(18))[0].tolist()
            child = context.Process(target=work, args=(env,))
            child.start()
            child.join()
            self.assertEqual(0, child.exitcode)
            for sentence in ("make a Client in each process", "make a Client in each process", "before the first Client"):
                self.assertIn(sentence, answers.get())
            env.step(np.zeros(18))
            with uchilsim.Client(self.server.address) as fresh:
                self.assertEqual("drive", fresh.info().role)
            self.assertEqual(expected, observe_once(self.server.address))

    def test_who_forks_before_the_first_client_has_one_in_each_process(self):
        program = """
import os, sys, uchilsim
child = os.fork()
with uchilsim.Client(sys.argv[1]) as client:
    role = client.info().role
if child == 0:
    os._exit(0 if role == "drive" else 1)
sys.exit(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]))
"""
        subprocess.run([sys.executable, "-c", program, self.server.address], check=True)


class Learning(WithServer):
    def test_a_population_is_worth_what_it_is_in_any_order(self):
        experiment = self.client.experiment("experiments/kick-short.json")
        random = np.random.default_rng(1)
        population = experiment.clip(random.uniform(experiment.lower, experiment.upper, (6, 25)))
        whole = experiment.evaluate(population, seed=3)
        self.assertEqual((6,), whole.fitness.shape)
        backwards = uchilsim.evaluate(population[::-1], "experiments/kick-short.json", seed=3, address=self.server.address)
        self.assertTrue(np.array_equal(whole.fitness, backwards[::-1]))
        with self.assertRaisesRegex(uchilsim.Refused, "vector 1"):
            experiment.evaluate([population[0], population[0] + 1e6])

    def test_a_learner_that_forgets_goes_on_from_its_state(self):
        class Counting:
            """Vectors of the start's surroundings; its state is how often it was asked."""
            asked, told = 0, []

            def __init__(self, question):
                self.question = question

            def ask(self):
                self.asked += 1
                middle = (self.question.lower + self.question.upper) / 2
                return self.question.clip(np.tile(middle, (2, 1)) * (1 + 0.01 * self.asked))

            def tell(self, vectors, fitness):
                Counting.told.append((vectors, fitness))

            def state(self):
                return str(self.asked)

            def restore(self, state):
                self.asked = int(state)

        spec = self.client.experiment("experiments/kick-short.json").spec
        spec.update(name="counting", learner={"name": "remote"}, reality="remote", stages={
            "first_generations": 3, "next_generations": 1, "total_generations": 3, "measured_individuals": 1})
        run = self.client.experiment(spec, directory="experiments").start_run()
        questions = run.questions()
        for _ in range(2):
            question = next(questions)
            learner = Counting(question)
            if question.state:
                learner.restore(question.state)
            vectors = learner.ask()
            with self.assertRaisesRegex(uchilsim.Refused, "no number"):
                question.answer(vectors * np.nan)
            question.answer(vectors, learner.state())
        with self.assertRaisesRegex(uchilsim.NotNow, "wait for real fitness"):
            run.serve(learner=Counting)
        self.assertEqual(3, run.generation)
        vectors, fitness = run.individuals(3)
        self.assertEqual((2, 25), vectors.shape)
        middle = (question.lower + question.upper) / 2
        self.assertTrue(np.allclose(question.clip(middle * 1.03), vectors[0]))
        task = run.tasks()[0]
        self.assertEqual(25, len(task.values()))
        task.send(void=True, note="the robot fell")
        with self.assertRaisesRegex(uchilsim.Refused, "not"):
            task.send(float("nan"))
        self.assertEqual("waiting", run.refresh().state)  # all values are void


class Kills(unittest.TestCase):
    def test_a_server_that_is_killed_leaves_database_and_logs_whole(self):
        server = Server()
        try:
            with uchilsim.Client(server.address) as client:
                world = client.open(DOG)
                for i in range(10):
                    world.step(1, {"robot": np.full(18, 0.01 * i)})
                spec = client.experiment("experiments/kick-short.json").spec
                spec.update(name="killed", reality="remote")
                run = client.experiment(spec, directory="experiments").start_run()
                while run.refresh().generation == 0:
                    pass
            server.process.kill()
            server.process.communicate()
            log = server.folder / "games" / world.log_file
            replay = subprocess.run([BTR, "--json", "live", str(log.with_suffix(".json")), "--replay", str(log)],
                                    capture_output=True, text=True, check=True)
            # Up to its last act, or to the end where the world still saw that the server was gone.
            self.assertIn(json.loads(replay.stdout)["periods"], (9, 10))
            db = str(server.folder / "a.db")
            subprocess.run([BTR, "check", "--db", db], capture_output=True, check=True)
            # Nobody works on it any more, so that it could go on at once.
            runs = json.loads(subprocess.run([BTR, "--json", "status", "--db", db], capture_output=True, check=True).stdout)
            self.assertFalse(runs[0]["active"])
        finally:
            shutil.rmtree(server.folder)


class Access(unittest.TestCase):
    def test_a_token_and_tls_open_the_door_and_nothing_else_does(self):
        folder = pathlib.Path(tempfile.mkdtemp())
        try:
            subprocess.run(["openssl", "req", "-x509", "-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:prime256v1", "-nodes",
                            "-days", "1", "-subj", "/CN=test", "-addext", "subjectAltName=IP:127.0.0.1", "-keyout",
                            str(folder / "key.pem"), "-out", str(folder / "cert.pem")], check=True, capture_output=True)
            tokens = folder / "tokens"
            tokens.write_text("drive 0123456789abcdef0123456789 me\nadministrate abcdef0123456789abcdef me\n")
            tokens.chmod(0o644)
            arguments = ["--tls", str(folder / "cert.pem"), str(folder / "key.pem"), "--token-file", str(tokens)]
            refused = subprocess.run([BTR, "serve", "--port", "0", *arguments], capture_output=True, text=True)
            self.assertEqual((1, 1), (refused.returncode, len(refused.stderr.splitlines())))
            self.assertIn("0600", refused.stderr)
            tokens.chmod(0o600)
            server = Server(*arguments)
            certificate = folder / "cert.pem"
            with uchilsim.Client(server.address, "0123456789abcdef0123456789", certificate) as client:
                self.assertEqual("drive", client.wait().role)
                with self.assertRaises(uchilsim.NoAccess):
                    client.shut_down()
            for token, given in (("0123456789abcdef012345678", certificate), (None, certificate)):
                with uchilsim.Client(server.address, token, given) as client, self.assertRaises(uchilsim.NoAccess):
                    client.info()
            subprocess.run(["openssl", "req", "-x509", "-key", str(folder / "key.pem"), "-days", "1", "-subj", "/CN=other",
                            "-addext", "subjectAltName=IP:127.0.0.2", "-out", str(folder / "other.pem")], check=True,
                           capture_output=True)
            port = server.said["port"]
            for address, given, why in ((server.address, None, "wants certificate=FILE"),
                                        (f"localhost:{port}", certificate, "connect to one of its subjectAltName"),
                                        (server.address, folder / "other.pem", "the server's certificate is another one")):
                with uchilsim.Client(address, "0123456789abcdef0123456789", given) as client:
                    for ask in (client.info, lambda: client.wait(0.2)):
                        with self.assertRaisesRegex(uchilsim.Unreachable, why):
                            ask()
            with uchilsim.Client(server.address, "abcdef0123456789abcdef", certificate) as client:
                client.shut_down()
            self.assertEqual(0, server.process.wait(30))
            server.close()
        finally:
            shutil.rmtree(folder)

    def test_an_address_beyond_this_machine_needs_both(self):
        result = subprocess.run([BTR, "serve", "--address", "0.0.0.0", "--port", "0"], capture_output=True, text=True)
        self.assertEqual(1, result.returncode)
        self.assertIn("without TLS and tokens", result.stderr)
        self.assertEqual(1, len(result.stderr.splitlines()))


class Examples(WithServer):
    def run_example(self, name, *arguments):
        result = subprocess.run([sys.executable, str(RESOURCES / "python" / name), self.server.address, *arguments],
                                capture_output=True, text=True, env=os.environ)
        self.assertEqual("", result.stderr)
        return result.stdout

    def test_a_policy_walks(self):
        lines = self.run_example("walk_env.py").splitlines()
        self.assertGreater(float(lines[0].split()[2]), 0.1)
        self.assertEqual(4, lines[1].count(" m"))

    def test_cma_es_learns_a_kick(self):
        lines = self.run_example("cma_es_kick.py", "6").splitlines()
        means = [float(line.split()[6]) for line in lines if line.startswith("generation")]
        self.assertEqual(6, len(means))
        self.assertGreater(means[-1], 2 * means[0])
        self.assertIn("finished", lines[-1])

    def test_a_robot_in_the_lab_measures(self):
        lines = self.run_example("lab_robot.py", "2").splitlines()
        self.assertIn("finished", lines[-1])
        self.assertGreaterEqual(sum(line.startswith("individual") for line in lines), 6)
        db = str(self.server.folder / "a.db")
        runs = json.loads(subprocess.run([BTR, "--json", "status", "--db", db], capture_output=True, check=True).stdout)
        self.assertIn("remote", {run["reality"] for run in runs})


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[3:], verbosity=1)

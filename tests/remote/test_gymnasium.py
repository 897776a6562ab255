"""The environments where Gymnasium is installed: they are its own. Against Gymnasium itself with its own checker, where
it is there; else against a stand-in of its documented interface.
   python3 test_gymnasium.py BTR RESOURCES"""
import gc
import inspect
import unittest
import unittest.mock

import numpy as np

try:
    import gymnasium
    from gymnasium.utils.env_checker import check_env
except ImportError:
    import gymnasium_stand_in
    gymnasium_stand_in.install()
    import gymnasium
    check_env = None

import uchilsim
from test_python import DOG, WithServer


class Gymnasium(WithServer):
    def test_an_environment_is_one_of_gymnasiums(self):
        with uchilsim.Env(self.client, DOG) as env:
            self.assertIsInstance(env, gymnasium.Env)
            for space in (env.observation_space, env.action_space):
                self.assertIs(gymnasium.spaces.Box, type(space))
            self.assertIs(env, env.unwrapped)
            self.assertEqual([], env.metadata["render_modes"])
            parameters = inspect.signature(env.reset).parameters
            self.assertTrue(all(parameters[p].kind is inspect.Parameter.KEYWORD_ONLY for p in ("seed", "options")))

    def test_it_does_what_gymnasiums_checker_asks_for(self):
        with uchilsim.Env(self.client, DOG, max_steps=4) as env:
            if check_env:
                check_env(env, skip_render_check=True)
            env.action_space.seed(1)
            first, info = env.reset(seed=7)
            state = env.np_random.bit_generator.state
            self.assertEqual(7, env.np_random_seed)
            self.assertTrue(env.observation_space.contains(first))
            self.assertIsInstance(info, dict)
            again, _ = env.reset(seed=7)
            self.assertTrue(np.array_equal(first, again))
            self.assertEqual(state, env.np_random.bit_generator.state)
            for step in range(4):
                action = env.action_space.sample()
                self.assertTrue(env.action_space.contains(action))
                observation, reward, terminated, truncated, info = env.step(action)
                self.assertTrue(env.observation_space.contains(observation))
                self.assertTrue(np.isfinite(reward) and isinstance(reward, float))
                self.assertIsInstance(terminated, bool)
                self.assertIsInstance(truncated, bool)
                self.assertIsInstance(info, dict)
            self.assertTrue(truncated)
            env.np_random = np.random.default_rng(1)
            self.assertEqual(-1, env.np_random_seed)

    def test_a_vector_is_one_of_gymnasiums_and_ends_once(self):
        vector = uchilsim.VectorEnv(2, self.client, DOG, max_steps=2)
        self.assertIsInstance(vector, gymnasium.vector.VectorEnv)
        self.assertIs(gymnasium.vector.AutoresetMode.NEXT_STEP, vector.metadata["autoreset_mode"])
        self.assertIs(gymnasium.spaces.Box, type(vector.observation_space))
        observations, _ = vector.reset(seed=1)
        self.assertTrue(vector.observation_space.contains(observations))
        actions = np.clip(np.float32(0), vector.action_space.low, vector.action_space.high)
        self.assertTrue(vector.action_space.contains(actions))
        for step in range(3):
            observations, rewards, terminated, truncated, infos = vector.step(actions)
            self.assertEqual((2,), rewards.shape)
            self.assertEqual((bool, bool), (terminated.dtype, truncated.dtype))
            self.assertTrue(infos["_time_s"].all())
        self.assertEqual([0.0, 0.0], infos["time_s"].tolist())  # began anew
        vector.close()
        self.assertTrue(vector.closed)
        vector.close()

    def test_what_cannot_be_made_is_said_without_a_second_error(self):
        # The base class closes whatever is thrown away.
        with unittest.mock.patch("sys.unraisablehook") as second:
            for client in (self.client, "nowhere:x:y"):
                with self.assertRaises((uchilsim.Error, OSError, ValueError)):
                    uchilsim.VectorEnv(2, client, DOG, robot="cat")
            gc.collect()
            second.assert_not_called()
        self.assertEqual([], self.client.worlds())


del WithServer  # it has no tests of its own

if __name__ == "__main__":
    unittest.main(argv=["test_gymnasium"])

"""A policy steps a dog in an environment of Gymnasium's kind, alone and four at once.
      btr serve   and then   python3 walk_env.py [ADDRESS [STEPS]]
"""
import sys

import numpy as np
import uchilsim

address, steps = (sys.argv[1:] + ["127.0.0.1:50051", "250"][len(sys.argv) - 1:])[:2]
legs = [f"{leg}_J{k}" for leg in ("LF", "RF", "LR", "RR") for k in (1, 2, 3)]


class Trot:
    """Diagonal legs swing together: 1.5 Hz, 0.25 rad, a bent knee while a leg comes forward."""

    def __init__(self, stance):
        self.stance, self.time = stance, 0.0

    def act(self, period_s):
        self.time += period_s
        action = self.stance.copy()
        for leg, phase in enumerate((0, np.pi, np.pi, 0)):
            angle = 3 * np.pi * self.time + phase
            action[3 * leg] -= 0.25 * np.sin(angle)
            action[3 * leg + 2] -= 0.4 * max(0.0, np.sin(angle))
        return action


with uchilsim.Client(address) as client:
    with uchilsim.Env(client, "games/dog.json", joints=legs, max_steps=int(steps)) as env:
        observation, info = env.reset(seed=1)
        stance = np.array([env.state[f"dog.{joint}.position_rad"] for joint in legs])
        trot, way = Trot(stance), 0.0
        truncated = terminated = False
        while not (terminated or truncated):
            observation, reward, terminated, truncated, info = env.step(trot.act(env.world.control_period_s))
            way += reward
        print(f"one dog: {way:.3f} m in {info['time_s']:.2f} s")

    dogs = uchilsim.VectorEnv(4, client, "games/dog.json", joints=legs, max_steps=int(steps))
    dogs.reset(seed=1)
    ways = np.zeros(4)
    for step in range(int(steps)):
        # Each with another swing.
        angles = 3 * np.pi * 0.008 * step + np.array([0, np.pi, np.pi, 0])
        actions = np.tile(stance, (4, 1))
        actions[:, 0::3] -= np.array([[0.1], [0.2], [0.3], [0.4]]) * np.sin(angles)
        actions[:, 2::3] -= 0.4 * np.maximum(0, np.sin(angles))
        observations, rewards, terminated, truncated, infos = dogs.step(actions)
        ways += rewards
    dogs.close()
    print("four dogs:", ", ".join(f"{way:.3f} m" for way in ways))

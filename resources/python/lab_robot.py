"""A robot in the lab with a computer of its own: it asks what to measure, kicks, and sends what it measured. Here a
script plays it: a simulator whose friction nobody told the run, with a tape measure that is good to 5 mm.
      btr serve --db my.db   and then   python3 lab_robot.py [ADDRESS [GENERATIONS]]
"""
import sys

import numpy as np
import uchilsim

address, generations = (sys.argv[1:] + ["127.0.0.1:50051", "8"][len(sys.argv) - 1:])[:2]
random = np.random.default_rng(7)

with uchilsim.Client(address) as client:
    spec = client.experiment("experiments/kick-short.json").spec
    laboratory = {**spec, "name": "The laboratory", "simulator": {"values": {"friction": 0.6, "servo_p_nm_rad": 6.5}}}
    robot = client.experiment(laboratory, directory="experiments")

    def measure(task):
        """One kick: how far the ball came [m], None where the trial does not count."""
        kick = robot.evaluate(task.parameters)
        print(f"individual {task.individual}: {kick.outcomes[0]}, {kick.fitness[0]:.3f} m")
        if kick.outcomes[0] != "finished":
            return None
        return max(0.0, float(kick.fitness[0] + random.normal(0, 0.005)))

    spec["adaptation"]["settings"]["generations"] = 3
    spec["adaptation"]["learner"]["settings"]["population"] = 6
    half = max(1, int(generations) // 2)
    spec.update(name="A kick for the lab's robot", reality="remote", stages={
        "first_generations": half, "next_generations": half, "total_generations": 2 * half, "measured_individuals": 3,
        "repeats": 2})
    run = client.experiment(spec, directory="experiments").start_run(seed=3).serve(robot=measure, sure=True)
    print(run)

"""How fast the open interface is, one table.
   PYTHONPATH=build/release/python python3 tests/remote/bench_remote.py build/release/bin/btr"""
import json
import subprocess
import sys
import tempfile
import time

import numpy as np
import uchilsim

btr = sys.argv[1]
DOG = "games/dog.json"


def per_second(work, count, rounds=5):
    """Median of some rounds."""
    rates = []
    for _ in range(rounds):
        begun = time.perf_counter()
        work(count)
        rates.append(count / (time.perf_counter() - begun))
    return np.median(rates)


with tempfile.TemporaryDirectory() as folder:
    server = subprocess.Popen([btr, "--json", "serve", "--port", "0", "--unix", folder + "/socket", "--rate", "1000000"], stdout=subprocess.PIPE, text=True)
    text = ""
    while not text.endswith("}\n"):
        text += server.stdout.readline()
    port = json.loads(text)["port"]
    random = np.random.default_rng(1)
    for name, address in (("TCP", f"127.0.0.1:{port}"), ("Unix socket", f"unix:{folder}/socket")):
        with uchilsim.Client(address) as client:
            with uchilsim.Env(client, DOG, max_steps=10**9) as env:
                env.reset(seed=1)
                actions = random.uniform(-0.1, 0.1, (1000, 18)).astype(np.float32)

                def steps(count):
                    for i in range(count):
                        env.step(actions[i % 1000])

                print(f"{name}: Env.step of one dog, 18 joints told anew: {per_second(steps, 2000):.0f}/s")
                still = np.zeros(18, np.float32)
                print(f"{name}: the same, nothing new told: "
                      f"{per_second(lambda n: [env.step(still) for _ in range(n)], 2000):.0f}/s")
                print(f"{name}: reset: {1000 / per_second(lambda n: [env.reset() for _ in range(n)], 10):.1f} ms")
            world = client.open(DOG, logged=False)
            print(f"{name}: 100 periods in one call: {100 * per_second(lambda n: [world.step(100) for _ in range(n)], 50):.0f} periods/s")
            world.close()
            vector = uchilsim.VectorEnv(4, client, DOG, max_steps=10**9)
            vector.reset(seed=1)
            four = random.uniform(-0.1, 0.1, (4, 18)).astype(np.float32)
            rate = per_second(lambda n: [vector.step(four * (1 + 0.01 * (i % 7))) for i in range(n)], 500)
            print(f"{name}: VectorEnv of four dogs: {4 * rate:.0f} steps of a dog/s")
            vector.close()
    # Frames both ways, one after the other in each round: the same steps, so that what differs is how a frame comes.
    address = f"127.0.0.1:{port}"
    with uchilsim.Client(address) as sharing, uchilsim.Client(address, shared_pictures=False) as calling:
        ways = {name: client.open(DOG, logged=False) for name, client in (("memory", sharing), ("calls", calling))}
        for world in ways.values():
            world.picture("dog")
        rates = {(name, what): [] for name in ways for what in ("picture()", "step(4) and picture()")}
        for _ in range(5):
            for name, world in ways.items():
                rates[name, "picture()"].append(per_second(lambda n: [world.picture("dog") for _ in range(n)], 500, 1))
            for name, world in ways.items():
                rates[name, "step(4) and picture()"].append(
                    per_second(lambda n: [(world.step(4), world.picture("dog")) for _ in range(n)], 100, 1))
        for (name, what), each in rates.items():
            print(f"frames by {name}: {what} {np.median(each):.0f}/s")
        for world in ways.values():
            world.close()
    server.send_signal(2)
    server.wait()

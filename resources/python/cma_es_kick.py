"""CMA-ES of one's own (Hansen, arXiv 1604.00772) learns a kick: it is the learner of a run, which stands in the
server's database like any other.      btr serve --db my.db   and then   python3 cma_es_kick.py [ADDRESS [GENERATIONS]]
"""
import sys

import numpy as np
import uchilsim


class CmaEs:
    def __init__(self, question, size=12):
        self.q, self.size, n, mu = question, size, len(question.parameters), size // 2
        w = np.log(mu + 0.5) - np.log(np.arange(1, mu + 1))
        self.w, self.random = w / w.sum(), np.random.default_rng(1)
        self.n, self.e = n, 1 / (self.w**2).sum()
        self.cs, self.cc = (self.e + 2) / (n + self.e + 5), (4 + self.e / n) / (n + 4 + 2 * self.e / n)
        self.c1 = 2 / ((n + 1.3)**2 + self.e)
        self.cm = min(1 - self.c1, 2 * (self.e - 2 + 1 / self.e) / ((n + 2)**2 + self.e))
        self.m, self.s, self.C, self.ps, self.pc = np.full(n, 0.5), 0.25, np.eye(n), np.zeros(n), np.zeros(n)

    def ask(self):
        self.A, self.z = np.linalg.cholesky(self.C), self.random.normal(size=(self.size, self.n))
        shares = np.clip(self.m + self.s * self.z @ self.A.T, 0, 1)
        return self.q.clip(self.q.lower + shares * (self.q.upper - self.q.lower))

    def tell(self, vectors, fitness):
        z = self.z[np.argsort(-fitness)[:len(self.w)]]
        y, step = z @ self.A.T, self.w @ z @ self.A.T
        self.m = self.m + self.s * step
        self.ps = (1 - self.cs) * self.ps + np.sqrt(self.cs * (2 - self.cs) * self.e) * (self.w @ z)
        self.pc = (1 - self.cc) * self.pc + np.sqrt(self.cc * (2 - self.cc) * self.e) * step
        self.s *= np.exp(self.cs * (np.linalg.norm(self.ps) / np.sqrt(self.n) - 1))
        self.C = (1 - self.c1 - self.cm) * self.C + self.c1 * np.outer(self.pc, self.pc) + self.cm * (y.T * self.w) @ y


address, generations = (sys.argv[1:] + ["127.0.0.1:50051", "20"][len(sys.argv) - 1:])[:2]
with uchilsim.Client(address) as client:
    spec = client.experiment("experiments/kick-short.json").spec
    spec.update(name="A kick by CMA-ES from Python", learner={"name": "remote"}, stages={
        "first_generations": int(generations), "next_generations": 1, "total_generations": int(generations),
        "measured_individuals": 2})
    spec["adaptation"]["settings"]["generations"] = 2
    run = client.experiment(spec, directory="experiments").start_run(seed=1).serve(learner=CmaEs)
    for g in run.generations():
        print(f"generation {g['number']}: best {g['best']:.3f} m, mean {g['mean']:.3f} m")
    print(run)

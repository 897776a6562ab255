#!/usr/bin/env python3
"""The seed papers' figures beside ours: one table from finished runs of the experiments "Learning to walk" and "Learning to kick".

    tests/papers/table.py BTR DATABASE walk|kick RUN [RUN ...]

BTR is the program; the runs are the seeds of one experiment. Each number is a mean over the runs with its 95 % interval
(Student's t), then the runs' own numbers. The papers' figures are those of Zagal and Ruiz-del-Solar (2004), measured on a
real ERS-7; ours are of the run's own reality, which the heading names.
"""
import csv
import io
import math
import subprocess
import sys

# Two-sided 95 % quantiles of Student's t by degrees of freedom (any statistical table).
T95 = [None, 12.706, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306, 2.262]


def export(btr, database, run, what):
    done = subprocess.run([btr, "export", "--db", database, "--run", run, "--what", what], stdout=subprocess.PIPE,
                          universal_newlines=True, check=False)
    if done.returncode != 0:
        sys.exit("btr export of run %s ended with %d" % (run, done.returncode))
    return list(csv.DictReader(io.StringIO(done.stdout)))


def number(row, beginning):
    """The value of the column that begins so: its end is the unit."""
    for name, text in row.items():
        if name == beginning or name.startswith(beginning + "_"):
            return float(text) if text != "" else None
    sys.exit("no column %s in %s" % (beginning, ", ".join(row)))


def real_by_stage(measurements):
    """Mean of the values that count, by stage and individual; policies of L2 are not among a stage's ten."""
    values = {}
    for row in measurements:
        if row["void"] == "1" or row["reason"].startswith("policy"):
            continue
        values.setdefault(int(row["stage"]), {}).setdefault(row["individual"], []).append(number(row, "value"))
    return {stage: [sum(v) / len(v) for v in each.values()] for stage, each in sorted(values.items())}


def mean(values):
    return sum(values) / len(values)


def spread(values):
    known = [v for v in values if v is not None]
    if not known:
        return "-"
    if len(known) == 1:
        return "%.3g" % known[0]
    m = mean(known)
    deviation = math.sqrt(sum((v - m) ** 2 for v in known) / (len(known) - 1))
    half = T95[min(len(known) - 1, len(T95) - 1)] * deviation / math.sqrt(len(known))
    return "%.3g ± %.2g" % (m, half)


def common(tables):
    ten = real_by_stage(tables["measurements"])
    gaps = tables["gaps"]
    hours = sum(float(g["wall_time_s"]) for g in tables["generations"]) / 3600
    return ten, gaps, hours


def walk(tables):
    ten, gaps, hours = common(tables)
    first, last = ten[min(ten)], ten[max(ten)]
    policies = [number(p, "measured_mean") for p in tables["policies"]]
    policies = [p for p in policies if p is not None]
    return [
        ("ten best after the first GA, average", mean(first), "18"),
        ("the best of them", max(first), "20"),
        ("mean gap between real and simulated of these ten, before L3", number(gaps[0], "new_before"), "-"),
        ("the same after L3", number(gaps[0], "new_after"), "2"),
        ("best policy of PGRL", max(policies) if policies else None, "23.5"),
        ("best at the end", max(last), "24.7"),
        ("mean gap of the last ten, unseen", number(gaps[-1], "new_before") if len(gaps) > 1 else None, "-"),
        ("generations of L1, computing time [h]", hours, "-"),
    ]


def kick(tables):
    ten, gaps, hours = common(tables)
    rows = []
    for stage, values in ten.items():
        rows.append(("stage %d: ten best, average real" % stage, mean(values), "-"))
        rows.append(("stage %d: the best of them" % stage, max(values), "-"))
    for gap in gaps:
        rows.append(("stage %s: mean gap of its ten, unseen" % gap["stage"], number(gap, "new_before"), "-"))
        rows.append(("stage %s: mean gap of all measured so far, after L3" % gap["stage"], number(gap, "after"), "-"))
    rows.append(("generations of L1, computing time [h]", hours, "8"))
    return rows


def main():
    if len(sys.argv) < 5 or sys.argv[3] not in ("walk", "kick"):
        sys.exit(__doc__)
    btr, database, which, runs = sys.argv[1], sys.argv[2], sys.argv[3], sys.argv[4:]
    whats = ["measurements", "gaps", "generations"] + (["policies"] if which == "walk" else [])
    all_rows, realities = [], set()
    for run in runs:
        tables = {what: export(btr, database, run, what) for what in whats}
        if not tables["gaps"]:
            sys.exit("run %s has no finished measurement stage" % run)
        realities.add(tables["gaps"][0]["reality"])
        all_rows.append(walk(tables) if which == "walk" else kick(tables))
    unit = "cm/s" if which == "walk" else "m"
    print("| reality: %s; fitness in %s | paper | ours, %d seeds | seed by seed |" % (", ".join(sorted(realities)), unit, len(runs)))
    print("|---|---|---|---|")
    for k, (name, _, paper) in enumerate(all_rows[0]):
        values = [rows[k][1] for rows in all_rows]
        print("| %s | %s | %s | %s |" % (name, paper, spread(values),
                                         ", ".join("-" if v is None else "%.3g" % v for v in values)))


if __name__ == "__main__":
    main()

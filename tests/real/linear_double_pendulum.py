#!/usr/bin/env python3
"""What linear least squares reaches on the DFKI double pendulum's runs: the peer of the gap analysis there.

    tests/real/linear_double_pendulum.py FOLDER      (python3-numpy, python3-scipy)

FOLDER holds the runs (design_C1_sysid_20230629). Base parameters of the rigid body, then viscous friction, Coulomb
friction and the elbow's rotor inertia are added in turn; the same four folds, filter (5 Hz, forwards and backwards) and
every 25th sample as in table.py. Prints the relative torque error of shoulder and elbow [%] on held-out runs.

Equations: the planar double pendulum, for example Spong, Hutchinson and Vidyasagar, Robot Modeling and Control, 7.4, with
angles from hanging and the second relative to the first.
"""
import argparse
import glob
import os

import numpy as np
from scipy.signal import butter, filtfilt

PERIOD_S = 0.002
LOWPASS_HZ = 5
EVERY = 25
STANDS_STILL_RAD_S = 0.05  # Coulomb friction as tanh of the velocity over this
FOLDS = 4
MODELS = ("rigid", "+ viscous", "+ Coulomb", "+ rotor")


def load(path):
    """q1, q2, their first and second derivatives, the two torques."""
    table = np.genfromtxt(path, delimiter=",", names=True)
    time = np.arange(table["time"][0], table["time"][-1], PERIOD_S)
    b, a = butter(4, LOWPASS_HZ * 2 * PERIOD_S)
    q1, q2, tau1, tau2 = (filtfilt(b, a, np.interp(time, table["time"], table[name]))
                          for name in ("pos_meas1", "pos_meas2", "tau_meas1", "tau_meas2"))
    v1, v2 = (np.gradient(q, PERIOD_S) for q in (q1, q2))
    a1, a2 = (np.gradient(v, PERIOD_S) for v in (v1, v2))
    edge = 10 * EVERY  # what the filter spoils at both ends
    return [column[edge:-edge:EVERY] for column in (q1, q2, v1, v2, a1, a2, tau1, tau2)]


def regressors(run, terms):
    """One matrix for each joint's torque, columns are parameters."""
    q1, q2, v1, v2, a1, a2 = run[:6]
    none = np.zeros_like(q1)
    coupled = np.cos(q2), np.sin(q2)
    shoulder = [a1, a1 + a2, coupled[0] * (2 * a1 + a2) - coupled[1] * (2 * v1 * v2 + v2 ** 2), np.sin(q1), np.sin(q1 + q2)]
    elbow = [none, a1 + a2, coupled[0] * a1 + coupled[1] * v1 ** 2, none, np.sin(q1 + q2)]
    if terms > 0:
        shoulder += [v1, none]
        elbow += [none, v2]
    if terms > 1:
        shoulder += [np.tanh(v1 / STANDS_STILL_RAD_S), none]
        elbow += [none, np.tanh(v2 / STANDS_STILL_RAD_S)]
    if terms > 2:  # the shoulder's rotor is not told from the upper arm's inertia
        shoulder += [none]
        elbow += [a2]
    return np.array(shoulder).T, np.array(elbow).T


def held_out_error(runs, fold, terms):
    train = [run for i, run in enumerate(runs) if i % FOLDS != fold]
    rest = [run for i, run in enumerate(runs) if i % FOLDS == fold]
    rows = np.vstack([part for run in train for part in regressors(run, terms)])
    torques = np.concatenate([part for run in train for part in run[6:]])
    parameters = np.linalg.lstsq(rows, torques, rcond=None)[0]
    errors = []
    for joint in (0, 1):
        recorded = np.concatenate([run[6 + joint] for run in rest])
        predicted = np.concatenate([regressors(run, terms)[joint] @ parameters for run in rest])
        errors.append(100 * np.sqrt(np.mean((predicted - recorded) ** 2) / np.mean(recorded ** 2)))
    return errors


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder")
    files = sorted(glob.glob(os.path.join(parser.parse_args().folder, "*.csv")))
    if len(files) < FOLDS:
        parser.error("%d runs; at least %d *.csv are needed" % (len(files), FOLDS))
    runs = [load(path) for path in files]
    for terms, name in enumerate(MODELS):
        folds = [held_out_error(runs, fold, terms) for fold in range(FOLDS)]
        print("%-10s mean %5.1f %5.1f   folds %s" %
              (name, *np.mean(folds, axis=0), ", ".join("%.1f/%.1f" % tuple(fold) for fold in folds)))


if __name__ == "__main__":
    main()

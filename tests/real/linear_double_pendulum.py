#!/usr/bin/env python3
"""What linear least squares reaches on the DFKI double pendulum's runs: the peer of the gap analysis there.

    tests/real/linear_double_pendulum.py FOLDER      (python3-numpy, python3-scipy)

FOLDER holds the runs (design_C1_sysid_20230629). Base parameters of the rigid body, then viscous friction, Coulomb
friction and the elbow's rotor inertia are added in turn. Folds and treatment are those of table.py and `btr gap residual
--inverse --lowpass 5 --every 25`: positions low-passed at 5 Hz, torques at 0.9 times what every 25th sample carries.
Prints the relative torque error of shoulder and elbow [%] on held-out runs.

Equations: the planar double pendulum, for example Spong, Hutchinson and Vidyasagar, Robot Modeling and Control, 7.4, with
angles from hanging and the second relative to the first.
"""
import argparse

import numpy as np
from scipy.signal import butter, sosfiltfilt

from table import cross_validate, csv_files, mean_of_folds

PERIOD_S = 0.002
LOWPASS_HZ = 5
EVERY = 25
ENDS = 10  # compared samples that the filters spoil at either end
STANDS_STILL_RAD_S = 0.05  # Coulomb friction as tanh of the velocity over this
MODELS = ("rigid", "+ viscous", "+ Coulomb", "+ rotor")


def lowpass(order, cutoff_hz, values):
    return sosfiltfilt(butter(order, cutoff_hz, fs=1 / PERIOD_S, output="sos"), values)


def compared(values):
    return lowpass(8, 0.45 / PERIOD_S / EVERY, values)[::EVERY][ENDS:-ENDS]


def regressors(q, v, a, terms):
    """One list of columns for each joint's torque; `q`, `v`, `a`: both joints' angles and their derivatives."""
    cos2, sin2 = np.cos(q[1]), np.sin(q[1])
    none = np.zeros_like(cos2)
    shoulder = [a[0], a[0] + a[1], cos2 * (2 * a[0] + a[1]) - sin2 * (2 * v[0] * v[1] + v[1] ** 2),
                np.sin(q[0]), np.sin(q[0] + q[1])]
    elbow = [none, a[0] + a[1], cos2 * a[0] + sin2 * v[0] ** 2, none, np.sin(q[0] + q[1])]
    if terms > 0:
        shoulder += [v[0], none]
        elbow += [none, v[1]]
    if terms > 1:
        shoulder += [np.tanh(v[0] / STANDS_STILL_RAD_S), none]
        elbow += [none, np.tanh(v[1] / STANDS_STILL_RAD_S)]
    if terms > 2:  # the shoulder's rotor is not told from the upper arm's inertia
        shoulder += [none]
        elbow += [a[1]]
    return shoulder, elbow


def load(path, terms):
    """For each joint: the regressors' rows and the recorded torques, at the compared samples."""
    table = np.genfromtxt(path, delimiter=",", names=True)
    time = np.arange(table["time"][0], table["time"][-1], PERIOD_S)

    def even(name):
        return np.interp(time, table["time"], table[name])

    q = [lowpass(4, LOWPASS_HZ, even("pos_meas%d" % joint)) for joint in (1, 2)]
    v = [np.gradient(angle, PERIOD_S) for angle in q]
    a = [np.gradient(rate, PERIOD_S) for rate in v]
    return [(np.array([compared(column) for column in columns]).T, compared(even("tau_meas%d" % joint)))
            for joint, columns in zip((1, 2), regressors(q, v, a, terms))]


def held_out_error(fold, terms):
    train = [joint for path in fold.train for joint in load(path, terms)]
    held_out = [load(path, terms) for path in fold.held_out]
    rows, torques = np.vstack([part for part, _ in train]), np.concatenate([part for _, part in train])
    parameters = np.linalg.lstsq(rows, torques, rcond=None)[0]
    errors = []
    for runs in zip(*held_out):
        recorded = np.concatenate([part for _, part in runs])
        predicted = np.concatenate([part @ parameters for part, _ in runs])
        errors.append(100 * np.sqrt(np.mean((predicted - recorded) ** 2) / np.mean(recorded ** 2)))
    return errors


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder")
    files = csv_files(parser.parse_args().folder)
    for terms, name in enumerate(MODELS):
        folds = [held_out_error(fold, terms) for fold in cross_validate(files, 4)]
        print("%-10s mean %5.1f %5.1f   folds %s" %
              (name, *mean_of_folds(folds), ", ".join("%.1f/%.1f" % tuple(fold) for fold in folds)))


if __name__ == "__main__":
    main()

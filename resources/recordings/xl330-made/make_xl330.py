#!/usr/bin/env python3
"""Makes the three recordings beside this script: a simulated XL330 servo with a pendulum whose simulator hides dry friction.

    make_xl330.py BTR          BTR: the program btr

The motion is that of resources/scenes/xl330.json with 0.03 N·m of coulomb_friction at xl330.shoulder, which the scene does
not have. Position is read in steps of an encoder of 4096 to the turn, velocity with noise of 0.05 rad/s (seed 1). Nobody
measured anything: an analysis of these files must find the friction.
"""
import csv, json, math, os, random, subprocess, sys, tempfile

here = os.path.dirname(os.path.abspath(__file__))
scene = os.path.join(here, "../../scenes/xl330.json")
period_s, length_s = 0.005, 6.0

COMMANDS = {  # rad over time; the gain of the servo is in the name, as the scene's mapping wants it
    "made_kp200_sines": lambda t: 0.9 * math.sin(2 * math.pi * 0.5 * t) + 0.35 * math.sin(2 * math.pi * 1.3 * t),
    "made_kp400_slow": lambda t: 0.7 * math.sin(2 * math.pi * 0.22 * t),
    "made_kp200_chirp": lambda t: 0.6 * math.sin(2 * math.pi * (0.2 * t + 0.12 * t * t)),
}
GAINS = {"kp200": 4.258519, "kp400": 8.517037}  # V/rad


def main(btr):
    random.seed(1)
    with tempfile.TemporaryDirectory() as folder:
        concealed = os.path.join(folder, "concealed.json")
        with open(concealed, "w") as file:
            json.dump({"format": "uchilsim-simulator-1", "values": {},
                       "effects": [{"effect": "coulomb_friction", "at": "xl330.shoulder",
                                    "parameters": {"torque_nm": 0.03}}]}, file)
        for name, command in COMMANDS.items():
            path = os.path.join(folder, name + ".csv")
            times = [k * period_s for k in range(int(length_s / period_s))]
            with open(path, "w") as file:
                file.write("t_s,goal_rad,torque_enable,pos_rad,speed_rad_s,volts,pwm_duty\n")
                for t in times:
                    file.write(f"{t:.4f},{command(t):.6f},1,0,0,7.4,0\n")
            out = os.path.join(folder, "out.csv")
            subprocess.run([btr, "gap", "predict", scene, "--simulator", concealed, "--recording", path, "--out", out],
                           check=True, stdout=subprocess.DEVNULL)
            rows = list(csv.DictReader(open(out)))
            step = 2 * math.pi / 4096
            with open(os.path.join(here, name + ".csv"), "w") as file:
                file.write("t_s,goal_rad,torque_enable,pos_rad,speed_rad_s\n")
                for row in rows:
                    t = float(row["time_s"])
                    position = round(float(row["xl330.shoulder.position_rad"]) / step) * step
                    speed = float(row["xl330.shoulder.velocity_rad_s"]) + random.gauss(0, 0.05)
                    file.write(f"{t:.4f},{command(t):.6f},1,{position:.6f},{speed:.4f}\n")
            with open(os.path.join(here, name + ".mapping.json"), "w") as file:
                json.dump({"time_s": {"column": "t_s"},
                           "xl330.shoulder.command_rad": {"column": "goal_rad"},
                           "xl330.shoulder.enabled": {"column": "torque_enable"},
                           "xl330.shoulder.position_rad": {"column": "pos_rad"},
                           "xl330.shoulder.velocity_rad_s": {"column": "speed_rad_s"},
                           "settings": [{"file_contains": name, "values": {
                               "robots.xl330.servos.shoulder.firmware_gain_v_per_rad": GAINS[name[5:10]]}}]}, file,
                          indent=1)
                file.write("\n")


main(*sys.argv[1:])

#!/usr/bin/env python3
"""Writes ers210.wrl or ers220.wrl: kinematics and joint data of the AIBO ERS-210 and ERS-220, plain bodies.

    python3 resources/robots/make_ers210.py 210 > resources/robots/ers210.wrl
    python3 resources/robots/make_ers210.py 220 > resources/robots/ers220.wrl

Both have the same legs. How certain each number is:
    dimensions, joint ranges      the robots' model information
    foot radius 13.96 mm          Tekkotsu's ERS210Info.h
    outer sizes                   Tekkotsu's meshes of the ERS-210; of the ERS-220 the body's overall sizes alone are known
    total mass 1.4 and 1.5 kg     recalled, not verified; divided among the parts as the ERS-7's, itself an estimate
    servo gains                   J1 : J2 : J3 as Sony's P gains 22 : 20 : 35; the scale (7.5 N.m/rad for Sony's 28) is an estimate
    joint speed of the legs       5.45 rad/s: 2.5 degrees in 8 ms, what Webots limits AIBO's joints to and what a published servo model of the
                                  ERS-210A has (recalled). Tekkotsu's 2.5 to 2.8 rad/s are too slow for gaits that were measured
    largest torque 0.85 N.m       Webots, a guess
Frames and units as in make_ers7.py, whose parts are used. Python 3 standard library only.
"""
import sys
from math import cos, pi, sin

import make_ers7 as parts
from make_ers7 import DARK, GREY, SILVER, box, close, collide, cylinder, degrees, draw, inertia_of_box, metres, number, open_segment, sphere, write
from solids import ellipsoid, loft

HIP = (59.5, 59.2)          # ahead of and beside the middle of the body
KNEE = (12.8, 0.5, -64)     # from the hip: ahead (front legs), outward, up
FOOT_RADIUS = 13.96
P_SCALE = 7.5 / 28
SERVO = {"J1": (22 * P_SCALE, 0.05, 0.85), "J2": (20 * P_SCALE, 0.05, 0.85), "J3": (35 * P_SCALE, 0.05, 0.85), "HEAD": (3, 0.03, 0.85),
         "SMALL": (1, 0.01, 0.1)}
LEG_SPEED = 2.5 * pi / 180 / 0.008
SHARES = {"body": 0.373, "neck": 0.015, "head": 0.126, "leg": 0.1215}  # of the total mass; four legs


def rounded(values):
    return tuple(round(v, 9) for v in values)


def joint(depth, name, axis, at, limits, speed, servo):
    p, d, torque = SERVO[servo]
    write(depth, f'DEF {name} Joint {{ name "{name}" jointType "rotate" jointId {parts.joint_count} jointAxis {axis} translation {metres(at)}')
    write(depth, f" llimit {degrees(limits[0])} ulimit {degrees(limits[1])} lvlimit {number(-speed)} uvlimit {number(speed)}"
                 f" maxTorque {torque} noLoadSpeed {number(speed)} pGain {number(p)} iGain 0 dGain {d}")
    write(depth, " children [")
    parts.joint_count += 1


def segment(depth, name, mass, com, size, group, solids, drawn, colour):
    """A link: box inertia of its outer size, what collides, one rounded body to look at."""
    open_segment(depth, name, mass, com, rounded(inertia_of_box(mass, *size)), group)
    write(depth, " collision [")
    for geometry, at, turn in solids:
        collide(depth + 2, geometry, at, turn)
    write(depth, " ] children [")
    for mesh, tone in zip(drawn, colour):
        draw(depth + 2, mesh, tone)
    write(depth, " ] }")


def foot_centre(front):
    """The centre of the foot ball at J3 = 0, from the drawing's contact point at J3 = 35 degrees."""
    x, z = (22.4, -64.9) if front else (-16.6, -74.9)
    z += FOOT_RADIUS
    c, s = cos(35 * pi / 180), sin(35 * pi / 180)
    return (c * x + s * z, 0, -s * x + c * z) if front else (c * x - s * z, 0, s * x + c * z)


def leg(depth, name, front, left, mass, coat):
    way, side = (1 if front else -1), (1 if left else -1)
    fold = "0 -1 0" if front else "0 1 0"
    group = f"leg:{name}"
    joint(depth, f"{name}_J1", fold, (HIP[0] * way, HIP[1] * side, 0), (-117, 117), LEG_SPEED, "J1")
    disc = loft([(-19, 0, 0, 31, 31, 2), (-3, 0, 0, 30, 30, 2)], "y", 18, 1, 2, 2, 2)
    if not left:
        disc = loft([(3, 0, 0, 30, 30, 2), (19, 0, 0, 31, 31, 2)], "y", 18, 1, 2, 2, 2)
    segment(depth + 2, f"{name}_ROTOR", mass * 0.26, (0, -11 * side, 0), (62, 18, 62), group, [(cylinder(32, 18), (0, -11 * side, 0), None)],
            [disc], [SILVER])
    joint(depth + 2, f"{name}_J2", "1 0 0" if left else "-1 0 0", (0, 0, 0), (-11, 89), LEG_SPEED, "J2")
    thigh = loft([(14, -2 * way, 4 * side, 14, 10, 2.3), (-20, 2 * way, 4 * side, 19, 15, 2.4), (-64, KNEE[0] * way, 2 * side, 17, 14, 2.3)],
                 "z", 14, 2, 7, 8, 3)
    segment(depth + 4, f"{name}_UPPER", mass * 0.37, (5 * way, 3 * side, -28), (36, 35, 90), group,
            [(box(34, 28, 68), (6 * way, 4 * side, -29), None)], [thigh], [coat])
    joint(depth + 4, f"{name}_J3", fold, (KNEE[0] * way, KNEE[1] * side, KNEE[2]), (-27, 147), LEG_SPEED, "J3")
    fx, _, fz = foot_centre(front)
    shank = loft([(12, 0, 0, 14, 14, 2.3), (-20, fx * 0.3, 0, 19, 15, 2.4), (-48, fx * 0.8, 0, 15, 14, 2.3)], "z", 14, 2, 6, 6, 3)
    sole = ellipsoid((fx, 0, fz), (FOOT_RADIUS,) * 3, 2, 12, 8)
    segment(depth + 6, f"{name}_LOWER", mass * 0.37, (fx * 0.4, 0, -32), (45, 34, 80), group,
            [(box(30, 28, 46), (fx * 0.3, 0, -20), None), (sphere(FOOT_RADIUS), (fx, 0, fz), None)], [shank, sole], [coat, DARK])
    for level in (5, 3, 1):
        close(depth + level)


def head(depth, model, mass_neck, mass_head, coat):
    low, high = (-82, 43)
    joint(depth, "NECK_TILT", "0 -1 0", (75, 0, 50), (low, high), 2.105, "HEAD")
    segment(depth + 2, "NECK", mass_neck, (0, 0, 24), (30, 30, 48), "neck", [(cylinder(14, 36), (0, 0, 24), "1 0 0 1.570796")],
            [loft([(0, 0, 0, 15, 15, 2), (46, 0, 0, 13, 13, 2)], "z", 14, 2, 4, 4, 2)], [DARK])
    joint(depth + 2, "HEAD_PAN", "0 0 1", (0, 0, 48), (-89.6, 89.6), 3.011, "HEAD")
    segment(depth + 4, "HEAD_BASE", mass_head * 0.06, (0, 0, 0), (20, 20, 20), "head", [], [ellipsoid((0, 0, 0), (14, 14, 14), 2, 10, 6)], [GREY])
    joint(depth + 4, "HEAD_ROLL", "1 0 0", (0, 0, 0), (-29, 29), 3.011, "HEAD")
    skull = loft([(-36, 0, 12, 26, 24, 2.3), (0, 0, 14, 41, 37, 2.5), (40, 0, 4, 34, 28, 2.4), (66, 0, -4, 22, 17, 2.3)], "x", 24, 2, 8, 8, 3)
    segment(depth + 6, "HEAD", mass_head * 0.94, (14, 0, 10), (122, 83, 79), "head", [(box(80, 76, 64), (4, 0, 12), None), (sphere(24), (50, 0, 0), None)],
            [skull], [coat])
    if model == "210":
        joint(depth + 6, "MOUTH", "0 -1 0", (20, 0, -14), (-47, -3), 4.374, "SMALL")
        segment(depth + 8, "MOUTH_JAW", 0.010, (16, 0, -6), (44, 38, 12), "head", [(box(40, 34, 10), (16, 0, -8), None)],
                [loft([(-4, 0, -6, 18, 6, 2.3), (30, 0, -8, 15, 6, 2.4)], "x", 12, 2, 4, 4, 2)], [SILVER])
        close(depth + 7)
    for level in (5, 3, 1):
        close(depth + level)


def tail(depth):
    joint(depth, "TAIL_TILT", "0 1 0", (-76.9, 0, 53), (-22, 22), 4.472, "SMALL")
    segment(depth + 2, "TAIL_BASE", 0.001, (0, 0, 0), (10, 10, 10), "body", [], [ellipsoid((0, 0, 0), (9, 9, 9), 2, 8, 6)], [GREY])
    joint(depth + 2, "TAIL_PAN", "0 0 1", (0, 0, 0), (-22, 22), 4.472, "SMALL")
    segment(depth + 4, "TAIL", 0.005, (-30, 0, 12), (70, 14, 20), "body", [(cylinder(6, 60), (-32, 0, 12), "0 0 1 1.570796")],
            [loft([(-64, 0, 22, 6, 6, 2), (-6, 0, 2, 7, 7, 2)], "x", 12, 2, 5, 3, 2)], [GREY])
    close(depth + 3)
    close(depth + 1)


def main():
    if sys.argv[1:] not in (["210"], ["220"]):
        sys.exit("which one? 210 or 220")
    model = sys.argv[1]
    total, coat = (1.4, SILVER) if model == "210" else (1.5, GREY)
    out = parts.out
    out.append("#VRML V2.0 utf8")
    out.append(f"# AIBO ERS-{model}, made by make_ers210.py beside this file, which tells how certain each number is.")
    out.append("# Metres, radians, kilograms; x forward, y left, z up at joint positions 0. Joint limits are the software's.")
    out.append(parts.PROTOS.rstrip())
    write(0, f'DEF ERS{model} Humanoid {{ name "ERS-{model}" version "1.0"')
    write(1, "humanoidBody [")
    write(2, 'DEF BODY_ROOT Joint { name "BODY_ROOT" jointType "free" translation 0 0 0.139')
    write(3, "children [")
    trunk = loft([(-100, 0, 10, 30, 34, 2.4), (-70, 0, 8, 43, 52, 2.6), (0, 0, 6, 46, 56, 2.6), (70, 0, 8, 44, 54, 2.6), (98, 0, 12, 32, 38, 2.4)],
                 "x", 26, 2, 6, 6, 3)
    segment(4, "BODY", total * SHARES["body"] - (0.006 if model == "210" else 0), (-2, 0, 4), (211, 94, 123), "body",
            [(box(120, 84, 92), (-4, 0, 6), None), (sphere(45), (52, 0, 6), None), (sphere(45), (-60, 0, 8), None)], [trunk], [coat])
    # Shapes belong to the segment above; the accelerometer is the body's own.
    parts.out[-1:] = [" " * 4 + " DEF ACCELEROMETER AccelerationSensor { sensorId 0 maxAcceleration 19.6133 19.6133 19.6133 }", " " * 4 + " ] }"]
    for name, front, left in (("LF", True, True), ("LR", False, True), ("RF", True, False), ("RR", False, False)):
        leg(4, name, front, left, total * SHARES["leg"], coat)
    head(4, model, total * SHARES["neck"], total * SHARES["head"] - (0.010 if model == "210" else 0), coat)
    if model == "210":
        tail(4)
    write(3, "] }")
    write(1, "]")
    write(0, "}")
    sys.stdout.write("\n".join(out) + "\n")


if __name__ == "__main__":
    main()

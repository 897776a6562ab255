#!/usr/bin/env python3
"""Writes ers7.wrl: kinematics and joint data of the AIBO ERS-7, rounded bodies to look at, simple bodies to collide.

    python3 resources/robots/make_ers7.py > resources/robots/ers7.wrl

Frames: x forward, y left, z up when all joints are 0. The body's origin lies midway between the four hip axes. Lengths here
are millimetres, in the file metres. Dimensions, joint ranges and joint speeds are those of the ERS-7's model information;
masses, inertias and servo numbers are estimates. Python 3 standard library only.
"""
import sys
from math import cos, pi, sin

from solids import ellipsoid, joined, loft, mirrored, moved, patch, turned

WHITE, SILVER, GREY, DARK, BLACK = "WHITE", "SILVER", "GREY", "DARK", "BLACK"
COLOURS = {
    "WHITE": "diffuseColor 0.93 0.93 0.95 specularColor 0.4 0.4 0.4 shininess 0.6",
    "SILVER": "diffuseColor 0.72 0.73 0.76 specularColor 0.5 0.5 0.5 shininess 0.5",
    "GREY": "diffuseColor 0.38 0.39 0.42",
    "DARK": "diffuseColor 0.16 0.16 0.18",
    "BLACK": "diffuseColor 0.03 0.03 0.05 specularColor 0.6 0.6 0.6 shininess 0.8",
    "BLUE_LIGHT": "diffuseColor 0.25 0.55 0.95 emissiveColor 0.1 0.3 0.6",
    "RED_CLOTH": "diffuseColor 0.82 0.07 0.08",
    "BLUE_CLOTH": "diffuseColor 0.08 0.20 0.80",
}

PROTOS = '''PROTO Joint [
  exposedField SFVec3f center 0 0 0  exposedField MFNode children []  exposedField SFVec3f translation 0 0 0
  exposedField SFRotation rotation 0 0 1 0  exposedField SFVec3f scale 1 1 1  exposedField SFRotation scaleOrientation 0 0 1 0
  exposedField SFString name ""  exposedField SFString jointType ""  exposedField SFInt32 jointId -1
  exposedField SFVec3f jointAxis 0 0 1  exposedField MFFloat llimit []  exposedField MFFloat ulimit []
  exposedField MFFloat lvlimit []  exposedField MFFloat uvlimit []  exposedField MFFloat climit []
  exposedField SFFloat gearRatio 1  exposedField SFFloat rotorInertia 0  exposedField SFFloat rotorResistor 0
  exposedField SFFloat torqueConst 1  exposedField SFFloat encoderPulse 1
  # Ours, all optional: N.m, N.m/rad, N.m/(rad.s), N.m.s/rad, N.m, N.m.s/rad, rad, s, rad/s, and the OPEN-R name of the joint.
  exposedField SFFloat maxTorque 0  exposedField SFFloat pGain 0  exposedField SFFloat iGain 0  exposedField SFFloat dGain 0
  exposedField SFFloat coulombFriction 0  exposedField SFFloat viscousFriction 0  exposedField SFFloat backlash 0
  exposedField SFFloat commandDelay 0  exposedField SFFloat noLoadSpeed 0  exposedField SFString primitive ""
] { Transform { center IS center children IS children translation IS translation rotation IS rotation scale IS scale
                scaleOrientation IS scaleOrientation } }
PROTO Segment [
  field SFVec3f bboxCenter 0 0 0  field SFVec3f bboxSize -1 -1 -1  exposedField SFString name ""
  exposedField SFVec3f centerOfMass 0 0 0  exposedField SFFloat mass 0
  exposedField MFFloat momentsOfInertia [ 0 0 0 0 0 0 0 0 0 ]  exposedField MFNode children []
  # Ours: the mass parameter that scales the segment; what collides in place of what is drawn.
  exposedField SFString massGroup ""  exposedField MFNode collision []
] { Group { bboxCenter IS bboxCenter bboxSize IS bboxSize children IS children } }
PROTO Humanoid [
  exposedField SFVec3f center 0 0 0  exposedField SFVec3f translation 0 0 0  exposedField SFRotation rotation 0 0 1 0
  exposedField SFVec3f scale 1 1 1  exposedField SFRotation scaleOrientation 0 0 1 0  exposedField SFString name ""
  exposedField SFString version "1.1"  exposedField MFString info []  exposedField MFNode humanoidBody []
  exposedField MFNode joints []  exposedField MFNode segments []
] { Transform { center IS center translation IS translation rotation IS rotation scale IS scale
                scaleOrientation IS scaleOrientation children [ Group { children IS humanoidBody } ] } }
# Ours: shapes of which a viewer shows one variant, here the jackets.
PROTO Part [ exposedField SFString name ""  exposedField SFInt32 whichChoice 0  exposedField MFNode choice [] ]
{ Switch { whichChoice IS whichChoice choice IS choice } }
PROTO AccelerationSensor [
  exposedField SFVec3f translation 0 0 0  exposedField SFRotation rotation 0 0 1 0  exposedField SFInt32 sensorId -1
  exposedField SFVec3f maxAcceleration -1 -1 -1
] { Transform { translation IS translation rotation IS rotation } }
PROTO VisionSensor [
  exposedField SFVec3f translation 0 0 0  exposedField SFRotation rotation 0 0 1 0  exposedField SFInt32 sensorId -1
  exposedField SFString name ""  exposedField SFString type "COLOR"  exposedField SFInt32 width 320
  exposedField SFInt32 height 240  exposedField SFFloat fieldOfView 0.785398  exposedField SFFloat frontClipDistance 0.01
  exposedField SFFloat backClipDistance 10  exposedField SFFloat frameRate 30
] { Transform { translation IS translation rotation IS rotation } }
'''

out = []
seen_colours = set()


def number(value):
    text = f"{value:.6g}"
    return "0" if text == "-0" else text


def metres(point):
    return " ".join(number(round(x / 1000, 5)) for x in point)


def write(depth, text):
    out.append(" " * depth + text)


def appearance(colour):
    if colour in seen_colours:
        return f"USE {colour}"
    seen_colours.add(colour)
    return f"DEF {colour} Appearance {{ material Material {{ {COLOURS[colour]} }} }}"


def mesh_geometry(mesh, crease):
    points = ", ".join(metres(p) for p in mesh[0])
    faces = ", ".join(" ".join(map(str, f)) + " -1" for f in mesh[1])
    return f"IndexedFaceSet {{ creaseAngle {crease} convex TRUE coord Coordinate {{ point [ {points} ] }} coordIndex [ {faces} ] }}"


def draw(depth, mesh, colour, crease=1.2):
    write(depth, f"Shape {{ appearance {appearance(colour)} geometry {mesh_geometry(mesh, crease)} }}")


def collide(depth, geometry, at=(0, 0, 0), rotation=None):
    turn = f" rotation {rotation}" if rotation else ""
    write(depth, f"Transform {{ translation {metres(at)}{turn} children Shape {{ geometry {geometry} }} }}")


def box(x, y, z):
    return f"Box {{ size {metres((x, y, z))} }}"


def sphere(radius):
    return f"Sphere {{ radius {number(radius / 1000)} }}"


def cylinder(radius, height):
    return f"Cylinder {{ radius {number(radius / 1000)} height {number(height / 1000)} }}"


def inertia_of_box(mass, x, y, z):
    """Principal moments of a solid box [kg m2]."""
    x, y, z = (v / 1000 for v in (x, y, z))
    return tuple(mass / 12 * v for v in (y * y + z * z, x * x + z * z, x * x + y * y))


def open_segment(depth, name, mass, com, moments, group):
    ixx, iyy, izz = map(number, moments)
    write(depth, f'DEF {name} Segment {{ name "{name}" mass {number(mass)} centerOfMass {metres(com)} massGroup "{group}"')
    write(depth, f" momentsOfInertia [ {ixx} 0 0 0 {iyy} 0 0 0 {izz} ]")


def degrees(value):
    return number(value * pi / 180)


SERVO = {"J1": (7.5, 0.05, 0.85), "J2": (7.5 * 20 / 28, 0.05, 0.85), "J3": (7.5, 0.05, 0.85), "NECK_TILT": (3, 0.03, 0.85),
         "HEAD_PAN": (2.4, 0.03, 0.85), "HEAD_TILT": (2.4, 0.03, 0.85), "MOUTH": (1, 0.01, 0.1), "TAIL": (1, 0.01, 0.1)}
joint_count = 0


def open_joint(depth, name, axis, at, limits, speed, servo, primitive):
    """Limits are those of the software; the mechanical stops lie 5 degrees further. Sony's largest joint speeds stand in
    Tekkotsu's ERS7Info.h; that they are the speeds at which the motors' torque ends is our reading of them."""
    global joint_count
    p, d, torque = SERVO[servo]
    write(depth, f'DEF {name} Joint {{ name "{name}" jointType "rotate" jointId {joint_count} jointAxis {axis} translation {metres(at)}')
    write(depth, f" llimit {degrees(limits[0])} ulimit {degrees(limits[1])} lvlimit {-speed} uvlimit {speed}"
                 f' maxTorque {torque} noLoadSpeed {speed} pGain {number(p)} iGain 0 dGain {d} primitive "{primitive}"')
    write(depth, " children [")
    joint_count += 1


def close(depth, brackets="] }"):
    write(depth, brackets)


# ---- body ------------------------------------------------------------------------------------------------------------

BODY = [(-112, 0, 14, 25, 27, 2.3), (-95, 0, 10, 38, 41, 2.4), (-66, 0, 7, 44, 49, 2.5), (-20, 0, 5, 45, 48, 2.5),
        (25, 0, 4, 45, 48, 2.5), (62, 0, 2, 45, 49, 2.4), (84, 0, -1, 38, 41, 2.3), (97, 0, -3, 28, 29, 2.2)]


def body(depth):
    # Mass and inertia of a solid of the body's outer size.
    open_segment(depth, "BODY", 0.614, (-2, 0, 2), (0.000876, 0.002565, 0.002612), "body")
    write(depth, " collision [")
    collide(depth + 2, box(130, 90, 88), (-4, 0, 4))
    collide(depth + 2, sphere(48), (56, 0, 1))
    collide(depth + 2, sphere(46), (-72, 0, 8))
    write(depth + 2, f"Shape {{ geometry {mesh_geometry(loft(BODY, 'x', 10, 1, 9, 9, 2), 0.5)} }}")
    write(depth, " ]")
    write(depth, " children [")
    draw(depth + 2, loft(BODY, "x", 28, 2, 10, 9, 4), WHITE)
    # Collar of the neck, three touch pads on the back, chest plate with its distance sensor, battery door below.
    draw(depth + 2, loft([(30, 62, 0, 22, 24, 2), (47, 64, 0, 19, 20, 2)], "z", 16, 1, 2, 5, 2), GREY)
    for at in (-58, -28, 2):
        draw(depth + 2, patch(BODY, (at, at + 24), (72, 108), 0.9, "x", 4, 4, 2), SILVER)
    draw(depth + 2, patch(BODY, (66, 97), (240, 300), 0.9, "x", 5, 6, 2), GREY)
    draw(depth + 2, ellipsoid((104, 0, -3), (4, 12, 6), 2.4, 10, 6), BLACK)
    draw(depth + 2, patch(BODY, (-45, 40), (250, 290), 0.9, "x", 6, 6, 2), SILVER)
    # The jackets that tell the teams apart: a cloth over back and flanks.
    for word, colour, choice in (("red", "RED_CLOTH", 0), ("blue", "BLUE_CLOTH", -1)):
        write(depth + 2, f'Part {{ name "{word}" whichChoice {choice} choice [ Group {{ children [')
        for side in (0, 1):
            flank = patch(BODY, (-40, 40), (-32, 66), 2.0, "x", 6, 9, 3)
            draw(depth + 4, mirrored(flank, "y") if side else flank, colour)
        draw(depth + 4, patch(BODY, (-104, -66), (42, 138), 2.0, "x", 6, 8, 3), colour)
        draw(depth + 4, patch(BODY, (66, 94), (196, 344), 2.0, "x", 6, 14, 3), colour)
        write(depth + 2, "] } ] }")
    write(depth + 2, "DEF ACCELEROMETER AccelerationSensor { sensorId 0 maxAcceleration 19.6133 19.6133 19.6133 }")
    write(depth, " ] }")


# ---- legs ------------------------------------------------------------------------------------------------------------

FOOT_RADIUS = 12.4


def foot_centre(front):
    """The centre of the foot ball at J3 = 0, from the drawing's contact point at J3 = 30 degrees."""
    x, z = (28.3, -71.5) if front else (-21.3, -76.5)
    z += FOOT_RADIUS
    c, s = cos(pi / 6), sin(pi / 6)
    return (c * x + s * z, 0, -s * x + c * z) if front else (c * x - s * z, 0, s * x + c * z)


def lower_leg(front):
    """Shank and paw. The paw is level when the leg stands at J3 = 30 degrees."""
    fx, _, fz = foot_centre(front)
    way = 1 if front else -1
    shank = loft([(13, -2 * way, 0, 13, 13, 2.3), (0, 0, 0, 18, 15.5, 2.4), (-22, -5 * way + fx * 0.2, 0, 18, 15.5, 2.4),
                  (-42, -4 * way + fx * 0.5, 0, 15.5, 14, 2.3), (-56, fx * 0.8, 0, 13, 13, 2.2)], "z", 14, 2, 5, 5, 3)
    tilt = 30 if front else -30
    paw = turned(ellipsoid((fx + 7, 0, fz + 1.2), (27, 19, 12.8), 2.5, 16, 8), "y", tilt, (fx, 0, fz))
    toes = [turned(ellipsoid((fx + 24, y, fz - 2.5), (9.5, 6.2, 8.6), 2.2, 8, 5), "y", tilt, (fx, 0, fz)) for y in (-11, 0, 11)]
    sole = ellipsoid((fx, 0, fz), (FOOT_RADIUS,) * 3, 2, 8, 6)
    return shank, paw, joined(*toes), sole


def leg(depth, name, front, left, chain):
    side = 1 if left else -1
    way = 1 if front else -1
    fold = "0 -1 0" if front else "0 1 0"
    swing = (-115, 130) if front else (-130, 115)
    group = f"leg:{name}"
    base = f"PRM:/r{chain}"

    open_joint(depth, f"{name}_J1", fold, (65 * way, 62.5 * side, 0), swing, 4.8651, "J1", f"{base}/c1-Joint2:{chain}1")
    d = depth + 2
    open_segment(d, f"{name}_ROTOR", 0.052, (0, -12 * side, 0), (1.73e-05, 3.12e-05, 1.73e-05), group)
    write(d, " collision [")
    collide(d + 2, cylinder(34.5, 19), (0, -12.5 * side, 0))
    write(d, " ] children [")
    ring = [(-21, 0, 0, 33, 33, 2), (-6, 0, 0, 33, 33, 2)]
    hub = [(-7, 0, 0, 24, 24, 2), (-1, 0, 0, 22, 22, 2)]
    for keys, colour, end in ((ring, SILVER, 2.5), (hub, DARK, 2)):
        disc = loft(keys, "y", 22, 1, 2.5, end, 2)
        draw(d + 2, disc if left else mirrored(disc, "y"), colour)
    write(d, " ] }")

    open_joint(d, f"{name}_J2", "1 0 0" if left else "-1 0 0", (0, 0, 0), (-10, 88), 5.2796, "J2", f"{base}/c1/c2-Joint2:{chain}2")
    d += 2
    open_segment(d, f"{name}_UPPER", 0.074, (4 * way, 4.7 * side, -30), (4.70208e-05, 4.74587e-05, 1.55462e-05), group)
    upper = [(12, 0, 6, 14, 8, 2.2), (0, 1 * way, 8, 18, 12.5, 2.3), (-22, 3 * way, 8, 19, 15, 2.4),
             (-46, 6 * way, 7, 18, 15, 2.4), (-69.5, 9 * way, 4.7, 16.5, 14.5, 2.3)]
    write(d, " collision [")
    collide(d + 2, box(35, 27, 74), (5 * way, 7 * side, -32))
    simple = loft(upper, "z", 8, 1, 8, 6, 2)
    write(d + 2, f"Shape {{ geometry {mesh_geometry(simple if left else mirrored(simple, 'y'), 0.5)} }}")
    write(d, " ] children [")
    thigh = loft(upper, "z", 14, 2, 9, 8, 3)
    draw(d + 2, thigh if left else mirrored(thigh, "y"), WHITE)
    cap = moved(loft([(17, 0, 0, 10.5, 10.5, 2), (20, 0, 0, 9.5, 9.5, 2)], "y", 14, 1, 1, 1.5, 2), (9 * way, 0, -69.5))
    draw(d + 2, cap if left else mirrored(cap, "y"), GREY)
    write(d, " ] }")

    open_joint(d, f"{name}_J3", fold, (9 * way, 4.7 * side, -69.5), (-25, 122), 5.2796, "J3", f"{base}/c1/c2/c3-Joint2:{chain}3")
    d += 2
    fx, _, fz = foot_centre(front)
    open_segment(d, f"{name}_LOWER", 0.074, (-4 if front else 8, 0, -37), (5.16828e-05, 5.70417e-05, 1.96162e-05), group)
    shank, paw, toes, sole = lower_leg(front)
    write(d, " collision [")
    collide(d + 2, box(33, 30, 54), (fx * 0.3 - 3 * way, 0, -25))
    collide(d + 2, sphere(FOOT_RADIUS), (fx, 0, fz))
    simple = joined(loft([(8, 0, 0, 16, 15, 2.4), (-45, fx * 0.6 - 3 * way, 0, 15, 14, 2.4)], "z", 8, 1, 6, 4, 2),
                    ellipsoid((fx, 0, fz), (FOOT_RADIUS,) * 3, 2, 12, 8))
    write(d + 2, f"Shape {{ geometry {mesh_geometry(simple, 0.5)} }}")
    write(d, " ] children [")
    draw(d + 2, shank, WHITE)
    draw(d + 2, paw, WHITE)
    draw(d + 2, toes, SILVER)
    draw(d + 2, sole, DARK)
    write(d, " ] }")
    close(d - 2 + 1)
    close(d - 4 + 1)
    close(depth + 1)


# ---- neck and head ---------------------------------------------------------------------------------------------------

HEAD = [(-34, 0, 8, 27, 24, 2.3), (-20, 0, 10, 39, 32, 2.4), (0, 0, 9, 44, 36, 2.5), (22, 0, 7, 44, 35, 2.5),
        (42, 0, 2, 38, 30, 2.4), (60, 0, -4, 30, 23, 2.4), (74, 0, -9, 23, 17, 2.3)]


def head(depth):
    open_joint(depth, "NECK_TILT", "0 -1 0", (67.5, 0, 19.5), (-75, 0), 3.1852, "NECK_TILT", "PRM:/r1/c1-Joint2:11")
    d = depth + 2
    open_segment(d, "NECK", 0.025, (0, 0, 37), (1.5e-05, 1.5e-05, 4e-06), "neck")
    write(d, " collision [")
    collide(d + 2, cylinder(15, 50), (0, 0, 38), "1 0 0 1.570796")
    write(d, " ] children [")
    draw(d + 2, loft([(0, 0, 0, 19, 20, 2.2), (18, 1, 0, 16, 17, 2.1), (44, 2, 0, 14, 15, 2), (66, 1, 0, 15, 17, 2)], "z", 16, 2, 12, 8, 3),
         DARK)
    draw(d + 2, joined(*[loft([(z, 1.5, 0, 16.8, 17.8, 2), (z + 4, 1.5, 0, 16.6, 17.6, 2)], "z", 16, 1, 1.5, 1.5, 2) for z in (18, 32, 46)]),
         GREY)
    write(d, " ] }")

    open_joint(d, "HEAD_PAN", "0 0 1", (0, 0, 80), (-88, 88), 10.0575, "HEAD_PAN", "PRM:/r1/c1/c2-Joint2:12")
    d += 2
    open_segment(d, "HEAD_BASE", 0.01, (0, 0, 0), (1.5e-06, 1.5e-06, 1.5e-06), "head")
    write(d, " collision [ ] children [")
    draw(d + 2, ellipsoid((0, 0, -14), (17, 17, 18), 2, 12, 8), GREY)
    write(d, " ] }")

    open_joint(d, "HEAD_TILT", "0 -1 0", (0, 0, 0), (-15, 45), 5.7814, "HEAD_TILT", "PRM:/r1/c1/c2/c3-Joint2:13")
    d += 2
    open_segment(d, "HEAD", 0.16, (21, 0, 6), (0.000186, 0.000288, 0.000328), "head")
    write(d, " collision [")
    collide(d + 2, box(76, 80, 62), (6, 0, 8))
    collide(d + 2, sphere(27), (56, 0, -5))
    write(d + 2, f"Shape {{ geometry {mesh_geometry(loft(HEAD, 'x', 10, 1, 8, 9, 2), 0.5)} }}")
    write(d, " ] children [")
    draw(d + 2, loft(HEAD, "x", 28, 2, 8, 9, 4), WHITE)
    # The dark face with its lights, the touch pad on the head, nose with camera, ear axes.
    draw(d + 2, patch(HEAD, (26, 75), (32, 148), 0.8, "x", 10, 16, 2.5), BLACK)
    for y in (62, 118):
        draw(d + 2, patch(HEAD, (40, 52), (y - 12, y + 12), 1.4, "x", 5, 5, 1), "BLUE_LIGHT")
    draw(d + 2, patch(HEAD, (-8, 16), (66, 114), 0.9, "x", 5, 6, 2), SILVER)
    draw(d + 2, ellipsoid((79.5, 0, -11), (5.5, 11, 8), 2.3, 14, 8), BLACK)
    draw(d + 2, moved(loft([(-1, 0, 0, 4.4, 4.4, 2), (1, 0, 0, 4.2, 4.2, 2)], "x", 10, 1, 0.5, 0.6, 2), (84.2, 0, -14.6)), GREY)
    for side in (1, -1):
        hub = moved(loft([(40, 0, 0, 10, 10, 2), (47, 0, 0, 9, 9, 2)], "y", 12, 1, 1, 2, 2), (-8, 0, 20))
        draw(d + 2, hub if side > 0 else mirrored(hub, "y"), GREY)
    # 208 x 160 pixels, 56.9 x 45.2 degrees; looks forward: -z of the sensor is x of the head.
    write(d + 2, 'DEF CAMERA VisionSensor { translation 0.08106 0 -0.0146 rotation 0.57735 -0.57735 -0.57735 2.094395 sensorId 0 '
                 'name "CAMERA" width 208 height 160 fieldOfView 0.788889 }')
    write(d, " ] }")

    # The lower jaw: 0 is shut against the stop.
    open_joint(d, "MOUTH", "0 -1 0", (40, 0, -17.5), (-55, -3), 10.1447, "MOUTH", "PRM:/r1/c1/c2/c3/c4-Joint2:14")
    d += 2
    open_segment(d, "MOUTH_JAW", 0.012, (14, 0, -6), inertia_of_box(0.012, 44, 38, 12), "head")
    write(d, " collision [")
    collide(d + 2, box(40, 34, 10), (14, 0, -8))
    write(d, " ] children [")
    draw(d + 2, loft([(-4, 0, -5, 20, 7, 2.3), (12, 0, -7, 22, 7.5, 2.4), (28, 0, -8, 17, 6, 2.4)], "x", 14, 2, 5, 6, 3), SILVER)
    write(d, " ] }")
    close(d - 1)
    d -= 2

    for side, name, chain in ((1, "L_EAR", "e5-Joint4:15"), (-1, "R_EAR", "e6-Joint4:16")):
        write(d, f'DEF {name}_BASE Joint {{ name "{name}_BASE" jointType "fixed" translation {metres((-8, 46 * side, 20))} primitive "PRM:/r1/c1/c2/c3/{chain}"')
        write(d, " children [")
        open_segment(d + 2, name, 0.004, (-6, 5 * side, -24), inertia_of_box(0.004, 40, 10, 80), "head")
        write(d + 2, " collision [ ] children [")
        ear = loft([(10, -2, 2, 9, 4, 2.2), (0, -3, 4, 14, 5.5, 2.3), (-24, -8, 6, 20, 6.5, 2.4), (-46, -13, 5, 20, 5.5, 2.3),
                    (-60, -16, 3.5, 14, 4, 2.2)], "z", 14, 2, 4, 6, 3)
        draw(d + 4, ear if side > 0 else mirrored(ear, "y"), GREY)
        write(d + 2, " ] }")
        close(d + 1)
    close(d - 1)
    close(d - 3)
    close(depth + 1)


def tail(depth):
    open_joint(depth, "TAIL_TILT", "0 1 0", (-102, 0, 33), (5, 60), 15.1625, "TAIL", "PRM:/r6/c1-Joint2:61")
    d = depth + 2
    open_segment(d, "TAIL_BASE", 0.001, (0, 0, 0), (1.66667e-08,) * 3, "body")
    write(d, " collision [ ] children [")
    draw(d + 2, ellipsoid((0, 0, 0), (13, 13, 13), 2, 12, 8), GREY)
    write(d, " ] }")
    open_joint(d, "TAIL_PAN", "1 0 0", (0, 0, 0), (-45, 45), 15.1625, "TAIL", "PRM:/r6/c2-Joint2:62")
    d += 2
    open_segment(d, "TAIL", 0.005, (-11, 0, 26), (3.54167e-06, 3.54167e-06, 3.33333e-07), "body")
    write(d, " collision [")
    collide(d + 2, cylinder(7, 85), (-8, 0, 42), "1 0 0 1.570796")
    write(d, " ] children [")
    draw(d + 2, loft([(4, 0, 0, 9, 9, 2), (20, -4, 0, 8.5, 8.5, 2), (45, -14, 0, 8, 8, 2.1), (68, -17, 0, 9, 9, 2.2), (84, -14, 0, 8, 8, 2.2)],
                     "z", 12, 3, 5, 7, 3), WHITE)
    write(d, " ] }")
    close(d - 1)
    close(depth + 1)


def main():
    out.append("#VRML V2.0 utf8")
    out.append("# AIBO ERS-7, made by make_ers7.py beside this file: change that and run it again.")
    out.append("# Metres, radians, kilograms; x forward, y left, z up at joint positions 0. Joint limits are the software's; the")
    out.append("# mechanical stops lie 5 degrees further. Dimensions are the robot's, masses and servo numbers are estimates.")
    out.append(PROTOS.rstrip())
    write(0, 'DEF ERS7 Humanoid { name "ERS-7" version "1.1"')
    write(1, "humanoidBody [")
    write(2, 'DEF BODY_ROOT Joint { name "BODY_ROOT" jointType "free" translation 0 0 0.146')
    write(3, "children [")
    body(4)
    for name, front, left, chain in (("LF", True, True, 2), ("LR", False, True, 3), ("RF", True, False, 4), ("RR", False, False, 5)):
        leg(4, name, front, left, chain)
    head(4)
    tail(4)
    write(3, "] }")
    write(1, "]")
    write(0, "}")
    sys.stdout.write("\n".join(out) + "\n")


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
"""Writes the fields of the four-legged league as scenes without robots: floor, walls, goals, beacons and the ball.
Sizes in metres. 2004: field 4.2 x 2.7 with beacons at (+-2.20, +-1.45) and (0, +-1.45), whose upper border is at 0.40, and
an outer white wall of 0.30 (rule book of 2004 and Roefer 2004; places of the beacons from a data set of 2003); goals 0.60 x
0.30 x 0.30 (estimated from the 0.60 wide goal of a public model of the older field). 2006: 5.4 x 3.6 without border, goals
0.80 wide, beacons 1.35 from the halfway line, no outer wall (field page of a team of 2005; the border of 0.20 is estimated); its
circle of 0.36 and its areas of 0.65 x 1.30 from the same page, those of 2004 scaled from them (estimated) with the
printed circle of 0.30; lines 0.025.
"""
import json
import os

GREEN, WHITE, YELLOW, SKY, PINK = "#2e7d32", "#f2f2f2", "#e8c61c", "#4fb3e8", "#e0559a"


def box(name, size, position, colour):
    return {"name": name, "shape": "box", "size_m": size, "position_m": position, "colour": colour, "friction": 0.5,
            "restitution": 0.3}


def beacon(name, x, y, upper, lower):
    """Two cylinders on a white foot, 0.10 across, upper border at 0.40."""
    parts = [("foot", 0.0, 0.20, WHITE), ("lower", 0.20, 0.10, lower), ("upper", 0.30, 0.10, upper)]
    return [{"name": f"{name}_{part}", "shape": "cylinder", "radius_m": 0.05, "height_m": height,
             "position_m": [x, y, bottom + height / 2], "colour": colour} for part, bottom, height, colour in parts]


def goal(name, x, width, depth, height, colour):
    """Open towards the middle of the field; its line at x."""
    out = 1 if x > 0 else -1
    wall = 0.02
    things = [box(f"{name}_back", [wall, width + 2 * wall, height], [x + out * (depth + wall / 2), 0, height / 2], colour)]
    for side, word in ((1, "left"), (-1, "right")):
        things.append(box(f"{name}_{word}", [depth, wall, height],
                          [x + out * depth / 2, side * (width + wall) / 2, height / 2], colour))
    return things


def around(length, width, gap, height):
    """Walls on all four sides; a gap in the short ones for the goals."""
    wall = 0.02
    things = []
    for side, word in ((1, "left"), (-1, "right")):
        things.append(box(f"wall_{word}", [length + 2 * wall, wall, height], [0, side * (width + wall) / 2, height / 2], WHITE))
        for end, place in ((1, "front"), (-1, "rear")):
            part = (width - gap) / 2
            things.append(box(f"wall_{place}_{word}", [wall, part, height],
                              [end * (length + wall) / 2, side * (gap + part) / 2, height / 2], WHITE))
    return things


def carpet(length, width, border, line, circle, penalty_depth, penalty_width):
    """Green, the border lines' outer edges at length x width, halfway line, centre circle, penalty areas."""
    x, y = (length - line) / 2, (width - line) / 2
    lines = [((-x - line / 2, side * y), (x + line / 2, side * y)) for side in (1, -1)]
    lines += [((side * x, -y), (side * x, y)) for side in (1, -1)] + [((0, -y), (0, y))]
    for side in (1, -1):
        inner, half = side * (length / 2 - penalty_depth + line / 2), (penalty_width - line) / 2
        lines += [((inner, -half - line / 2), (inner, half + line / 2))]
        lines += [((inner, end), (side * x, end)) for end in (half, -half)]
    return {"size_m": [length + 2 * border, width + 2 * border], "colour": "#29753d", "line_colour": "#f2f2f2",
            "lines": [{"from_m": a, "to_m": b, "width_m": line} for a, b in lines],
            "circles": [{"centre_m": [0, 0], "radius_m": circle / 2, "width_m": line}]}


def field(length, width, goal_width, carpet, obstacles):
    return {"format": "uchilsim-scene-1", "step_s": 0.008, "control_period_s": 0.008,
            "sliding_friction": "isotropic",
            "field": {"length_m": length, "width_m": width,
                      "goals": {"width_m": goal_width, "depth_m": 0.3, "height_m": 0.3}},
            "floor": {"friction": 1.0, "restitution": 0.0}, "robots_collide": True, "carpet": carpet,
            "robots": [],
            "balls": [{"name": "ball", "radius_m": 0.0425, "mass_kg": 0.055, "rolling_deceleration_m_s2": 0.4,
                       "restitution": 0.4, "position_m": [0, 0, 0.0425]}],
            "obstacles": obstacles}


def beacons(places):
    things = []
    for number, (x, y, upper, lower) in enumerate(places, 1):
        things += beacon(f"beacon{number}", x, y, upper, lower)
    return things


fields = {
    "four-legged-2004": field(
        4.2, 2.7, 0.6,
        carpet(4.2, 2.7, 0.2, 0.025, 0.30, 0.45, 0.90),
        around(4.6, 3.1, 0.6, 0.30) + goal("goal_yellow", 2.1, 0.6, 0.3, 0.3, YELLOW) + goal("goal_sky", -2.1, 0.6, 0.3, 0.3, SKY) +
        beacons([(2.2, 1.45, PINK, YELLOW), (2.2, -1.45, YELLOW, PINK), (-2.2, 1.45, PINK, SKY), (-2.2, -1.45, SKY, PINK),
                 (0, 1.45, PINK, WHITE), (0, -1.45, WHITE, PINK)])),
    "four-legged-2006": field(
        5.4, 3.6, 0.8,
        carpet(5.4, 3.6, 0.2, 0.025, 0.36, 0.65, 1.30),
        goal("goal_yellow", 2.7, 0.8, 0.3, 0.3, YELLOW) + goal("goal_sky", -2.7, 0.8, 0.3, 0.3, SKY) +
        beacons([(1.35, 1.9, PINK, YELLOW), (1.35, -1.9, YELLOW, PINK), (-1.35, 1.9, PINK, SKY), (-1.35, -1.9, SKY, PINK)])),
}
here = os.path.dirname(os.path.abspath(__file__))
for name, content in fields.items():
    with open(os.path.join(here, name + ".json"), "w") as out:
        json.dump(content, out, indent=1)
        out.write("\n")

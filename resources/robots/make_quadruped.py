#!/usr/bin/env python3
"""Writes quadruped.urdf: a made-up walking robot of 7 kg as strangers bring them, without gains or torque limits.

    resources/robots/make_quadruped.py > resources/robots/quadruped.urdf
"""

body, upper, lower = (0.36, 0.16, 0.09, 4.6), (0.16, 0.018, 0.4), (0.16, 0.012, 0.2)  # sizes [m], mass [kg]


def number(value):
    return f"{value:.6g}"


def box(size, mass):
    x, y, z = size
    return [mass / 12 * s for s in (y * y + z * z, x * x + z * z, x * x + y * y)]


def inertial(mass, moments, place):
    return (f'    <inertial><origin xyz="{place}"/><mass value="{number(mass)}"/>'
            f'<inertia ixx="{number(moments[0])}" iyy="{number(moments[1])}" izz="{number(moments[2])}"/></inertial>')


def shown(geometry, place, colour):
    shape = f'<origin xyz="{place}"/><geometry>{geometry}</geometry>'
    return (f'    <visual>{shape}<material name="{colour}"/></visual>\n'
            f"    <collision>{shape}</collision>")


def joint(name, parent, child, place, axis, lower_rad, upper_rad):
    return (f'  <joint name="{name}" type="revolute">\n    <parent link="{parent}"/><child link="{child}"/>\n'
            f'    <origin xyz="{place}"/><axis xyz="{axis}"/>\n'
            f'    <limit lower="{lower_rad}" upper="{upper_rad}" velocity="12"/>\n  </joint>')


print('<?xml version="1.0"?>\n<!-- Made by make_quadruped.py -->\n<robot name="quadruped">')
print('  <material name="grey"><color rgba="0.35 0.38 0.42 1"/></material>')
print('  <material name="orange"><color rgba="0.9 0.45 0.1 1"/></material>')
print('  <link name="trunk">')
print(inertial(body[3], box(body[:3], body[3]), "0 0 0"))
print(shown(f'<box size="{body[0]} {body[1]} {body[2]}"/>', "0 0 0", "grey") + "\n  </link>")
for leg, x, y in (("front_left", 1, 1), ("front_right", 1, -1), ("rear_left", -1, 1), ("rear_right", -1, -1)):
    rod = [upper[2] / 12 * upper[0] ** 2] * 2 + [upper[2] / 2 * upper[1] ** 2]
    shin = [lower[2] / 12 * lower[0] ** 2] * 2 + [lower[2] / 2 * lower[1] ** 2]
    print(f'  <link name="{leg}_hip">\n' + inertial(0.15, [1e-4] * 3, "0 0 0"))
    print('    <visual><geometry><sphere radius="0.03"/></geometry><material name="orange"/></visual>\n  </link>')
    print(f'  <link name="{leg}_thigh">\n' + inertial(upper[2], rod, f"0 0 {-upper[0] / 2}"))
    print(shown(f'<cylinder radius="{upper[1]}" length="{upper[0]}"/>', f"0 0 {-upper[0] / 2}", "grey") + "\n  </link>")
    print(f'  <link name="{leg}_shank">\n' + inertial(lower[2], shin, f"0 0 {-lower[0] / 2}"))
    print(shown(f'<cylinder radius="{lower[1]}" length="{lower[0]}"/>', f"0 0 {-lower[0] / 2}", "grey"))
    print(shown('<sphere radius="0.02"/>', f"0 0 {-lower[0]}", "orange") + "\n  </link>")
    print(joint(f"{leg}_roll", "trunk", f"{leg}_hip", f"{x * 0.16} {y * 0.09} 0", "1 0 0", -0.6, 0.6))
    print(joint(f"{leg}_pitch", f"{leg}_hip", f"{leg}_thigh", f"0 {y * 0.035} 0", "0 1 0", -1.2, 1.6))
    print(joint(f"{leg}_knee", f"{leg}_thigh", f"{leg}_shank", f"0 0 {-upper[0]}", "0 1 0", -2.4, 0))
print("</robot>")

"""Rounded bodies as meshes, for the robot generators beside this file. Python 3 standard library only.

A mesh is (points, faces): points in millimetres, faces counter-clockwise seen from outside.
"""
from math import cos, sin, pi, copysign


def power(value, exponent):
    return copysign(abs(value) ** exponent, value)


def superellipse(angle, exponent):
    """A point of |x|^n + |y|^n = 1; n = 2 is a circle, larger is squarer."""
    return power(cos(angle), 2 / exponent), power(sin(angle), 2 / exponent)


def volume(points, faces):
    total = 0
    for face in faces:
        for i in range(1, len(face) - 1):
            (ax, ay, az), (bx, by, bz), (cx, cy, cz) = points[face[0]], points[face[i]], points[face[i + 1]]
            total += ax * (by * cz - bz * cy) + ay * (bz * cx - bx * cz) + az * (bx * cy - by * cx)
    return total / 6


def outward(mesh):
    points, faces = mesh
    return mesh if volume(points, faces) > 0 else (points, [face[::-1] for face in faces])


def smooth(keys, steps):
    """Catmull-Rom through the keys (tuples of numbers): `steps` pieces between two keys."""
    result = []
    for k in range(len(keys) - 1):
        before = keys[max(k - 1, 0)]
        after = keys[min(k + 2, len(keys) - 1)]
        for s in range(steps):
            t = s / steps
            result.append(tuple(
                0.5 * (2 * b + (c - a) * t + (2 * a - 5 * b + 4 * c - d) * t * t + (3 * b - a - 3 * c + d) * t ** 3)
                for a, b, c, d in zip(before, keys[k], keys[k + 1], after)))
    result.append(keys[-1])
    return result


def rings_of(keys, steps, begin, end, domes=4):
    """Sections along an axis: key = (at, centre u, centre v, radius u, radius v, exponent); rounded ends of these lengths."""
    middle = smooth(keys, steps)

    def dome(section, length):
        at, cu, cv, ru, rv, n = section
        return [(at + length * sin(a), cu, cv, ru * cos(a), rv * cos(a), n)
                for a in [pi / 2 * i / domes for i in range(1, domes)]], (at + length, cu, cv)

    way = 1 if middle[-1][0] > middle[0][0] else -1
    first, tip = dome(middle[0], -begin * way)
    last, end_tip = dome(middle[-1], end * way)
    return first[::-1] + middle + last, tip, end_tip


AXES = {"x": lambda a, u, v: (a, u, v), "y": lambda a, u, v: (v, a, u), "z": lambda a, u, v: (u, v, a)}


def loft(keys, axis="x", around=24, steps=4, begin=5.0, end=5.0, domes=4):
    """A closed body through the sections. axis x: u = y, v = z; y: u = z, v = x; z: u = x, v = y."""
    place = AXES[axis]
    rings, tip, end_tip = rings_of(keys, steps, begin, end, domes)
    points = []
    for at, cu, cv, ru, rv, n in rings:
        for i in range(around):
            u, v = superellipse(2 * pi * i / around, n)
            points.append(place(at, cu + ru * u, cv + rv * v))
    faces = []
    for r in range(len(rings) - 1):
        for i in range(around):
            j = (i + 1) % around
            faces.append((r * around + i, r * around + j, (r + 1) * around + j, (r + 1) * around + i))
    points += [place(*tip), place(*end_tip)]
    last = (len(rings) - 1) * around
    for i in range(around):
        j = (i + 1) % around
        faces.append((len(points) - 2, j, i))
        faces.append((len(points) - 1, last + i, last + j))
    return outward((points, faces))


def patch(keys, span, angles, offset, axis="x", steps=8, across=16, thickness=1.0):
    """A thin shell over a part of a loft's side: from span[0] to span[1] along the axis, between two angles [degrees].
    Its corners are rounded: towards the ends of the span the angles close in."""
    place = AXES[axis]
    sections = smooth(keys, 40)
    points = []
    low, high = (pi / 180 * a for a in angles)

    def section(at):
        for a, b in zip(sections, sections[1:]):
            if a[0] <= at <= b[0] or b[0] <= at <= a[0]:
                t = (at - a[0]) / (b[0] - a[0]) if b[0] != a[0] else 0
                return [x + (y - x) * t for x, y in zip(a, b)]
        return sections[0] if abs(at - sections[0][0]) < abs(at - sections[-1][0]) else sections[-1]

    for layer in (offset, offset - thickness):
        for s in range(steps + 1):
            k = -cos(pi * s / steps)
            at = span[0] + (span[1] - span[0]) * (k + 1) / 2
            width = (1 - abs(k) ** 4) ** 0.25
            _, cu, cv, ru, rv, n = section(at)
            for i in range(across + 1):
                middle, half = (low + high) / 2, (high - low) / 2
                u, v = superellipse(middle + half * max(width, 0.05) * (2 * i / across - 1), n)
                points.append(place(at, cu + (ru + layer) * u, cv + (rv + layer) * v))
    size = (steps + 1) * (across + 1)
    index = lambda layer, s, i: layer * size + s * (across + 1) + i
    faces = []
    for s in range(steps):
        for i in range(across):
            outer = (index(0, s, i), index(0, s, i + 1), index(0, s + 1, i + 1), index(0, s + 1, i))
            faces.append(outer)
            faces.append(tuple(p + size for p in reversed(outer)))
    rim = [(0, i) for i in range(across)] + [(s, across) for s in range(steps)] + \
          [(steps, i) for i in range(across, 0, -1)] + [(s, 0) for s in range(steps, 0, -1)]
    for k, a in enumerate(rim):
        b = rim[(k + 1) % len(rim)]
        faces.append((index(0, *b), index(0, *a), index(1, *a), index(1, *b)))
    return outward((points, faces))


def ellipsoid(centre, radii, exponent=2.0, around=16, rings=10):
    cx, cy, cz = centre
    rx, ry, rz = radii
    points, faces = [], []
    for r in range(1, rings):
        s, z = superellipse(-pi / 2 + pi * r / rings, exponent)
        for i in range(around):
            u, v = superellipse(2 * pi * i / around, exponent)
            points.append((cx + rx * s * u, cy + ry * s * v, cz + rz * z))
    for r in range(rings - 2):
        for i in range(around):
            j = (i + 1) % around
            faces.append((r * around + i, r * around + j, (r + 1) * around + j, (r + 1) * around + i))
    points += [(cx, cy, cz - rz), (cx, cy, cz + rz)]
    last = (rings - 2) * around
    for i in range(around):
        j = (i + 1) % around
        faces.append((len(points) - 2, j, i))
        faces.append((len(points) - 1, last + i, last + j))
    return outward((points, faces))


def turned(mesh, axis, degrees, centre=(0, 0, 0)):
    """Rotated by the right-hand rule about an axis through the centre."""
    c, s = cos(pi / 180 * degrees), sin(pi / 180 * degrees)
    a, b = {"x": (1, 2), "y": (2, 0), "z": (0, 1)}[axis]
    points = []
    for point in mesh[0]:
        p = [x - o for x, o in zip(point, centre)]
        p[a], p[b] = c * p[a] - s * p[b], s * p[a] + c * p[b]
        points.append(tuple(x + o for x, o in zip(p, centre)))
    return points, mesh[1]


def mirrored(mesh, axis):
    """The mirror image across the plane through the origin that is normal to the axis."""
    k = "xyz".index(axis)
    points = [tuple(-x if i == k else x for i, x in enumerate(p)) for p in mesh[0]]
    return points, [face[::-1] for face in mesh[1]]


def moved(mesh, by):
    return [tuple(x + d for x, d in zip(p, by)) for p in mesh[0]], mesh[1]


def joined(*meshes):
    points, faces = [], []
    for mesh in meshes:
        faces += [tuple(i + len(points) for i in face) for face in mesh[1]]
        points = points + list(mesh[0])
    return points, faces

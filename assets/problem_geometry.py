"""Vectors, quaternions and inertia in plain Python, for make_problems.py."""
import math


# Vectors are lists of three; quaternions are [w, x, y, z] and map body axes to world axes.
def add(*vectors):
    return [sum(parts) for parts in zip(*vectors)]


def sub(a, b):
    return [x - y for x, y in zip(a, b)]


def scale(s, a):
    return [s * x for x in a]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def unit(a):
    return scale(1 / math.hypot(*a), a)


def turn(axis, angle):
    s = math.sin(angle / 2)
    return [math.cos(angle / 2)] + scale(s, axis)


def compose(*quaternions):
    out = [1.0, 0.0, 0.0, 0.0]
    for q in quaternions:
        v, u = out[1:], q[1:]
        out = [out[0] * q[0] - dot(v, u)] + add(scale(out[0], u), scale(q[0], v), cross(v, u))
    return scale(1 / math.hypot(*out), out)


def rotate(q, a):
    t = scale(2, cross(q[1:], a))
    return add(a, scale(q[0], t), cross(q[1:], t))


def back(q, a):
    return rotate([q[0]] + scale(-1, q[1:]), a)


def diagonal(moments):
    return [[moments[0], 0.0, 0.0], [0.0, moments[1], 0.0], [0.0, 0.0, moments[2]]]


def box(mass, x, y, z):
    return diagonal([mass * (y * y + z * z) / 12, mass * (x * x + z * z) / 12, mass * (x * x + y * y) / 12])

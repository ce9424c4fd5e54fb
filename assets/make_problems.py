#!/usr/bin/env python3
"""Writes assets/problems/*.json: small problems of schema rigid-ref/1 with solutions in closed form.

Needs nothing but Python's standard library. Each function states its problem and the formula of its solution; the
files are committed, so the script runs only when a problem is added or changed:  python3 assets/make_problems.py
"""
import json
import math
import pathlib

from problem_geometry import add, back, box, compose, cross, diagonal, dot, rotate, scale, sub, turn, unit

G = 9.81


class Part:
    """A body: constants, and its motion as a function of time -> (cog, quaternion, velocity, angular velocity)."""

    def __init__(self, name, mass, inertia, cog_in_node, motion):
        self.name, self.mass, self.inertia = name, mass, inertia
        self.cog_in_node, self.motion = cog_in_node, motion

    def node(self, p, q):
        return sub(p, rotate(q, self.cog_in_node))

    def definition(self):
        p, q, v, w = self.motion(0.0)
        return {"name": self.name, "mass": self.mass, "inertia_cog_body": self.inertia,
                "cog_in_node": self.cog_in_node, "position_node": self.node(p, q), "position_cog": p,
                "orientation_wxyz": q, "velocity_cog": v,
                "velocity_node": sub(v, cross(w, rotate(q, self.cog_in_node))),
                "angular_velocity_world": w, "angular_velocity_body": back(q, w)}

    def state(self, t):
        p, q, v, w = self.motion(t)
        return {"position_cog": p, "quaternion_wxyz": q, "velocity_cog": v, "angular_velocity_world": w,
                "position_node": self.node(p, q)}

    def kinetic(self, t):
        _, q, v, w = self.motion(t)
        w_body = back(q, w)
        spin = dot(w_body, [dot(row, w_body) for row in self.inertia])
        return (self.mass * dot(v, v) + spin) / 2


def problem(name, title, description, parts, duration, accuracy, joints=(), forces=(), kinematic=(),
            gravity=(0.0, 0.0, -G), elastic=lambda t: 0.0):
    samples = []
    for i in range(11):
        t = duration * i / 10
        kinetic = sum(part.kinetic(t) for part in parts)
        weight = sum(-part.mass * dot(gravity, part.motion(t)[0]) for part in parts)
        samples.append({"t": t, "state": {part.name: part.state(t) for part in parts},
                        "energy": {"kinetic": kinetic, "potential_gravity": weight,
                                   "potential_elastic_or_central": elastic(t),
                                   "total": kinetic + weight + elastic(t)}})
    return {"schema": "rigid-ref/1", "name": name, "title": title, "description": description,
            "gravity": list(gravity), "bodies": [part.definition() for part in parts], "particles": [],
            "kinematic_bodies": list(kinematic), "joints": list(joints), "forces": list(forces), "contacts": [],
            "duration": duration, "samples": samples, "accuracy": {"estimated_abs": accuracy},
            "reference_method": "closed form", "source": "assets/make_problems.py",
            "error_metric": "position: max over samples and bodies of the distance of the centres of gravity [m]; "
                            "attitude: 2 atan2(|vec(conj(q) q_ref)|, |scalar|) [rad]"}


def free_symmetric_top():
    """Poinsot with two equal moments: L stands still, the axis goes round it at |L|/It, the body turns about its own
    axis at w3 (It - I3)/It besides. The centre of gravity flies on a parabola."""
    mass, it, i3 = 1.7, 0.05, 0.08
    q0, w_body = turn(unit([1, 2, -1]), 0.9), [0.8, 0.0, 6.0]
    momentum = rotate(q0, [it * w_body[0], 0.0, i3 * w_body[2]])
    rate, own = math.hypot(*momentum) / it, w_body[2] * (it - i3) / it
    p0, v0, g = [1.0, -2.0, 3.0], [2.0, 1.0, 7.0], [0.0, 0.0, -G]

    def motion(t):
        q = compose(turn(unit(momentum), rate * t), q0, turn([0, 0, 1], own * t))
        w = add(scale(1 / it, momentum), scale(own, rotate(q, [0, 0, 1])))
        return add(p0, scale(t, v0), scale(t * t / 2, g)), q, add(v0, scale(t, g)), w

    part = Part("top", mass, diagonal([it, it, i3]), [0.1, -0.05, 0.2], motion)
    return problem("free_symmetric_top", "Thrown symmetric top", free_symmetric_top.__doc__, [part], 2.0, 1e-14)


def jacobi_amplitude(u, k):
    """am(u, k) by the arithmetic-geometric mean (Abramowitz and Stegun 16.4)."""
    a, b, c, steps = 1.0, math.sqrt(1 - k * k), k, []
    while abs(c) > 1e-17:
        a, b, c = (a + b) / 2, math.sqrt(a * b), (a - b) / 2
        steps.append((a, c))
    phi = 2 ** len(steps) * a * u
    for a, c in reversed(steps):
        phi = (phi + math.asin(c / a * math.sin(phi))) / 2
    return phi


def quarter_period(k):
    a, b = 1.0, math.sqrt(1 - k * k)
    while abs(a - b) > 1e-16:
        a, b = (a + b) / 2, math.sqrt(a * b)
    return math.pi / (2 * a)


def welded_pendulum():
    """Two boxes welded together on a pivot about y, released from rest at 2 rad from the lowest place:
    sin(psi/2) = k sn(K - w t, k), k = sin(psi0/2), w^2 = g S / I, S the first moment about the hinge, I the moment of
    inertia about it (Landau and Lifshitz I, section 11)."""
    hinge, psi0 = [0.3, -0.2, 1.0], 2.0
    boxes = [("upper", 1.2, box(1.2, 0.1, 0.2, 0.5), [0.05, 0.02, -0.25]),
             ("lower", 0.7, box(0.7, 0.3, 0.1, 0.1), [0.2, -0.1, -0.5])]
    moment = [sum(m * c[i] for _, m, _, c in boxes) for i in range(3)]
    about_hinge = sum(inertia[1][1] + m * (c[0] ** 2 + c[2] ** 2) for _, m, inertia, c in boxes)
    lowest, first = math.atan2(moment[0], -moment[2]), math.hypot(moment[0], moment[2])
    w, k = math.sqrt(G * first / about_hinge), math.sin(psi0 / 2)
    quarter = quarter_period(k)

    def motion_of(c):
        def motion(t):
            phi = jacobi_amplitude(quarter - w * t, k)
            psi = 2 * math.asin(k * math.sin(phi))
            rate = [0.0, -2 * k * w * math.cos(phi), 0.0]
            q = turn([0, 1, 0], lowest + psi)
            r = rotate(q, c)
            return add(hinge, r), q, cross(rate, r), rate
        return motion

    parts = [Part(name, m, inertia, c, motion_of(c)) for name, m, inertia, c in boxes]
    joints = [{"type": "pivot", "name": "hinge", "body_a": "world", "body_b": "upper", "anchor_world": hinge,
               "axis_world": [0.0, 1.0, 0.0]},
              {"type": "fixed", "name": "weld", "body_a": "upper", "body_b": "lower", "anchor_world": hinge}]
    return problem("welded_pendulum", "Pendulum of two welded boxes", welded_pendulum.__doc__, parts, 3.0, 1e-13,
                   joints=joints)


def damped_oscillator(x0, v0, omega2, half_damping):
    """x'' = -omega2 x - 2 half_damping x', under-damped: -> (x(t), x'(t))."""
    w = math.sqrt(omega2 - half_damping ** 2)
    b = (v0 + half_damping * x0) / w

    def at(t):
        e, s, c = math.exp(-half_damping * t), math.sin(w * t), math.cos(w * t)
        x = e * (x0 * c + b * s)
        return x, e * w * (b * c - x0 * s) - half_damping * x
    return at


def slider_spring_damper():
    """A block on a tilted slider between weight, spring and damper that act along its axis:
    m s'' = m g.n - k (s - l0) - c s', a damped harmonic oscillation about s = l0 + m g.n / k."""
    mass, k, c, l0, n = 1.5, 60.0, 1.2, 0.4, [0.48, 0.64, -0.6]
    q, origin, offset = turn(unit([2, -1, 3]), 1.1), [0.5, 0.1, 2.0], [0.1, -0.2, 0.05]
    rest = l0 + mass * dot([0, 0, -G], n) / k
    at = damped_oscillator(0.9 - rest, -0.5, k / mass, c / (2 * mass))

    def motion(t):
        s, rate = at(t)
        # The spring is fastened to a point of the block `offset` (body axes) off its centre of gravity.
        return sub(add(origin, scale(rest + s, n)), rotate(q, offset)), q, scale(rate, n), [0.0, 0.0, 0.0]

    part = Part("block", mass, box(mass, 0.2, 0.3, 0.4), [0.03, 0.02, -0.01], motion)
    joints = [{"type": "slider", "name": "rail", "body_a": "world", "body_b": "block", "anchor_world": origin,
               "axis_world": n}]
    forces = [{"type": "spring_damper_point_to_point", "a": {"body": "world", "point_world": origin},
               "b": {"body": "block", "point_body_cog": offset}, "stiffness": k, "damping": c, "rest_length": l0}]
    return problem("slider_spring_damper", "Block on a tilted slider with spring and damper",
                   slider_spring_damper.__doc__, [part], 2.0, 1e-14, joints=joints, forces=forces,
                   elastic=lambda t: k / 2 * (rest + at(t)[0] - l0) ** 2)


def slider_on_turning_arm():
    """A bead with a spring on a rail that an animated arm turns at constant rate: r'' = W^2 r - k/m (r - l0), an
    oscillation at sqrt(k/m - W^2) about k l0 / (k - m W^2). The rail carries the weight and the Coriolis force."""
    mass, k, l0, spin, beside = 0.8, 40.0, 0.3, 4.0, 0.25
    anchor = [0.2, -0.3, 0.5]
    omega2 = k / mass - spin * spin
    rest = k * l0 / (mass * omega2)
    at = damped_oscillator(0.7 - rest, 0.4, omega2, 0.0)
    q0 = turn(unit([1, 1, 0]), 0.6)

    def motion(t):
        r, rate = at(t)
        arm, w = turn([0, 0, 1], spin * t), [0.0, 0.0, spin]
        along = rotate(arm, [rest + r, beside, 0.0])
        return (add(anchor, along), compose(arm, q0), add(rotate(arm, [rate, 0.0, 0.0]), cross(w, along)), w)

    part = Part("bead", mass, diagonal([0.004, 0.005, 0.006]), [0.0, 0.05, 0.0], motion)
    kinematic = [{"name": "arm", "anchor_world": anchor, "axis_world": [0.0, 0.0, 1.0],
                  "law": {"type": "uniform_acceleration", "rate": spin, "acceleration": 0.0},
                  "orientation_wxyz": [1.0, 0.0, 0.0, 0.0]}]
    joints = [{"type": "slider", "name": "rail", "body_a": "arm", "body_b": "bead", "anchor_world": anchor,
               "axis_world": [1.0, 0.0, 0.0]}]
    forces = [{"type": "spring_damper_point_to_point",
               "a": {"body": "arm", "point_body_cog": [0.0, beside, 0.0]},
               "b": {"body": "bead", "point_body_cog": [0.0, 0.0, 0.0]}, "stiffness": k, "damping": 0.0,
               "rest_length": l0}]
    return problem("slider_on_turning_arm", "Bead with a spring on a turning rail", slider_on_turning_arm.__doc__,
                   [part], 2.0, 1e-14, joints=joints, forces=forces, kinematic=kinematic,
                   elastic=lambda t: k / 2 * (rest + at(t)[0] - l0) ** 2)


def top_steady_precession():
    """Heavy symmetric top on a ball joint, spun so that its axis keeps its tilt theta: I' f^2 cos(theta) - I3 w3 f
    + m g l = 0 for the precession rate f, I' about the tip (Landau and Lifshitz I, section 35)."""
    mass, it, i3, length, theta, f = 0.9, 0.012, 0.02, 0.25, 0.7, 2.5
    about_tip = it + mass * length ** 2
    w3 = (mass * G * length + about_tip * f * f * math.cos(theta)) / (i3 * f)
    own, tip = w3 - f * math.cos(theta), [0.1, 0.2, 0.3]

    def motion(t):
        q = compose(turn([0, 0, 1], f * t), turn([1, 0, 0], theta), turn([0, 0, 1], own * t))
        axis = rotate(q, [0, 0, 1])
        w = add([0, 0, f], scale(own, axis))
        return add(tip, scale(length, axis)), q, cross(w, scale(length, axis)), w

    part = Part("top", mass, diagonal([it, it, i3]), [0.0, 0.0, length], motion)
    joints = [{"type": "ball", "name": "tip", "body_a": "world", "body_b": "top", "anchor_world": tip}]
    return problem("top_steady_precession", "Top in steady precession", top_steady_precession.__doc__, [part], 1.0,
                   1e-14, joints=joints)


def drag_and_torque():
    """A body in wind with linear drag and a constant torque about a principal axis: velocity decays to
    u + m g / c at the rate c / m, the angle is w0 t + T t^2 / (2 I)."""
    mass, c, torque, i3, spin = 0.6, 0.5, 0.09, 0.03, 1.5
    wind, p0, v0 = [2.0, -1.0, 0.5], [0.0, 1.0, 10.0], [8.0, 3.0, 4.0]
    q0 = turn(unit([1, 2, 2]), 0.8)
    axis = rotate(q0, [0, 0, 1])
    last, tau = add(wind, scale(mass / c, [0, 0, -G])), mass / c

    def motion(t):
        e = math.exp(-t / tau)
        p = add(p0, scale(t, last), scale(tau * (1 - e), sub(v0, last)))
        q = compose(turn(axis, spin * t + torque * t * t / (2 * i3)), q0)
        return p, q, add(last, scale(e, sub(v0, last))), scale(spin + torque * t / i3, axis)

    part = Part("body", mass, diagonal([0.02, 0.025, i3]), [0.0, 0.1, 0.0], motion)
    forces = [{"type": "linear_drag", "body": "body", "coefficient": c, "medium_velocity": wind},
              {"type": "torque_constant", "body": "body", "torque_world": scale(torque, axis)}]
    return problem("drag_and_torque", "Body in wind under a constant torque", drag_and_torque.__doc__, [part], 2.0,
                   1e-14, forces=forces)


def main():
    folder = pathlib.Path(__file__).resolve().parent / "problems"
    folder.mkdir(exist_ok=True)
    for make in (free_symmetric_top, welded_pendulum, slider_spring_damper, slider_on_turning_arm,
                 top_steady_precession, drag_and_torque):
        made = make()
        made["description"] = " ".join(made["description"].split())
        path = folder / (made["name"] + ".json")
        path.write_text(json.dumps(made, indent=1) + "\n", encoding="utf-8")
        print(path.name)


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
"""Compares what `pantin info --joint ...` says of robots with Pinocchio: link poses at random joint values, total masses.

    python3 tests/support/compare_with_pinocchio.py build/release/bin/pantin [NAME...]

Takes every URDF of the PyPI package example-robot-data, or those whose path holds a NAME, and prints a table for README
and a summary line. A robot that pantin refuses must be one of REFUSED, for the reason given there. Exit code: 0 where all
is so and poses agree to 1e-9 (rotation entries and metres) and masses to 1e-9 relative, 1 where not, 77 (skipped) where a
package is missing (PyPI: pin, example-robot-data).
"""
import argparse
import importlib.metadata
import json
import math
import random
import subprocess
import sys

TOLERANCE = 1e-9
SKIPPED = 77
REFUSED = {  # the end of a path -> what the error must say
    "alex_psyonic_hands.urdf": "does not exist",  # its mimics name joints that are in no file of the package
    "ur3.urdf": "has no name",                    # a part for xacro
}


def skip(reason):
    print(f"SKIPPED: comparison with Pinocchio: {reason}; pip install pin example-robot-data, and name that Python in "
          "PANTIN_PYTHON")
    sys.exit(SKIPPED)


try:
    import pinocchio
except ImportError as error:
    skip(str(error))


def model_files(names):
    """(short path, path) of the robots in the package example-robot-data, which is data without a module of its own."""
    try:
        package = importlib.metadata.distribution("example-robot-data")
    except importlib.metadata.PackageNotFoundError as error:
        skip(str(error))
    found = []
    for file in package.files or []:
        short = "/".join(str(file).split("/robots/", 1)[-1].split("/"))
        if str(file).endswith(".urdf") and (not names or any(name in short for name in names)):
            found.append((short, str(package.locate_file(file).resolve())))
    if not found:
        skip(f"example-robot-data {package.version} has no robot {names}")
    return sorted(found)


def random_values(model, randomness):
    """Joint name -> numbers as Pantin takes them: within its limits, a full turn where it has none, any rigid motion of a
    floating joint (position, then quaternion w, x, y, z)."""
    values = {}
    for i in range(1, model.njoints):
        joint = model.joints[i]
        low, high = -math.pi, math.pi
        if joint.nq == 1:
            low = max(low, float(model.lowerPositionLimit[joint.idx_q]))
            high = min(high, float(model.upperPositionLimit[joint.idx_q]))
        numbers = [randomness.uniform(low, high)]
        if joint.nq == 7:
            q = [randomness.gauss(0, 1) for _ in range(4)]
            length = math.sqrt(sum(x * x for x in q))
            numbers = [randomness.uniform(-2, 2) for _ in range(3)] + [x / length for x in q]
        values[model.names[i]] = numbers
    return values


def configuration(model, values):
    q = pinocchio.neutral(model)
    for i in range(1, model.njoints):
        joint, numbers = model.joints[i], values[model.names[i]]
        if joint.nq == 1:
            q[joint.idx_q] = numbers[0]
        elif joint.nq == 2:  # a joint without limits is cosine and sine
            q[joint.idx_q], q[joint.idx_q + 1] = math.cos(numbers[0]), math.sin(numbers[0])
        else:  # position, then x, y, z, w
            q[joint.idx_q:joint.idx_q + 7] = numbers[:3] + numbers[4:] + numbers[3:4]
    return q


def pinocchio_poses(model, values):
    """Link name -> 4x4 pose in the world."""
    data = model.createData()
    pinocchio.framesForwardKinematics(model, data, configuration(model, values))
    return {frame.name: data.oMf[i].homogeneous for i, frame in enumerate(model.frames)
            if frame.type == pinocchio.FrameType.BODY and frame.name != "universe"}


def pantin_info(program, file, values):
    """The document of `pantin info`, and what it says on standard error."""
    command = [program, "info", file, "--json"]
    for name, numbers in values.items():
        command.append(f"--joint={name}={','.join(map(repr, numbers))}")
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    return json.loads(done.stdout), done.stderr


def flat(matrix):
    """Entries row by row, of rows or of a list that is flat already."""
    return [x for row in matrix for x in row] if isinstance(matrix[0], list) else matrix


def greatest_error(expected, found):
    """Greatest difference of any matrix entry, and the link where it is; a link that is missing is infinitely wrong."""
    worst, where = 0.0, "-"
    for name, pose in expected.items():
        error = math.inf
        if name in found:
            error = max(abs(a - b) for a, b in zip(flat(pose.tolist()), flat(found[name]), strict=True))
        if error > worst:
            worst, where = error, name
    return worst, where


class Robot:
    """One row of the table; `verdict` is "agree" where all is as it should be."""

    def __init__(self, name):
        self.name, self.links, self.joints, self.mass = name, 0, 0, "-"
        self.pose_error = self.mass_error = 0.0
        self.verdict = "agree"

    def compare(self, program, file, configurations, randomness):
        reason = REFUSED.get(self.name.rsplit("/", 1)[-1])
        first, errors = pantin_info(program, file, {})
        if "nodes" not in first:
            self.verdict = f"refused: {reason}" if reason and reason in errors else "REFUSED: " + errors.splitlines()[0]
            return
        model = pinocchio.buildModelFromUrdf(file)
        self.joints = model.njoints - 1
        for _ in range(configurations):
            values = random_values(model, randomness)
            expected, (info, errors) = pinocchio_poses(model, values), pantin_info(program, file, values)
            self.links = len(expected)
            found = {node["name"]: node["absolute"] for node in info.get("nodes", [])}
            self.pose_error = max(self.pose_error, greatest_error(expected, found)[0])
        mass = sum(inertia.mass for inertia in model.inertias)  # that of the world holds what is fixed to it
        self.mass = f"{mass:.4g}"
        found = first["total_mass"] or 0.0
        self.mass_error = abs(found - mass) / mass if mass > 0 else abs(found)
        if max(self.pose_error, self.mass_error) > TOLERANCE:
            self.verdict = "DISAGREE"

    def row(self):
        return (f"| {self.name} | {self.links} | {self.joints} | {self.mass} | {self.pose_error:.1e} | "
                f"{self.mass_error:.1e} | {self.verdict} |")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program", help="path of pantin")
    parser.add_argument("names", nargs="*", help="parts of the paths of robots; all without")
    parser.add_argument("--configurations", type=int, default=3, help="random ones for each robot (default 3)")
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()

    print(f"Pinocchio {pinocchio.__version__}, {arguments.configurations} random configurations a robot, seed "
          f"{arguments.seed}\n")
    print("| robot | links | joints | mass [kg] | greatest difference of poses | of masses (relative) | verdict |\n"
          "|---|---|---|---|---|---|---|")
    robots = []
    for name, file in model_files(arguments.names):
        robots.append(Robot(name))
        robots[-1].compare(arguments.program, file, arguments.configurations, random.Random(arguments.seed))
        print(robots[-1].row(), flush=True)
    bad = [robot.name for robot in robots if not robot.verdict.startswith(("agree", "refused"))]
    refused = sum(robot.verdict.startswith("refused") for robot in robots)
    print(f"\n{len(robots)} robots: {len(robots) - refused - len(bad)} agree, {refused} are refused for the right reason, "
          f"{len(bad)} are wrong {bad or ''}; greatest difference of poses {max(r.pose_error for r in robots):.1e}, of "
          f"masses {max(r.mass_error for r in robots):.1e}, allowed {TOLERANCE:.0e}")
    sys.exit(1 if bad else 0)


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
"""Compares the link poses of `pantin info --joint ...` with Pinocchio's at random joint values.

    python3 tests/support/compare_with_pinocchio.py build/release/bin/pantin

Needs the PyPI packages pin and example-robot-data. Prints a table for README and a summary line. Exit code: 0 where all
poses agree to 1e-9 (rotation entries and metres), 1 where they do not, 77 (skipped) where a package is missing.
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
ROBOTS = {"panda": "panda_description/urdf/panda.urdf", "ur5": "ur_description/urdf/ur5_robot.urdf",
          "talos": "talos_data/robots/talos_reduced.urdf", "talos full": "talos_data/robots/talos_full_v2.urdf"}


def skip(reason):
    print(f"SKIPPED: comparison with Pinocchio: {reason}; pip install pin example-robot-data, and name that Python in "
          "PANTIN_PYTHON")
    sys.exit(SKIPPED)


try:
    import pinocchio
except ImportError as error:
    skip(str(error))


def model_file(ending):
    """The path of a file of the package example-robot-data, which is data without a module of its own."""
    try:
        package = importlib.metadata.distribution("example-robot-data")
    except importlib.metadata.PackageNotFoundError as error:
        skip(str(error))
    for file in package.files or []:
        if str(file).endswith(ending):
            return str(package.locate_file(file))
    skip(f"example-robot-data {package.version} has no {ending}")


def random_values(model, randomness):
    """Joint name -> value within its limits; a full turn where it has none."""
    values = {}
    for i in range(1, model.njoints):
        joint = model.joints[i]
        low, high = -math.pi, math.pi
        if joint.nq == 1:
            low = max(low, float(model.lowerPositionLimit[joint.idx_q]))
            high = min(high, float(model.upperPositionLimit[joint.idx_q]))
        values[model.names[i]] = randomness.uniform(low, high)
    return values


def configuration(model, values):
    q = pinocchio.neutral(model)
    for i in range(1, model.njoints):
        joint, value = model.joints[i], values[model.names[i]]
        if joint.nq == 1:
            q[joint.idx_q] = value
        else:  # a joint without limits is cosine and sine
            q[joint.idx_q], q[joint.idx_q + 1] = math.cos(value), math.sin(value)
    return q


def pinocchio_poses(model, values):
    """Link name -> 4x4 pose in the world."""
    data = model.createData()
    pinocchio.framesForwardKinematics(model, data, configuration(model, values))
    return {frame.name: data.oMf[i].homogeneous for i, frame in enumerate(model.frames)
            if frame.type == pinocchio.FrameType.BODY and frame.name != "universe"}


def pantin_poses(program, file, values):
    command = [program, "info", file, "--json"]
    for name, value in values.items():
        command.append(f"--joint={name}={value!r}")
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        sys.exit(f"{' '.join(command[:4])} ... ended with {done.returncode}:\n{done.stderr}")
    return {node["name"]: node["absolute"] for node in json.loads(done.stdout)["nodes"]}


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


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program", help="path of pantin")
    parser.add_argument("--configurations", type=int, default=10, help="random ones for each robot (default 10)")
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()

    print(f"Pinocchio {pinocchio.__version__}, {arguments.configurations} random configurations a robot, seed "
          f"{arguments.seed}\n")
    print("| robot | links | movable joints | greatest difference | at link |\n|---|---|---|---|---|")
    worst = 0.0
    for robot, ending in ROBOTS.items():
        file, randomness = model_file(ending), random.Random(arguments.seed)
        model = pinocchio.buildModelFromUrdf(file)
        error, where, links = 0.0, "-", 0
        for _ in range(arguments.configurations):
            values = random_values(model, randomness)
            expected = pinocchio_poses(model, values)
            links = len(expected)
            error, where = max((error, where), greatest_error(expected, pantin_poses(arguments.program, file, values)))
        print(f"| {robot} | {links} | {model.njoints - 1} | {error:.1e} | {where} |", flush=True)
        worst = max(worst, error)
    agreed = worst <= TOLERANCE
    print(f"\n{'agree' if agreed else 'DISAGREE'}: greatest difference {worst:.1e}, allowed {TOLERANCE:.0e}")
    sys.exit(0 if agreed else 1)


if __name__ == "__main__":
    main()

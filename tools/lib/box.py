# SPDX-License-Identifier: GPL-3.0-or-later
"""Random arteries of the box that sweeps are about, computed by a tier: box.py PROGRAM [options] (see tools/box)."""

import argparse
import collections
import csv
import itertools
import math
import pathlib
import random
import shutil
import subprocess
import sys

SCENE = "scenes/cylinder.toml"
LAWS = ("EXP1", "EXP2", "EXP1+EXP2-FS", "EXP1+EXP2-ZS")
# Of the paper's artery: its radius (cm), and the outlet resistance (dyn s/cm5) that belongs to it.
RADIUS, RESISTANCE = 0.033, 1.032e6
MMHG = 1333.22  # dyn/cm2
HEADER = ("wall.law", "geometry.radius[cm]", "geometry.thickness[cm]", "geometry.length[cm]",
          "tether.stiffness[dyn/cm3]", "tether.traction", "wall.activation_stretch[1]", "outlet.kind",
          "outlet.resistance[dyn s/cm5]", "outlet.proximal_resistance[dyn s/cm5]", "outlet.compliance[cm5/dyn]")


def artery(chance):
    """One of the box, in the order of HEADER; resistance falls with the square of the radius, so that pressures
    stay within a living artery's in wide and narrow ones."""
    def log_uniform(low, high):
        return math.exp(chance.uniform(math.log(low), math.log(high)))

    law = chance.choice(LAWS)
    radius = RADIUS * log_uniform(0.5, 5)
    thickness = radius * chance.uniform(0.1, 0.5)
    length = radius * chance.uniform(5, 40)
    stiffness = log_uniform(0.3e7, 3e7)
    traction = "normal" if chance.random() < 0.9 else "reference"
    stretch = chance.uniform(1.2, 1.7)
    resistance = log_uniform(0.5, 2) * RESISTANCE * (RADIUS / radius) ** 2
    windkessel = chance.random() >= 0.7
    compliance = log_uniform(0.05, 1) / resistance
    values = [law, radius, thickness, length, stiffness, traction, stretch if law == "EXP1+EXP2-FS" else "",
              "rcr" if windkessel else "resistance", resistance,
              0.1 * resistance if windkessel else "", compliance if windkessel else ""]
    return [f"{value:.6g}" if isinstance(value, float) else value for value in values]


def write_points(path, points):
    # A few arteries may all leave a key to the scene, which a sweep takes for a slip.
    given = [any(point[k] for point in points) for k in range(len(HEADER))]
    with open(path, "w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file)
        writer.writerows(list(itertools.compress(row, given)) for row in (HEADER, *points))


def sweep(program, points, folder, options):
    command = [program, "sweep", SCENE, "--points", points, "--quiet", "--out", folder, *options]
    if subprocess.run(command, check=False).returncode not in (0, 3):
        sys.exit(f"{' '.join(map(str, command))} failed")
    with open(folder / "sweep.csv", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def in_the_box(program, folder, count, seed, again):
    """The first `count` arteries of the seed that 0D finds to be in the box."""
    chance = random.Random(seed)
    drawn = [artery(chance) for _ in range(2 * count + 40)]
    write_points(folder / "drawn.csv", drawn)
    rows = sweep(program, folder / "drawn.csv", folder / "drawn",
                 ["--tier", "lumped", "--quantity", "pressure.mean", "--quantity", "radial_displacement.P1.max", again])
    kept = []
    for point, row in zip(drawn, rows):
        if row["status"] != "done":
            continue
        pressure = float(row["pressure.mean[dyn/cm2]"]) / MMHG
        opening = float(row["radial_displacement.P1.max[cm]"]) / float(point[1])
        if 40 <= pressure <= 250 and opening <= 2:
            kept.append(point)
    if len(kept) < count:
        sys.exit(f"only {len(kept)} of {len(drawn)} arteries drawn are in the box")
    return kept[:count]


def main():
    parser = argparse.ArgumentParser(prog="tools/box")
    parser.add_argument("program")
    parser.add_argument("--count", type=int, default=200)
    parser.add_argument("--seed", type=int, default=11)
    parser.add_argument("--tier", default="axisym", choices=("axisym", "full3d"))
    parser.add_argument("--set", action="append", default=[], metavar="KEY=VALUE")
    parser.add_argument("--at-least", type=float, default=0.99, metavar="SHARE")
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("results/box"))
    parser.add_argument("--resume", action="store_true")
    arguments = parser.parse_args()
    if arguments.count < 1:
        parser.error(f"--count {arguments.count}: a number of arteries of 1 or more")
    if not shutil.which(arguments.program):
        parser.error(f"{arguments.program}: no program; build it, or name another as the first argument")

    arguments.out.mkdir(parents=True, exist_ok=True)
    again = "--resume" if arguments.resume else "--replace"
    points = in_the_box(arguments.program, arguments.out, arguments.count, arguments.seed, again)
    write_points(arguments.out / "points.csv", points)
    settings = [word for setting in arguments.set for word in ("--set", setting)]
    rows = sweep(arguments.program, arguments.out / "points.csv", arguments.out / arguments.tier,
                 ["--tier", arguments.tier, "--quantity", "pressure.mean", "--quantity",
                  "radial_displacement.P1.max", again, *settings])

    done = sum(row["status"] == "done" for row in rows)
    print(f"{arguments.tier}: {done} of {len(rows)} arteries of the box complete (seed {arguments.seed})")
    for row in rows:
        if row["status"] != "done":
            print(f"  point {row['point']}: {row['status']}, {row['reason']}")
    by_law = collections.Counter(row["wall.law"] for row in rows if row["status"] != "done")
    if by_law:
        print("  by law: " + ", ".join(f"{law} {count}" for law, count in sorted(by_law.items())))
    return 0 if done >= arguments.at_least * len(rows) else 1


if __name__ == "__main__":
    sys.exit(main())

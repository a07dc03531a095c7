# SPDX-License-Identifier: GPL-3.0-or-later
"""Times sweeps of the paper's artery: bench_sweep.py PROGRAM [WHOLE_RUNS] (see tools/bench-sweep)."""

import csv
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile
import time

SCENE = "scenes/cylinder.toml"
RANGES = {"outlet.resistance": "5e5:2e6", "tether.stiffness": "3e6:3e7", "wall.activation_stretch": "1.2:1.7"}
OBSERVABLES = ["pressure", "inflow", "outflow", "outlet_pressure", "transmural_pressure"] + [
    f"{name}.P{point}"
    for name in ("radial_displacement", "fiber_angle", "fiber_stretch", "recruitment", "von_mises")
    for point in (1, 2, 3, 4)
]
GRADIENT_KEYS = ("outlet.resistance", "tether.stiffness", "wall.activation_stretch", "geometry.thickness",
                 "wall.fiber_stiffness")
EXTREMES = [f"{name}.{end}" for name in OBSERVABLES for end in ("max", "min")]


def sweep(program, folder, *more):
    """Seconds, processor seconds and peak memory (MiB) of a sweep."""
    command = [program, "sweep", SCENE, "--quiet", "--replace", "--out", folder, *more]
    start = time.perf_counter()
    process = subprocess.Popen(command)
    _, status, usage = os.wait4(process.pid, 0)
    if status != 0:
        sys.exit(f"{' '.join(command)} failed")
    return time.perf_counter() - start, usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024


def rows(folder):
    with open(pathlib.Path(folder, "sweep.csv"), encoding="utf-8") as file:
        return list(csv.DictReader(file))


def vary(counts=None):
    arguments = []
    for key, span in RANGES.items():
        suffix = f":{counts[key]}" if counts else ""
        arguments += ["--vary", f"{key}={span}{suffix}"]
    return arguments


def asked(quantities):
    return [word for name in quantities for word in ("--quantity", name)]


def largest_error(program, folder):
    """Of all extremes of 40 points at 0.1 %, over what the observable ranges over in the beat."""
    tables = []
    for tolerance in ("1e-9", "1e-3"):
        sweep(program, folder, *vary(), "--sample", "sobol:40", "--tier", "lumped", *asked(EXTREMES),
              "--set", f"accuracy.tolerance={tolerance}")
        tables.append(rows(folder))
    worst = (0.0, "")
    for exact, found in zip(*tables):
        for head in exact:
            if ".max[" not in head:
                continue
            low = head.replace(".max[", ".min[")
            span = float(exact[head]) - float(exact[low])
            for end in (head, low):
                if span > 0:
                    worst = max(worst, (abs(float(found[end]) - float(exact[end])) / span, end))
    return worst


def whole_run(program):
    """Processor seconds of a whole run through a library."""
    return float(subprocess.run([program, SCENE, "200"], check=True, capture_output=True, text=True).stdout)


def against(program, whole_runs, folder):
    """Whole runs of another library beside points of sweeps, by turns; medians of the processor's time of one."""
    # One job each: threads that wait for others take the processor's time, too.
    at_bar = ["--tier", "lumped", "--jobs", "1", "--set", "accuracy.tolerance=1e-3", *asked(EXTREMES)]
    grid = dict(zip(RANGES, (15, 15, 13)))
    rounds = []
    for _ in range(3):
        of_grid = sweep(program, folder, *vary(grid), *at_bar)[1] / (15 * 15 * 13)
        of_sample = sweep(program, folder, *vary(), "--sample", "sobol:2000", *at_bar)[1] / 2000
        rounds.append((whole_run(whole_runs), of_grid, of_sample))
    whole, of_grid, of_sample = (statistics.median(times) for times in zip(*rounds))
    print(f"a whole run of the other library: {1e3 * whole:.2f} ms of a processor; "
          f"a point of the grid {1e3 * of_grid:.3f} ms, {whole / of_grid:.1f} times less; "
          f"of the Sobol' sample {1e3 * of_sample:.3f} ms, {whole / of_sample:.1f} times less")


def run_2d(program, folder, *settings):
    """Processor seconds of a run of the paper's artery in 2D."""
    command = [program, "run", SCENE, "--tier", "axisym", "--quiet", "--replace", "--out",
               str(pathlib.Path(folder, "run")), "--set", "output.field_interval=0"]
    for setting in settings:
        command += ["--set", setting]
    process = subprocess.Popen(command)
    _, status, usage = os.wait4(process.pid, 0)
    if status != 0:
        sys.exit(f"{' '.join(command)} failed")
    return usage.ru_utime + usage.ru_stime


def plain_runs_2d(program, folder):
    """What derivatives by five keys, and the motion of the mesh, cost in 2D, side by side."""
    keys = ", ".join(f'"{key}"' for key in GRADIENT_KEYS)
    kinds = {"plain": [], "five keys": [f"sensitivity.parameters=[{keys}]"], "harmonic": ["mesh.motion=harmonic"]}
    rounds = [{kind: run_2d(program, folder, *settings) for kind, settings in kinds.items()} for _ in range(5)]
    median = {kind: statistics.median(times[kind] for times in rounds) for kind in kinds}
    print(f"2D, a run: {median['plain']:.2f} s of a processor, with harmonic motion {median['harmonic']:.2f} s; "
          f"derivatives by five keys cost {median['five keys'] / median['plain'] - 1:.1f} runs more", flush=True)


def main():
    program = sys.argv[1]
    at_bar = ["--tier", "lumped", "--set", "accuracy.tolerance=1e-3"]
    grid = dict(zip(RANGES, (15, 15, 13)))
    with tempfile.TemporaryDirectory() as folder:
        studies = [
            ("0D, grid 15 x 15 x 13, all extremes", 15 * 15 * 13, [*vary(grid), *at_bar, *asked(EXTREMES)]),
            ("0D, Sobol' sample, all extremes", 20_000,
             [*vary(), "--sample", "sobol:20000", *at_bar, *asked(EXTREMES)]),
            ("2D at 1 %, Sobol' sample", 100, [*vary(), "--sample", "sobol:100", "--tier", "axisym"]),
        ]
        for name, points, arguments in studies:
            wall, processor, memory = sweep(program, folder, *arguments)
            print(f"{name}: {points} points in {wall:.2f} s ({processor:.2f} s of processors), "
                  f"{points / wall:.0f} a second, {memory:.0f} MiB", flush=True)
        plain_runs_2d(program, folder)
        if len(sys.argv) > 2:
            against(program, sys.argv[2], folder)
        error, where = largest_error(program, folder)
        print(f"largest error of an extreme at 0.1 %: {error:.2e} of its range ({where})")


if __name__ == "__main__":
    main()

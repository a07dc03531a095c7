# SPDX-License-Identifier: GPL-3.0-or-later
"""Times `tunica run` on the paper's cylinder under the four laws and prints medians beside their bars.

Usage: time_runs.py PROGRAM [RUNS]

Two beats at a relative tolerance of 1e-6, files written, no report. Set-up and solver times are the run's own
(record.json); the process is timed from outside, from its start to its end. Exit code 1 when a bar is missed.
"""

import json
import pathlib
import statistics
import subprocess
import sys
import tempfile
import time

LAWS = ("EXP1", "EXP2", "EXP1+EXP2-ZS", "EXP1+EXP2-FS")
BARS = {"solver": 10.0, "with set-up": 25.0, "process": 80.0}  # ms


def time_once(program, law, folder):
    start = time.perf_counter()
    subprocess.run(
        [program, "run", "scenes/cylinder.toml", "--quiet", "--no-report", "--out", folder]
        + ["--set", f"wall.law={law}", "--set", "accuracy.tolerance=1e-6", "--set", "time.beats=2"],
        check=True,
    )
    process = time.perf_counter() - start
    seconds = json.loads(pathlib.Path(folder, "record.json").read_text())["seconds"]
    return {
        "solver": 1e3 * seconds["solve"],
        "with set-up": 1e3 * (seconds["setup"] + seconds["solve"]),
        "process": 1e3 * process,
    }


def main():
    program, runs = sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 21
    print(f"medians of {runs} runs in ms")
    print(f"{'law':14}" + "".join(f"{name:>14}" for name in BARS))
    print(f"{'bar':14}" + "".join(f"{bar:14.1f}" for bar in BARS.values()))
    missed = False
    for law in LAWS:
        with tempfile.TemporaryDirectory() as folder:
            samples = [time_once(program, law, folder) for _ in range(runs)]
        cells = ""
        for name, bar in BARS.items():
            median = statistics.median(sample[name] for sample in samples)
            missed |= median > bar
            cells += f"{median:14.2f}"
        print(f"{law:14}{cells}")
    if missed:
        sys.exit("a bar is missed")


if __name__ == "__main__":
    main()

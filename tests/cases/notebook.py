# SPDX-License-Identifier: GPL-3.0-or-later
"""Executes a notebook with the results in a folder, and once without: notebook.py NOTEBOOK RESULTS."""

import json
import os
import shutil
import subprocess
import sys
import tempfile


def execute(program, notebook, results, folder):
    """Exit code, what was printed, and the executed notebook."""
    environment = dict(os.environ, TUNICA_RESULTS=results, MPLBACKEND="module://matplotlib_inline.backend_inline",
                       IPYTHONDIR=folder, JUPYTER_RUNTIME_DIR=folder)
    run = subprocess.run([program, "--to", "notebook", "--execute", "--ExecutePreprocessor.timeout=300",
                          "--output-dir", folder, "--output", "executed.ipynb", notebook],
                         env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
    executed = os.path.join(folder, "executed.ipynb")
    if run.returncode != 0 or not os.path.exists(executed):
        return run.returncode, run.stdout, None
    with open(executed, encoding="utf-8") as file:
        return 0, run.stdout, json.load(file)


def main():
    notebook, results = (os.path.abspath(argument) for argument in sys.argv[1:])
    program = shutil.which("jupyter-nbconvert")
    if not program:
        sys.exit("no nbconvert here")
    with tempfile.TemporaryDirectory() as folder:
        code, printed, executed = execute(program, notebook, results, folder)
        if code != 0:
            sys.exit(printed)
        outputs = [output for cell in executed["cells"] for output in cell.get("outputs", [])]
        images = [output for output in outputs if "image/png" in output.get("data", {})]
        text = "".join("".join(output.get("text", "")) for output in outputs)
        if len(images) != 2:
            sys.exit(f"{len(images)} figures instead of 2:\n{text}")
        if text.count("mmHg") != 8 or text.count("% of the beat") != 8:
            sys.exit(f"not every law and point has its line:\n{text}")
        code, printed, _ = execute(program, notebook, os.path.join(folder, "nothing"), folder)
        if code == 0 or "Make them with: tools/study reproduction" not in printed:
            sys.exit(f"without results the notebook does not say which command makes them:\n{printed}")


if __name__ == "__main__":
    main()

# SPDX-License-Identifier: GPL-3.0-or-later
"""Blood flow in elastic arteries, from Python.

    scene = tunica.Scene("scenes/cylinder.toml")
    scene["outlet.resistance"] = "1.2e6 dyn s/cm5"
    result = tunica.run(scene)
    result.observables["pressure"].max()

Numbers are in the CGS unit of their key, column or quantity; text may carry another unit where a scene's key is
set. Tables are pandas DataFrames, with the units of their columns in `.attrs["units"]`; where there is no pandas
they are dicts of numpy arrays with the same `.attrs`.
"""
from ._compute import Answer, ask, evaluate, run
from ._result import Columns, Result, read, read_sweep
from ._scene import Scene
from ._tunica import InvalidInput, OutputFailure, SolverFailure, known_quantities
from ._tunica import version as __version__

InvalidInput.__doc__ = "Input that cannot be computed with; one line says what is allowed. A ValueError."
SolverFailure.__doc__ = ("A solver that gave up. `.time` is how far the run came (s, NaN where it did not begin), "
                         "`.result` what it has, a Result, or None. A RuntimeError.")
OutputFailure.__doc__ = "Results that cannot be written: names the path and the system's reason. An OSError."

__all__ = ["Answer", "Columns", "InvalidInput", "OutputFailure", "Result", "Scene", "SolverFailure", "ask",
           "evaluate", "known_quantities", "read", "read_sweep", "run"]

# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs, questions to runs, and many of them."""
from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Callable, NamedTuple, Sequence

import numpy as np

from . import _tunica
from ._result import Result
from ._scene import Scene, override_text


class Progress(NamedTuple):
    """Where a run stands."""
    beat: int  #: 1 for the first, 0 on the way to the state that the run starts from
    time: float  #: s of simulated time; rows that have ended, in evaluate()
    end_time: float  #: s; all rows
    step: int


def _teller(progress: Callable[[Progress], Any] | None):
    return None if progress is None else lambda *where: progress(Progress(*where))


def _check(told: dict[str, Any]) -> None:
    """Raises what an ending other than "done" stands for."""
    if told["ending"] == "done":
        return
    if told["ending"] == "refused":
        raise _tunica.InvalidInput(told["reason"])
    if told["ending"] == "interrupted":
        raise KeyboardInterrupt
    failure = _tunica.SolverFailure(told["reason"])
    failure.time = told["time"]
    failure.result = Result(told["parts"]) if "parts" in told else None
    raise failure


def run(scene: Scene, tier: str = "auto", *, out: str | os.PathLike | None = None, resume: bool = False,
        progress: Callable[[Progress], Any] | None = None) -> Result:
    """Computes a scene with "lumped", "axisym", "full3d" or the cheapest of them that suits ("auto").

    The first two compute in this process, the third by the program `tunica`. `out` is a folder to keep the
    result in, as `tunica run --out` would; `resume` goes on with a run that was interrupted there. `progress`
    is called with a Progress some times a second. Ctrl-C, or whatever `progress` raises, ends the run. Raises
    InvalidInput, SolverFailure and OutputFailure.
    """
    if resume and out is None:
        raise _tunica.InvalidInput("resume needs out, the folder of the run to go on with")
    folder = Path() if out is None else Path(out)
    told = scene.bound.compute(tier, "" if out is None else folder, resume, _teller(progress))
    _check(told)
    return Result(told["parts"])


@dataclass(frozen=True)
class Answer:
    """Quantities of a run, each in its unit; NaN where law or tier have no such thing."""
    tier: str
    quantities: tuple[str, ...]
    keys: tuple[str, ...]
    values: np.ndarray  #: by quantity
    gradients: np.ndarray | None  #: by quantity and key, in the units of both; None when not asked for

    def __getitem__(self, quantity: str) -> float:
        return float(self.values[self.quantities.index(quantity)])

    def gradient(self, quantity: str, key: str) -> float:
        """d(quantity)/d(key)."""
        if self.gradients is None:
            raise _tunica.InvalidInput("no gradients were asked for; give ask() the keys as gradients=[...]")
        return float(self.gradients[self.quantities.index(quantity), self.keys.index(key)])

    @property
    def units(self) -> dict[str, str]:
        return {name: _tunica.quantity_unit(name) for name in self.quantities}


def ask(scene: Scene, quantities: Sequence[str], tier: str = "auto", *, gradients: Sequence[str] = (),
        progress: Callable[[Progress], Any] | None = None) -> Answer:
    """Numbers of the last beat, named OBSERVABLE.STATISTIC ("pressure.max"; known_quantities() has them), and
    their derivatives by keys of the scene, without a whole result. Raises as run() does."""
    told = scene.bound.ask(tier, list(quantities), list(gradients), _teller(progress))
    _check(told)
    return Answer(told["tier"], tuple(quantities), tuple(gradients), told["values"], told.get("gradients"))


def evaluate(scene: Scene, keys: Sequence[str], points: Any, quantities: Sequence[str], tier: str = "auto", *,
             threads: int | None = None,
             progress: Callable[[Progress], Any] | None = None) -> tuple[np.ndarray, list[str]]:
    """Quantities at many points, side by side on `threads` threads (all cores when None).

    `points` has a row for each point and a column for each key, in the key's unit, as the samplers of SALib,
    scipy.stats.qmc and others make them. Returns an array with a row for each point and a column for each
    quantity, and a list of reasons: "" for a point that was computed, else why it could not be; its row is NaN.
    Raises InvalidInput for keys, quantities or shapes that suit no point at all, and KeyboardInterrupt.
    """
    for key in keys:
        if not _tunica.declaration(key)[1]:
            raise _tunica.InvalidInput(f"{key} does not hold a number; change it by scene.with_(...)")
    if threads is not None and threads < 1:
        raise _tunica.InvalidInput(f"threads = {threads}: has to be 1 or more")
    points = np.asarray(points, dtype=float)
    if points.ndim != 2 or points.shape[1] != len(keys):
        raise _tunica.InvalidInput(f"points have shape {points.shape}: a row for each point and a column for each of "
                                   f"the {len(keys)} keys are needed")
    rows = [[override_text(key, value) for key, value in zip(keys, row)] for row in points.tolist()]
    return scene.bound.evaluate(tier, rows, list(quantities), threads or 0, _teller(progress))

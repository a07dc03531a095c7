# SPDX-License-Identifier: GPL-3.0-or-later
"""A scene and its changes."""
from __future__ import annotations

import json
import os
import shutil
from collections.abc import Mapping
from pathlib import Path
from typing import Any, Iterator

import numpy as np

from . import _tunica


def _program() -> Path:
    """The program `tunica`, which computes what this process cannot: the one built with the package, else the
    first in PATH."""
    here = Path(__file__).resolve().parent
    for path in (_tunica.program_in_build, _tunica.program_in_install):
        if (here / path).is_file():
            return (here / path).resolve()
    return Path(shutil.which("tunica") or "tunica")


def override_text(key: str, value: Any) -> str:
    """"key=value" as the program's --set takes it. Floats lose no digit; whole ones also suit integer keys."""
    def text(one: Any) -> str:
        if isinstance(one, (bool, np.bool_)):
            return "true" if one else "false"
        if isinstance(one, (int, np.integer)):
            return str(int(one))
        if isinstance(one, (float, np.floating)):
            return repr(float(one)).removesuffix(".0")
        if isinstance(one, str):
            return json.dumps(one)
        raise _tunica.InvalidInput(f"{key}: {one!r} is not a number, a text, a flag or a list of them")

    if isinstance(value, (str, os.PathLike)):
        return f"{key}={os.fspath(value)}"
    if isinstance(value, (list, tuple, np.ndarray)) and np.ndim(value) == 1:
        return f"{key}=[{', '.join(text(one) for one in value)}]"
    return f"{key}={text(value)}"


class Scene(Mapping):
    """A scene file with changes of its keys: a mapping from every key that applies, defaults included, to its
    value in CGS units.

    Reading and setting raise InvalidInput for what the scene does not allow, naming the nearest key; what was
    set before then stays. Values to set are numbers, flags, texts ("75 mmHg", "EXP1") or lists of them.
    """

    def __init__(self, file: str | os.PathLike, changes: Mapping[str, Any] | None = None):
        self._file = Path(file)
        self._change({key: override_text(key, value) for key, value in (changes or {}).items()})

    def _change(self, overrides: dict[str, str]) -> None:
        self.bound = _tunica.Bound(self._file, list(overrides.values()), _program())
        self._overrides = overrides
        self._values = self.bound.values()

    @property
    def file(self) -> Path:
        return self._file

    @property
    def name(self) -> str:
        return self.bound.name()

    @property
    def remarks(self) -> list[str]:
        """What hardly can be meant although it is allowed, one line each."""
        return self.bound.remarks()

    def __getitem__(self, key: str) -> Any:
        try:
            return self._values[key]
        except KeyError:
            _tunica.declaration(key)
            raise _tunica.InvalidInput(f"{key} has no value in the scene {self.name}") from None

    def __contains__(self, key: object) -> bool:
        return key in self._values

    def __iter__(self) -> Iterator[str]:
        return iter(self._values)

    def __len__(self) -> int:
        return len(self._values)

    def __setitem__(self, key: str, value: Any) -> None:
        self.set({key: value})

    def set(self, changes: Mapping[str, Any]) -> None:
        """Sets several keys at once, where one alone would not be allowed."""
        self._change({**self._overrides, **{key: override_text(key, value) for key, value in changes.items()}})

    def with_(self, changes: Mapping[str, Any]) -> Scene:
        """Another scene with these changes; this one stays as it is."""
        other = Scene.__new__(Scene)
        other._file = self._file
        other._change({**self._overrides, **{key: override_text(key, value) for key, value in changes.items()}})
        return other

    @staticmethod
    def unit(key: str) -> str:
        """The unit of a key's numbers, "1" for none."""
        return _tunica.declaration(key)[0]

    @staticmethod
    def meaning(key: str) -> str:
        return _tunica.declaration(key)[2]

    def describe(self) -> str:
        """The scene as TOML, with every default, unit and meaning."""
        return self.bound.describe()

    def __repr__(self) -> str:
        return f"tunica.Scene({str(self._file)!r}, {list(self._overrides.values())})"

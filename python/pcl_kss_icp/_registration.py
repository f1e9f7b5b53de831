# SPDX-License-Identifier: BSD-3-Clause
"""Registration of two clouds."""
from __future__ import annotations

import operator
import warnings
from types import MappingProxyType
from typing import Any, Callable, Dict, Mapping, NamedTuple, Optional, Tuple, Union

from . import _core
from ._clouds import cloud_of, numbers_of
from ._result import Result, result_of

Value = Union[bool, int, float, str]
Progress = Callable[[str, float], object]


class Setting(NamedTuple):
    """What may be set."""

    default: Value
    meaning: str
    values: str
    """What the value may be: "use a whole number, at least 20 points"."""


SETTINGS: Mapping[str, Setting] = MappingProxyType(
    {row[0]: Setting(*row[1:]) for row in _core.settings_table()})
"""All settings by name, as the command line tool and the C++ library have them."""


def _whole(name: str, value: Any, unit: str) -> int:
    """A whole number of something, at least one."""
    try:
        number = 0 if isinstance(value, bool) else operator.index(value)
    except TypeError:
        number = 0
    if not 1 <= number < 2**31:
        raise ValueError(f"{name} {value!r}: use a whole number, at least 1 {unit}.")
    return number


def _settings(rigid: bool, scale_range: Optional[Tuple[float, float]],
              confidence: Optional[float], others: Dict[str, Value]) -> Dict[str, Value]:
    """The settings by the names of the table."""
    named: Dict[str, Value] = {}
    if rigid:
        named["estimate_scale"] = False
    if scale_range is not None:
        try:
            named["smallest_scale"], named["largest_scale"] = scale_range
        except (TypeError, ValueError):
            raise ValueError(f"scale_range {scale_range!r}: use the smallest and the largest "
                             "scale.") from None
    if confidence is not None:
        named["minimum_confidence"] = confidence
    for name in named.keys() & others.keys():
        raise ValueError(f"{name} is set twice: say it by one name.")
    return {**named, **others}


class Registration:
    """Registers clouds, and keeps what it has made of them: many sources are placed on one
    target faster by one Registration than by many.

    The settings are those of register(). One thread at a time may use it; another one may
    call cancel().
    """

    def __init__(self, *, rigid: bool = False, mode: str = "auto",
                 scale_range: Optional[Tuple[float, float]] = None,
                 confidence: Optional[float] = None, device: str = "auto",
                 threads: int = 0, time_limit: float = 0.0, max_iterations: int = 300,
                 **settings: Value) -> None:
        iterations = _whole("max_iterations", max_iterations, "iterations")
        others = {"mode": mode, "device": device, "threads": threads,
                  "time_limit": time_limit, **settings}
        named = _settings(rigid, scale_range, confidence, others)
        self._core = _core.Registration(named, iterations)

    def align(self, source: Any, target: Any, *, guess: Any = None,
              source_normals: Any = None, target_normals: Any = None, samples: int = 10000,
              progress: Optional[Progress] = None) -> Result:
        """Find the similarity that maps the source onto the target: see register()."""
        return self._align(source, target, guess, source_normals, target_normals, samples,
                           progress)

    def _align(self, source: Any, target: Any, guess: Any, source_normals: Any,
               target_normals: Any, samples: int, progress: Optional[Progress]) -> Result:
        """What align() and register() call, so that warnings name the line that has called
        them."""
        samples = _whole("samples", samples, "points")
        if progress is not None and not callable(progress):
            raise TypeError("progress is to be called with a stage and the share of it that "
                            f"is done, which {progress!r} cannot be.")
        with self._core:
            clouds = (*cloud_of(source, source_normals, "source", samples),
                      *cloud_of(target, target_normals, "target", samples))
            if guess is not None:
                guess = numbers_of(guess, "guess")
                if guess.shape != (4, 4):
                    raise ValueError("guess: 4 x 4 numbers are needed, not an array of shape "
                                     f"{guess.shape}.")
            try:
                return result_of(self._core.align(*clouds, guess, progress))
            finally:  # whatever it has come to: the next one is not to tell of it
                for warning in _core.take_warnings():
                    warnings.warn(warning, RuntimeWarning, stacklevel=3)

    def cancel(self) -> None:
        """End the align() that is running, from another thread: it returns the best pose so
        far, with the cause "stopped". The next one is not affected."""
        self._core.cancel()


def register(source: Any, target: Any, *, rigid: bool = False, guess: Any = None,
             mode: str = "auto", scale_range: Optional[Tuple[float, float]] = None,
             confidence: Optional[float] = None, device: str = "auto", threads: int = 0,
             time_limit: float = 0.0, max_iterations: int = 300,
             source_normals: Any = None, target_normals: Any = None, samples: int = 10000,
             progress: Optional[Progress] = None, **settings: Value) -> Result:
    """Find the similarity that maps the source onto the target, wherever they lie.

    source, target: N x 3 numbers in any unit, of any type, as an array or as lists, held in
        double precision; N x 6 with normals in the last columns. Or a point cloud or mesh of
        Open3D (legacy or tensors) or of trimesh: meshes are sampled. Points that are not
        finite are left out.
    rigid: the clouds have the same scale: then both may be incomplete.
    guess: 4 x 4, a similarity that may be right. It competes with the poses that are found,
        and keeps its scale.
    mode: what the clouds show: "auto", "global" (both all of the object), "partial" (one is
        a part of the other), "overlap" (both lack parts), "scene" (one is an object in the
        other).
    scale_range: smallest and largest scale where it is estimated; any by default.
    confidence: from which on the clouds count as registered, in [0, 1]; 0.5 by default.
    device: where the search runs: "auto" (the first OpenCL device, GPUs first, else the
        host), "host", or a part of a platform's or a device's name (device_names()).
    threads: on the host and on an OpenCL CPU device; 0: as many as there are cores.
    time_limit: seconds after which the best pose so far has to do; 0: never.
    max_iterations: of the final ICP.
    source_normals, target_normals: N x 3, of any length; zeros and NaN are unknown. Without
        any, normals are found from the points.
    samples: points that stand for a mesh.
    progress: called with the name of a stage and the share of it that is done, in [0, 1], on
        this thread; what it raises ends the work and is raised here.
    settings: all others of SETTINGS, listed below.

    Returns a Result, also where the clouds do not fit: it is false then, and its reason says
    why. Raises ValueError where an argument is wrong. KeyboardInterrupt ends the work within
    two tenths of a second.

    Other Python threads run meanwhile, and may register clouds, too.
    """
    registration = Registration(rigid=rigid, mode=mode, scale_range=scale_range,
                                confidence=confidence, device=device, threads=threads,
                                time_limit=time_limit, max_iterations=max_iterations,
                                **settings)
    return registration._align(source, target, guess, source_normals, target_normals,
                               samples, progress)


def _documented(text: str) -> str:
    """With the settings of the table."""
    rows = [f"{name} ({setting.default!r} by default; {setting.values}): {setting.meaning}"
            for name, setting in SETTINGS.items()]
    return text.rstrip() + "\n\n    Settings:\n\n        " + "\n        ".join(rows) + "\n"


if register.__doc__:
    register.__doc__ = _documented(register.__doc__)

# SPDX-License-Identifier: BSD-3-Clause
"""What a registration has come to."""
from __future__ import annotations

from dataclasses import dataclass
from types import MappingProxyType
from typing import Any, Mapping, Optional, Tuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._clouds import numbers_of

Matrix = NDArray[np.float64]


def _frozen(value: Any) -> Any:
    """An array or a dictionary that nobody can change; anything else as it is."""
    if isinstance(value, Mapping):
        return MappingProxyType({key: _frozen(each) for key, each in value.items()})
    if isinstance(value, np.ndarray):
        value = np.array(value, dtype=np.float64, order="C")
        value.setflags(write=False)
    return value


def _pickled(value: Any) -> Any:
    """What pickle takes."""
    if isinstance(value, Mapping):
        return {key: _pickled(each) for key, each in value.items()}
    return value


def _rebuilt(kind: Any, values: Mapping[str, Any]) -> Any:
    return kind(**values)


class _Frozen:
    """Cannot be changed, nor what is made of it by pickle."""

    def __post_init__(self) -> None:
        for name, value in vars(self).items():
            object.__setattr__(self, name, _frozen(value))

    def __reduce__(self) -> Any:
        return _rebuilt, (type(self), _pickled(vars(self)))


@dataclass(frozen=True, eq=False, repr=False)
class Alternative(_Frozen):
    """A pose that competed to be the result."""

    transformation: Matrix
    """4 x 4, the similarity that maps the source onto the target."""
    overlap: Tuple[float, float]
    """The shares of the source and of the target that lie on the other, in [0, 1]."""
    score: float
    """How closely they do, in [0, 2]: two samplings of one surface come to 1.5."""
    evidence: Mapping[str, Any]
    """What the surfaces of the clouds say of the pose, by the names of the tool's report."""

    def __repr__(self) -> str:
        return (f"Alternative(scale={_scale_of(self.transformation):.6g}, "
                f"overlap=({self.overlap[0]:.2f}, {self.overlap[1]:.2f}), "
                f"score={self.score:.3f})")


@dataclass(frozen=True, eq=False, repr=False)
class Result(_Frozen):
    """What register() has come to; true where the clouds were registered."""

    transformation: Matrix
    """4 x 4, the similarity that maps the source onto the target, x -> s R x + t, in the
    units of the clouds; after a failure without a pose the guess, or the identity."""
    scale: float
    """s of the transformation."""
    converged: bool
    """Whether the clouds show one object and lie on each other: bool(result)."""
    reason: str
    """One sentence on why not; empty where they do."""
    cause: Optional[str]
    """What kind of reason that is: "input" (the clouds, the guess or the settings determine
    no pose), "device" (the OpenCL device is not there or failed), "stopped" (cancelled, or
    the time limit has passed), "unsettled" (the final ICP still moved), "no_fit" (the clouds
    do not lie on each other), or "other"; None where they do."""
    confidence: float
    """The probability that the pose is right or an equivalent one, in [0, 1]."""
    ambiguous: bool
    """Whether another pose is about as good, as for a symmetric object: alternatives[1]."""
    alternatives: Tuple[Alternative, ...]
    """The distinct poses that competed: the result first, then the likeliest; empty where
    there is no pose."""
    covariance: Optional[Matrix]
    """6 x 6: of the rotation about the axes (radians) and of the place of the source's
    centroid (units of the target); 7 x 7 where the scale has been estimated: of its
    logarithm, too. None where it is not known. With a rotation_axis the rows and columns of
    the rotations about the other two axes are zero."""
    undetermined: int
    """Directions of the pose that the surfaces leave undetermined, as three for a ball."""
    mode: Optional[str]
    """What the clouds show: "global" (both all of the object), "partial" (one is a part of
    the other), "overlap" (both lack parts), or "scene"; None where there is no pose."""
    iterations: int
    """Iterations of the result's final ICP."""
    far_points: Tuple[int, int]
    """Points of source and target that are too far from the others to be held."""
    seconds: Mapping[str, float]
    """Wall time by stage, in the order in which they ran."""
    device: str
    """Where the search ran."""

    @property
    def overlap(self) -> Tuple[float, float]:
        """The shares of the source and of the target that lie on the other, in [0, 1]."""
        return self.alternatives[0].overlap if self.alternatives else (0.0, 0.0)

    def __bool__(self) -> bool:
        return self.converged

    def apply(self, points: ArrayLike) -> Matrix:
        """Points where the transformation places them.

        points: N x 3 numbers, or N x 6 with normals, which take the rotation alone; or the
        three of one point. Returns an array of doubles of the same shape.
        """
        rows = numbers_of(points, "points")
        if rows.ndim not in (1, 2) or rows.shape[-1] not in (3, 6):
            raise ValueError("points: N x 3 numbers are needed, or N x 6 with normals, "
                             f"not an array of shape {rows.shape}.")
        linear = self.transformation[:3, :3]
        placed: Matrix = rows[..., :3] @ linear.T + self.transformation[:3, 3]
        if rows.shape[-1] == 3:
            return placed
        return np.concatenate([placed, rows[..., 3:] @ (linear.T / self.scale)], axis=-1)

    def __matmul__(self, points: ArrayLike) -> Matrix:
        return self.apply(points)

    def __repr__(self) -> str:
        if not self.converged:
            return f"Result(converged=False, cause={self.cause!r}, reason={self.reason!r})"
        total = sum(self.seconds.values())
        return (f"Result(converged=True, scale={self.scale:.6g}, "
                f"confidence={self.confidence:.2f}"
                + (", ambiguous=True" if self.ambiguous else "") +
                f", mode={self.mode!r}, overlap=({self.overlap[0]:.2f}, "
                f"{self.overlap[1]:.2f}), seconds={total:.3g}, device={self.device!r})")


def _scale_of(transformation: Matrix) -> float:
    return float(np.cbrt(np.linalg.det(transformation[:3, :3])))


def result_of(values: Mapping[str, Any]) -> Result:
    """The core's dictionary as a Result."""
    alternatives = tuple(Alternative(**pose) for pose in values["alternatives"])
    return Result(**{**values, "alternatives": alternatives})

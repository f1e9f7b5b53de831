# SPDX-License-Identifier: BSD-3-Clause
"""The command line: python -m pcl_kss_icp"""
from __future__ import annotations

import argparse
import json
import os
import sys
import warnings
from typing import Any, Dict, List, Mapping, Optional

import numpy as np

from . import SETTINGS, Result, __version__, device_names, register
from ._files import FileError, check_format, read, written

SUCCESS, NOT_REGISTERED, FAILED, INTERRUPTED = 0, 1, 2, 130

EXIT_STATUS = """\
Exit status:
  0    registered
  1    not registered: the clouds do not fit, or determine no pose, or the time
       limit has passed; only the report is written
  2    the command line or a file is wrong, a device failed, or memory ran out
  130  interrupted; no file is written
"""


def _complain(message: object) -> None:
    """On one line, whatever it quotes."""
    text = "".join(c if c.isprintable() else " " for c in str(message))
    print(f"pcl_kss_icp: {text}", file=sys.stderr)


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="python -m pcl_kss_icp", allow_abbrev=False,
        formatter_class=argparse.RawDescriptionHelpFormatter,
        description="Finds the rotation, translation and scale that place the cloud SOURCE "
                    "upon TARGET,\nwherever they lie. Files are .npy, .txt, .xyz, .csv and "
                    ".asc; with their libraries\ninstalled (pip install "
                    "'pcl_kss_icp[files]') .las, .laz, .e57, .ply, .obj, .stl,\n.off and .glb.",
        epilog=EXIT_STATUS)
    add = parser.add_argument
    add("source", metavar="SOURCE", nargs="?")
    add("target", metavar="TARGET", nargs="?")
    add("--out", metavar="FILE", help="write SOURCE where it has been placed, with all its "
        "attributes, in a format of the same library")
    add("--transform", metavar="FILE", help="write the transformation: 4x4 numbers")
    add("--report", metavar="FILE", help="write all results as JSON, also if not registered")
    add("--guess", metavar="FILE", help="a transformation that may be right, as written")
    add("--rigid", action="store_true", help="the clouds have the same scale")
    add("--upright", metavar="AXIS", nargs="?", const="z", dest="rotation_axis",
        help=SETTINGS["rotation_axis"].meaning + "; z if none is named")
    add("--mode", metavar="WORD", help=SETTINGS["mode"].meaning)
    add("--scale-range", metavar=("A", "B"), nargs=2, type=float,
        help="smallest and largest scale where it is estimated")
    add("--confidence", metavar="C", type=float, help=SETTINGS["minimum_confidence"].meaning)
    add("--time-limit", metavar="SECONDS", type=float, help=SETTINGS["time_limit"].meaning)
    add("--device", metavar="NAME", help=SETTINGS["device"].meaning)
    add("--threads", metavar="N", type=int, help=SETTINGS["threads"].meaning)
    add("--max-iterations", metavar="N", type=int, default=300,
        help="iterations of the final ICP at most (default 300)")
    add("--iterations", dest="max_iterations", type=int, default=argparse.SUPPRESS,
        help=argparse.SUPPRESS)  # as it was called in the beginning
    add("--samples", metavar="N", type=int, default=10000,
        help="points that stand for a mesh (default 10000)")
    add("--set", metavar="NAME=VALUE", action="append", default=[],
        help="any setting of pcl_kss_icp.SETTINGS; may be repeated")
    add("--list-devices", action="store_true", help="list the OpenCL devices")
    add("--quiet", action="store_true", help="no output but files and errors")
    add("--version", action="version", version=f"pcl_kss_icp {__version__}")
    return parser


def _with_axes(arguments: List[str]) -> List[str]:
    """Arguments in which --upright has its axis: what follows it may be a file."""
    words = list(arguments)
    for i, word in enumerate(words):
        if word == "--upright":
            has_axis = words[i + 1:i + 2] and words[i + 1] in ("any", "x", "y", "z")
            words[i:i + (2 if has_axis else 1)] = [
                "--upright=" + (words[i + 1] if has_axis else "z")]
    return words


def _typed(text: str, default: object) -> Any:
    """A value as a setting with that default has it; else the text, which it refuses."""
    if isinstance(default, bool):
        return {"true": True, "false": False}.get(text.lower(), text)
    if isinstance(default, str):
        return text
    try:
        return type(default)(text)  # type: ignore[call-arg]
    except ValueError:
        return text


def _settings_of(options: argparse.Namespace) -> Dict[str, Any]:
    settings: Dict[str, Any] = {
        name: getattr(options, name)
        for name in ("rotation_axis", "mode", "scale_range", "confidence", "time_limit",
                     "device", "threads")
        if getattr(options, name) is not None}
    if options.rigid:
        settings["rigid"] = True
    for assignment in options.set:
        name, equals, text = assignment.partition("=")
        if not equals or name not in SETTINGS:
            raise ValueError(f"--set {assignment}: there are {', '.join(SETTINGS)}, each with "
                             "=VALUE")
        settings[name] = _typed(text, SETTINGS[name].default)
    return settings


def _transformation_of(path: str) -> Any:
    try:
        matrix = np.loadtxt(path)
    except (OSError, ValueError) as error:
        raise FileError(f"{path}: {error}") from None
    if matrix.shape != (4, 4):
        raise FileError(f"{path}: holds no transformation, which is 4x4 numbers, row by row")
    return matrix


def _report_of(result: Result, source: str, target: str) -> Dict[str, Any]:
    """By the names of the C++ tool's report."""
    has_pose = bool(result.alternatives)
    covariance = result.covariance if has_pose else None
    deviation = None if covariance is None else 0.0
    if covariance is not None and len(covariance) > 6:
        deviation = result.scale * float(np.sqrt(covariance[6, 6]))
    report: Dict[str, Any] = {
        "version": __version__,
        "inputs": {"source": {"file": source}, "target": {"file": target}},
        "converged": result.converged}
    if not result.converged:
        report.update(reason=result.reason, cause=result.cause)
    report.update(
        transformation=result.transformation.tolist() if has_pose else None,
        scale=result.scale if has_pose else None,
        scale_deviation=deviation,
        covariance=None if covariance is None else covariance.tolist(),
        undetermined=None if covariance is None else result.undetermined,
        mode=result.mode,
        overlap=result.overlap if has_pose else None,
        score=result.alternatives[0].score if has_pose else None,
        confidence=result.confidence, ambiguous=result.ambiguous,
        alternatives=[{"transformation": pose.transformation.tolist(),
                       "overlap": pose.overlap, "score": pose.score,
                       "evidence": pose.evidence} for pose in result.alternatives],
        far_points=result.far_points, device=result.device,
        seconds={**result.seconds, "total": sum(result.seconds.values())})
    return report


def _without_infinities(value: Any) -> Any:
    """JSON has no infinity and no NaN: null stands for them."""
    if isinstance(value, Mapping):
        return {key: _without_infinities(each) for key, each in value.items()}
    if isinstance(value, (list, tuple)):
        return [_without_infinities(each) for each in value]
    return None if isinstance(value, float) and not np.isfinite(value) else value


def _write_text(path: str, text: str) -> None:
    with written(path) as part, open(part, "w", encoding="utf-8") as file:
        file.write(text)


def _summary_of(result: Result) -> str:
    shares = [f"{round(100 * share)} %" for share in result.overlap]
    rows = "\n".join("".join(f"{number!r:>25}" for number in row)
                     for row in result.transformation.tolist())
    return (f"Transformation of SOURCE onto TARGET:\n{rows}\n"
            f"Scale:    {result.scale:.6g}\n"
            f"Overlap:  {shares[0]} of SOURCE, {shares[1]} of TARGET\n"
            f"Sure:     {round(100 * result.confidence)} %"
            + (", but another pose is about as good (see --report)" if result.ambiguous else "")
            + f"\nTime:     {sum(result.seconds.values()):.3g} s on {result.device}")


def _register_files(options: argparse.Namespace) -> int:
    settings = _settings_of(options)
    if options.out:
        check_format(options.source, options.out)
    for path in filter(None, (options.out, options.transform, options.report)):
        folder = os.path.dirname(path) or "."
        if not os.path.isdir(folder):
            raise FileError(f"{path}: there is no folder {folder}")
    source, target = read(options.source), read(options.target)
    guess = _transformation_of(options.guess) if options.guess else None
    result = register(source.cloud(), target.cloud(), guess=guess, samples=options.samples,
                      max_iterations=options.max_iterations, **settings)
    if options.report:
        report = _report_of(result, options.source, options.target)
        _write_text(options.report, json.dumps(_without_infinities(report), indent=2) + "\n")
    if not result:
        _complain(f"not registered: {result.reason}")
        return FAILED if result.cause in ("device", "other") else NOT_REGISTERED
    if options.out:
        with written(options.out) as part:
            source.write(part, result)
    if options.transform:
        _write_text(options.transform, "".join(
            " ".join(map(repr, row)) + "\n" for row in result.transformation.tolist()))
    if not options.quiet:
        print(_summary_of(result))
        for path, number in zip((options.source, options.target), result.far_points):
            if number:
                _complain(f"warning: {path}: {number} points lie far away from all others; "
                          "the search went without")
    return SUCCESS


def main(arguments: Optional[List[str]] = None) -> int:
    parser = _parser()
    options = parser.parse_intermixed_args(
        _with_axes(sys.argv[1:] if arguments is None else arguments))
    if options.target is None and not options.list_devices:
        parser.error("needs SOURCE and TARGET")
    warnings.showwarning = lambda message, *_: _complain(f"warning: {message}")
    if options.quiet:
        warnings.simplefilter("ignore")
    try:
        if options.list_devices:
            print("\n".join(device_names()))
            return SUCCESS
        return _register_files(options)
    except MemoryError:
        _complain("needs more memory than there is")
    except (FileError, ValueError, TypeError) as error:
        _complain(error)
    except KeyboardInterrupt:
        return INTERRUPTED
    except Exception as error:  # whatever it is, it does not say that the clouds do not fit
        _complain(f"{type(error).__name__}: {error}")
    return FAILED


if __name__ == "__main__":
    sys.exit(main())

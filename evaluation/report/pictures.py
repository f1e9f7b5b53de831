# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of the worst cases: the clouds before, after, and as they should be (needs
Debian's python3-matplotlib)."""
import json
import os
import sys
from dataclasses import dataclass

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from PIL import Image

ORANGE, BLUE = np.array([0.93, 0.50, 0.13]), np.array([0.20, 0.45, 0.78])
MAXIMUM = 2500
DPI = 100


@dataclass(frozen=True)
class Picture:
    """A picture of the report."""
    name: str
    title: str


def draw_all(worst: str, folder: str) -> list:
    """Draws each folder in a folder of cases; returns the pictures."""
    names = sorted(os.listdir(worst)) if os.path.isdir(worst) else []
    pictures = []
    for name in names:
        try:
            meta, source, target = _read_case(os.path.join(worst, name))
        except (OSError, ValueError, TypeError, KeyError) as error:
            print(f"report.py: no picture of {os.path.join(worst, name)}: {error}",
                  file=sys.stderr)
            continue
        _draw(meta, source, target, os.path.join(folder, name + ".png"))
        pictures.append(Picture(name, _title(meta)))
    return pictures


def _read_case(folder: str):
    with open(os.path.join(folder, "meta.json"), encoding="utf-8") as file:
        meta = json.load(file)
    for field in ("pose", "truth"):
        if field in meta:
            meta[field] = _pose(meta[field])
    clouds = [read_ply(os.path.join(folder, name)) for name in ("source.ply", "target.ply")]
    return meta, *[_fewer(cloud) for cloud in clouds]


def _pose(numbers: list) -> np.ndarray:
    pose = np.array(numbers, dtype=float).reshape(4, 4)
    if not np.isfinite(pose).all():
        raise ValueError("the pose is not finite")
    return pose


def read_ply(path: str) -> np.ndarray:
    """The finite points of an ASCII PLY file, n x 3."""
    with open(path, encoding="ascii", errors="replace") as file:
        lines = file.read().splitlines()
    if "end_header" not in lines or "format ascii 1.0" not in lines:
        raise ValueError(f"{os.path.basename(path)} is not an ASCII PLY file")
    end = lines.index("end_header")
    count, names, element = 0, [], ""
    for words in (line.split() for line in lines[:end]):
        if words[:1] == ["element"]:
            element = words[1]
            count = int(words[2]) if element == "vertex" else count
        elif words[:1] == ["property"] and element == "vertex":
            names.append(words[-1])
    columns = [names.index(axis) for axis in "xyz"]
    rows = [line.split() for line in lines[end + 1:end + 1 + count]]
    points = np.array([[float(row[column]) for column in columns] for row in rows])
    points = points[np.isfinite(points).all(axis=1)] if len(points) else points
    if not len(points):
        raise ValueError(f"{os.path.basename(path)} has no points")
    return points


def _fewer(points: np.ndarray) -> np.ndarray:
    if len(points) <= MAXIMUM:
        return points
    chosen = np.random.RandomState(0).permutation(len(points))[:MAXIMUM]
    return points[np.sort(chosen)]


def _moved(points: np.ndarray, pose: np.ndarray) -> np.ndarray:
    return points @ pose[:3, :3].T + pose[:3, 3]


def _title(meta: dict) -> str:
    verdict = "solved" if meta.get("solved") else "not solved"
    angle = meta.get("rotation_deg")
    off = f", {angle:.3g}° off" if isinstance(angle, (int, float)) else ""
    if "pose" not in meta:
        off = ", no answer"
    return (f"{meta.get('method', '')}: {meta.get('model', '')}, "
            f"{meta.get('condition', '')}, {verdict}{off}")


def _view(points: np.ndarray) -> np.ndarray:
    """Rows: to the right, up, and towards the viewer. The target's long axes lie across,
    a little turned, so that depth shows."""
    _, _, axes = np.linalg.svd(points - points.mean(axis=0), full_matrices=False)
    signs = np.sign(axes[np.arange(3), np.abs(axes).argmax(axis=1)])
    axes = axes * signs[:, None]
    axes[2] = np.cross(axes[0], axes[1])
    turn, tilt = np.radians(25), np.radians(20)
    about_up = np.array([[np.cos(turn), 0, np.sin(turn)], [0, 1, 0],
                         [-np.sin(turn), 0, np.cos(turn)]])
    about_right = np.array([[1, 0, 0], [0, np.cos(tilt), -np.sin(tilt)],
                            [0, np.sin(tilt), np.cos(tilt)]])
    return about_right @ about_up @ axes


def _draw(meta: dict, source: np.ndarray, target: np.ndarray, path: str):
    view = _view(target)
    panels = {"before": source}
    for title, field in (("after", "pose"), ("true pose", "truth")):
        if field in meta:  # a method without an answer has no pose
            panels[title] = _moved(source, meta[field])
    figure, axes = plt.subplots(1, len(panels), figsize=(4.2 * len(panels), 4.4), dpi=DPI,
                                squeeze=False)
    for panel, (title, moved) in zip(axes[0], panels.items()):
        _panel(panel, moved @ view.T, target @ view.T)
        panel.set_title(title, fontsize=11, color="#444444")
    figure.suptitle(_title(meta), fontsize=12, x=0.01, ha="left", fontweight="bold")
    left_of_target = 0.99 - 0.75 / figure.get_figwidth()
    for x, text, colour in ((left_of_target, "source", ORANGE), (0.99, "target", BLUE)):
        figure.text(x, 0.975, text, color=colour, ha="right", va="top", fontsize=11,
                    fontweight="bold")
    figure.tight_layout(rect=(0, 0, 1, 0.97))
    figure.savefig(path, facecolor="white")
    plt.close(figure)
    with Image.open(path) as picture:  # thousands of pale points: few colours do, and
        few_colours = picture.convert("RGB").quantize(64)  # a quarter of the bytes
    few_colours.save(path, optimize=True)


def _panel(panel, source: np.ndarray, target: np.ndarray):
    """Both clouds, the farthest points first and palest."""
    points = np.concatenate([source, target])
    colours = np.concatenate([np.tile(ORANGE, (len(source), 1)),
                              np.tile(BLUE, (len(target), 1))])
    depth = points[:, 2]
    nearness = (depth - depth.min()) / max(np.ptp(depth), 1e-12)
    strength = (0.45 + 0.55 * nearness)[:, None]
    order = np.argsort(depth, kind="stable")
    shades = np.clip(1 - strength * (1 - colours), 0, 1)
    panel.scatter(points[order, 0], points[order, 1], s=3.0, linewidths=0, c=shades[order])
    low, high = points[:, :2].min(axis=0), points[:, :2].max(axis=0)
    centre, half = (low + high) / 2, 0.54 * max((high - low).max(), 1e-12)
    panel.set_xlim(centre[0] - half, centre[0] + half)
    panel.set_ylim(centre[1] - half, centre[1] + half)
    panel.set_aspect("equal")
    panel.set_xticks([])
    panel.set_yticks([])
    for spine in panel.spines.values():
        spine.set_color("#DDDDDD")

#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Draws how a registration goes, on two outlines in a plane: all that it shows is
computed here, in two dimensions (needs Debian's python3-numpy).

usage: draw_how_it_works.py PICTURE.svg"""
import sys

import numpy as np

ORANGE, BLUE, GREY, INK = "#c8741a", "#3a6ea8", "#b0b0b0", "#333333"
WIDTH, HEIGHT, PANEL = 1200, 330, 240


def outline(angles):
    """A lump without symmetry."""
    radius = 0.62 + sum(height * np.exp(narrowness * (np.cos(angles - at) - 1))
                        for at, height, narrowness in ((0.5, 1.0, 9), (2.3, 0.85, 16),
                                                       (3.7, 0.45, 9), (5.2, 0.7, 30)))
    return np.stack([radius * np.cos(angles), radius * np.sin(angles)], axis=1)


def rotation(degrees):
    a = np.radians(degrees)
    return np.array([[np.cos(a), -np.sin(a)], [np.sin(a), np.cos(a)]])


def distances(a, b):
    """From each point of a to the nearest one of b."""
    return np.linalg.norm(a[:, None] - b[None], axis=2).min(axis=1)


def energy(source, target, limit=0.35):
    """The mean of the distances both ways, none counted beyond a limit."""
    return 0.5 * (np.minimum(distances(source, target), limit).mean()
                  + np.minimum(distances(target, source), limit).mean())


def pre_shape(points):
    centred = points - points.mean(axis=0)
    return centred / np.sqrt((centred ** 2).sum(axis=1).mean())


def refined(source, target, steps=40):
    """ICP in the plane."""
    for _ in range(steps):
        gaps = np.linalg.norm(source[:, None] - target[None], axis=2)
        near = gaps.min(axis=1) < 0.3
        a, b = source[near], target[gaps.argmin(axis=1)[near]]
        u, _, v = np.linalg.svd((a - a.mean(axis=0)).T @ (b - b.mean(axis=0)))
        turn = v.T @ np.diag([1, np.linalg.det(v.T @ u.T)]) @ u.T
        source = (source - a.mean(axis=0)) @ turn.T + b.mean(axis=0)
    return source


class Drawing:
    def __init__(self):
        self.parts = []

    def dots(self, points, middle, scale, colour, radius=1.5):
        for x, y in points:
            self.parts.append(f'<circle cx="{middle[0] + scale * x:.1f}" '
                              f'cy="{middle[1] - scale * y:.1f}" r="{radius}" fill="{colour}"/>')

    def line(self, points, colour, width=1.0, dashes=""):
        path = " ".join(f"{x:.1f},{y:.1f}" for x, y in points)
        dashes = f' stroke-dasharray="{dashes}"' if dashes else ""
        self.parts.append(f'<polyline points="{path}" fill="none" stroke="{colour}" '
                          f'stroke-width="{width}"{dashes}/>')

    def ring(self, middle, radius, colour):
        self.parts.append(f'<circle cx="{middle[0]:.1f}" cy="{middle[1]:.1f}" r="{radius}" '
                          f'fill="none" stroke="{colour}" stroke-width="1"/>')

    def text(self, x, y, words, size=13, weight="normal", anchor="middle", colour=INK):
        self.parts.append(f'<text x="{x:.1f}" y="{y:.1f}" font-size="{size}" '
                          f'font-weight="{weight}" text-anchor="{anchor}" '
                          f'fill="{colour}">{words}</text>')

    def write(self, path):
        with open(path, "w") as file:
            file.write(f'<svg xmlns="http://www.w3.org/2000/svg" width="{WIDTH}" '
                       f'height="{HEIGHT}" viewBox="0 0 {WIDTH} {HEIGHT}" '
                       'font-family="Helvetica, Arial, sans-serif">\n'
                       f'<rect width="{WIDTH}" height="{HEIGHT}" fill="white"/>\n'
                       + "\n".join(self.parts) + "\n</svg>\n")


def main(picture):
    drawing = Drawing()
    middles = [PANEL * (i + 0.5) for i in range(5)]
    titles = [("1  Two clouds", "anywhere, any scale, parts missing"),
              ("2  Even points, one size", "centred, divided by their size"),
              ("3  Search all rotations", "and centres and scales"),
              ("4  Refine the minima", "by ICP, from each of them"),
              ("5  Lay surfaces, judge", "how sure is the pose?")]
    for middle, (title, words) in zip(middles, titles):
        drawing.text(middle, 28, title, 15, "bold")
        drawing.text(middle, 48, words)
    for middle in middles[1:]:
        x, y = middle - PANEL / 2, 170
        drawing.line([(x - 6, y), (x + 6, y)], INK)
        drawing.line([(x + 1, y - 4), (x + 6, y), (x + 1, y + 4)], INK)

    # the target lacks a part, the source another one
    target = outline(np.linspace(0.35, 2 * np.pi - 0.3, 110))
    source = outline(np.linspace(-1.9, 2 * np.pi - 2.9, 440)) @ rotation(137).T
    drawing.dots(1.35 * source, (middles[0] - 22, 142), 40, ORANGE, 1.1)
    drawing.dots(target, (middles[0] + 50, 245), 34, BLUE)

    target, source = pre_shape(target), pre_shape(source[::4])
    for points, colour, x in ((source, ORANGE, -52), (target, BLUE, 52)):
        drawing.ring((middles[1] + x, 170), 40, GREY)
        drawing.dots(points, (middles[1] + x, 170), 40, colour)

    # the energy of each rotation, and its local minima
    angles = np.arange(0, 360, 3)
    energies = np.array([energy(source @ rotation(a).T, target) for a in angles])
    low, high = energies.min(), energies.max()
    place = lambda a, e: (middles[2] - 95 + 190 * a / 360, 235 - 130 * (e - low) / (high - low))
    drawing.line([(middles[2] - 95, 95), (middles[2] - 95, 250), (middles[2] + 95, 250)], GREY)
    drawing.line([place(a, e) for a, e in zip(angles, energies)], INK, 1.2)
    minima = [i for i in range(len(angles))
              if energies[i] == min(energies[(i + k) % len(angles)] for k in range(-8, 9))]
    minima = sorted(minima, key=lambda i: energies[i])[:3]
    for i in minima:
        drawing.ring(place(angles[i], energies[i]), 4, ORANGE)
    drawing.text(middles[2], 268, "rotation")
    drawing.text(middles[2] - 88, 92, "energy", anchor="start")
    drawing.text(middles[2], 300, "ICP alone takes the nearest valley", 12)

    spots = [(middles[3], 115), (middles[3] - 55, 235), (middles[3] + 55, 235)]
    poses = [refined(source @ rotation(angles[i]).T, target) for i in minima]
    poses.sort(key=lambda pose: energy(pose, target))
    for spot, pose in zip(spots, poses):
        drawing.dots(target, spot, 34, BLUE, 1.2)
        drawing.dots(pose, spot, 34, ORANGE, 1.2)
    drawing.text(middles[3], 300, "the pose with most overlap goes on", 12)

    best = (middles[4], 160)
    drawing.line([(best[0] + 62 * x, best[1] - 62 * y) for x, y in target], BLUE, 1.2)
    drawing.dots(poses[0], best, 62, ORANGE, 1.6)
    shared = (distances(poses[0], target) < 0.1).mean()
    drawing.text(middles[4], 275, f"{100 * shared:.0f} % of the source lie on the target", 12)
    drawing.text(middles[4], 300, "accepted from confidence 0.5 on", 12)
    drawing.write(picture)


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main(sys.argv[1])

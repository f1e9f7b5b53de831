# SPDX-License-Identifier: BSD-3-Clause
"""Families of objects, each member told by its random numbers."""
import numpy as np

import geometry
import solids


def mounting_plate(rng):
    """A plate with bosses, pads and a wall: what is milled."""
    length, width = 1., rng.uniform(.45, .9)
    parts = [solids.box((length, width, rng.uniform(.04, .1)))]
    for _ in range(rng.integers(4, 9)):
        x, y = rng.uniform(-.4, .4) * length, rng.uniform(-.4, .4) * width
        high = rng.uniform(.06, .3)
        if rng.random() < .5:
            parts.append(solids.cylinder(rng.uniform(.03, .1), 0, high, x, y))
        else:
            parts.append(solids.standing((*rng.uniform(.05, .25, 2), high), x, y,
                                         rng.choice([0, np.pi / 4, rng.uniform(0, 3)])))
    return geometry.joined(*parts)


def bracket(rng):
    """Two legs at a right angle, ribs between, and a bush."""
    thick, wide, tall = rng.uniform(.06, .12), rng.uniform(.4, .8), rng.uniform(.5, 1.)
    parts = [solids.standing((1, wide, thick), 0, 0),
             solids.standing((thick, wide, tall), -.5 + thick / 2, 0)]
    for y in np.linspace(-.4, .4, rng.integers(1, 4)) + rng.uniform(-.08, .08):
        parts.append(solids.standing((.3, .04, .3 * tall), -.3, y * wide, 0, thick))
    outer, inner = (r * rng.uniform(.08, .14) for r in (1, .6))
    bush = solids.extruded(solids.circle(outer), 0, 2.5 * thick, solids.circle(inner))
    return geometry.joined(*parts, geometry.moved_mesh(geometry.similarity(
        shift=(rng.uniform(.1, .3), rng.uniform(-.2, .2) * wide, 0)), bush))


def shaft(rng):
    """Steps about an axis: any turn about it is as right."""
    radii, heights = rng.uniform(.08, .35, 5), np.cumsum(rng.uniform(.1, .4, 5))
    profile, low = [(0., 0.)], 0.
    for radius, high in zip(radii, heights):
        profile += [(radius, low), (radius, high)]
        low = high
    return solids.revolved(profile + [(0., low)])


def gear(rng):
    """As many equally right poses as teeth."""
    teeth = rng.integers(8, 25)
    angles = np.linspace(0, 2 * np.pi, 8 * teeth, endpoint=False)
    radius = 1 + rng.uniform(.06, .12) * np.clip(2 * np.cos(teeth * angles), -1, 1)
    rim = radius[:, None] * np.c_[np.cos(angles), np.sin(angles)]
    bore = rng.uniform(.2, .5) * np.c_[np.cos(angles), np.sin(angles)]
    return solids.extruded(rim, 0, rng.uniform(.15, .5), bore)


def plank(rng):
    """A box, the same after half a turn about each axis."""
    return solids.box((1., rng.uniform(.1, .4), rng.uniform(.03, .09)))


def marked_plank(rng):
    """A plank with something small on it that tells its poses apart."""
    size = np.array([1., rng.uniform(.15, .4), rng.uniform(.04, .09)])
    x, y = rng.uniform(.2, .45), rng.uniform(-.3, .3) * size[1]
    mark = solids.standing((*rng.uniform(.05, .12, 2), rng.uniform(.03, .08)), x, y, 0,
                           size[2] / 2)
    return geometry.joined(solids.box(size), mark)


def chair(rng):
    w, d = rng.uniform(.4, .5, 2)
    seat, leg = rng.uniform(.4, .48), rng.uniform(.03, .05)
    parts = [solids.standing((w, d, .04), 0, 0, 0, seat)]
    parts += [solids.standing((leg, leg, seat), x * (w - leg) / 2, y * (d - leg) / 2)
              for x in (-1, 1) for y in (-1, 1)]
    back = rng.uniform(.35, .55)
    if rng.random() < .5:
        parts.append(solids.standing((w, .03, back), 0, d / 2 - .015, 0, seat + .04))
    else:
        parts += [solids.standing((.04, .03, back), x, d / 2 - .015, 0, seat + .04)
                  for x in np.linspace(-w / 2 + .02, w / 2 - .02, 4)]
    if rng.random() < .4:
        parts += [solids.standing((.05, d, .03), x * w / 2, 0, 0, seat + .2)
                  for x in (-1, 1)]
    return geometry.joined(*parts)


def table(rng):
    w, d, h = rng.uniform(.8, 1.8), rng.uniform(.5, .9), rng.uniform(.45, .78)
    leg = rng.uniform(.04, .08)
    parts = [solids.standing((w, d, .04), 0, 0, 0, h)]
    parts += [solids.standing((leg, leg, h), x * (w / 2 - leg), y * (d / 2 - leg))
              for x in (-1, 1) for y in (-1, 1)]
    if rng.random() < .7:
        parts.append(solids.standing((.35, d * .8, h * rng.uniform(.4, .8)),
                                     w * rng.choice([-.3, .3]), 0, 0, h * .15))
    return geometry.joined(*parts)


def shelf(rng):
    w, d, h = rng.uniform(.6, 1.2), rng.uniform(.25, .4), rng.uniform(.8, 2.)
    parts = [solids.standing((w, d, .02), 0, 0, 0, z)
             for z in np.linspace(0, h, rng.integers(3, 7))]
    parts += [solids.standing((.02, d, h), x * w / 2, 0) for x in (-1, 1)]
    if rng.random() < .5:
        parts.append(solids.standing((w, .01, h), 0, d / 2))
    parts += [solids.standing((rng.uniform(.1, .3), .15, .15), rng.uniform(-.3, .3) * w, 0)
              for _ in range(3)]
    return geometry.joined(*parts)


def stone(rng):
    """A sphere, dented by waves and broken flat here and there."""
    vertices, faces = solids.ball(5)
    radius = np.ones(len(vertices))
    for _ in range(14):
        wave = rng.normal(size=3) * rng.uniform(1, 4)
        radius += .3 / np.linalg.norm(wave) * np.cos(vertices @ wave + rng.uniform(0, 6.3))
    stretched = vertices * np.maximum(radius, .3)[:, None] * rng.uniform(.6, 1.2, 3)
    for _ in range(rng.integers(1, 4)):
        normal = rng.normal(size=3)
        normal /= np.linalg.norm(normal)
        over = np.maximum(stretched @ normal - rng.uniform(.35, .7), 0)
        stretched = stretched - over[:, None] * normal
    return stretched, faces


def bumps(rng, rows, columns, along):
    """A ridge, bent to an arch where asked, with rows of bumps, each a little different."""
    u, v = np.meshgrid(np.linspace(0, 1, 40 * columns), np.linspace(-1, 1, 30 * rows),
                       indexing="ij")
    height = .5 * np.exp(-(v / .8) ** 4)
    for column in range(columns):
        for row in range(rows):
            at = (column + .5 + rng.uniform(-.06, .06)) / columns
            off = (2 * row + 1) / rows - 1 + rng.uniform(-.08, .08)
            wide, deep = .48 / columns * rng.uniform(.75, 1.), .8 / rows * rng.uniform(.7, 1.)
            shape = ((u - at) / wide) ** 4 + ((v - off) / deep) ** 4
            height += rng.uniform(.25, .6) * np.exp(-shape)
    x, y, out_x, out_y = along(u)
    points = np.stack([x + .12 * v * out_x, y + .12 * v * out_y, .25 * height], 2)
    return solids.sheet(points)


def jaw(rng):
    """An arch of bumps: every one looks much like every other."""
    open_by, deep = rng.uniform(.8, 1.), rng.uniform(.9, 1.3)

    def along(u):
        angle = np.pi * u
        return (open_by * np.cos(angle), deep * np.sin(angle), np.cos(angle),
                np.sin(angle))

    return bumps(rng, 1, int(rng.integers(10, 15)), along)


def keyboard(rng):
    """A straight field of bumps."""
    return bumps(rng, int(rng.integers(2, 5)), int(rng.integers(8, 14)),
                 lambda u: (2 * u, 0 * u, 0 * u, 3 + 0 * u))


def panel(rng, thickness=None):
    """A pressed panel with thickness: two skins that lie near each other."""
    u, v = np.meshgrid(np.linspace(-.5, .5, 60), np.linspace(-.5, .5, 60), indexing="ij")
    width = rng.uniform(.5, .9)
    z = rng.uniform(-.25, .25) * u ** 2 + rng.uniform(-.3, .3) * v ** 2
    z += rng.uniform(-.15, .15) * u * v
    for _ in range(rng.integers(2, 5)):
        x, y, r = rng.uniform(-.35, .35), rng.uniform(-.35, .35), rng.uniform(.06, .15)
        z += rng.choice([-1, 1]) * rng.uniform(.02, .05) / (
            1 + (((u - x) ** 2 + (v - y) ** 2) / r ** 2) ** 4)
    thickness = rng.uniform(.015, .05) if thickness is None else thickness
    skew = rng.uniform(-.2, .2) * u
    return solids.skins(np.stack([u, width * v + skew, z], 2), thickness)


def pipework(rng):
    """Pipes of one gauge that turn at right angles."""
    at, axis, parts = np.zeros(3), 0, []
    radius = rng.uniform(.04, .09)
    for _ in range(rng.integers(5, 9)):
        axis = (axis + rng.integers(1, 3)) % 3
        step = rng.choice([-1, 1]) * rng.uniform(.3, 1.)
        vertices, faces = solids.cylinder(radius, min(0, step) - radius,
                                          max(0, step) + radius)
        parts.append((np.roll(vertices, axis + 1, axis=1) + at, faces))
        at = at + step * np.eye(3)[axis]
    return geometry.joined(*parts)


def steps(rng):
    """Blocks, each smaller than the last by one ratio: much like itself at other scales."""
    ratio, size, x = rng.uniform(.75, .9), 1., 0.
    width, lift = rng.uniform(.5, 1.2), rng.uniform(.4, 1.)
    parts = []
    for _ in range(7):
        parts.append(solids.standing((size, width * size, lift * size), x + size / 2, 0))
        x, size = x + size, size * ratio
    return geometry.joined(*parts)


def assembly(rng):
    """Parts on a base plate, some of them twice."""
    parts = [solids.box((1.6, 1.1, .05), (0, 0, -.03))]
    for make in rng.choice([gear, bracket, shaft, stone, marked_plank, pipework], 3):
        part = geometry.unit(make(rng))
        for _ in range(rng.integers(1, 3)):
            place = geometry.similarity(
                geometry.turn_about_z(rng.uniform(0, 6.3)),
                (*rng.uniform(-.5, .5, 2) * [1.2, .7], .2), rng.uniform(.4, .6))
            parts.append(geometry.moved_mesh(place, part))
    return geometry.joined(*parts)


FAMILIES = {f.__name__: f for f in (
    mounting_plate, bracket, shaft, gear, plank, marked_plank, chair, table, shelf, stone,
    jaw, keyboard, panel, pipework, steps, assembly)}
SYMMETRIC = ("shaft", "gear", "plank")

# SPDX-License-Identifier: BSD-3-Clause
"""Rooms, corridors and streets, in metres, each told by its random numbers."""
import numpy as np

import geometry
import parts
import solids


def wall(start, end, height, rng, openings=2):
    """A wall with niches, as windows and doors are."""
    start, end = np.asarray(start, float), np.asarray(end, float)
    length = np.linalg.norm(end - start)
    along = (end - start) / length
    angle = np.arctan2(along[1], along[0])
    meshes = [solids.standing((length, .02, height), *(start + end) / 2, angle)]
    for _ in range(openings):
        wide, tall = rng.uniform(.7, 1.6), rng.uniform(.8, 2.1)
        at = start + along * rng.uniform(.2, .8) * length
        bottom = 0 if tall > 1.8 else rng.uniform(.6, .9)
        frame = .06
        for off, size, low in ((-wide / 2, (frame, .12, tall), bottom),
                               (wide / 2, (frame, .12, tall), bottom),
                               (0, (wide, .12, frame), bottom + tall)):
            meshes.append(solids.standing(size, *(at + along * off), angle, low))
    return geometry.joined(*meshes)


def furniture(rng, x, y):
    """Something that stands at (x, y)."""
    make = rng.choice([parts.chair, parts.table, parts.shelf, sofa, cupboard, lamp])
    return geometry.moved_mesh(geometry.similarity(
        geometry.turn_about_z(rng.choice([0, .5, 1, 1.5]) * np.pi + rng.normal() * .1),
        (x, y, 0)), make(rng))


def sofa(rng):
    w = rng.uniform(1.2, 2.2)
    return geometry.joined(
        solids.standing((w, .8, .42), 0, 0), solids.standing((w, .2, .8), 0, .35),
        *[solids.standing((.18, .8, .6), x * w / 2, 0) for x in (-1, 1)])


def cupboard(rng):
    w, d, h = rng.uniform(.4, 1.2), rng.uniform(.35, .6), rng.uniform(.7, 2.)
    return geometry.joined(solids.standing((w, d, h), 0, 0),
                           solids.standing((.03, .04, .2), w * .3, -d / 2, 0, h / 2))


def lamp(rng):
    h = rng.uniform(1.2, 1.8)
    return geometry.joined(
        solids.cylinder(.02, 0, h), solids.cylinder(.16, 0, .03),
        solids.revolved([(.22, h - .25), (.12, h + .05)], 24))


def room(rng, clutter=()):
    """A furnished room, and two places to stand in it: (mesh, eyes)."""
    w, d, h = rng.uniform(3.2, 7), rng.uniform(3, 6), rng.uniform(2.4, 3)
    corners = [(0, 0), (w, 0), (w, d), (0, d)]
    if rng.random() < .4:   # the corner at (w, d) is cut out
        a, b = rng.uniform(.55, .8) * w, rng.uniform(.55, .8) * d
        corners[2:3] = [(w, b), (a, b), (a, d)]
    meshes = [solids.box((w, d, .02), (w / 2, d / 2, z)) for z in (0, h)]
    meshes += [wall(a, b, h, rng, int(rng.integers(0, 3)))
               for a, b in zip(corners, corners[1:] + corners[:1])]
    spots = rng.uniform([.5, .5], [w - .5, d - .5], (int(rng.integers(5, 12)), 2))
    meshes += [furniture(rng, *spot) for spot in spots]
    for mesh in clutter:
        place = geometry.similarity(
            geometry.turn_about_z(rng.uniform(0, 6.3)),
            (*rng.uniform([.4, .4], [w * .7, d * .7]), rng.uniform(.3, .9)),
            rng.uniform(.3, .8))
        meshes.append(geometry.moved_mesh(place, mesh))
    eyes = np.c_[rng.uniform([.2 * w, .2 * d], [.6 * w, .6 * d], (2, 2)),
                 rng.uniform(1.2, 1.8, 2)]
    return geometry.joined(*meshes), eyes


def corridor(rng):
    """A long corridor whose doors come at equal or unequal steps."""
    length, w, h = rng.uniform(14, 30), rng.uniform(1.6, 2.6), rng.uniform(2.3, 2.8)
    meshes = [solids.box((length, w, .02), (length / 2, w / 2, z)) for z in (0, h)]
    meshes += [solids.standing((length, .02, h), length / 2, y) for y in (0, w)]
    meshes += [solids.standing((.02, w, h), x, w / 2) for x in (0, length)]
    equal = rng.random() < .5
    steps = np.arange(1.5, length - 1, rng.uniform(2, 4))
    for side in (0, w):
        for x in steps if equal else rng.uniform(1, length - 1, len(steps)):
            for off in (-.45, .45):
                meshes.append(solids.standing((.08, .16, 2.05), x + off, side))
            meshes.append(solids.standing((.98, .16, .08), x, side, 0, 2.05))
    if not equal:
        for x in rng.uniform(1, length - 1, 4):
            meshes.append(solids.standing((.5, .35, rng.uniform(.6, 1.8)), x,
                                          rng.choice([.2, w - .2])))
    first = rng.uniform(2, length - 10)
    eyes = [(x, w * rng.uniform(.35, .65), 1.5) for x in (first, first + rng.uniform(2, 6))]
    return geometry.joined(*meshes), np.array(eyes)


def car(rng, x, y):
    long, angle = rng.uniform(3.6, 4.8), rng.normal() * .03
    body = solids.standing((long, 1.7, .75), 0, 0, 0, .25)
    cabin = solids.standing((long * .5, 1.5, .55), rng.uniform(-.4, .2), 0, 0, 1.)
    wheels = [solids.standing((.6, .25, .6), i * long * .32, j * .75)
              for i in (-1, 1) for j in (-1, 1)]
    return geometry.moved_mesh(geometry.similarity(geometry.turn_about_z(angle), (x, y, 0)),
                               geometry.joined(body, cabin, *wheels))


def facade(rng, start, side):
    """House fronts in a row along x at y = side."""
    meshes, x, outward = [], start, np.sign(side)
    while x < -start:
        wide, tall = rng.uniform(6, 14), rng.uniform(5, 12)
        y = side + outward * rng.uniform(0, 1.5)
        meshes.append(solids.standing((wide, .3, tall), x + wide / 2, y))
        columns, floors = int(wide // rng.uniform(1.8, 3)), int(tall // 2.9)
        size = rng.uniform(.8, 1.3), .25, rng.uniform(1., 1.7)
        for column in range(columns):
            for floor in range(floors):
                meshes.append(solids.standing(
                    size, x + (column + .5) * wide / columns, y - outward * .15, 0,
                    .9 + 2.9 * floor))
        if rng.random() < .5:
            meshes.append(solids.standing((2., .9, .15), x + rng.uniform(2, wide - 2),
                                          y - outward * .5, 0, 3))
        x += wide + (rng.uniform(1.5, 5) if rng.random() < .3 else 0)
    return meshes


def street(rng):
    """A street along x, and two places 5 to 20 m apart on it."""
    reach, half = 55., rng.uniform(5.5, 9)
    road = rng.uniform(2.8, 4)
    meshes = [solids.box((2 * reach, 2 * half + 6, .02)),
              *[solids.standing((2 * reach, half - road, .14), 0, s * (half + road) / 2)
                for s in (-1, 1)]]
    meshes += facade(rng, -reach, half) + facade(rng, -reach, -half)
    for x in np.arange(-reach, reach, rng.uniform(12, 25)) + rng.uniform(0, 8):
        meshes.append(solids.cylinder(.09, 0, rng.uniform(4, 7), x + rng.normal(),
                                      road + .5, 12))
    for x in rng.uniform(-reach, reach, int(rng.integers(4, 14))):
        meshes.append(car(rng, x, rng.choice([-1, 1]) * (road - 1)))
    for x in rng.uniform(-reach, reach, int(rng.integers(0, 9))):
        y = rng.choice([-1, 1]) * (road + .8)
        crown = geometry.unit(parts.stone(rng))
        meshes += [solids.cylinder(.14, 0, 2.5, x, y, 12), geometry.moved_mesh(
            geometry.similarity(shift=(x, y, 3.5), scale=rng.uniform(2.5, 4)), crown)]
    first = rng.uniform(-25, 5)
    apart = rng.uniform(5, 20)
    eyes = [(x, rng.uniform(-1.5, 1.5), 2.) for x in (first, first + apart)]
    return geometry.joined(*meshes), np.array(eyes)

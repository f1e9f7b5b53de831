# SPDX-License-Identifier: BSD-3-Clause
"""Kinds of cases of rooms, corridors and streets: functions of (world, random numbers,
whether foreign)."""
import numpy as np
from scipy.spatial import cKDTree

import geometry
import places
import scanning
from case import Case

STREET = {"low": -25, "high": 40, "reach": 50}


def metric(rng):
    return str(rng.choice(["rigid", "metric"]))


def place(world, make, edge, rng, clutter=()):
    """(name, mesh, eyes) of a place; triangles up to edge long."""
    name, own = world.seeded(make.__name__, rng)
    mesh, eyes = make(own, clutter) if clutter else make(own)
    return name, geometry.refined(mesh, edge), eyes


def shared(source, target):
    """Share of the source's points that the target has, too."""
    spacing = np.median(cKDTree(target).query(target[::20], 7)[0][:, 6])
    return np.mean(cKDTree(target).query(source[::10])[0] < 1.5 * spacing)


def two_scans(world, rng, foreign, make, edge, least, fields, noise, tolerance, **how):
    """Scans from both places of one, or each of its own. They share at least so much."""
    name, mesh, eyes = place(world, make, edge, rng)
    other, there, its_eyes = place(world, make, edge, rng) if foreign else (name, mesh, eyes)
    for _ in range(6):
        source, target = (scanning.scan_around(
            scene, eye, int(rng.uniform(9000, 22000)), rng, noise, heading=rng.uniform(0, 360),
            field=rng.uniform(*fields), **how)
            for scene, eye in ((mesh, eyes[0]), (there, its_eyes[1])))
        if foreign or shared(source, target) > least:
            break
    return Case(source, target, sorted({name, other}), foreign,
                (tolerance[0], tolerance[1] / geometry.diagonal(source)), scaling=metric(rng))


def room(world, rng, foreign):
    return two_scans(world, rng, foreign, places.room, .5, .2, (130, 360),
                     rng.uniform(.001, .012), (3., .15))


def corridor(world, rng, foreign):
    return two_scans(world, rng, foreign, places.corridor, .8, .2, (200, 360),
                     rng.uniform(.001, .01), (3., .25), reach=12)


def street(world, rng, foreign):
    return two_scans(world, rng, foreign, places.street, 2., .15, (300, 360),
                     rng.uniform(.003, .03), (2., .4), **STREET)


def in_room(world, rng, foreign):
    """A template and a scan of a room that holds the object, or does not."""
    name, mesh = world.thing(rng)
    size = rng.uniform(.5, 1.4)
    sized = geometry.moved_mesh(geometry.similarity(scale=size), mesh)
    room_name, own = world.seeded("room", rng)
    scene, eyes = places.room(own)
    heading = rng.uniform(0, 6.3)
    ahead = np.array([np.cos(heading), np.sin(heading), 0]) * rng.uniform(1.2, 2)
    pose = geometry.similarity(geometry.random_rotation(rng), [*(eyes[0] + ahead)[:2], .9])
    there = geometry.moved_mesh(pose, sized)
    scene = geometry.refined(scene if foreign else geometry.joined(scene, there), .5)
    target = scanning.scan_around(scene, eyes[0], int(rng.uniform(12000, 25000)), rng,
                                  rng.uniform(.001, .008), heading=np.degrees(heading),
                                  field=rng.uniform(110, 260))
    source = geometry.sampled(there, int(rng.uniform(3000, 7000)), rng)[0]
    return Case(source, target, sorted([name, room_name]), foreign, (6., .05),
                () if foreign else (there, there), metric(rng))

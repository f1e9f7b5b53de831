# SPDX-License-Identifier: BSD-3-Clause
"""Kinds of cases of objects, with a right pose and, as far as they can be, of two different
objects: functions of (world, random numbers, whether foreign)."""
import numpy as np

import geometry
import parts
import scanning
import solids
from case import Case


def count(rng, low=3000, high=15000):
    return int(np.exp(rng.uniform(np.log(low), np.log(high))))


def pair(world, rng, foreign):
    """Twice an object, or two: ((mesh, mesh), names)."""
    things = world.two_things(rng) if foreign else [world.thing(rng)] * 2
    return [mesh for _, mesh in things], sorted({name for name, _ in things})


def like_pair(world, rng, families):
    things = world.two_members(rng, families)
    return [mesh for _, mesh in things], sorted(name for name, _ in things)


def with_noise(points, sigma, rng):
    return points + rng.normal(size=points.shape) * sigma * geometry.diagonal(points)


def cloud(mesh, rng, sigma=None, points=None):
    """Points all over the mesh; noise up to 0.5 % of the diagonal unless told."""
    sigma = rng.choice([0, rng.uniform(0, .005)]) if sigma is None else sigma
    return with_noise(geometry.sampled(mesh, points or count(rng), rng)[0], sigma, rng)


def view(mesh, direction, rng):
    return scanning.depth_view(mesh, direction, count(rng), rng, rng.uniform(0, .004))


def made(source, target, names, meshes, foreign, **more):
    """A case; of two objects no pose is right, so that surfaces are not asked."""
    return Case(source, target, names, foreign, surfaces=() if foreign else tuple(meshes),
                **more)


def whole(world, rng, foreign):
    meshes, names = pair(world, rng, foreign)
    return made(cloud(meshes[0], rng), cloud(meshes[1], rng), names, meshes, foreign)


def large(world, rng, foreign):
    meshes, names = pair(world, rng, foreign)
    source, target = (cloud(mesh, rng, None, count(rng, 20000, 60000)) for mesh in meshes)
    return made(source, target, names, meshes, foreign)


def noisy(world, rng, foreign):
    meshes, names = pair(world, rng, foreign)
    sigma = np.exp(rng.uniform(np.log(.003), np.log(.03)))
    source = cloud(meshes[0], rng, sigma)
    target = cloud(meshes[1], rng, rng.choice([0, sigma]))
    return made(source, target, names, meshes, foreign, tolerance=(6., .04),
                slack=.008 + sigma / 2)


def one_sided(world, rng, foreign):
    """Noise that lies on one side of the surface."""
    meshes, names = pair(world, rng, foreign)
    points, faces = geometry.sampled(meshes[0], count(rng), rng)
    out = geometry.face_normals(meshes[0])[0][faces]
    source = points + out * rng.uniform(0, rng.uniform(.002, .02), (len(points), 1))
    return made(source, cloud(meshes[1], rng), names, meshes, foreign)


def uneven(world, rng, foreign):
    meshes, names = pair(world, rng, foreign)
    source = scanning.denser_on_one_side(cloud(meshes[0], rng, None, 12000), rng)
    return made(source, cloud(meshes[1], rng), names, meshes, foreign)


def sparse(world, rng, foreign):
    meshes, names = pair(world, rng, foreign)
    source = cloud(meshes[0], rng, None, count(rng, 60, 800))
    target = cloud(meshes[1], rng, None, count(rng, 60, 4000))
    return made(source, target, names, meshes, foreign, tolerance=(8., .05), slack=.02)


def stray(world, rng, foreign):
    """Points that belong to nothing."""
    meshes, names = pair(world, rng, foreign)
    source = cloud(meshes[0], rng)
    strays = rng.uniform(-.6, .6, (int(len(source) * rng.uniform(.05, .6)), 3))
    return made(np.vstack([source, strays]), cloud(meshes[1], rng), names, meshes, foreign)


def cut(world, rng, foreign):
    meshes, names = pair(world, rng, foreign)
    source = scanning.kept_part(cloud(meshes[0], rng), rng.uniform(.25, .8), rng)[0]
    return made(source, cloud(meshes[1], rng), names, meshes, foreign)


def both_cut(world, rng, foreign):
    """Cut on opposite sides: they share 0.9 to 0.15 of each."""
    meshes, names = pair(world, rng, foreign)
    shared = rng.uniform(.15, .9)
    kept = 1 / (2 - shared)
    source, direction = scanning.kept_part(cloud(meshes[0], rng), kept, rng)
    turned = -direction if not foreign else rng.normal(size=3)
    target = scanning.kept_part(cloud(meshes[1], rng), kept, rng, turned)[0]
    return made(source, target, names, meshes, foreign)


def one_view(world, rng, foreign):
    """A depth view onto the whole object."""
    meshes, names = pair(world, rng, foreign)
    return made(view(meshes[0], rng.normal(size=3), rng), cloud(meshes[1], rng), names, meshes,
                foreign)


def two_views(world, rng, foreign):
    meshes, names = pair(world, rng, foreign)
    first = rng.normal(size=3)
    first /= np.linalg.norm(first)
    across = np.cross(first, rng.normal(size=3))
    angle = np.radians(rng.uniform(15, 90))
    second = np.cos(angle) * first + np.sin(angle) * across / np.linalg.norm(across)
    return made(view(meshes[0], first, rng), view(meshes[1], second, rng), names, meshes,
                foreign)


def distorted(world, rng, foreign):
    """Two views by a scanner that distorts each in a way of its own."""
    meshes, names = pair(world, rng, foreign)
    first = rng.normal(size=3)
    second = first / np.linalg.norm(first) + rng.normal(size=3) * rng.uniform(.2, .8)
    views = []
    for mesh, direction in zip(meshes, (first, second)):
        amount = np.exp(rng.uniform(np.log(.0005), np.log(.004)))
        bent = geometry.bent(geometry.refined(mesh, .1), amount, rng)
        points = count(rng, 3000, 50000)
        noise = rng.uniform(0, .4) / np.sqrt(points)
        views.append(scanning.depth_view(bent, direction, points, rng, noise))
    return made(*views, names, meshes, foreign)


def on_table(world, rng, foreign):
    """Views of objects on a table, onto another such view or onto the object."""
    meshes, names = pair(world, rng, foreign)
    turn = geometry.similarity(geometry.random_rotation(rng))
    views = []
    for mesh in meshes:
        upright = geometry.moved_mesh(turn, mesh)
        upright = upright[0] - [0, 0, upright[0][:, 2].min()], upright[1]
        table = solids.box((1.6, 1.6, .02), (0, 0, -.01))
        heading, down = rng.uniform(0, 6.3), rng.uniform(.3, 1.)
        direction = np.array([np.cos(heading), np.sin(heading), -down])
        scene = geometry.refined(geometry.joined(upright, table), .2)
        views.append(view(scene, direction, rng))
    if rng.random() < .5:
        views[1] = cloud(upright, rng)
    meshes = [upright, upright]
    return made(*views, names, meshes, foreign, tolerance=(4., .02))


def as_built(world, rng, foreign):
    """An object's model, and scans of it as it was built, or as scanners distort it."""
    meshes, names = pair(world, rng, foreign)
    built = geometry.refined(meshes[1], .1)
    built = geometry.bent(built, np.exp(rng.uniform(np.log(.002), np.log(.01))), rng)
    views = [view(built, rng.normal(size=3), rng) for _ in range(rng.integers(1, 6))]
    clouds = [cloud(meshes[0], rng, None, count(rng, 3000, 30000)), np.vstack(views)]
    if rng.random() < .5:
        clouds.reverse()
    return made(*clouds, names, meshes, foreign, slack=.015)


def panel_skin(world, rng, foreign):
    """One skin of a thin panel onto both: a wall off is wrong."""
    things = world.two_members(rng, ["panel"])
    (name, mesh), (other, target) = things if foreign else (things[0], things[0])
    own = np.random.default_rng(int(name.split("-")[1]))
    thickness = own.uniform(.015, .05)
    mesh = geometry.unit(parts.panel(own, thickness))
    target = target if foreign else mesh
    ahead = np.array([*rng.uniform(-.5, .5, 2), rng.choice([-1, 1])])
    source = scanning.depth_view(mesh, ahead, count(rng, 5000, 20000), rng,
                                 rng.uniform(0, .2) * thickness)
    target = cloud(target, rng, rng.uniform(0, .1) * thickness, count(rng, 8000, 30000))
    return Case(source, target,
                sorted({name, other}) if foreign else [name], foreign, (3., .35 * thickness),
                scaling=str(rng.choice(["rigid", "metric", "any"], p=[.45, .4, .15])))


def two_sides(world, rng, foreign):
    """Front and back of something flat or broken, which share little but the rim."""
    families = ["stone", "stone", "marked_plank", "mounting_plate", "bracket", "assembly"]
    things = world.two_members(rng, families)
    (name, mesh), (other, behind) = things if foreign else (things[0], things[0])
    direction = np.array([*rng.normal(size=2) * .4, 1.])
    source = view(mesh, direction, rng)
    target = view(behind, -direction + rng.normal(size=3) * .6, rng)
    return made(source, target, sorted({name, other}) if foreign else [name], [mesh, mesh],
                foreign, tolerance=(4., .02))


def symmetric(world, rng, foreign):
    families = list(parts.SYMMETRIC)
    things = world.two_members(rng, families)
    (name, mesh), (other, target) = things if foreign else (things[0], things[0])
    source = cloud(mesh, rng)
    if rng.random() < .4:
        source = view(mesh, rng.normal(size=3), rng)
    return Case(source, cloud(target, rng), sorted({name, other}) if foreign else [name],
                foreign, surfaces=(mesh, target))


def similar(world, rng, foreign):
    """Members of one family: the other one looks alike, and is not the same."""
    families = ["jaw", "keyboard", "mounting_plate", "bracket", "marked_plank", "chair",
                "table", "shelf", "stone", "steps", "jaw"]
    meshes, names = like_pair(world, rng, families)
    if not foreign:
        meshes, names = [meshes[0]] * 2, names[:1]
    source = cloud(meshes[0], rng)
    way = rng.integers(3)
    if way == 1:
        source = scanning.kept_part(source, rng.uniform(.3, .7), rng)[0]
    if way == 2:
        source = view(meshes[0], rng.normal(size=3), rng)
    return Case(source, cloud(meshes[1], rng), names, foreign, surfaces=tuple(meshes))


def scale_free(world, rng, foreign):
    """Parts of parts that look alike at other scales, the scale not told."""
    meshes, names = like_pair(world, rng, ["steps", "pipework", "mounting_plate", "bracket"])
    if not foreign:
        meshes, names = [meshes[0]] * 2, names[:1]
    source = cloud(meshes[0], rng) if rng.random() < .4 else view(
        meshes[0], rng.normal(size=3), rng)
    source = scanning.kept_part(source, rng.uniform(.4, .9), rng)[0]
    return Case(source, cloud(meshes[1], rng), names, foreign, surfaces=tuple(meshes),
                scaling="any")


def mirror(world, rng, foreign):
    """The mirror image, whole or cut; right where the object is its own mirror image."""
    name, mesh = world.thing(rng)
    image = geometry.mirrored(mesh)
    source = cloud(image, rng)
    if rng.random() < .5:
        source = scanning.kept_part(source, rng.uniform(.7, .9), rng)[0]
    return Case(source, cloud(mesh, rng), [name], True, surfaces=(image, mesh))


def small_on_big(world, rng, foreign):
    (small, mesh), (big, target) = world.two_things(rng)
    source = cloud(mesh, rng) * rng.uniform(.05, .35)
    target = cloud(target, rng, None, 12000)
    if rng.random() < .3:
        source, target = target, source
    return Case(source, target, sorted([small, big]), True,
                scaling=str(rng.choice(["rigid", "metric"])))

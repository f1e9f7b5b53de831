# SPDX-License-Identifier: BSD-3-Clause
"""Objects and places of one part, fit or check."""
import numpy as np

import case
import geometry
import parts


class World:
    def __init__(self, models, split):
        self.models = {name: mesh for name, mesh in models.items()
                       if case.split_of(name) == split}
        self.split = split

    def seeded(self, name, rng):
        """A name and random numbers of its own for something of this part."""
        while True:
            number = int(rng.integers(1000000))
            if case.split_of(f"{name}-{number}") == self.split:
                return f"{name}-{number}", np.random.default_rng(number)

    def member(self, family, rng):
        """A member of a family of parts: (name, mesh), its diagonal 1."""
        name, own = self.seeded(family, rng)
        return name, geometry.unit(parts.FAMILIES[family](own))

    def thing(self, rng):
        """Any object, but for panels, whose poses need tolerances of their own."""
        if rng.random() < .7:
            name = str(rng.choice(sorted(self.models)))
            return name, self.models[name]
        return self.member(str(rng.choice([f for f in parts.FAMILIES if f != "panel"])), rng)

    def two_things(self, rng):
        first = second = self.thing(rng)
        while second[0].split("-")[0] == first[0].split("-")[0] != "random" or \
                second[0] == first[0]:
            second = self.thing(rng)
        return first, second

    def two_members(self, rng, families):
        family = str(rng.choice(families))
        return self.member(family, rng), self.member(family, rng)

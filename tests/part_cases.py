"""Cases of flat parts for the two planners: random ones, and edits of them."""

import random
from functools import cache
from typing import Any

from lightbench.scene import Scene

COUNT = 20


def random_parts(chance: random.Random) -> dict[str, Any]:
    """Parts that hang on one another, children before their parents too."""
    names = [f"part{n}" for n in range(chance.randint(1, 12))]
    parts = {}
    for n, name in enumerate(names):
        shape = chance.choice(["square", "circle", "line"])
        size = chance.uniform(0.01, 2)
        parts[name] = {
            "shape": shape,
            "parent": chance.choice([None, *names[:n]]),
            "position": [chance.uniform(-1, 1), chance.uniform(-1, 1)],
            "rotation": chance.choice([0, 30, 90, chance.uniform(-360, 360)]),
            "scale": [size, size if shape == "circle" else chance.uniform(0.01, 2)],
            "color": [chance.random(), 0, 1],
            "width": chance.uniform(1, 64),
        }
    return dict(chance.sample(sorted(parts.items()), k=len(parts)))


@cache
def flat_scenes() -> dict[str, Scene]:
    """Scenes of nothing but parts, by name."""
    chance = random.Random(12)
    empty: dict[str, Any] = {"materials": {}, "objects": {}}
    return {
        f"flat-{n}": Scene.parse({**empty, "parts": random_parts(chance)}) for n in range(COUNT)
    }


def part_settings(chance: random.Random, there: Scene) -> dict[str, Any]:
    """Edits of a part, in every spelling."""
    at = f"parts.{chance.choice(sorted(there.parts))}"
    x, y = chance.uniform(-2, 2), chance.uniform(-2, 2)
    return {
        f"{at}.position": chance.choice([[x, y], f"{x!r},{y!r}"]),
        f"{at}.rotation": chance.choice([90, "-45", chance.uniform(-360, 360)]),
        f"{at}.scale": chance.choice(["2", 0.3, chance.uniform(0.1, 5)]),
        f"{at}.color": chance.choice(["#1a2b3c", [chance.random(), 2, 0]]),
        f"{at}.width": chance.uniform(1, 64),
        **chance.choice([{}, {f"{at}.parent": "auto"}, {f"{at}.parent": None}]),
    }

"""Lights of a document (KHR_lights_punctual), or three that suit a model without any."""

import math

import numpy as np
from numpy.typing import NDArray

from lightbench.errors import ModelError
from lightbench.gltf.limits import Budget
from lightbench.gltf.names import Names
from lightbench.gltf.nodes import FARTHEST, Placed
from lightbench.gltf.notes import Notes
from lightbench.gltf.schema import Document

__all__ = ["three_lights", "with_lights"]

Floats = NDArray[np.float64]
Data = dict[str, object]
# (name, towards the light along the camera's right, up and back, lux, colour). The key light puts
# a facing white surface near radiance 1, that of white paper; the rim stands behind the model.
STUDIO = (
    ("key", (-0.8, 0.9, 0.75), 3.0, (1.0, 0.97, 0.92)),
    ("fill", (0.9, 0.2, 0.6), 0.7, (0.88, 0.94, 1.0)),
    ("rim", (0.35, 0.7, -0.9), 1.8, (1.0, 1.0, 1.0)),
)


def with_lights(
    document: Document, places: list[Placed], budget: Budget, notes: Notes
) -> dict[str, Data]:
    """The scene's lights by name. They shine along their node's -Z; their range is not used.

    Raises ModelError.
    """
    lights: dict[str, Data] = {}
    names = Names()
    for place in places:
        if not place.node.extensions.punctual:
            continue
        where = f"nodes[{place.index}]"
        budget.spend("lights", 1, where)
        light = _light(document, place.node.extensions.punctual.light, place.world, where)
        if light is None:
            notes.add(f"{where}: its light has no direction and was left out")
            continue
        index = place.node.extensions.punctual.light
        lights[names.new(place.node.name, document.lights[index].name, "light")] = light
    return lights


def _light(document: Document, index: int, world: Floats, where: str) -> Data | None:
    """Candela or lux as given. A colour brighter than 1 becomes intensity."""
    light = document.lights[index]
    brightest = max(*light.color, 1.0)
    made: Data = {
        "type": light.type,
        "color": [c / brightest for c in light.color],
        "intensity": min(light.intensity * brightest, 1e30),
    }
    if light.type != "directional":
        made["position"] = _reachable(world[:3, 3], where)
    if light.type != "point":
        length = float(np.linalg.norm(world[:3, 2]))
        if not length > 1e-12:
            return None
        made["direction"] = [float(-c / length) + 0.0 for c in world[:3, 2]]
    if light.type == "spot":
        inner, outer = light.spot.inner_cone_angle, light.spot.outer_cone_angle
        if inner > outer:
            raise ModelError(
                f"extensions.KHR_lights_punctual.lights[{index}].spot: innerConeAngle {inner:g} "
                f"exceeds outerConeAngle {outer:g}"
            )
        made |= {"inner": math.degrees(inner), "outer": math.degrees(outer)}
    return made


def _reachable(position: Floats, where: str) -> list[float]:
    if np.abs(position).max() > FARTHEST:
        raise ModelError(f"{where}: lies beyond {FARTHEST:g} m, the farthest allowed")
    return [float(c) + 0.0 for c in position]


def three_lights(right: Floats, up: Floats, back: Floats) -> dict[str, Data]:
    """Directional key, fill and rim light about a camera's axes."""
    lights: dict[str, Data] = {}
    for name, (x, y, z), lux, color in STUDIO:
        towards = x * right + y * up + z * back
        lights[name] = {
            "type": "directional",
            "direction": [round(float(-c), 6) + 0.0 for c in towards / np.linalg.norm(towards)],
            "color": list(color),
            "intensity": lux,
        }
    return lights

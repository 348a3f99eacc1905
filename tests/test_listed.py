"""Objects of a list are what they are by name, and meshes the shapes that they are made of."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import lightbench as lb
from lightbench import assets, traced
from lightbench.exact.directions import Array, unit
from lightbench.scene import Scene
from lightbench.settings import Setting
from lightbench.shapes import mesh
from tests.cards import WHITE, Data, card, card_mesh, mapped, shown, texture
from tests.support import assert_sound

SIZE = (96, 72)
CODES = np.random.default_rng(41).integers(40, 255, (2, 16, 16, 3))
BUMPS = np.random.default_rng(42).integers(90, 165, (16, 16, 3)) + np.array([0, 0, 90])
MATT: Data = {"kd": [0.6, 0.5, 0.4], "ks": [0.2, 0.2, 0.2], "ambient": [0.1, 0.2, 0.3]}
BOTH: Data = {**MATT, "double_sided": True}
GLASS: Data = {"kd": [0.1, 0.1, 0.1], "ks": [0.3] * 3, "transmittance": 0.7, "ior": 1.3}
CLEAR: Data = {**GLASS, "kd": [0, 0, 0], "ks": [0, 0, 0], "ambient": [0.1, 0.2, 0.3]}
MAPPED: Data = {
    **MATT,
    "maps": {
        "base_color": {"texture": "grain", "scale": [3, 2], "rotation": 20},
        "normal": {"texture": "bumps"},
    },
}
OTHER: Data = {**MATT, "maps": {"base_color": {"texture": "spots", "offset": [0.2, 0.3]}}}


def textures() -> Data:
    return {"grain": texture(CODES[0]), "spots": texture(CODES[1]), "bumps": texture(BUMPS)}


def shapes(*materials: str) -> dict[str, Data]:
    """One of each shape, turned and stretched, no two of them alike; the materials in turns."""
    things: list[Data] = [
        {"shape": "sphere", "position": [-1.9, 0.9, 0.2], "scale": 0.7, "rotation": [20, 70, 10]},
        {"shape": "sphere", "position": [-0.1, 1.1, -0.4], "scale": [0.9, 0.5, 0.6],
         "rotation": [15, 40, 25]},
        {"shape": "cube", "position": [1.7, 1.0, 0.1], "scale": [0.9, 1.2, 0.7],
         "rotation": [30, 35, 10]},
        {"shape": "cone", "position": [-1.2, -1.2, 0.7], "scale": [0.6, 1.2, 0.5],
         "rotation": [-40, 15, 12]},
        {"shape": "plane", "position": [1.5, -0.9, 0.9], "scale": [0.7, 1, 0.9],
         "rotation": [-120, 30, 0]},
        {"shape": "triangle", "corners": [[-0.4, -1.2, 1.2], [0.7, -1.3, 0.8], [0.2, -0.5, 1.4]]},
        {"shape": "plane", "position": [0, -1.6, 0], "scale": [9, 1, 9]},
    ]  # fmt: skip
    return {
        f"thing{i}": {**thing, "material": materials[i % len(materials)]}
        for i, thing in enumerate(things)
    }


def room(objects: dict[str, Data], **more: Any) -> Scene:
    materials = {"matt": MATT, "both": BOTH, "glass": GLASS, "clear": CLEAR}
    images = {"mapped": MAPPED, "other": OTHER}
    used = {thing["material"] for thing in objects.values()}
    data: Data = {
        "camera": {"eye": [0.5, 1.2, 7], "target": [0.1, -0.1, 0], "fov": 36},
        "materials": {k: m for k, m in {**materials, **images}.items() if k in used},
        "textures": textures() if used & set(images) else {},
        "objects": objects,
        "lights": {
            "lamp": {"type": "point", "position": [2, 5, 4], "intensity": 60},
            "sun": {"type": "directional", "direction": [0.6, -1, -0.5], "intensity": 1},
        },
        "background": [0.1, 0.3, 0.6],
        "settings": {
            "technique": "whitted", "shadow": "ray", "ambient": "lab", "model": "blinn_phong",
            "max_bounces": 3,
        },
    }  # fmt: skip
    return Scene.parse({**data, **more})


def assert_alike(one: Scene, other: Scene, share: float, **settings: Setting) -> None:
    """The same picture, but for a share of the pixels, where an edge runs through them."""
    a, b = (lb.render(scene, SIZE, **settings) for scene in (one, other))
    for picture in (a, b):
        assert_sound(picture)
    off = np.abs(a.linear - b.linear).max(axis=2)
    assert a.linear.std() > 0.05
    assert (off > 1e-3).mean() <= share


def listed(scene: Scene) -> Scene:
    """With as many more objects as make a list of it, where no ray comes."""
    data: Data = scene.data()
    first = next(iter(data["objects"].values()))
    far = {**first, "shape": "sphere", "scale": 0.1, "position": [0, 500, 900]}
    far.pop("corners", None)
    data["objects"] |= {f"far{i}": far for i in range(traced.LONG)}
    return Scene.parse(data)


FLOOR: Data = {"shape": "plane", "position": [0, -1.6, 0], "scale": [9, 1, 9], "material": "matt"}
INSIDE: Data = {"camera": {"eye": [1.75, 1.05, 0.2], "target": [0, 0, 0], "fov": 90}}
CASES: dict[str, tuple[tuple[str, ...], Data]] = {
    "from below": (("both", "matt"), {"camera": {"eye": [0.5, -6, 6], "target": [0, 0, 0]}}),
    "glass": (("glass",), {}),
    "within glass": (("glass",), INSIDE),
    "mapped": (("mapped", "other"), {}),
}


@pytest.mark.parametrize("case", CASES)
def test_a_list_is_what_its_objects_are_by_name(case: str) -> None:
    materials, more = CASES[case]
    scene = room(shapes(*materials), **more)
    assert_alike(scene, listed(scene), 2e-3)


@pytest.mark.parametrize("shape", ["cube", "sphere"])
def test_a_body_that_is_not_of_glass_has_no_inside(shape: str) -> None:
    """Seen from there, with both its sides: the others alone, by name and of a list."""
    body: Data = {"shape": shape, "scale": [3, 4, 5], "position": INSIDE["camera"]["eye"]}
    others = {"pane": {"shape": "cube", "material": "glass"}, "floor": FLOOR}
    with_it = room({"body": {**body, "material": "both"}, **others}, **INSIDE)
    without = room(others, **INSIDE)
    for scene in (with_it, listed(with_it)):
        assert_alike(without, scene, 0.0, shadow="none")


PLACE: Data = {"position": [0.2, 0.3, 1], "scale": [1.9, 1.6, 1.1], "rotation": [35, 40, 15]}


@pytest.mark.parametrize("shape", ["cube", "plane"])
@pytest.mark.parametrize("material", ["mapped", "clear", "both"])
def test_a_mesh_is_the_shape_that_it_is_made_of(shape: str, material: str) -> None:
    """With its shadow on a floor. Beside an edge of the cube its images are filtered as if the
    mesh's face went on."""
    key = assets.add_mesh(mesh(shape), keep=True)
    high = [0.5, 0.5 if shape == "cube" else 0.0, 0.5]
    asset = {"mesh": key, "low": [-x for x in high], "high": high}
    thing = {**PLACE, "material": material}
    one, other = (
        room({"thing": {**thing, **what}, "floor": FLOOR}, meshes=meshes)
        for what, meshes in (
            ({"shape": shape}, {}), ({"shape": "mesh", "mesh": "made"}, {"made": asset})
        )
    )  # fmt: skip
    assert_alike(one, other, 0.02 if (shape, material) == ("cube", "mapped") else 2e-3)


# What a ray met has what rasterisation draws


def vertices(count: int = 4) -> dict[str, Any]:
    """What a card's corners may have: each of them something else."""
    random = np.random.default_rng(43)
    leaning = random.uniform(-1, 1, (count, 3)) * (0.7, 0, 0.7) + (0, 1, 0)
    return {
        "normals": unit(leaning), "colors": random.uniform(0.2, 1.0, (count, 4)),
        "uvs": random.uniform(0, 1, (count, 2)), "uvs1": random.uniform(0, 1, (count, 2)),
        "tangents": np.c_[unit(random.normal(size=(count, 3))), np.ones(count)],
    }  # fmt: skip


TURNED: Data = {"scale": 2, "rotation": [20, 30, 10]}


def of_vertices(material: Data, **arrays: Any) -> Scene:
    thing = {**TURNED, "shape": "mesh", "mesh": "m"}
    return card(material, textures(), thing, meshes={"m": card_mesh(**arrays)})


def both_ways(scene: Scene, view: str, **more: Setting) -> list[Array]:
    """By rasterisation and by rays."""
    return [shown(scene, view=view, technique=name, **more) for name in ("raster", "whitted")]


@pytest.mark.parametrize("view", ["base_color", "normal", "tangent", "uv"])
def test_what_vertices_have_is_what_rasterisation_draws(view: str) -> None:
    drawn, found = both_ways(of_vertices(mapped("base_color", "grain", uv=1), **vertices()), view)
    # Images are filtered in another way.
    np.testing.assert_allclose(found, drawn, atol=0.1 if view == "base_color" else 1e-4)
    assert drawn.std() > 0.05


def test_a_mesh_without_normals_has_those_of_its_triangles() -> None:
    arrays = {**vertices(), "normals": np.zeros((4, 3))}
    found = shown(of_vertices(WHITE, **arrays), view="normal", technique="whitted")
    plane = shown(card(WHITE, {}, TURNED), view="normal", technique="whitted")
    np.testing.assert_allclose(found, plane, atol=1e-5)


def test_a_mesh_without_tangents() -> None:
    arrays = {**vertices(), "tangents": np.zeros((4, 4))}
    drawn, found = both_ways(of_vertices(mapped("normal", "bumps"), **arrays), "normal")
    np.testing.assert_allclose(found, drawn, atol=0.05)


def test_a_surface_of_two_sides_from_behind() -> None:
    """Its normal is turned round, not mirrored in the plane across the view."""
    scene = card({**WHITE, "double_sided": True}, {}, {"scale": 2, "rotation": [150, 20, 0]})
    drawn, found = both_ways(scene, "normal")
    np.testing.assert_allclose(found, drawn, atol=1e-5)


def test_a_shape_has_no_second_coordinates() -> None:
    """What asks for them has the image's corner everywhere, in full detail."""
    scene = card(mapped("base_color", "grain", uv=1), textures())
    found = 255.0 * shown(scene, view="base_color", technique="whitted")
    corner = CODES[0][[0, 0, -1, -1], [0, -1, 0, -1]].mean(axis=0)
    np.testing.assert_allclose(found, np.broadcast_to(corner, found.shape), atol=1.01)

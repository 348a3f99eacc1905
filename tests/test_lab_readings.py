"""What the lab's script leaves open shows in its pictures, and where float32 may differ is known.

The figures are those of `reflectance2`: pixels whose linear colour changes, the largest change.
"""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from lightbench.exact.directions import Array, unit
from tests.lab.display import lab_white
from tests.lab.edges import near_change, surfaces
from tests.lab.tables import SCENES, Scene
from tests.lab.texture import CELLS, DARK, SIZE, checker, coordinates, look_up
from tests.lab.tracer import LIT, SCRIPT, SHADOWED, Reading, Traced, primary_rays, trace

# A change that is more than float64's rounding.
CHANGED = 1e-6
OTHER_READINGS = {
    "fov vertical": (Reading(fov="vertical"), 99516, 0.95),
    "right-handed": (Reading(handed="right"), 100074, 0.63),
    "no shadows": (Reading(shadows=False), 36480, 0.37),
    "ambient once": (Reading(ambient="first light"), 99524, 0.06),
    "no reflection": (Reading(bounces=0), 5875, 0.61),
    "mirror keeps 1 - reflectance": (Reading(mirror_keeps="the rest"), 74571, 0.44),
}


@cache
def truth(scene: Scene) -> Traced:
    """The scene as the lab means it."""
    return trace(scene)


def change(scene: Scene, other: Traced) -> Array:
    """The largest change of a channel from the truth, (H, W)."""
    largest: Array = np.abs(other.linear - truth(scene).linear).max(axis=-1)
    return largest


@pytest.mark.parametrize("name", OTHER_READINGS)
def test_each_reading_shows(name: str) -> None:
    reading, pixels, largest = OTHER_READINGS[name]
    scene = SCENES["reflectance2"]
    difference = change(scene, trace(scene, reading))
    assert (difference > CHANGED).sum() == pytest.approx(pixels, abs=10)
    assert difference.max() == pytest.approx(largest, abs=5e-3)


@pytest.mark.parametrize(
    "reading",
    [
        Reading(shadows_end_at_light=False),
        Reading(two_sided=False),
        Reading(turn_normals=True),
        Reading(bounces=2),
    ],
)
def test_what_no_printed_scene_can_tell_apart(reading: Reading) -> None:
    """These need scenes of their own; test_lab_tracer.py has them."""
    for name, scene in SCENES.items():
        small = replace(scene, camera=replace(scene.camera, width=250, height=200))
        assert not change(small, trace(small, reading)).any(), name


def test_the_cut_at_grazing_light_shows_in_the_mirror() -> None:
    """A few pixels of the bright rim, by more than a gate of 1e-4 lets through."""
    scene = SCENES["reflectance2"]
    difference = change(scene, trace(scene, Reading(cos_threshold=0.0)))
    assert 0 < (difference > 1e-4).sum() < 50
    assert difference.max() > 0.05


def test_pi_of_the_printed_matrices_moves_outlines_only() -> None:
    scene = SCENES["reflectance2"]
    difference = change(scene, trace(scene, Reading(pi=3.14)))
    assert difference[~truth(scene).ids.edges()].max() < 0.02 < 0.5 < difference.max()


def test_over_saturated_pixels() -> None:
    linear = truth(SCENES["reflectance2"]).linear
    white = (lab_white(linear) == 1.0).all(axis=-1)
    assert white.sum() == (linear > 1.0).any(axis=-1).sum() == 25
    assert all(truth(s).linear.max() <= 1.0 for n, s in SCENES.items() if n != "reflectance2")


# Edges


def test_near_a_change() -> None:
    labels = np.zeros((5, 6), np.int64)
    labels[2, 3:] = 1
    near = near_change(labels)
    expected = np.zeros_like(near)
    expected[1:4, 2:] = True
    np.testing.assert_array_equal(near, expected)


def test_halves_of_a_wall_are_one_surface() -> None:
    assert surfaces(SCENES["shadows"]) == [0, 1, 2, 3, 3]
    green, red, blue, upper, lower = SCENES["shadows"].objects
    other = replace(lower, material=red.material)
    assert surfaces(replace(SCENES["shadows"], objects=(upper, other, lower))) == [0, 1, 0]
    assert surfaces(replace(SCENES["shadows"], objects=(green, green, blue))) == [0, 1, 2]


def test_two_lights_are_told_apart() -> None:
    """The wall faces both: in shadow of either, of none, of both."""
    ids = truth(SCENES["reflectance2"]).ids
    on_wall = ids.lights[0][ids.surface[0] == 3]
    pairs = {key + 3 * fill for key in (SHADOWED, LIT) for fill in (SHADOWED, LIT)}
    assert set(on_wall.tolist()) == pairs


def slightly_off(scene: Scene) -> Traced:
    """The scene with rays that are off by some 1e-6, as those of float32 are."""
    return trace(scene, replace(SCRIPT, pi=SCRIPT.pi * (1.0 + 1e-6)))


@pytest.mark.parametrize("name", SCENES)
def test_slight_errors_show_at_edges_only(name: str) -> None:
    scene = SCENES[name]
    edges = truth(scene).ids.edges()
    difference = change(scene, slightly_off(scene))
    assert difference[~edges].max() < 1e-4
    assert 0.005 < edges.mean() < 0.05


def test_a_mask_without_its_shadows_or_texture_would_miss_some() -> None:
    for name in ("shadows", "texture"):
        ids = truth(SCENES[name]).ids
        assert (ids.edges() & ~ids.silhouettes()).sum() > 1000


# Texture


def test_the_checker() -> None:
    texels = checker()
    assert texels.shape == (SIZE, SIZE) == (400, 400)
    assert texels[0, 0] == texels[49, 49] == texels[50, 50] == texels[399, 399] == 1.0
    assert texels[0, 50] == texels[50, 0] == DARK
    assert np.isclose(texels.mean(), (1.0 + DARK) / 2.0, rtol=1e-12)


def test_the_texture_multiplies_the_light() -> None:
    plain, textured = truth(SCENES["illumination"]), truth(SCENES["texture"])
    seen = plain.ids.surface[0] == 0
    ratio = textured.linear[seen][:, 0] / plain.linear[seen][:, 0]
    dark = textured.ids.texel[0][seen] == 1
    np.testing.assert_allclose(ratio, np.where(dark, DARK, 1.0), rtol=1e-15)


def test_cells_end_at_equal_angles() -> None:
    """On the disk seen from the eye: a cell's borders are where n_x or n_y is sin(k pi / 8)."""
    scene = SCENES["texture"]
    ids = truth(scene).ids
    d = primary_rays(scene).direction.reshape(400, 500, 3)
    sine = np.hypot(d[..., 0], d[..., 1])
    seen = sine * 10.0 < 1.6
    sine = sine[seen]
    t = 10.0 * np.sqrt(1.0 - sine**2) - np.sqrt(1.6**2 - (10.0 * sine) ** 2)
    n = (t[:, None] * d[seen] + [0.0, 0.0, 10.0]) / 1.6
    borders = np.sin((np.arange(1, CELLS) / CELLS - 0.5) * np.pi)
    column, row = np.searchsorted(borders, n[:, 0]), np.searchsorted(borders, -n[:, 1])
    np.testing.assert_array_equal(ids.texel[0][seen], (column + row) % 2)


def test_the_labs_mapping_uses_half_of_the_texture() -> None:
    n = unit(np.random.default_rng(7).normal(size=(100_000, 3)))
    u, v = coordinates(n)
    assert (np.abs(u - 0.5) + np.abs(v - 0.5)).max() <= 0.5 + 1e-12
    np.testing.assert_array_equal(coordinates(n * [1, 1, -1]), (u, v))
    around, _ = coordinates(n, "sphere")
    used = np.histogram2d(around, v, bins=10, range=((0, 1), (0, 1)))[0]
    assert (used > 0).all()
    assert (np.histogram2d(u, v, bins=10, range=((0, 1), (0, 1)))[0] > 0).mean() < 0.65


def test_the_last_texel_takes_the_end() -> None:
    """u = 1 and v = 1 lie past the last column and row."""
    poles = np.array([[1.0, 0, 0], [0, -1.0, 0], [-1.0, 0, 0], [0, 1.0, 0]])
    u, v = coordinates(poles)
    np.testing.assert_allclose(u, [1, 0.5, 0, 0.5], atol=1e-15)
    np.testing.assert_allclose(v, [0.5, 1, 0.5, 0], atol=1e-15)
    assert look_up(poles).tolist() == [DARK, DARK, 1.0, 1.0]

"""Textures: made alike each time, tiling, and plausible as surfaces."""

from __future__ import annotations

from itertools import product
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray
from PIL import Image

from scenes.making.noise import spectral
from scenes.making.surface import Surface, maps, write
from scenes.making.textures import SETS, make
from tests.support import SCENES

FOLDER = SCENES / "textures"
KINDS = ["albedo", "normal", "orm"]
# A picture hangs alone.
TILING = [name for name in SETS if name != "painting"]
METALS = ["brushed_metal", "gold_leaf"]

Values = NDArray[np.float64]


def pixels(path: Path) -> Values:
    """Codes of an image, (n, n, 3) float64."""
    with Image.open(path) as image:
        assert image.mode == "RGB"
        return np.asarray(image).astype(np.float64)


def stored(name: str, kind: str) -> Values:
    return pixels(FOLDER / f"{name}_{kind}.png")


def seam(codes: Values, axis: int) -> float:
    """The step between opposite edges, over the largest between two neighbouring rows inside."""
    inside = np.abs(np.diff(codes, axis=axis)).mean(axis=(1 - axis, 2))
    return float(np.abs(codes.take(0, axis) - codes.take(-1, axis)).mean() / inside.max())


def normals(name: str) -> Values:
    return stored(name, "normal") / 127.5 - 1


def test_every_set_is_stored_and_nothing_else() -> None:
    expected = {f"{name}_{kind}.png" for name, kind in product(SETS, KINDS)}
    assert {path.name for path in FOLDER.iterdir()} == expected
    assert sum(path.stat().st_size for path in FOLDER.iterdir()) < 7e6


@pytest.mark.parametrize("name", ["pages", "plaster"])
def test_making_a_set_again_gives_the_stored_one(name: str, tmp_path: Path) -> None:
    first = [path.read_bytes() for path in write(name, make(name), tmp_path)]
    paths = write(name, make(name), tmp_path)
    assert [path.read_bytes() for path in paths] == first
    for kind, path, step in zip(KINDS, paths, make(name).steps, strict=True):
        apart = np.abs(pixels(path) - stored(name, kind))
        # Another processor's exp and FFT may round a texel to the next step.
        assert apart.max() <= step
        assert (apart > 0).mean() < 1e-3


@pytest.mark.parametrize(("name", "kind"), list(product(TILING, KINDS)))
@pytest.mark.parametrize("axis", [0, 1])
def test_opposite_edges_differ_no_more_than_neighbours_inside(
    name: str, kind: str, axis: int
) -> None:
    assert seam(stored(name, kind), axis) < 1.25


@pytest.mark.parametrize("axis", [0, 1])
def test_a_picture_that_does_not_tile_has_a_seam(axis: int) -> None:
    cut = stored("tiles", "albedo")[:480, :480]
    assert seam(cut, axis) > 2


@pytest.mark.parametrize("name", SETS)
def test_normals_are_unit_and_face_outward(name: str) -> None:
    vectors = normals(name)
    # Half a step of the coarsest rounding, in each of three components.
    np.testing.assert_allclose(np.linalg.norm(vectors, axis=-1), 1, atol=0.035)
    assert vectors[..., 2].min() > 0


@pytest.mark.parametrize("name", SETS)
def test_normals_are_those_of_a_height_that_closes(name: str) -> None:
    vectors = normals(name)
    slopes = -vectors[..., :2] / vectors[..., 2:]
    # Up and down a periodic height cancel; an 8-bit zero lies 1/255 beside 0.
    np.testing.assert_allclose(slopes.mean(axis=(0, 1)), 0, atol=0.012)


def test_normal_of_a_known_slope() -> None:
    # 1 m of a wave h = a sin(2 pi x) that climbs to the right at u = 0, and another down the image.
    n, a = 64, 0.02
    wave = a * np.sin(2 * np.pi * (np.arange(n) + 0.5) / n)
    flat, grey = np.ones((n, n)), np.full((n, n, 3), 0.5)
    for height, channel, sign in ((np.tile(wave, (n, 1)), 0, -1), (np.tile(wave, (n, 1)).T, 1, 1)):
        made = maps(Surface(1.0, height, grey, flat, 0 * flat, steps=(1, 1, 1)))
        vector = made["normal"][0, 0].astype(float) / 127.5 - 1
        slope = sign * vector[channel] / vector[2]
        assert slope == pytest.approx(2 * np.pi * a, rel=0.08)
        assert made["orm"][0, 0, 1] == 255
        assert made["orm"][0, 0, 2] == 0


def test_hollows_are_darker_than_rims() -> None:
    n = 64
    height = np.zeros((n, n))
    height[24:40, 24:40] = -0.05
    flat, grey = np.ones((n, n)), np.full((n, n, 3), 0.5)
    sky = maps(Surface(1.0, height, grey, flat, 0 * flat))["orm"][..., 0]
    assert sky[25, 25] < sky[0, 0] - 20
    assert sky[0, 0] > 250


@pytest.mark.parametrize("name", SETS)
def test_a_texel_is_metal_or_not(name: str) -> None:
    metalness = stored(name, "orm")[..., 2]
    assert np.isin(metalness, (0, 255)).mean() > 0.97
    assert (metalness.max() == 255) == (name in METALS)


@pytest.mark.parametrize("name", SETS)
def test_colours_and_roughness_are_those_of_real_surfaces(name: str) -> None:
    albedo, orm = stored(name, "albedo"), stored(name, "orm")
    matt = orm[..., 2] == 0
    assert not matt.any() or 30 <= albedo[matt].min() <= albedo[matt].max() <= 240
    # Metals reflect more than half, in their strongest channel.
    assert matt.all() or albedo[orm[..., 2] == 255].max(axis=-1).min() > 160
    assert orm[..., 1].min() > 20


def test_gold_leaf_shows_clay_where_leaf_is_missing() -> None:
    albedo, orm = stored("gold_leaf", "albedo"), stored("gold_leaf", "orm")
    bare = orm[..., 2] == 0
    assert 0.003 < bare.mean() < 0.1
    assert albedo[bare].mean(axis=0) @ (1, -1, 0) > 40
    assert orm[bare, 1].mean() > orm[~bare, 1].mean() + 60


def test_noise_has_the_period_of_its_grid_and_the_range_that_is_said() -> None:
    field = spectral(np.random.Generator(np.random.PCG64(1)), 128, 1.0, low=4, high=16)
    assert field.mean() == pytest.approx(0, abs=1e-12)
    assert field.std() == pytest.approx(1)
    power = np.abs(np.fft.fft2(field)) ** 2
    frequency = np.hypot(*np.meshgrid(*[np.fft.fftfreq(128, 1 / 128)] * 2))
    assert power[(frequency > 2) & (frequency < 24)].sum() > 0.99 * power.sum()

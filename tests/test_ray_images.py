"""Images that rays read: filtered along the longer side of a pixel's print, as in float64."""

from typing import Any

import numpy as np
import pytest

from lightbench.exact.directions import Array
from lightbench.scene import Scene
from tests.cards import Data, card, centres, mapped, shown, texture
from tests.rays import plane, rays

CODES = np.random.default_rng(51).integers(0, 256, (64, 128, 3))
TEXELS = np.array([128, 64])
SIDE = 64


def pyramid() -> list[Array]:
    """The image and its means over 2 x 2, 4 x 4, ... texels."""
    levels = [CODES / 255.0]
    while min(levels[-1].shape[:2]) > 1:
        h, w = levels[-1].shape[:2]
        levels.append(levels[-1].reshape(h // 2, 2, w // 2, 2, -1).mean(axis=(1, 3)))
    return levels


def bilinear(image: Array, uv: Array) -> Array:
    """Of a repeating image, at (..., 2)."""
    size = np.array([image.shape[1], image.shape[0]])
    at = uv * size - 0.5
    first = np.floor(at).astype(int)
    share = at - first
    total = np.zeros((*uv.shape[:-1], image.shape[2]))
    for corner in np.ndindex(2, 2):
        i, j = np.moveaxis((first + corner) % size, -1, 0)
        total += image[j, i] * np.abs(1 - np.array(corner) - share).prod(axis=-1)[..., None]
    return total


def filtered(uv: Array, right: Array, up: Array, most: int) -> Array:
    """McCormack et al. 1999, section 3: probes as wide as the print's shorter side, in a row.

    Texture coordinates of pixels, and how far they go to the next one (..., 2): (..., 3).
    """
    wide, high = (np.linalg.norm(step * TEXELS, axis=-1) for step in (right, up))
    along = np.where((wide > high)[..., None], right, up)
    longer, shorter = np.maximum(wide, high), np.minimum(wide, high)
    count = np.minimum(np.ceil(longer / np.maximum(shorter, 1.0)), most)
    level = np.log2(np.maximum(longer / count, 1.0))
    total = np.zeros((*uv.shape[:-1], 3))
    for i in range(most):
        place = uv + ((i + 0.5) / count - 0.5)[..., None] * along
        for number, image in enumerate(pyramid()):
            share = np.clip(1.0 - np.abs(level - number), 0.0, None) * (i < count)
            total += share[..., None] * bilinear(image, place)
    return np.asarray(total / count[..., None])


def assert_filtered(
    scene: Scene, uv: Array, most: int, share: float = 0.0, **settings: Any
) -> None:
    """Of (SIDE, SIDE, 2) coordinates, but for a share of the pixels: where a probe more begins.

    Levels are of 8 bits, and drivers weigh them in 8 bits.
    """
    found = shown(scene, SIDE, technique="whitted", anisotropy=most, **settings)[1:, :-1]
    here, right, above = uv[1:, :-1], uv[1:, 1:], uv[:-1, :-1]
    want = filtered(here, right - here, above - here, most)
    off = np.abs(found - want).max(axis=-1) > 0.015
    assert off.mean() <= share
    assert np.abs(want - want.mean(axis=(0, 1))).max() > 0.05


SCALES = [(0.5, 1), (0.5, 8), (4, 1), (0.1, 4), (3, 0.2), (2, 4), (1, 8), (1.5, 5)]


@pytest.mark.parametrize("tilt", [0.0, 60.0])
@pytest.mark.parametrize("scale", SCALES)
def test_an_image_is_filtered_along_its_print(scale: tuple[float, float], tilt: float) -> None:
    """A card; tilted, and by as much longer, it looks the same."""
    longer: Data = {"rotation": [tilt, 0, 0], "scale": [1, 1, 1 / np.cos(np.radians(tilt))]}
    scene = card(mapped("base_color", scale=list(scale)), {"t": texture(CODES)}, longer)
    for most in (1, 2, 16):
        assert_filtered(scene, centres() * scale, most, view="base_color")


CAMERA: Data = {"eye": [0.1, 0.6, 1.0], "target": [0, 0, 0], "fov": 40}
GLOW: Data = {
    "base_color": [0, 0, 0], "f0": [0, 0, 0], "emissive": [1, 1, 1],
    "maps": {"emissive": {"texture": "t", "scale": [2, 3]}},
}  # fmt: skip


@pytest.mark.parametrize("most", [2, 16])
def test_an_image_seen_at_a_slant(most: int) -> None:
    """The ground, by the ray of each pixel and of its neighbours."""
    scene = card(GLOW, {"t": texture(CODES)}, {"scale": 8}, camera=CAMERA)
    origin, direction = rays(scene, (SIDE, SIDE))
    way = plane((origin, direction), (0, 0, 0), (0, 1, 0))
    met = origin + way[..., None] * direction
    assert_filtered(scene, (met[..., [0, 2]] / 8 + 0.5) * (2, 3), most, 0.04)


def test_an_image_in_a_mirror() -> None:
    """A ceiling, in the ground: as it would look through it, under the ground."""
    ceiling = {"shape": "plane", "material": "own", "rotation": [180, 0, 0], "position": [0, 1, 0]}
    mirror = {"base_color": [0, 0, 0], "f0": [0, 0, 0], "reflectance": 1}
    scene = card(
        GLOW, {"t": texture(CODES)}, camera=CAMERA,
        materials={"own": GLOW, "mirror": mirror},
        objects={
            "ceiling": {**ceiling, "scale": 20},
            "ground": {"shape": "plane", "material": "mirror", "scale": 20},
        },
    )  # fmt: skip
    origin, direction = rays(scene, (SIDE, SIDE))
    way = plane((origin, direction), (0, -1, 0), (0, 1, 0))
    met = origin + way[..., None] * direction
    assert_filtered(scene, (met[..., [0, 2]] * (1, -1) / 20 + 0.5) * (2, 3), 16, 0.04)


def test_an_image_of_whole_texels_has_no_print() -> None:
    """The texel at the pixel's middle, however the image lies, as rasterisation has it."""
    images = {"t": texture(CODES, filter="nearest")}
    scene = card(mapped("base_color", scale=[5, 0.4]), images)
    given: Data = {"view": "base_color", "anisotropy": 16}
    traced = shown(scene, SIDE, technique="whitted", **given)
    drawn = shown(scene, SIDE, **given)
    assert (np.abs(traced - drawn).max(axis=-1) > 1e-6).mean() < 0.01
    assert len(np.unique(drawn.reshape(-1, 3), axis=0)) > 4

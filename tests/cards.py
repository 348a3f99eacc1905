"""A card that fills the picture: pixel (i, j) of n sees u, v = (j + 1/2) / n, (i + 1/2) / n."""

import io
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray
from PIL import Image as Pillow

import lightbench as lb
from lightbench import assets
from lightbench.exact.directions import Array
from lightbench.plan import plan
from lightbench.render import on_gl_thread, renderer
from lightbench.scene import Scene
from lightbench.settings import Setting
from lightbench.shapes import mesh
from tests.support import assert_sound, library

__all__ = [
    "FACTORS", "SIDE", "WHITE", "attachment", "card", "card_mesh", "centres", "decoded", "facing",
    "mapped", "shown", "texture",
]  # fmt: skip

SIDE = 64
Data = dict[str, Any]
WHITE: Data = {"base_color": [1, 1, 1], "metalness": 1, "roughness": 1}
FACTORS: dict[str, Any] = {"base_color": [0.9, 0.8, 0.7], "metalness": 0.6, "roughness": 0.8}


def texture(codes: ArrayLike, **how: object) -> Data:
    """A texture of 8-bit codes (H, W, 1 to 4); a lone colour is one texel."""
    pixels = np.atleast_3d(np.asarray(codes, np.uint8))
    if np.ndim(codes) == 1:
        pixels = pixels.reshape(1, 1, -1)
    stream = io.BytesIO()
    Pillow.fromarray(np.repeat(pixels, 3, 2) if pixels.shape[2] == 1 else pixels).save(
        stream, "PNG"
    )
    return {"image": assets.add_image(stream.getvalue(), keep=False), **how}


def decoded(codes: ArrayLike) -> Array:
    """sRGB codes of 255 as linear values: IEC 61966-2-1."""
    c = np.asarray(codes, np.float64) / 255.0
    return np.where(c <= 0.04045, c / 12.92, ((c + 0.055) / 1.055) ** 2.4)


def facing(**camera: object) -> Data:
    """A parallel view from above of what lies between -1/2 and 1/2."""
    looking = {"eye": [0, 2, 0], "up": [0, 0, -1], "projection": "orthographic", "height": 1}
    return {**looking, **camera}


def card(
    material: Data, textures: Mapping[str, Data] | None = None, shape: Data | None = None,
    **more: Any,
) -> Scene:  # fmt: skip
    """A card of a material that fills the picture, without lights unless given."""
    return Scene.parse(
        {
            "camera": facing(),
            "textures": dict(textures or {}),
            "materials": {"own": material},
            "objects": {"card": {"shape": "plane", "material": "own", **(shape or {})}},
            **more,
        }
    )


def card_mesh(**arrays: Any) -> Data:
    """A card's mesh with other arrays, as a scene's `meshes` has it."""
    given: dict[str, Any] = {n: np.asarray(each, np.float32) for n, each in arrays.items()}
    made = replace(mesh("plane"), **given)
    return {
        "mesh": assets.add_mesh(made, keep=False), "low": [-0.5, 0, -0.5], "high": [0.5, 0, 0.5],
        "colors": made.colors is not None, "uv1": made.uvs1 is not None,
    }  # fmt: skip


def shown(scene: Scene, side: int = SIDE, /, **settings: Setting) -> Array:
    """(side, side, 3) of the linear picture, which is sound."""
    image = lb.render(scene, (side, side), **{"ambient": "none", **settings})
    assert_sound(image)
    return image.linear.astype(np.float64)


def attachment(
    scene: Scene, name: str, size: Sequence[int] = (SIDE, SIDE), **settings: Setting
) -> NDArray[np.float32]:
    """(H, W, 4 or 1), row 0 at the top: all that a pass wrote."""
    planned = plan(library(), scene, settings, (size[0], size[1]), name)
    return np.asarray(on_gl_thread(lambda: renderer().run(planned)).linear)


def centres(side: int = SIDE) -> Array:
    """(side, side, 2) u and v that the pixels' middles see."""
    at = (np.arange(side) + 0.5) / side
    return np.stack(np.meshgrid(at, at), axis=-1)


def mapped(slot: str, name: str = "t", **how: Any) -> dict[str, Any]:
    """A white material with one map."""
    return {**WHITE, "maps": {slot: {"texture": name, **how}}}

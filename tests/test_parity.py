"""One picture: the browser renders what the offline renderer renders, on both ANGLE backends."""

from collections.abc import Callable, Iterator
from contextlib import ExitStack
from functools import cache
from itertools import product
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from playwright.sync_api import Page, sync_playwright

import lightbench as lb
from lightbench import render_plan
from lightbench.compare import compare
from lightbench.image import Image
from lightbench.settings import Resolved, resolve
from tests.browser import BACKENDS, launched, render_in, serving
from tests.support import alternatives, assert_sound, library, planned, presets

# Outlines are a smaller share of a larger picture; that share is what the 99.9 % are about.
SIZE = (480, 360)
# Where every bit must agree, fewer pixels tell as much.
SMALL = (160, 120)
RAYS = {"technique": "whitted", "shadow": "ray"}
# What rays read of these scenes: objects by name or of a list, arrays of images, meshes.
TRACED = ("box-room", "model-room", "normal-maps", "texture-compare", "toon-garden", "shadow-lab")


@pytest.fixture(scope="module")
def address() -> Iterator[str]:
    with serving() as url:
        yield url


@pytest.fixture(scope="module")
def pages(address: str) -> Iterator[Callable[[str], Page]]:
    """The page on either backend, opened once: a parameter of this fixture would open it a test."""
    with ExitStack() as stack:
        playwright = stack.enter_context(sync_playwright())

        @cache
        def opened(backend: str) -> Page:
            page = stack.enter_context(launched(playwright, backend)).new_page()
            page.goto(address)
            page.evaluate("window.lightbench.ready")
            return page

        yield opened


@pytest.fixture(params=list(BACKENDS))
def page(request: pytest.FixtureRequest, pages: Callable[[str], Page]) -> Page:
    return pages(request.param)


def cases() -> Iterator[tuple[str, dict[str, Any]]]:
    for preset in presets():
        yield preset, {}
    yield "box-room", {"model": "phong", "samples": 2}
    for settings in alternatives():
        yield "box-room", dict(settings)
    for settings in (*shadows(), *views(), *surfaces(), *cameras()):
        yield "box-room", settings
    for settings in rays():
        yield "lab/reflectance2", settings
    for scene in TRACED:
        yield scene, dict(RAYS)
    yield "box-room", {**both({"transmittance": 0.6, "ior": 1.3}), **RAYS, "max_bounces": 3}
    yield "box-room", {**both({"alpha_mode": "blend", "opacity": 0.4}), **RAYS}
    yield "model-room", {"shadow": "ray"}
    yield "single-sphere", {"outline": "sobel_depth"}
    yield "model-room", {"view": "base_color", "anisotropy": 1}
    yield "normal-maps", {"view": "normal"}


def shadows() -> Iterator[dict[str, Any]]:
    menu = library()
    for shadow, bias in product(menu.choices("shadows"), menu.choices("biases")):
        if shadow != "none":
            yield {"shadow": shadow, "bias": bias}
    yield {"shadow": "hard", "lights.lamp.casts": False, "lights.spot.outer": 80}
    yield {"shadow": "hard", "lights.lamp.far": 2.5}


def views() -> Iterator[dict[str, Any]]:
    """Of shadows, of every light's map; and one that is signed, over several samples."""
    yield {"view": "shadow", "shadow": "pcf"}
    yield {"view": "normal", "samples": 2}
    for light in range(3):
        yield {"view": "light_depth", "shadow": "hard", "depth_light": light}


def surfaces() -> Iterator[dict[str, Any]]:
    """Transparency and what a material may be, each on the two shapes in the middle of the room."""
    glass = {"alpha_mode": "blend", "opacity": 0.4, "double_sided": True}
    for fields in (
        glass,
        {"alpha_mode": "mask", "opacity": 0.4, "alpha_cutoff": 0.5},
        {"model": "phong", "emissive": [0.2, 0.3, 0.1]},
        {"unlit": True},
    ):
        yield both(fields)
    yield {**both(glass), "shadow": "hard"}
    yield {**both(glass), "outline": "sobel"}
    yield {**both(glass), "view": "overdraw"}


def rays() -> Iterator[dict[str, Any]]:
    """Triangles and mirrored cameras drawn object by object, and what a traced picture may be."""
    yield {"technique": "raster", "shadow": "hard"}
    yield {"technique": "raster", "camera.mirrored": False, "camera.fov_of": "height"}
    yield {"max_bounces": 4, "samples": 2, "camera.projection": "orthographic", "camera.height": 9}
    yield {"camera.light": "lamp", "objects.red_ball.scale": [1, 2, 1]}


def both(fields: dict[str, Any]) -> dict[str, Any]:
    return {f"materials.{m}.{k}": v for m in ("cube", "sphere") for k, v in fields.items()}


def cameras() -> Iterator[dict[str, Any]]:
    yield {"camera.projection": "orthographic", "camera.height": 4, "outline": "sobel"}
    for light in ("lamp", "spot", "window"):
        yield {"camera.light": light}


def check(page: Page, scene: str, settings: dict[str, Any], size: tuple[int, int] = SIZE) -> None:
    linear, display, renderer = render_in(page, scene, settings, size)
    offline = lb.render(scene, size, **settings)
    assert_sound(offline)
    # The same rasteriser must agree in every bit; a difference is one between our two runtimes.
    if "llvmpipe" in renderer and "llvmpipe" in offline.renderer:
        assert np.array_equal(linear, offline.linear)
        assert np.array_equal(display, offline.display)
        return
    resolved = resolve(library(), lb.load(scene), settings)
    if resolved.scene.textures:
        assert_filtered(display, offline)
    elif not has_edges(resolved):
        assert_alike(display, offline)
    elif resolved.choices["shadow"] != "none" and resolved.choices["bias"] == "constant":
        # A lit surface is compared with itself, to the last bit: the stripes lie where they may.
        assert abs(float(display.mean()) - float(offline.display.mean())) < 2
    else:
        assert_alike(display, offline, edges=8)


def has_edges(resolved: Resolved) -> bool:
    """Whether there are more outlines than those of objects: of shadows, of what is behind."""
    materials = resolved.scene.materials.values()
    seen = {setting: resolved.choices[setting] for setting in ("shadow", "outline", "view")}
    plain = seen == {"shadow": "none", "outline": "none", "view": "final"}
    return not plain or any(material.alpha_mode == "blend" for material in materials)


def assert_alike(display: NDArray[np.uint8], offline: Image, edges: int = 1) -> None:
    """Equal but for single codes, and for outlines that fall on the next pixel.

    Beside an outline a pixel may hold the other side of it, shaded one pixel further on; in a
    smooth place its neighbours span a few codes, and so may it. With `edges` times as many outlines
    some may be a texel of a light's map further on, which is more than a pixel, and those are more
    than the hundredth of the pixels that the gate of FLIP leaves out.
    """
    difference = compare(display, offline.display)
    assert difference.share_above_one <= edges * 1e-3, difference
    assert difference.flip_mean <= 0.02, difference
    assert difference.flip_p99 <= (0.05 if edges == 1 else 0.15), difference
    low, high = neighbours(offline.display)
    span = high - low + 1
    beyond = ((display < low - span) | (display > high + span)).any(axis=-1)
    assert beyond.mean() <= (0 if edges == 1 else 1e-3), beyond.sum()


def assert_filtered(display: NDArray[np.uint8], offline: Image) -> None:
    """Equal but for how a driver filters textures, which is its own: in the mean over 12 pixels."""
    difference = np.abs(blocks(display) - blocks(offline.display)).max(axis=-1)
    assert difference.mean() <= 1.0, difference.mean()
    assert np.percentile(difference, 99) <= 3.0, np.percentile(difference, 99)
    assert np.percentile(difference, 99.9) <= 6.0, np.percentile(difference, 99.9)


def blocks(display: NDArray[np.uint8]) -> NDArray[np.float64]:
    """(H / 12, W / 12, 3) means."""
    height, width, _ = display.shape
    means = display.reshape(height // 12, 12, width // 12, 12, 3).mean(axis=(1, 3))
    return np.asarray(means, np.float64)


def neighbours(display: NDArray[np.uint8]) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Least and largest code of each pixel's 3 x 3 neighbourhood, per channel."""
    padded = np.pad(display.astype(int), ((1, 1), (1, 1), (0, 0)), mode="edge")
    windows = np.lib.stride_tricks.sliding_window_view(padded, (3, 3), axis=(0, 1))
    return windows.min(axis=(3, 4)), windows.max(axis=(3, 4))


def pictures() -> Iterator[tuple[str, str, dict[str, Any]]]:
    """Every case on the rasteriser that must agree in every bit.

    On the other one, what rasterisers may see differently: not each formula once more.
    """
    for scene, settings in cases():
        yield "llvmpipe", scene, settings
    for preset in presets():
        yield "swiftshader", preset, {}
    for settings in (*list(shadows())[1::4], *views(), *surfaces(), *cameras(), RAYS):
        yield "swiftshader", "box-room", settings
    for scene in ("shadow-lab", "toon-garden", "model-room", "normal-maps", "texture-compare"):
        yield "swiftshader", scene, dict(RAYS)


@pytest.mark.parametrize(("backend", "scene", "settings"), list(pictures()), ids=str)
def test_same_picture(
    pages: Callable[[str], Page], backend: str, scene: str, settings: dict[str, Any]
) -> None:
    check(pages(backend), scene, settings, SMALL if backend == "llvmpipe" else SIZE)


def test_same_sources(page: Page) -> None:
    """Byte for byte, what the browser compiles is what moderngl compiles."""
    for scene, settings in cases():
        made = page.evaluate(
            "([s, o, z]) => window.lightbench.plan(s, o, z)", [scene, settings, list(SIZE)]
        )
        expected = planned(scene, settings, SIZE)
        for ours, theirs in zip(expected["programs"], made["programs"], strict=True):
            assert ours["vertex"] == theirs["vertex"]
            assert ours["fragment"] == theirs["fragment"]


def test_a_missing_highlight_would_be_seen() -> None:
    """The gates above tell pictures apart that differ by one lobe."""
    rough = lb.render("single-sphere", SIZE, model="lambert").display
    with pytest.raises(AssertionError):
        assert_alike(rough, lb.render("single-sphere", SIZE))


def test_a_wrong_texture_would_be_seen() -> None:
    """The gate of filtered textures tells flat normals and unfiltered light apart."""
    right = lb.render("normal-maps", SIZE)
    materials = lb.load("normal-maps").materials
    flat = {f"materials.{name}.normal_scale": 0 for name in materials}
    with pytest.raises(AssertionError):
        assert_filtered(lb.render("normal-maps", SIZE, **flat).display, right)
    with pytest.raises(AssertionError):
        assert_filtered(right.display[:, ::-1], right)


@pytest.mark.parametrize("name", ["shadow_map.0", "shadow_map.1", "shadow_map.2", "radiance"])
def test_same_attachment(page: Page, name: str) -> None:
    settings: dict[str, Any] = {"shadow": "hard", "shadow_resolution": 256}
    linear, _, renderer = render_in(page, "box-room", settings, (64, 48), name)
    offline = render_plan(lb.load("box-room"), (64, 48), settings, name)
    assert linear.shape == offline.linear.shape
    if "llvmpipe" in renderer and "llvmpipe" in offline.renderer:
        assert np.array_equal(linear, offline.linear)
    else:
        assert np.isclose(linear, offline.linear, rtol=1e-2, atol=1e-3).mean() >= 0.97

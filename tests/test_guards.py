"""What files promise where no preset and no random sample goes: guards, floors, rare branches.

Each of these was found missing by breaking the shaders: see test_mutations.py.
"""
# ruff: noqa: E741  (l is the direction to the light)

import math
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

import lightbench as lb
from lightbench.exact.directions import Array, unit
from lightbench.glsl import call
from lightbench.image import Image
from tests import samples, support
from tests.samples import Single, evaluate, single
from tests.support import assert_sound, copy_of_shaders, library

GRAZING_COS, VISIBILITY_FLOOR = 1e-7, 1e-14  # lib/constants.glsl
ROOM, SIZE = "box-room", (64, 48)
TITLE = '/*---\ntitle = "Dropped in"\n---*/\n'
UP = single([[0.0, 0.0, 1.0]])
ASIDE = single([[0.6, 0.0, 0.8]])
DOWN = single([[0.6, 0.0, -0.8]])
FLAT = single([[1.0, 0.0, 0.0]])
AWAY = single([[-1.0, 0.0, 0.0]])
MASKINGS = [name for name in library().stable("maskings") if name != "none"]


def masked(name: str, function: str, *given: Any, alpha: float = 0.3) -> float:
    """G or visibility of l, v and h."""
    path = f"maskings/{name}.glsl"
    return float(evaluate(path, function, (*given, single([alpha])), {})[0])


# Below the horizon, and on it


def test_a_grazing_cosine_is_none_to_the_lab() -> None:
    """Up to 0.001, n.l ends all light and n.h the highlight: kd n.l + ks, where s is 0."""
    m = {name: row[:1] for name, row in samples.material([0.5], [0.0]).items()}
    kd, ks = m["kd"].astype(np.float64), m["ks"].astype(np.float64)

    def lit(l: Any, v: Any) -> Array:
        return evaluate("models/lab.glsl", "brdfCos", (m, single(l), single(v)), {})

    low, high = np.array([[5e-4], [9.9e-4], [1e-3]]), np.array([[1.01e-3], [1.5e-3], [0.1]])
    for cosine, want in ((low, 0.0 * ks), (high, kd * high + ks)):
        l = np.hstack([np.sqrt(1.0 - cosine**2), 0.0 * cosine, cosine])
        np.testing.assert_allclose(lit(l, UP) - want, 0.0, atol=1e-6)
    # Seen from below, just so that n.h is that cosine.
    l = np.array([[0.8, 0.0, 0.6]])
    for half, want in ((low, kd * 0.6), (high, kd * 0.6 + ks)):
        h = np.hstack([np.sqrt(1.0 - half**2), 0.0 * half, half])
        v = 2.0 * (h @ l.T) * h - l
        kept = np.abs(half[:, 0] - 1e-3) > 1e-6
        found = lit(np.broadcast_to(l, v.shape), v)[kept]
        np.testing.assert_allclose(found, np.broadcast_to(want, found.shape), rtol=1e-6)


@pytest.mark.parametrize("name", MASKINGS)
def test_nothing_is_seen_below_the_horizon(name: str) -> None:
    for function in ("masking", "visibility"):
        for l, v in ((DOWN, UP), (UP, DOWN), (DOWN, DOWN), (DOWN, ASIDE), (ASIDE, DOWN)):
            assert masked(name, function, l, v, UP) == 0.0, function
    for l, v in ((FLAT, UP), (UP, FLAT), (FLAT, AWAY)):
        assert masked(name, "masking", l, v, UP) == 0.0


def test_facets_that_face_down_are_in_no_groove() -> None:
    across = single([[-0.8, 0.0, 0.6]])
    assert masked("cook_torrance", "masking", FLAT, ASIDE, across) == 0.0
    for function in ("masking", "visibility"):
        assert masked("cook_torrance", function, ASIDE, ASIDE, DOWN) == 0.0
        assert masked("cook_torrance", function, ASIDE, ASIDE, AWAY) == 0.0


# Finite in truth; what is not is a small number over VISIBILITY_FLOOR.
BOTH_GRAZE = {
    "smith_ggx_uncorrelated": 1.0 / 0.3**2,
    "smith_beckmann_uncorrelated": (3.535 / 0.3 / 2.0) ** 2,
}


@pytest.mark.parametrize("name", MASKINGS)
def test_visibility_on_both_horizons_is_finite(name: str) -> None:
    for v in (FLAT, AWAY):
        got = masked(name, "visibility", FLAT, v, UP)
        limits = [BOTH_GRAZE[name]] if name in BOTH_GRAZE else [k * 1e14 for k in (0.25, 0.5, 1.0)]
        assert any(got == pytest.approx(limit, rel=1e-5) for limit in limits), got


@pytest.mark.parametrize("name", library().stable("distributions"))
def test_no_facet_stands_upright(name: str) -> None:
    """D is 0 on the horizon at any width, those included that have an even spread."""
    for alpha in samples.ALPHAS:
        path, arguments = f"distributions/{name}.glsl", (FLAT, single([alpha]))
        assert evaluate(path, "distribution", arguments, {}) == 0.0


@pytest.mark.parametrize(
    ("path", "function", "limit"),
    [
        ("lib/lambda_ggx.glsl", "lambdaGgx", 0.5),
        ("lib/lambda_beckmann.glsl", "lambdaBeckmann", 1.0 / 3.535),
        ("lib/lambda_beckmann_exact.glsl", "lambdaBeckmannExact", 0.5 / math.sqrt(math.pi)),
    ],
)
def test_lambda_on_the_horizon_is_that_of_the_lowest_cosine(
    path: str, function: str, limit: float
) -> None:
    got = evaluate(path, function, (FLAT, single([0.3])), {})
    assert got == pytest.approx(0.3 * limit / GRAZING_COS, rel=1e-5)


# Rounding


def test_a_cosine_above_one_is_no_negative_light() -> None:
    over = single([np.nextafter(np.float32(1.0), np.float32(2.0))])
    m = samples.material([0.5], [1.0]) | {"f0": single([[0.0, 0.04, 1.0]])}
    for name in library().stable("fresnels"):
        F = evaluate(f"fresnels/{name}.glsl", "fresnel", (m, over), {})
        assert (F >= 0.0).all()
        assert (F <= 1.0 + 1e-6).all()


def test_log1p_keeps_its_digits() -> None:
    """Within 2e-7 of the truth in its range, as its file says."""
    x = single([*np.linspace(-0.25, 0.25, 20_001), *np.geomspace(1e-30, 0.25, 500)])
    want = np.log1p(x.astype(np.float64))
    got = evaluate("lib/log1p.glsl", "log1p", (x,), {})
    zero = want == 0.0
    assert not got[zero].any()
    assert np.abs(got[~zero] / want[~zero] - 1.0).max() < 2.05e-7


@pytest.mark.parametrize("name", library().stable("transfers"))
def test_no_code_is_above_white(name: str) -> None:
    top = single(1.0 - np.arange(5000) * 2.0**-24)
    code = evaluate(f"transfers/{name}.glsl", "transfer", (np.stack([top] * 3, axis=1),), {})
    assert code.max() == 1.0


# Spheres that are neither at the origin nor of radius 1

SPHERES = ("lib/sphere.glsl", "lib/sphere_textbook.glsl")
# Textbook forms are held to what test_textbook.py asks of them.
CLOSE = {SPHERES[0]: 1e-5, SPHERES[1]: 1e-3}


def first_hit(origin: Array, direction: Array, centre: Array, radius: Array) -> Array:
    """The smaller positive root of |o + t d - c|^2 = r^2, or -1."""
    f = origin - centre
    b, c = np.sum(f * direction, axis=1), np.sum(f * f, axis=1) - radius**2
    root = np.sqrt(np.maximum(b * b - c, -1.0).astype(complex))
    near, far = -b - root.real, -b + root.real
    found = np.where(near > 0.0, near, np.where(far > 0.0, far, -1.0))
    return np.where(b * b < c, -1.0, found)


@pytest.mark.parametrize("path", SPHERES)
def test_a_sphere_anywhere(path: str) -> None:
    """From outside and inside, towards it and away, past it: no ray that all but grazes it."""
    random = np.random.default_rng(6)
    count = 4000
    centre = random.uniform(-3.0, 3.0, (count, 3))
    radius = random.uniform(0.1, 3.0, count)
    out = unit(random.normal(size=(count, 3)))
    side = unit(np.cross(out, random.normal(size=(count, 3))))
    share = np.concatenate(
        [random.uniform(0.0, 0.98, count // 2), random.uniform(1.02, 2, count // 2)]
    )
    away = radius * np.concatenate([random.uniform(-0.9, 0.9, 1000), random.uniform(-9, 9, 3000)])
    origin = centre + (side * share[:, None] * radius[:, None]) + out * away[:, None]
    given = tuple(single(x) for x in (origin, out, centre, radius))
    want = first_hit(*samples.doubled(given))
    # On the surface itself the answer is either side's.
    sharp = np.abs(np.linalg.norm(origin - centre, axis=1) / radius - 1.0) > 0.01
    got = evaluate(path, "sphereHit", given, {})
    assert (got[sharp & (want < 0.0)] == -1.0).all()
    hit = sharp & (want > 0.0)
    assert 1000 < hit.sum() < 3500
    assert got[hit] == pytest.approx(want[hit], rel=CLOSE[path])


@pytest.mark.parametrize("path", SPHERES)
def test_a_sphere_touched(path: str) -> None:
    """By a ray that passes it; from a point on it, its other side; from its middle plane."""
    origins = single([[-3.0, 1.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 0.5, 0.0], [0.0, 0.0, 0.0]])
    x, middle, one = single([[1.0, 0.0, 0.0]]), single([[0.0, 0.0, 0.0]]), single([1.0])
    got = evaluate(path, "sphereHit", (origins, x, middle, one), {})
    assert got == pytest.approx([3.0, 2.0, math.sqrt(0.75), 1.0], rel=1e-6)
    assert evaluate(path, "sphereHit", (single([[1.0, 0.0, 0.0]]), x, middle, one), {}) <= 0.0


def test_the_textbook_sphere_takes_any_direction() -> None:
    """Distances are in lengths of it; on the surface, outwards, it finds nothing."""
    x, middle, one = single([[2.0, 0.0, 0.0]]), single([[0.0, 0.0, 0.0]]), single([1.0])
    origins = single([[-3.0, 0.5, 0.0], [0.0, 0.5, 0.0], [1.0, 0.0, 0.0], [-3.0, 1.01, 0.0]])
    got = evaluate(SPHERES[1], "sphereHit", (origins, x, middle, one), {})
    half = math.sqrt(0.75)
    assert got == pytest.approx([(3.0 - half) / 2.0, half / 2.0, -1.0, -1.0], rel=1e-6)


# Parameters that no other test sets


def test_a_point_of_a_light_is_a_tenth_of_a_millimetre() -> None:
    """Below the slider's lowest radius too: 1e30 cd stay finite."""
    light = {"intensity": UP, "light_radius": single([0.0])}
    for distance, want in ((0.0, 1e8), (1e-5, 1e8), (2e-4, 2.5e7)):
        given = (single([distance]), light)
        got = evaluate("attenuations/inverse_square.glsl", "attenuation", given, {})
        assert got == pytest.approx(want, rel=1e-6)


def test_ambient_light_has_its_colour() -> None:
    m = samples.material([0.5], [1.0])
    settings = {"ambient_color": [0.5, 0.25, 2.0], "ambient_level": 3.0}
    got = evaluate("ambients/constant.glsl", "ambient", (m,), settings)
    assert got == pytest.approx(m["base_color"] * [1.5, 0.75, 6.0], rel=1e-6)


@pytest.mark.parametrize("name", library().stable("tonemaps"))
def test_what_has_no_tone_stays_as_it_is(name: str) -> None:
    odd = single([[-3.0, -2.0, 0.5], [0.0, 0.0, 0.0], [math.inf, 2.0, 0.25], [math.inf] * 3])
    got = evaluate(f"tonemaps/{name}.glsl", "tonemap", (odd,), {})
    assert np.array_equal(got, odd)


# Files without what is optional


def code_of(path: str) -> str:
    """A file of the folder under test."""
    return (support.SHADERS / path).read_text()


def without(path: str, name: str) -> str:
    """A file of the folder with a function of it called otherwise: an optional one is gone."""
    text = code_of(path)
    assert f" {name}(" in text
    return text.replace(f" {name}(", f" {name}Hidden(")


def facets(shaders: Path, masking: str, l: Single, v: Single) -> NDArray[np.float32]:
    """The metal's brdf under a masking."""
    m = samples.material([0.5], [1.0]) | {"metalness": single([1.0])}
    fields = {name: m[name] for name in ("base_color", "metalness", "roughness", "f0")}
    file, settings = "models/cook_torrance.glsl", {"masking": masking}
    return call(file, "brdf", fields, l, v, settings=settings, shaders=shaders)


def test_a_masking_without_visibility(tmp_path: Path) -> None:
    """Divided by the cosines, none below GRAZING_COS, at which Lambda is held too: the same."""
    dropped = {"maskings/plain.glsl": without("maskings/smith_ggx.glsl", "visibility")}
    shaders = copy_of_shaders(tmp_path, dropped)
    l, v = samples.around(0.05, 2), samples.around(0.05, 3)
    want = facets(shaders, "smith_ggx", l, v)
    assert facets(shaders, "plain", l, v) == pytest.approx(want, rel=1e-5)
    low = single([[1.0, 0.0, 1e-9]])
    for l, v in ((low, ASIDE), (ASIDE, low)):
        want = facets(shaders, "smith_ggx", l, v)
        assert facets(shaders, "plain", l, v) == pytest.approx(want, rel=1e-4)


def picture(
    folder: Path, patch: pytest.MonkeyPatch, files: Mapping[str, str], **given: Any
) -> Image:
    """The box room with files dropped into the shader folder."""
    patch.setenv("LIGHTBENCH_SHADERS", str(copy_of_shaders(folder, files)))
    return lb.render(ROOM, SIZE, **given)


def test_a_model_without_its_cosine(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The pass multiplies brdf by it: Phong's looks as it does with its own."""
    dropped = {"models/plain.glsl": without("models/phong.glsl", "brdfCos")}
    want = picture(tmp_path, monkeypatch, dropped, model="phong").linear
    got = lb.render(ROOM, SIZE, model="plain").linear
    np.testing.assert_allclose(got, want, rtol=1e-5, atol=1e-7)


def test_a_model_that_does_not_ask_where_light_comes_from(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The pass leaves out light from below the horizon, by which the cosine would be negative."""
    code = "vec3 brdf(Material m, vec3 l, vec3 v) { return vec3(0.25); }"
    dropped = {"models/mist.glsl": TITLE + '#include "lib/material.glsl"\n' + code}
    image = picture(tmp_path, monkeypatch, dropped, model="mist", ambient="none")
    assert_sound(image)
    lambert = lb.render(ROOM, SIZE, model="lambert", ambient="none").linear
    assert np.array_equal(image.linear > 0.0, lambert > 0.0)


def test_a_shadow_takes_its_share(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    code = "float shadow(int light, Receiver r) { return 0.25; }"
    shadow = {"shadows/dim.glsl": TITLE + '#include "lib/receiver.glsl"\n' + code}
    image = picture(tmp_path, monkeypatch, shadow, shadow="dim", ambient="none")
    assert np.array_equal(image.linear, lb.render(ROOM, SIZE, ambient="none").linear * 0.25)


def test_an_invalid_sample_is_not_averaged_away(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """One of four is negative, and the pixel is that one."""
    code = "return mod(gl_FragCoord.x, 2.0) < 1.0 ? vec3(9.0, 8.0, 7.0) : vec3(-1.0, 2.0, 3.0);"
    code = f'#include "lib/material.glsl"\nvec3 ambient(Material m) {{ {code} }}'
    image = picture(
        tmp_path, monkeypatch, {"ambients/odd.glsl": TITLE + code},
        ambient="odd", samples=2, **{f"lights.{n}.intensity": 0.0 for n in lb.load(ROOM).lights},
    )  # fmt: skip
    assert (image.linear == [-1.0, 2.0, 3.0]).all()
    assert image.invalid().negative == image.linear[..., 0].size

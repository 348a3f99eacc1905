"""Fresnel terms against each other and against what is known of metals."""

import math

import numpy as np
import pytest

from lightbench.exact import Array
from lightbench.exact.facets import FRESNELS
from lightbench.scene import Object, Scene
from lightbench.scene_surfaces import Material
from lightbench.values import F0_MAX, draw_values
from tests import samples
from tests.samples import Single, evaluate, single

# Complex indices for 650, 550 and 450 nm: gold and copper by the Brendel-Bormann model of Rakic et
# al. 1998, iron by Johnson & Christy 1974; and how far Schlick's curve leaves the exact one.
METALS = {
    "gold": ((0.18299, 0.42108, 1.3734), (3.4242, 2.3459, 1.7704), 0.022),
    "copper": ((0.27105, 0.67693, 1.3164), (3.6092, 2.6248, 2.2921), 0.038),
    "iron": ((2.9114, 2.9497, 2.5845), (3.0893, 2.9318, 2.7670), 0.178),
}
COSINES = np.cos(np.radians(np.linspace(0.0, 90.0, 901)))


def fresnel(name: str, cosine: Array | Single, **fields: Single) -> Array:
    """The shader's reflectance of a material of which only some fields matter."""
    m = samples.material([0.5], [1.0]) | fields
    return evaluate(f"fresnels/{name}.glsl", "fresnel", (m, single(cosine)), {})


def at_normal(eta: Array, k: Array) -> Array:
    """((eta - 1)^2 + k^2) / ((eta + 1)^2 + k^2)."""
    return np.asarray(((eta - 1.0) ** 2 + k**2) / ((eta + 1.0) ** 2 + k**2))


@pytest.mark.parametrize("name", METALS)
def test_a_metal_is_what_was_measured(name: str) -> None:
    eta, k, _ = METALS[name]
    got = fresnel("conductor", COSINES, eta=single([eta]), k=single([k]))
    fields = {"eta": np.array([eta]), "k": np.array([k])}
    assert got == pytest.approx(FRESNELS["conductor"](fields, COSINES), rel=1e-5)
    assert got[0] == pytest.approx(at_normal(np.array(eta), np.array(k)), rel=1e-6)
    assert got[-1] == pytest.approx(1.0, abs=1e-5)


@pytest.mark.parametrize("name", METALS)
def test_by_how_much_schlick_leaves_a_metal(name: str) -> None:
    eta, k, most = METALS[name]
    exact = fresnel("conductor", COSINES, eta=single([eta]), k=single([k]))
    schlick = fresnel("schlick", COSINES, f0=single(exact[:1]))
    worst = np.abs(schlick - exact).max()
    assert 0.98 * most < worst < most


def test_a_conductor_without_extinction_is_a_dielectric() -> None:
    for f0 in (0.0, 1e-6, 0.02, 0.04, 0.17, 0.5, 0.9):
        eta = (1.0 + math.sqrt(f0)) / (1.0 - math.sqrt(f0))
        metal = fresnel("conductor", COSINES, eta=single([[eta] * 3]), k=single([[0.0] * 3]))
        clear = fresnel("dielectric", COSINES, f0=single([[f0] * 3]))
        # The index rounded to float32 is that of another reflectance.
        assert metal == pytest.approx(clear, rel=1e-5, abs=1e-7), f0


def test_a_faint_extinction_changes_as_little() -> None:
    eta = single([[1.0, 1.33, 2.4]])
    clear = fresnel("conductor", COSINES, eta=eta, k=single([[0.0] * 3]))
    for k in (1e-12, 1e-7, 1e-5):
        faint = fresnel("conductor", COSINES, eta=eta, k=single([[k] * 3]))
        assert faint[:-10] == pytest.approx(clear[:-10], abs=200.0 * k + 1e-7)


def test_a_thinner_medium_reflects_all_light_beyond_its_angle() -> None:
    eta = np.array([0.2, 0.5, 0.9])
    cosine = np.sqrt(1.0 - eta**2)[:, None] * np.linspace(0.0, 0.999, 200)
    for i, beyond in enumerate(cosine):
        got = fresnel("conductor", beyond, eta=single([eta]), k=single([[0.0] * 3]))
        assert got[:, i] == pytest.approx(1.0, abs=1e-6)


# The index that follows from a reflectance and a metalness


def uniforms(**fields: object) -> dict[str, Array]:
    """What a scene gives to the shader for a material."""
    scene = Scene.parse({"materials": {"m": fields}, "objects": {}})
    values = draw_values(scene, Object(shape="cube", material="m"), (0, 0, 0))
    return {name.removeprefix("u_"): np.array(value) for name, value in values.items()}


@pytest.mark.parametrize("metalness", [0.0, 1e-3, 0.25, 0.5, 0.9, 1.0])
def test_a_derived_index_reflects_f0(metalness: float) -> None:
    for level in (0.0, 1e-4, 0.04, 0.3, 0.7, 0.95, 0.998, F0_MAX):
        given = uniforms(
            base_color=[level, level, level], f0=[level, level, level], metalness=metalness
        )
        assert at_normal(given["eta"], given["k"]) == pytest.approx(level, abs=1e-6)
        normal = fresnel(
            "conductor", single([1.0]), eta=single([given["eta"]]), k=single([given["k"]])
        )
        assert normal == pytest.approx(level, abs=1e-4)
        if metalness == 0.0:
            assert not given["k"].any()


def test_a_perfect_mirror_has_the_index_of_a_good_one() -> None:
    for metalness in (0.0, 0.3, 1.0):
        given = uniforms(base_color=[1, 1, 1], f0=[1, 1, 1], metalness=metalness)
        assert at_normal(given["eta"], given["k"]) == pytest.approx(F0_MAX, abs=1e-6)
        arguments = single([[1.0, 1.0, 1.0]]), single([metalness])
        got = [
            evaluate("lib/conductor.glsl", f"{name}Of", arguments, {})[0] for name in ("eta", "k")
        ]
        assert at_normal(*got) == pytest.approx(F0_MAX, abs=1e-6)


def test_the_shader_derives_the_index_that_the_scene_does() -> None:
    random = np.random.default_rng(3)
    for metalness in (0.0, 0.5, 1.0, *random.uniform(0.0, 1.0, 20)):
        given = uniforms(
            base_color=list(random.uniform(0.0, 1.0, 3)),
            f0=[*(random.uniform(0.0, 1.0, 2) ** 4), 1.0],
            metalness=metalness,
        )
        arguments = single([given["f0"]]), single([metalness])
        for function in ("eta", "k"):
            got = evaluate("lib/conductor.glsl", f"{function}Of", arguments, {})
            # The reflectance was rounded to float32 on its way.
            assert got[0] == pytest.approx(given[function], rel=6e-5), (function, metalness)


def test_a_given_index_is_used() -> None:
    given = uniforms(base_color=[1, 0, 0], metalness=1, eta=[0.2, 0.4, 1.4], k=[3, 2, 1])
    assert given["eta"] == pytest.approx([0.2, 0.4, 1.4])
    assert given["k"] == pytest.approx([3.0, 2.0, 1.0])


def test_an_index_is_whole() -> None:
    for field in ("eta", "k"):
        with pytest.raises(ValueError, match="give both eta and k, or neither"):
            Material.model_validate({field: [1, 1, 1]})

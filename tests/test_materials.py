"""The material library: its values hold, agree with each other and reach the picture."""

import itertools
import json
import math
from pathlib import Path

import numpy as np
import pytest

import lightbench as lb
from lightbench import options
from lightbench.errors import SceneError
from lightbench.exact import models
from lightbench.exact.directions import Array
from lightbench.materials import FIELDS, LibraryMaterial, materials
from lightbench.scene import Object, Scene
from lightbench.scene_surfaces import Material
from lightbench.settings import Setting, resolve
from lightbench.values import draw_values
from tests.support import SCENES, assert_sound, library, planned
from tests.test_laws import CONSERVED, even, view_direction

MATERIALS = materials()
METALS = [name for name, each in MATERIALS.items() if each.metalness == 1.0]
CLEAR = [name for name, each in MATERIALS.items() if each.metalness == 0.0]
OLD = ("phong", "blinn_phong")
# Akenine-Moller et al. 2018, Real-Time Rendering, table 9.2: colours integrated over the spectrum.
PUBLISHED = {
    "gold": (1.0, 0.782, 0.344), "copper": (0.955, 0.638, 0.538), "iron": (0.562, 0.565, 0.578),
    "silver": (0.972, 0.960, 0.915), "aluminium": (0.913, 0.922, 0.924),
    "titanium": (0.542, 0.497, 0.449), "chromium": (0.549, 0.556, 0.554),
    "nickel": (0.660, 0.609, 0.526), "platinum": (0.673, 0.637, 0.585),
    "brass": (0.910, 0.778, 0.423),
}  # fmt: skip


def scene(**fields: object) -> Scene:
    """A cube of a material, before a lamp."""
    return Scene.parse(
        {
            "materials": {"left": fields},
            "objects": {"cube": {"shape": "cube", "material": "left"}},
            "lights": {"lamp": {"type": "point", "position": [1, 2, 4], "intensity": 100}},
        }
    )


def uniforms(name: str) -> dict[str, Array]:
    """What the shader gets for a library material."""
    there = scene(library=name)
    values = draw_values(there, Object(shape="cube", material="left"), (0, 0, 0))
    return {field.removeprefix("u_"): np.array([value]) for field, value in values.items()}


def test_what_there_is() -> None:
    assert {"gold", "copper", "iron", "silver", "aluminium", "glass", "water", "plastic"} <= set(
        MATERIALS
    )
    assert len(METALS) >= 12
    assert len(CLEAR) >= 12
    assert sorted([*METALS, *CLEAR]) == sorted(MATERIALS)


@pytest.mark.parametrize("name", MATERIALS)
def test_a_material_is_one_of_a_scene(name: str) -> None:
    each = MATERIALS[name]
    assert each.title
    assert each.source
    made = Material.model_validate({"library": name})
    assert made.library == name
    for field, value in each.values().items():
        got = getattr(made, field)
        assert (list(got) if isinstance(got, tuple) else got) == value, field


@pytest.mark.parametrize("name", METALS)
def test_a_metal_has_the_reflectance_of_its_index(name: str) -> None:
    each = MATERIALS[name]
    eta, k = np.array(each.eta), np.array(each.k)
    normal = ((eta - 1.0) ** 2 + k**2) / ((eta + 1.0) ** 2 + k**2)
    assert each.base_color == pytest.approx(normal, abs=1e-3)
    assert uniforms(name)["f0"][0] == pytest.approx(normal, abs=1e-3)


@pytest.mark.parametrize("name", PUBLISHED)
def test_a_metal_is_near_its_published_colour(name: str) -> None:
    assert MATERIALS[name].base_color == pytest.approx(PUBLISHED[name], abs=0.1)


@pytest.mark.parametrize("name", CLEAR)
def test_a_dielectric_has_the_reflectance_of_its_index(name: str) -> None:
    ior = MATERIALS[name].ior
    assert ior is not None
    values = uniforms(name)
    assert values["f0"] == pytest.approx(((ior - 1.0) / (ior + 1.0)) ** 2, rel=1e-6)
    # The index that the exact terms use is that one again, and clear.
    assert values["eta"] == pytest.approx(ior, rel=1e-6)
    assert not values["k"].any()


@pytest.mark.parametrize("name", MATERIALS)
def test_nothing_sends_back_more_than_comes(name: str) -> None:
    """Of light along the normal, within which the classic highlight too keeps, without a norm."""
    v, solid = even(300)
    values = uniforms(name)
    normal = np.broadcast_to(view_direction(1.0), v.shape)
    for model in (models.cook_torrance_cos, models.blinn_phong_cos):
        sent = np.sum(model(values, normal, v) * v[:, 2:] * solid[:, None], axis=0)
        assert (sent <= CONSERVED).all(), (model.__name__, sent)


@pytest.mark.parametrize(("name", "model"), list(itertools.product(METALS, OLD)))
def test_the_models_look_alike(name: str, model: str) -> None:
    """Phong's with a quarter of the shininess: the middle of the pictures is as bright."""
    shininess = MATERIALS[name].shininess
    assert shininess is not None
    own: dict[str, Setting] = (
        {"materials.left.shininess": shininess / 4} if model == "phong" else {}
    )
    there = scene(library=name)
    ball = there.model_copy(update={"objects": {"ball": Object(shape="sphere", material="left")}})
    want = lb.render(ball, (64, 64), ambient="none", model="cook_torrance").linear
    got = lb.render(ball, (64, 64), ambient="none", model=model, **own).linear
    tone = np.power([x / (1.0 + x) for x in (want, got)], 1 / 2.2)
    assert math.sqrt(np.mean((tone[0] - tone[1]) ** 2)) < 0.04
    assert np.abs(tone[0].mean(axis=(0, 1)) - tone[1].mean(axis=(0, 1))).max() < 0.02


# In a scene


def test_given_values_stand_above() -> None:
    made = scene(library="gold", roughness=0.9, kd=None).materials["left"]
    assert made.roughness == 0.9
    assert made.kd is None
    assert made.base_color == MATERIALS["gold"].base_color


def test_a_given_reflectance_takes_the_place_of_the_index() -> None:
    made = scene(library="glass", f0=[0.1, 0.1, 0.1]).materials["left"]
    assert made.f0 == (0.1, 0.1, 0.1)
    assert made.ior is None


def test_a_parsed_scene_keeps_what_it_has() -> None:
    there = scene(library="glass", roughness=0.7)
    assert Scene.parse(there.data()) == there
    data = json.loads(json.dumps(there.data()))
    assert data["materials"]["left"]["base_color"] == list(MATERIALS["glass"].base_color)


def edited(there: Scene, **fields: Setting) -> Material:
    settings = {f"materials.left.{field}": value for field, value in fields.items()}
    return resolve(library(), there, settings).scene.materials["left"]


def test_an_edit_changes_the_material_whole() -> None:
    there = scene(library="gold", roughness=0.9)
    made = edited(there, library="copper")
    assert made == Material.model_validate({"library": "copper"})
    orders: list[dict[str, Setting]] = [
        {"library": "ice", "roughness": 0.8},
        {"roughness": 0.8, "library": "ice"},
    ]
    for fields in orders:
        made = edited(there, **fields)
        assert made == Material.model_validate({"library": "ice", "roughness": 0.8})


def test_an_edit_to_no_material_keeps_the_values() -> None:
    there = scene(library="gold", roughness=0.9)
    for nothing in (None, "auto"):
        assert edited(there, library=nothing) == there.materials["left"].model_copy(
            update={"library": None}
        )


@pytest.mark.parametrize(
    ("fields", "words"),
    [
        ({"library": "unobtainium"}, r"materials\.left\.library: no material 'unobtainium'; there"),
        ({"library": "Gold"}, r"materials\.left\.library"),
        ({"library": 3}, r"materials\.left\.library"),
        ({"library": ["gold"]}, r"materials\.left\.library"),
        ({"library": "gold", "eta": "auto"}, "both eta and k"),
    ],
)
def test_a_wrong_name_is_refused(fields: dict[str, object], words: str) -> None:
    with pytest.raises(SceneError, match=words):
        scene(**fields)


def test_a_library_material_is_rendered() -> None:
    gold = lb.render(scene(library="gold"), (32, 24), fresnel="conductor", ambient="none")
    assert_sound(gold)
    same = {"base_color": [0, 0, 0], "metalness": 1, "roughness": 0.3}
    index = {"eta": list(MATERIALS["gold"].eta or ()), "k": list(MATERIALS["gold"].k or ())}
    plain = lb.render(scene(**same, **index), (32, 24), fresnel="conductor", ambient="none")
    assert np.array_equal(gold.linear, plain.linear)
    assert gold.linear.max() > 0.01


# Where it is read from, and where it is shown


def own_library(folder: Path, monkeypatch: pytest.MonkeyPatch, text: str) -> None:
    monkeypatch.setenv("LIGHTBENCH_SCENES", str(folder))
    (folder / "materials.toml").write_text(text)


CHALK = """[chalk]
title = "Chalk"
source = "a test"
base_color = [0.9, 0.9, 0.9]
roughness = 1.0
"""


def test_another_folder_of_scenes(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Its own library, or the built-in one where it has none."""
    monkeypatch.setenv("LIGHTBENCH_SCENES", str(tmp_path))
    assert materials() == MATERIALS
    own_library(tmp_path, monkeypatch, CHALK)
    assert list(materials()) == ["chalk"]
    assert scene(library="chalk").materials["left"].base_color == (0.9, 0.9, 0.9)
    with pytest.raises(SceneError, match="no material 'gold'; there is: chalk"):
        scene(library="gold")


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("[chalk", "materials.toml: not a TOML file"),
        ("chalk = 3", "materials.toml: chalk: "),
        (CHALK.replace("0.9]", "2]"), "materials.toml: chalk.base_color.2: "),
        (CHALK + "gloss = 1", "materials.toml: chalk.gloss: "),
        (CHALK + "eta = [1, 1, 1]", "chalk: give both eta and k, or neither"),
        (CHALK + "f0 = [0, 0, 0]\nior = 1.5", "chalk: give f0 or ior, not both"),
    ],
)
def test_a_wrong_file_is_refused(
    text: str, words: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    own_library(tmp_path, monkeypatch, text)
    with pytest.raises(SceneError) as caught:
        scene(library="chalk")
    assert words in str(caught.value)
    assert "\n" not in str(caught.value)


def test_it_is_among_the_options() -> None:
    for data in (options.options(library()), options.manifest(library(), SCENES)):
        assert list(data["materials"]) == list(MATERIALS)
        assert data["materials"]["gold"]["title"] == "Gold"
        assert "Rakic" in data["materials"]["gold"]["source"]
    printed = options.listing(library())
    assert all(f"  {name} " in printed for name in MATERIALS)


def test_the_fields_are_those_of_a_scene() -> None:
    assert set(FIELDS) <= set(Material.model_fields)
    assert set(LibraryMaterial.model_fields) == {"title", "source", *FIELDS}


def test_presets_take_a_material_from_it() -> None:
    name = next(iter(lb.load("metals").materials))
    made = planned("metals", {f"materials.{name}.library": "copper"})
    draws = [d for drawn in made["passes"] for batch in drawn["batches"] for d in batch["draws"]]
    colors = [d["uniforms"]["u_base_color"] for d in draws if "u_base_color" in d["uniforms"]]
    assert any(np.allclose(c, MATERIALS["copper"].base_color, atol=1e-6) for c in colors)


def test_the_gold_by_physics_is_gold() -> None:
    """Red over green over blue all over the sphere, its highlight not burnt to white."""
    right = lb.load("two-golds").materials["right"]
    assert right.library == "gold"
    image = lb.render("two-golds", (160, 90))
    assert_sound(image)
    half = image.display[:, 85:].astype(int)
    ball = half[half.sum(axis=2) > 90]
    assert len(ball) > 1500
    assert (ball[:, 0] > ball[:, 1]).all()
    assert (ball[:, 1] > 1.1 * ball[:, 2]).all()
    assert (ball.min(axis=1) < 210).all()
    assert (ball == 255).mean() < 0.01

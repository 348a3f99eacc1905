"""Only what the scene requires: nothing is planned, declared, bound or set that is not used."""

from collections.abc import Iterator

import moderngl
import pytest

import lightbench as lb
from lightbench.plan import plan
from lightbench.plan_types import Plan
from lightbench.render import on_gl_thread, renderer
from lightbench.scene import Scene
from lightbench.settings import Setting
from tests.support import alternatives, library, planned, presets

SCREEN_STATE = {"gl_VertexID"}


def cases() -> Iterator[tuple[str, dict[str, Setting]]]:
    for preset in presets():
        yield preset, {}
        yield preset, {"samples": 3}
    for settings in alternatives():
        yield "box-room", settings
    for shadow in library().choices("shadows"):
        for bias in library().choices("biases"):
            yield "box-room", {"shadow": shadow, "bias": bias}
    for outline in library().choices("outlines"):
        yield "texture-compare", {"outline": outline}
    for model in library().choices("models"):
        yield "normal-maps", {"model": model, "fresnel": "conductor"}
    for preset in presets():
        if not preset.startswith("lab/"):
            yield preset, {"technique": "whitted", "shadow": "ray"}
    yield "box-room", {"camera.projection": "orthographic"}
    yield "box-room", {"camera.light": "window", "shadow": "hard"}


def check(made: Plan) -> None:
    """Each program's active uniforms and attributes are exactly those that the plan supplies."""
    programs = on_gl_thread(lambda: [renderer().program(p) for p in made["programs"]])
    used: set[int] = set()
    bound: set[str] = set()
    for planned_pass in made["passes"]:
        names = [n for b in planned_pass["batches"] for n in programs[b["program"]]]
        assert set(planned_pass["samplers"]) <= set(names), planned_pass["name"]
        for batch in planned_pass["batches"]:
            used.add(batch["program"])
            program = programs[batch["program"]]
            members = {name: program[name] for name in program}
            active = {n for n, m in members.items() if isinstance(m, moderngl.Uniform)}
            attributes = {n for n, m in members.items() if isinstance(m, moderngl.Attribute)}
            for draw in batch["draws"]:
                supplied = {*batch["uniforms"], *draw["uniforms"], *draw["textures"]}
                supplied |= {*draw["arrays"], *draw["tables"]}
                supplied |= {sampler for sampler in planned_pass["samplers"] if sampler in active}
                assert supplied == active, (planned_pass["name"], supplied ^ active)
            assert attributes - SCREEN_STATE == set(
                made["programs"][batch["program"]]["attributes"]
            )
            bound |= {t for draw in batch["draws"] for t in draw["textures"].values()}
    assert bound == set(made["textures"])
    draws = [draw for p in made["passes"] for b in p["batches"] for draw in b["draws"]]
    for kind in ("arrays", "tables"):
        assert {name for draw in draws for name in draw[kind].values()} == set(made[kind])
    assert used == set(range(len(made["programs"])))
    read = {t for p in made["passes"] for t in p["samplers"].values()} | {*made["outputs"].values()}
    assert read == set(made["targets"]) == {p["target"] for p in made["passes"]}


@pytest.mark.parametrize(("preset", "settings"), list(cases()), ids=str)
def test_nothing_unused(preset: str, settings: dict[str, Setting]) -> None:
    check(planned(preset, settings))


def test_defines_are_used() -> None:
    for preset, settings in cases():
        for program in planned(preset, settings)["programs"]:
            for text in (program["vertex"], program["fragment"]):
                for line in text.splitlines():
                    if line.startswith("#define"):
                        assert text.count(line.split()[1]) > 1, line
                    assert not line.startswith("#") or line.startswith(("#define", "#version"))


def lights(*names: str) -> Scene:
    """The box room with some of its lights."""
    data = lb.load("box-room").data()
    assert isinstance(data["lights"], dict)
    data["lights"] = {name: data["lights"][name] for name in names}
    data["views"] = {}
    return Scene.parse(data)


def forward(*names: str) -> str:
    made = plan(library(), lights(*names), {}, (64, 48))
    check(made)
    return made["programs"][0]["fragment"]


def test_no_light_no_lighting() -> None:
    text = forward()
    assert "brdf" not in text
    assert "v_normal" not in text
    assert "attenuation" not in text
    assert "ambient" in text


def test_only_a_directional_light_has_no_distance() -> None:
    text = forward("window")
    assert "attenuation" not in text
    assert "spot" not in text
    assert "u_light0_position" not in text
    assert "u_light0_direction" in text


def test_only_a_spot_light_has_a_cone() -> None:
    assert "spot" not in forward("lamp", "window")
    assert "u_light0_cos_inner" in forward("spot")


def test_a_pass_left_out_costs_nothing() -> None:
    assert [p["name"] for p in planned("box-room", {})["passes"]] == ["forward", "display"]
    names = [p["name"] for p in planned("box-room", {"samples": 2})["passes"]]
    assert names == ["forward", "resolve", "display"]
    names = [p["name"] for p in planned("box-room", {"outline": "sobel"})["passes"]]
    assert names == ["forward", "normal_distance", "outline", "display"]


def test_attributes_follow_from_what_is_read() -> None:
    """No tangent without a normal map, no texture coordinate without a texture."""

    def attributes(preset: str, settings: dict[str, Setting]) -> set[str]:
        return {a for p in planned(preset, settings)["programs"] for a in p["attributes"]}

    assert attributes("box-room", {}) == {"a_position", "a_normal"}
    assert attributes("box-room", {"view": "base_color"}) == {"a_position"}
    assert "a_tangent" in attributes("texture-compare", {})
    assert "a_tangent" not in attributes("texture-compare", {"view": "roughness"})
    assert "a_uv0" in attributes("texture-compare", {"view": "roughness"})


def test_a_texture_that_nothing_follows_from_is_not_bound() -> None:
    bound = planned("texture-compare", {"view": "metalness"})["textures"]
    assert all(not name.endswith(("albedo", "normal")) for name in bound)


def test_the_inactive_choices_are_not_compiled() -> None:
    made = planned("box-room", {"model": "lambert"})
    assert "distribution" not in made["settings"]
    assert "roughness" not in str(made["programs"])

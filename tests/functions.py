"""Which functions of the shader folder a test can call, and what covers the others.

A function is called where what it returns can be read back, where it is not given a picture, and
where its file, assembled, reads none, takes in no varying, asks for no scene and for nothing that
only a scene has. Every other one is named here with the test that sees it at work.
"""

from __future__ import annotations

import re
from collections.abc import Mapping

from lightbench.assemble import Source
from lightbench.contract import same_arguments
from lightbench.glsl import source_of
from lightbench.glsl_run import RETURNS
from lightbench.settings import Setting
from tests.support import library

__all__ = ["ELSEWHERE", "choices", "hooks", "lib", "promises", "source", "uncalled"]

Function = tuple[str, str]

VIEWS, SHADOWS, OUTLINES = "test_views.", "test_shadows.", "test_outlines."
MAPS, BVH, IMAGES = "test_surface_maps.", "test_bvh.", "test_ray_images."
WHITTED, LAB = "test_whitted.", "test_lab_scenes."
ALIKE = WHITTED + "test_a_ray_sees_what_rasterisation_draws"
SCRIPT = LAB + "test_as_the_script_has_it"
TREE = "test_sphere_tree.test_pictures_show_the_nearest"
LISTED = "test_listed.test_a_list_is_what_its_objects_are_by_name"
VERTICES = "test_listed.test_what_vertices_have_is_what_rasterisation_draws"
ATTRIBUTES = "test_attributes_lie_between_those_of_the_vertices"

# Files and uniforms that ask for a scene.
OF_SCENES = {"stages/leaving.glsl", "u_lights_total"}

# Functions that cannot be called, and the test of pictures that shows what each does.
ELSEWHERE: dict[Function, str] = {
    ("ambients/lab.glsl", "ambient"): SCRIPT,
    **{
        ("lib/bvh.glsl", name): BVH + "test_a_soup"
        for name in ("boxRay", "meshHit", "triangleAtHit")
    },
    ("lib/bvh.glsl", "nextLeaf"): BVH + "test_only_leaves_in_the_way_are_looked_at",
    ("lib/frame.glsl", "basis"): "test_formulas.test_basis_is_orthonormal_everywhere",
    **{
        ("lib/mesh_table.glsl", name): BVH + ATTRIBUTES
        for name in (
            "meshAttribute",
            "meshCorner",
            "edgesAt",
            "meshFace",
            "meshTexel",
            "meshTriangles",
        )
    },
    ("lib/bvh.glsl", "metFrom"): BVH + "test_a_ball_from_one_side",
    ("lib/split.glsl", "withoutBase"): "test_formulas.test_other_functions",
    ("lib/watertight.glsl", "projection"): BVH + "test_no_ray_leaves_a_closed_ball",
    ("outlines/sobel.glsl", "outline"): OUTLINES + "test_outlines_are_those_of_float64",
    ("outlines/sobel_depth.glsl", "outline"): OUTLINES + "test_outlines_are_those_of_float64",
    ("shadows/hard.glsl", "shadow"): SHADOWS + "test_the_shadow_of_a_ball",
    ("shadows/pcf.glsl", "covered"): SHADOWS + "test_a_filter_is_a_square_of_texels",
    ("shadows/pcf.glsl", "shadow"): SHADOWS + "test_a_filter_is_a_square_of_texels",
    ("shadows/pcss.glsl", "blockerAt"): SHADOWS + "test_softness_follows_the_light_s_size",
    ("shadows/pcss.glsl", "lightRadius"): SHADOWS + "test_softness_follows_the_light_s_size",
    ("shadows/pcss.glsl", "meanBlocker"): SHADOWS + "test_softness_follows_the_light_s_size",
    ("shadows/pcss.glsl", "open"): SHADOWS + "test_no_acne_at_any_resolution",
    ("shadows/pcss.glsl", "penumbra"): SHADOWS + "test_softness_follows_the_light_s_size",
    ("shadows/pcss.glsl", "shadow"): SHADOWS + "test_softness_follows_the_light_s_size",
    ("shadows/ray.glsl", "passed"): TREE,
    ("shadows/ray.glsl", "shadow"): SCRIPT,
    ("stages/emission.glsl", "readEmission"): MAPS + "test_emission_is_added",
    ("stages/eye.glsl", "towardsEye"): VIEWS + "test_a_term_is_the_mean_over_the_lights",
    ("stages/images.glsl", "imageAt"): IMAGES + "test_an_image_is_filtered_along_its_print",
    ("stages/leaving.glsl", "leaving"): SCRIPT,
    ("stages/leaving.glsl", "within"): WHITTED + "test_a_slab_moves_what_is_behind_it",
    ("stages/lights.glsl", "brdfCos"): "test_guards.test_a_model_without_its_cosine",
    ("stages/lights.glsl", "fromLights"): VIEWS + "test_the_parts_add_up_to_the_whole",
    **{("stages/listed.glsl", name): LISTED for name in ("distanceTo", "meshBase")},
    **{("stages/listed.glsl", name): TREE for name in ("passesBy", "nextListed")},
    ("stages/list.glsl", "listTexel"): TREE,
    ("stages/list.glsl", "listed"): LISTED,
    ("stages/list.glsl", "placeOf"): LISTED,
    ("stages/material.glsl", "readMaterial"): MAPS + "test_a_map_of_one_texel_is_a_factor",
    ("stages/met.glsl", "beside"): IMAGES + "test_an_image_seen_at_a_slant",
    ("stages/met.glsl", "met"): SCRIPT,
    ("stages/met_listed.glsl", "between"): VERTICES,
    ("stages/met_listed.glsl", "metMesh"): VERTICES,
    ("stages/met_listed.glsl", "metOwn"): LISTED,
    ("stages/met_listed.glsl", "tangentOn"): LISTED,
    ("stages/met_listed.glsl", "uvOn"): LISTED,
    ("stages/met_own.glsl", "metOwn"): ALIKE,
    ("stages/nearest.glsl", "meet"): TREE,
    ("stages/nearest.glsl", "nearest"): SCRIPT,
    ("stages/nearest.glsl", "normalOf"): LISTED,
    ("stages/normal.glsl", "readNormal"): MAPS + "test_a_normal_map_tilts_the_normal",
    ("stages/occlusion.glsl", "readOcclusion"): MAPS + "test_occlusion_dims_ambient_light_alone",
    ("stages/opacity.glsl", "readOpacity"): "test_opacity.test_a_mask_is_cut_out",
    ("stages/outline.glsl", "edges"): OUTLINES + "test_outlines_are_those_of_float64",
    ("stages/outline.glsl", "outlineStep"): OUTLINES + "test_outlines_are_those_of_float64",
    ("stages/shadow_map.glsl", "comparedAt"): SHADOWS + "test_no_acne_at_any_resolution",
    ("stages/shadow_map.glsl", "mapPoint"): SHADOWS + "test_the_shadow_of_a_ball",
    ("stages/shadow_map.glsl", "receivedAt"): SHADOWS + "test_no_acne_at_any_resolution",
    ("stages/shadow_map.glsl", "stored"): SHADOWS + "test_the_shadow_of_a_ball",
    ("stages/shaded.glsl", "shaded"): SCRIPT,
    ("stages/surface.glsl", "radianceAt"): VIEWS + "test_the_parts_add_up_to_the_whole",
    ("stages/surface.glsl", "surfaceLight"): VIEWS + "test_the_parts_add_up_to_the_whole",
    ("stages/texels.glsl", "mirrored"): MAPS + "test_texels_repeat_end_or_turn_back",
    ("stages/texels.glsl", "readTexels"): MAPS + "test_a_transform_is_that_of_float64",
    ("views/depth.glsl", "inspect"): VIEWS + "test_depth_is_the_ray_s_length",
    ("techniques/whitted.glsl", "trace"): SCRIPT,
    **{
        (f"views/dir_{axis}.glsl", "inspect"): WHITTED + "test_the_scripts_numbers"
        for axis in "xyz"
    },
    ("views/tangent.glsl", "inspect"): VIEWS + "test_tangents_run_along_u",
    ("views/uv.glsl", "inspect"): VIEWS + "test_uv_of_a_plane",
}


def contract(path: str) -> list[str]:
    """Names of the functions of a choice that take what its folder's promised one takes."""
    folder = library().folders[path.split("/")[0]]
    names = same_arguments(folder.function, folder.optional)
    return [name for name in names if name in library().files[path].functions]


def promises(path: str) -> list[str]:
    """Names of the functions of a choice that its folder knows, but for marks of `#if`."""
    folder = library().folders[path.split("/")[0]]
    texts = filter(None, (folder.function, *folder.optional))
    known = [text for text in texts if "()" not in text]
    names = [text.split("(")[0].split()[-1] for text in known]
    return [name for name in names if name in library().files[path].functions]


def source(path: str, function: str, settings: Mapping[str, Setting] | None = None) -> Source:
    """What a call of the function assembles."""
    promised = library().promised(path)
    objects = promised is not None and function != promised
    return source_of(library(), path, settings or {}, objects=objects)[0]


def of_scenes(made: Source) -> bool:
    """Whether it asks for a scene, or for what only a scene has."""
    return not OF_SCENES.isdisjoint({*made.files, *made.uniforms})


def called(path: str, function: str) -> bool:
    """Whether a test can call the function."""
    file = library().files[path]
    code = "\n".join(file.code.split("\n")[file.functions[function] - 1 :])
    if code.split()[0] not in RETURNS or "sampler2D" in code.partition(")")[0]:
        return False
    made = source(path, function)
    pictures = any(library().files[file].meta.reads for file in made.files)
    return (
        not (pictures or of_scenes(made)) and re.search(r"^\s*in ", made.text, re.MULTILINE) is None
    )


def of_choices() -> list[str]:
    menu = library()
    return [path for path in menu.files if path.split("/")[0] in menu.folders]


def plain(path: str) -> bool:
    """Not a textbook form: those are in test_textbook.py."""
    return not library().files[path].meta.textbook_of


def choices() -> list[Function]:
    """(file, function) of the functions that a folder's files promise, where they can be called."""
    found = [(path, name) for path in of_choices() if plain(path) for name in contract(path)]
    return [each for each in found if called(*each)]


def hooks() -> list[Function]:
    """(file, function) of what a folder allows beside those."""
    found = [
        (path, name)
        for path in of_choices()
        for name in promises(path)
        if name not in contract(path)
    ]
    return [each for each in found if called(*each)]


def lib() -> list[Function]:
    """(file, function) of lib/."""
    found = [(path, name) for path in library().files if path.startswith("lib/") and plain(path)
             for name in library().files[path].functions if name != "main"]  # fmt: skip
    return [each for each in found if called(*each)]


def uncalled() -> set[Function]:
    """(file, function) of what no test can call: of choices that read pictures, lib/ and stages/.

    A choice's own helpers are called with it.
    """
    menu = library()
    found = {
        (path, name)
        for path in of_choices()
        for name in promises(path)
        if plain(path) and not called(path, name)
    }
    found |= {
        (path, name)
        for path in {path for path, _ in found if path.startswith(("shadows/", "outlines/"))}
        for name in menu.files[path].functions
        if name not in ("exact", "reachless", "unlined", "unshadowed")
    }
    parts = [path for path in menu.files if path.startswith(("lib/", "stages/")) and plain(path)]
    return found | {
        (path, name)
        for path in parts
        for name in menu.files[path].functions
        if name != "main" and (path.startswith("stages/") or not called(path, name))
    }

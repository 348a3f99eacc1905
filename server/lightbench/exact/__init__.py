"""Every shader function in float64, in the form that the papers print: the truth to compare with.

Each takes what its GLSL twin takes, in float64, with the settings that its file reads as keywords.
`FUNCTIONS` maps (file, function) to it, `reference` looks one up. A textbook form shares the exact
form of the file that it stands beside.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np

from lightbench.exact import (
    directions,
    display,
    facets,
    light,
    models,
    outlines,
    shadows,
    shapes,
    terms,
    views,
)
from lightbench.exact.directions import Array

if TYPE_CHECKING:
    from lightbench.library import Library

__all__ = ["FUNCTIONS", "Array", "reference"]

FUNCTIONS: dict[tuple[str, str], Callable[..., Array]] = {
    ("ambients/constant.glsl", "ambient"): light.constant_ambient,
    ("ambients/none.glsl", "ambient"): light.no_ambient,
    ("attenuations/inverse_square.glsl", "attenuation"): light.inverse_square,
    ("attenuations/none.glsl", "attenuation"): light.as_strong,
    ("attenuations/polynomial.glsl", "attenuation"): light.polynomial,
    ("biases/constant.glsl", "compared"): shadows.constant_bias,
    ("biases/normal_offset.glsl", "compared"): shadows.sloped,
    ("biases/normal_offset.glsl", "shift"): shadows.normal_shift,
    ("biases/slope.glsl", "compared"): shadows.sloped,
    ("lib/alpha.glsl", "alphaFromRoughness"): facets.alpha_from_roughness,
    ("lib/base.glsl", "blendWithBase"): models.blend_with_base,
    ("lib/base.glsl", "overBase"): models.over_base,
    ("lib/conductor.glsl", "clearEta"): facets.clear_eta,
    ("lib/conductor.glsl", "etaOf"): facets.eta_of,
    ("lib/conductor.glsl", "kOf"): facets.k_of,
    ("lib/cube.glsl", "cubeDirection"): shadows.cube_direction,
    ("lib/cube.glsl", "cubeFace"): shadows.cube_face,
    ("lib/disk.glsl", "diskPoint"): shadows.disk_point,
    ("lib/display.glsl", "displayRange"): display.display_range,
    ("lib/frame.glsl", "facingNormal"): directions.facing_normal,
    ("lib/frame.glsl", "halfVector"): directions.half_vector,
    ("lib/frame.glsl", "unitNormal"): directions.unit_normal,
    ("lib/fresnel.glsl", "fresnel0"): terms.fresnel0,
    ("lib/fresnel.glsl", "pow5"): terms.pow5,
    ("lib/heat.glsl", "heat"): views.heat,
    ("lib/invalid.glsl", "flagInvalid"): display.flag_invalid,
    ("lib/invalid.glsl", "invalid"): display.invalid,
    ("lib/lambda_ggx.glsl", "lambdaGgx"): facets.lambda_ggx,
    ("lib/lambda_ggx.glsl", "slopeGgx"): facets.slope_ggx,
    ("lib/log1p.glsl", "log1p"): np.log1p,
    ("lib/luminance.glsl", "luminance"): display.luminance,
    ("lib/erf.glsl", "erfc"): terms.erfc,
    ("lib/slope.glsl", "slopeBias"): shadows.slope_bias,
    ("lib/smith.glsl", "smithCorrelated"): terms.smith_correlated,
    ("lib/smith.glsl", "smithSeparable"): terms.smith_separable,
    ("lib/sobel.glsl", "sobel"): outlines.sobel,
    ("lib/specular_power.glsl", "specularPower"): terms.specular_power,
    ("lib/sphere.glsl", "sphereHit"): light.sphere_hit,
    ("lib/spot.glsl", "spot"): light.spot,
    ("lib/strokes.glsl", "circleDistance"): outlines.circle_distance,
    ("lib/strokes.glsl", "lineDistance"): outlines.segment_distance,
    ("lib/strokes.glsl", "segmentDistance"): outlines.segment_distance,
    ("lib/strokes.glsl", "squareDistance"): outlines.square_distance,
    ("lib/strokes.glsl", "strokeCoverage"): outlines.stroke_coverage,
    ("lib/tangent.glsl", "mappedNormal"): directions.mapped_normal,
    ("lib/tangent.glsl", "unpackNormal"): directions.unpacked_normal,
    ("lib/tone.glsl", "hasTone"): display.has_tone,
    ("lib/watertight.glsl", "cornersHit"): light.corners_hit,
    ("lib/watertight.glsl", "edgeSide"): light.edge_side,
    ("lib/watertight.glsl", "projected"): light.projected,
    ("mappings/lab.glsl", "mapping"): shapes.arcsines,
    ("mappings/spherical.glsl", "mapping"): shapes.spherical,
    ("models/blinn_phong.glsl", "brdf"): models.over_cosine(models.blinn_phong_cos),
    ("models/blinn_phong.glsl", "brdfCos"): models.blinn_phong_cos,
    ("models/cook_torrance.glsl", "brdf"): models.cook_torrance,
    ("models/cook_torrance.glsl", "brdfCos"): models.cook_torrance_cos,
    ("models/lab.glsl", "brdf"): models.over_cosine(models.lab_cos),
    ("models/lab.glsl", "brdfCos"): models.lab_cos,
    ("models/lab.glsl", "modulated"): np.multiply,
    ("models/lambert.glsl", "brdf"): models.lambert,
    ("models/phong.glsl", "brdf"): models.over_cosine(models.phong_cos),
    ("models/phong.glsl", "brdfCos"): models.phong_cos,
    ("models/toon.glsl", "brdf"): models.over_cosine(models.toon_cos),
    ("models/toon.glsl", "brdfCos"): models.toon_cos,
    ("models/toon.glsl", "toneLevel"): models.tone_level,
    ("models/toon.glsl", "toned"): models.toned,
    ("outlines/none.glsl", "outline"): outlines.unlined,
    ("shadows/none.glsl", "shadow"): shadows.unshadowed,
    ("views/final.glsl", "view"): display.final_view,
    ("views/invalid.glsl", "view"): display.invalid_view,
}
for _name, _distribution in facets.DISTRIBUTIONS.items():
    FUNCTIONS[f"distributions/{_name}.glsl", "distribution"] = _distribution
for _name, _masking in facets.MASKINGS.items():
    FUNCTIONS[f"maskings/{_name}.glsl", "masking"] = _masking
    FUNCTIONS[f"maskings/{_name}.glsl", "visibility"] = facets.VISIBILITIES[_name]
for _name, _fresnel in facets.FRESNELS.items():
    FUNCTIONS[f"fresnels/{_name}.glsl", "fresnel"] = _fresnel
for _name, _tonemap in display.TONEMAPS.items():
    FUNCTIONS[f"tonemaps/{_name}.glsl", "tonemap"] = _tonemap
for _name, _view in views.VIEWS.items():
    FUNCTIONS[f"views/{_name}.glsl", "view"] = _view
for (_name, _hook), _shown in views.HOOKS.items():
    FUNCTIONS[f"views/{_name}.glsl", _hook] = _shown
for (_file, _name), _form in shapes.FORMS.items():
    FUNCTIONS[f"lib/{_file}.glsl", _name] = _form
for _name, _transfer in display.TRANSFERS.items():
    FUNCTIONS[f"transfers/{_name}.glsl", "transfer"] = _transfer
for _name, _quantisation in display.QUANTISATIONS.items():
    FUNCTIONS[f"quantisations/{_name}.glsl", "quantise"] = _quantisation
for _file, _name, _lambda in (
    ("lambda_beckmann", "Beckmann", facets.lambda_beckmann),
    ("lambda_beckmann_exact", "BeckmannExact", facets.lambda_beckmann_exact),
):
    FUNCTIONS[f"lib/{_file}.glsl", f"lambda{_name}"] = _lambda
    FUNCTIONS[f"lib/{_file}.glsl", f"cosLambda{_name}"] = facets.cos_lambda(_lambda)


def reference(library: Library, path: str, function: str) -> Callable[..., Array] | None:
    """The exact form of a file's function, or None for a function that has none."""
    file = library.files[path]
    if file.meta.textbook_of:
        path = f"{path.rpartition('/')[0]}/{file.meta.textbook_of}.glsl"
    return FUNCTIONS.get((path, function))

"""Drop-in: one file in a folder is all it takes, for a choice as for a pass."""

from pathlib import Path

import numpy as np
import pytest
from fastapi.testclient import TestClient

import lightbench as lb
from lightbench.api import create_app
from tests.support import assert_sound, copy_of_shaders

FILES = {
    "distributions/evenly_spread.glsl": """/*---
title = "Flat"
equation = 'D(h) = 1/\\pi'
source = "this test"
domain = { alpha = [0.0, 1.0] }
unit = "1/sr"
---*/
float distribution(vec3 h, float alpha) { return h.z > 0.0 ? 0.31830989 : 0.0; }
""",
    "tonemaps/half_of_it.glsl": """/*---
title = "Half of it"
[parameters.share]
default = 0.5
range = [0.0, 1.0]
step = 0.01
---*/
vec3 tonemap(vec3 radiance) { return radiance * u_share; }
""",
    "models/mist_all_over.glsl": """/*---
title = "Mist"
---*/
vec3 brdf(Material m, vec3 l, vec3 v) { return vec3(0.25); }
""",
    "passes/dark_corners.glsl": """/*---
title = "Dark corners"
draw = "screen"
reads = ["linear"]
when = "dark_corners > 0"
[writes.linear]
format = "rgba32f"
[parameters.dark_corners]
default = 0.0
range = [0.0, 1.0]
step = 0.01
---*/
#include "lib/screen.glsl"
#if FRAGMENT
out vec4 o_linear;
void main() {
    ivec2 size = textureSize(u_linear, 0);
    float r = length(gl_FragCoord.xy / vec2(size) - 0.5);
    o_linear = texelFetch(u_linear, ivec2(gl_FragCoord.xy), 0) * (1.0 - u_dark_corners * r);
}
#endif
""",
}


@pytest.fixture
def dropped(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> TestClient:
    monkeypatch.setenv("LIGHTBENCH_SHADERS", str(copy_of_shaders(tmp_path, FILES)))
    return TestClient(create_app())


def pixels(**settings: float | str) -> np.ndarray:
    image = lb.render("box-room", (64, 48), **settings)
    assert_sound(image)
    return image.display.astype(int)


def test_manifest_and_options_have_them(dropped: TestClient) -> None:
    files = dropped.get("/data/manifest.json").json()["files"]
    assert set(FILES) <= set(files)
    options = dropped.get("/api/options").text
    for word in ("Flat", "Half of it", "Mist", "dark_corners"):
        assert word in options


@pytest.mark.usefixtures("dropped")
def test_each_changes_the_picture() -> None:
    plain = pixels()
    for settings in (
        {"distribution": "evenly_spread"},
        {"tonemap": "half_of_it"},
        {"model": "mist_all_over", "ambient": "none"},
        {"dark_corners": 0.8},
    ):
        assert np.abs(pixels(**settings) - plain).max() > 5, settings
    tones = [pixels(tonemap="half_of_it", share=share).mean() for share in (0.2, 0.5, 0.9)]
    assert tones == sorted(tones)


@pytest.mark.usefixtures("dropped")
def test_a_pass_joins_where_it_reads_and_writes() -> None:
    both = pixels(dark_corners=0.8, samples=2)
    assert np.abs(both - pixels(samples=2)).max() > 5


def test_rest_renders_them(dropped: TestClient) -> None:
    url = "/api/render/box-room.png?width=64&height=48"
    plain = dropped.get(url).content
    for more in ("distribution=evenly_spread", "tonemap=half_of_it&share=0.3", "dark_corners=0.5"):
        answer = dropped.get(f"{url}&{more}")
        assert answer.status_code == 200
        assert answer.content != plain


@pytest.mark.parametrize("path", list(FILES))
def test_nothing_else_knew(path: str) -> None:
    """The names of this test's files appear nowhere in the project itself."""
    root = Path(lb.__file__).parents[2]
    sources = [*root.glob("server/**/*.py"), *root.glob("web/src/**/*.ts")]
    assert not [s for s in sources if Path(path).stem in s.read_text()]

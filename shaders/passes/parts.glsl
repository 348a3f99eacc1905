/*---
title = "Parts"
about = "The outlines of flat parts over the picture, the scene's first part lowest."
draw  = "screen"
reads = ["linear"]
when  = "parts > 0"

[writes.linear]
format = "rgba32f"
---*/
#include "lib/screen.glsl"
#if FRAGMENT

#include "lib/strokes.glsl"

uniform vec2 u_resolution;
#for PARTS
uniform mat3 u_part@{index}_matrix;
uniform vec3 u_part@{index}_color;
uniform float u_part@{index}_width;
#endfor

out vec4 o_linear;

// The picture's middle is (0, 0); its shorter side, `unit` pixels twice, runs from -1 to 1.
void main() {
    vec3 shown = texelFetch(u_linear, ivec2(gl_FragCoord.xy), 0).rgb;
    float unit = 0.5 * min(u_resolution.x, u_resolution.y);
    vec2 at = (gl_FragCoord.xy - 0.5 * u_resolution) / unit;
    vec2 q;
    float distance;
#for PARTS
    q = at - u_part@{index}_matrix[2].xy;
#if @{square}
    distance = squareDistance(q, u_part@{index}_matrix[0].xy, u_part@{index}_matrix[1].xy);
#else
    distance = @{shape}Distance(q, u_part@{index}_matrix[0].xy);
#endif
    shown = mix(shown, u_part@{index}_color, strokeCoverage(unit * distance, u_part@{index}_width));
#endfor
    o_linear = vec4(shown, 1.0);
}

#endif

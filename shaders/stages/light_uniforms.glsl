// What the renderers know of each light; positions are about the eye.
#for LIGHTS
uniform vec3 u_light@{index}_intensity;
#if @{positional}
uniform vec3 u_light@{index}_position;
#for LIGHT_FIELDS
uniform @{type} u_light@{index}_@{name};
#endfor
#else
uniform vec3 u_light@{index}_direction;
#endif
#if @{spot}
uniform vec3 u_light@{index}_axis;
uniform float u_light@{index}_cos_inner;
uniform float u_light@{index}_cos_outer;
#endif
#endfor

// A light: intensity in candela (point, spot) or lux (directional), per channel, and the fields
// that the included choices declare per light.
struct Light {
    vec3 intensity;
#for LIGHT_FIELDS
    @{type} @{name};
#endfor
};

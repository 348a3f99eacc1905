// What a surface is made of: the fields that the included choices read, and no others. base_color,
// metalness, roughness 0..1; f0 reflectance at normal incidence; kd, ks 1/sr; shininess.
struct Material {
#for MATERIAL_FIELDS
    @{type} @{name};
#endfor
#if MATERIAL_FIELD_COUNT == 0
    // GLSL has no empty struct.
    float unused;
#endif
};

/*---
title  = "Images by number"
source = "McCormack et al. 1999, Feline: Fast Elliptical Lines for Anisotropic Texture Mapping"
about  = """
Rays that meet different objects side by side read their images in one program: those of a like size \
are layers of one texture. An image's number is its texture's times 256, and its layer. What a \
driver does for the pixels of a triangle is done here: probes along the longer side of the pixel's \
print on the image, each as wide as its shorter side, but no narrower than keeps them few."""
---*/
#for IMAGE_ARRAYS
uniform highp sampler2DArray u_images@{index};
#endfor

#for IMAGE_ARRAYS
#if !@{nearest}
vec4 probes@{index}(vec3 at, vec4 steps) {
    vec2 size = vec2(textureSize(u_images@{index}, 0).xy);
    float right = length(steps.xy * size);
    float up = length(steps.zw * size);
    vec2 along = right > up ? steps.xy : steps.zw;
    float most = max(right, up);
    float count = min(ceil(most / max(min(right, up), 1.0)), float(ANISOTROPY));
    float level = log2(max(most / count, 1.0));
    vec4 sum = vec4(0.0);
    for (float i = 0.5; i < count; i += 1.0) {
        sum += textureLod(u_images@{index}, vec3(at.xy + (i / count - 0.5) * along, at.z), level);
    }
    return count > 0.0 ? sum / count : textureLod(u_images@{index}, at, 0.0);
}
#endif
#endfor

// steps: how far uv goes to the next pixel, to the right and up.
vec4 imageAt(float image, vec2 uv, vec4 steps) {
    float array = floor(image / 256.0);
    vec3 at = vec3(uv, image - 256.0 * array);
#for IMAGE_ARRAYS
    if (array == @{index}.0) {
#if @{nearest}
        return textureLod(u_images@{index}, at, 0.0);
#else
        return probes@{index}(at, steps);
#endif
    }
#endfor
    return vec4(1.0);
}

// SPDX-License-Identifier: MIT
// The point being shaded, from the varyings and the material's textures. Expects `material` (baseColor, strandIdAmp)
// and the material textures to be declared.
#ifndef PELAGE_SURFACE_GLSL
#define PELAGE_SURFACE_GLSL
struct Surface {
    vec3 world, tangent, normal, wo;  // unit vectors; normal faces the viewer
    vec3 color;                       // scene-linear base colour with its map and strand variation
    float alpha;
};

vec3 safeNormalize(vec3 v, vec3 fallback) {
    float squared = dot(v, v);
    return squared > 1e-20 ? v * inversesqrt(squared) : fallback;
}

Surface fetchSurface() {
    Surface s;
    s.world = v_world;
    s.wo = safeNormalize(frame.eye - v_world, -frame.viewForward);
    s.tangent = safeNormalize(v_tangent, vec3(0.0, -1.0, 0.0));
    s.normal = safeNormalize(v_normal, s.wo);
    // Cards are seen from both sides; a strand's normal is perpendicular to it and never faces away (thesis 4.4).
    if (isStrand) s.normal = safeNormalize(s.normal - s.tangent * dot(s.normal, s.tangent), s.wo);
    if (dot(s.normal, s.wo) < 0.0) s.normal = -s.normal;
    s.color = material.baseColor;
    if (isStrand) s.color *= v_color;
    s.alpha = isStrand ? v_coverage : 1.0;
    if (!isStrand && alphaMode == ALPHA_BLEND) s.alpha = texture(sampler2D(opacityMap, s_material), v_uv).a;
    if (useColorMap) s.color *= texture(sampler2D(colorMap, s_material), v_uv).rgb;
    if (useStrandId) {
        float id = isStrand ? v_strand.x : texture(sampler2D(strandIdMap, s_material), v_uv).r;
        s.color *= 1.0 + material.strandIdAmp * (2.0 * id - 1.0);
    }
    return s;
}

// Targets are 16-bit floats, whose largest number is 65504: more than that would come out as infinity and stay one
// through resolve and display.
vec4 finish(vec3 radiance, Surface s) {
    radiance = min(radiance, vec3(65000.0));
    if (alphaMode == ALPHA_BLEND) return vec4(radiance * s.alpha, s.alpha);
    return vec4(radiance, 1.0);
}
#endif

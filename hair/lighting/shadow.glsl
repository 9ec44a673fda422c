// SPDX-License-Identifier: MIT
// How much of a light reaches a point: alpha-tested shadow map with percentage-closer filtering, and an exponential
// falloff with the distance travelled inside the hair, so that light fades instead of stopping at the first strand
// (thesis section 4.5, after Karis 2016).
#ifndef PELAGE_SHADOW_GLSL
#define PELAGE_SHADOW_GLSL

layout(set = 1, binding = 0) uniform texture2DArray u_shadowMap;
layout(set = 1, binding = 1) uniform sampler s_nearest;

// Metres from the light's near plane frame, for reversed depth (1 near, 0 far).
float shadowDistance(float depth, vec4 range) {
    float near = range.x, far = range.y;
    return range.z > 0.5 ? near * far / (near + depth * (far - near)) : far - depth * (far - near);
}

float shadowTap(vec3 uvLayer, float receiver, vec4 range, float density, float bias) {
    float occluder = shadowDistance(textureLod(sampler2DArray(u_shadowMap, s_nearest), uvLayer, 0.0).r, range);
    float depthInside = receiver - occluder - bias;
    if (shadowMode == SHADOW_EXPONENTIAL) return exp(-density * max(depthInside, 0.0));
    return depthInside > 0.0 ? 0.0 : 1.0;
}

// 1 lit .. 0 dark.
float shadowTransmittance(LightData light, vec3 world, float density, float bias) {
    if (shadowMode == SHADOW_OFF || light.direction.w < 0.0) return 1.0;
    vec4 clip = light.shadow * vec4(world, 1.0);
    vec3 ndc = clip.xyz / clip.w;
    if (any(greaterThan(abs(ndc.xy), vec2(1.0))) || clip.w <= 0.0) return 1.0;
    vec2 uv = vec2(0.5 + 0.5 * ndc.x, 0.5 - 0.5 * ndc.y);
    float receiver = shadowDistance(clamp(ndc.z, 0.0, 1.0), light.shadowDepth);
    float layer = light.direction.w;
    if (shadowMode == SHADOW_HARD) {
        return shadowTap(vec3(uv, layer), receiver, light.shadowDepth, density, bias);
    }
    float sum = 0.0;
    for (int y = -pcfRadius; y <= pcfRadius; ++y) {
        for (int x = -pcfRadius; x <= pcfRadius; ++x) {
            vec2 offset = vec2(x, y) * light.shadowDepth.w;
            sum += shadowTap(vec3(uv + offset, layer), receiver, light.shadowDepth, density, bias);
        }
    }
    float width = float(2 * pcfRadius + 1);
    return sum / (width * width);
}
#endif

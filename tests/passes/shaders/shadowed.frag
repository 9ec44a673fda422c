#version 450
// What the comparison with a shadow map gives for a receiver at 0.75 and at 0.25, and the irradiance.
layout(set = 1, binding = 0) uniform texture2DArray u_map;
layout(set = 1, binding = 1) uniform samplerShadow s_shadow;
layout(set = 1, binding = 2) uniform textureCube u_sky;
layout(set = 1, binding = 3) uniform sampler s_linear;
layout(location = 0) out vec4 color;
void main() {
    vec2 at = vec2(0.2, 0.8);
    color.r = texture(sampler2DArrayShadow(u_map, s_shadow), vec4(at, 0.0, 0.75));
    color.g = texture(sampler2DArrayShadow(u_map, s_shadow), vec4(at, 0.0, 0.25));
    color.b = texture(samplerCube(u_sky, s_linear), vec3(0, 1, 0)).r;
    color.a = 1.0;
}

// SPDX-License-Identifier: MIT
// The host's own shading: one directional light and ambient.
#version 450
layout(location = 0) in vec3 a_position;
layout(location = 1) in vec3 a_normal;
layout(push_constant) uniform Push {
    mat4 clip;          // model to clip space
    vec4 columns[3];    // xyz: of the matrix that turns normals; w: a component of the colour
    vec4 toLight;
} push;
layout(location = 0) out vec3 v_color;

void main() {
    vec3 n = normalize(mat3(push.columns[0].xyz, push.columns[1].xyz, push.columns[2].xyz) * a_normal);
    v_color = vec3(push.columns[0].w, push.columns[1].w, push.columns[2].w) * (0.3 + 0.7 * max(dot(n, push.toLight.xyz), 0.0));
    gl_Position = push.clip * vec4(a_position, 1.0);
}

// SPDX-License-Identifier: MIT
// Copies the display picture, which is encoded already, to a window of any channel order.
#version 450
#extension GL_EXT_samplerless_texture_functions : require

// The window's format encodes by itself: undo the encoding so that it is applied once.
layout(constant_id = 0) const bool decodeSrgb = false;

layout(set = 0, binding = 0) uniform texture2D u_picture;
layout(location = 0) out vec4 o_color;

void main() {
    ivec2 last = textureSize(u_picture, 0) - 1;
    vec3 encoded = texelFetch(u_picture, min(ivec2(gl_FragCoord.xy), last), 0).rgb;
    if (decodeSrgb) {
        vec3 power = pow((encoded + 0.055) / 1.055, vec3(2.4));
        encoded = mix(power, encoded / 12.92, lessThanEqual(encoded, vec3(0.04045)));
    }
    o_color = vec4(encoded, 1.0);
}

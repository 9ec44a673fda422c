// SPDX-License-Identifier: MIT
// Scene-linear, premultiplied colour over the background, through the display transform that OpenColorIO generated from
// hair/color/pelage.ocio when the project was built. The result is encoded for an sRGB display.
#version 450
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require
#include "display_ocio.glsl"

#define DISPLAY_ACES 0
#define DISPLAY_NONE 1
layout(constant_id = 0) const int displayTransform = DISPLAY_ACES;

layout(set = 1, binding = 0) uniform texture2D u_source;
layout(set = 1, binding = 1, std140) uniform Display {
    vec4 background;  // rgb: scene-linear; w: exposure
} u_display;
layout(location = 0) out vec4 o_color;

void main() {
    vec4 source = texelFetch(u_source, ivec2(gl_FragCoord.xy), 0);
    vec3 linear = (source.rgb + u_display.background.rgb * (1.0 - source.a)) * u_display.background.w;
    vec4 encoded = displayTransform == DISPLAY_ACES ? displayAces(vec4(linear, 1.0)) : displayPlain(vec4(linear, 1.0));
    o_color = vec4(clamp(encoded.rgb, 0.0, 1.0), 1.0);
}

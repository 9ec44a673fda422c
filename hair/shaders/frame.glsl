// SPDX-License-Identifier: MIT
// Set 0: what is the same for everything drawn into one view. One buffer per view; lights are those of the scene.
#ifndef PELAGE_FRAME_GLSL
#define PELAGE_FRAME_GLSL

#define MAX_LIGHTS 8
#ifndef FRAME_SET  // passes that are not raster passes have it as a slot, in set 1
#define FRAME_SET 0
#define FRAME_BINDING 0
#endif

struct LightData {
    vec4 position;    // xyz: m; w: 1 point, 0 directional
    vec4 direction;   // xyz: unit, from the surface to a directional light; w: layer of the shadow map, -1 none
    vec4 power;       // rgb: E_perp in W/m2 (directional) or I in W/sr (point)
    mat4 shadow;      // world -> shadow clip space
    vec4 shadowDepth; // x: near, y: far (m); z: 1 perspective, 0 orthographic; w: 1 / size of the map in texels
};

layout(set = FRAME_SET, binding = FRAME_BINDING, std140) uniform Frame {
    mat4 viewProjection, inverseViewProjection;
    vec4 eye;         // xyz: m, world; w: number of lights
    vec4 viewport;    // width, height, 1 / width, 1 / height
    vec4 pixel;       // metres per pixel = x * distance to the eye + y; z: frame index; w: exposure
    vec4 viewForward; // xyz: unit, into the picture; w: 1 in the view of a light
    vec4 ambient;     // rgb: mean radiance of the environment, W/sr/m2
    LightData lights[MAX_LIGHTS];
} frame;

float metresPerPixel(vec3 world) {
    return frame.pixel.x * max(dot(world - frame.eye.xyz, frame.viewForward.xyz), 0.0) + frame.pixel.y;
}
#endif

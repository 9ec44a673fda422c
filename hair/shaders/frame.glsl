// SPDX-License-Identifier: MIT
// Set 0: what is the same for everything drawn into one view. One buffer per view; lights are those of the scene.
//
// No shader may branch on a value of this block that is the same for a whole draw: lavapipe then compiles and keeps
// another variant of the shader each time it is bound. Counts and kinds are specialization constants (options.glsl,
// lighting/light.glsl).
#ifndef PELAGE_FRAME_GLSL
#define PELAGE_FRAME_GLSL
#include "lighting/light_data.glsl"

#ifndef FRAME_SET  // passes that are not raster passes have it as a slot, in set 1
#define FRAME_SET 0
#define FRAME_BINDING 0
#endif

layout(set = FRAME_SET, binding = FRAME_BINDING, std140) uniform Frame {
#define PELAGE_FRAME_MEMBER(type, name) type name;
#include "frame.def"
    LightData lights[MAX_LIGHTS];
} frame;

float metresPerPixel(vec3 world) {
    return frame.pixelScale * max(dot(world - frame.eye, frame.viewForward), 0.0) + frame.pixelConstant;
}
#endif

// SPDX-License-Identifier: MIT
// Set 2 of the forward shaders: textures that every shipped material type has. The uniform block at binding 0 is each
// shader's own; its members are filled by name from the material type's inputs.
#ifndef PELAGE_MATERIAL_COMMON_GLSL
#define PELAGE_MATERIAL_COMMON_GLSL
layout(set = 2, binding = 1) uniform texture2D opacityMap;
layout(set = 2, binding = 2) uniform sampler s_material;
layout(set = 2, binding = 3) uniform texture2D colorMap;
layout(set = 2, binding = 4) uniform texture2D strandIdMap;
#endif

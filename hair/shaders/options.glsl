// SPDX-License-Identifier: MIT
// Shader options: specialization constants, set by name from the material type's options. What is off is gone from the
// specialised shader. Numbers of words are their places among the words of the material types.
#ifndef PELAGE_OPTIONS_GLSL
#define PELAGE_OPTIONS_GLSL

#define ALPHA_OPAQUE 0
#define ALPHA_TEST 1
#define ALPHA_COVERAGE 2
#define ALPHA_HASHED 3
#define ALPHA_BLEND 4
layout(constant_id = 0) const int alphaMode = ALPHA_TEST;

#define PELAGE_SHADOW_TECHNIQUE(number, word, name, traits) const int SHADOW_##word = number;
PELAGE_SHADOW_TECHNIQUE(0, off, Off, 0)
#include "lighting/shadow_techniques.def"
#undef PELAGE_SHADOW_TECHNIQUE
layout(constant_id = 1) const int shadowMode = SHADOW_exponential;
layout(constant_id = 2) const int pcfRadius = 1;  // window of 2 r + 1 texels

layout(constant_id = 3) const bool envOn = true;
layout(constant_id = 4) const bool ambientOn = true;
layout(constant_id = 5) const bool useColorMap = false;
layout(constant_id = 6) const bool useStrandId = false;

layout(constant_id = 7) const bool lobeR = true;
layout(constant_id = 8) const bool lobeTT = true;
layout(constant_id = 9) const bool lobeTRT = true;
layout(constant_id = 11) const bool lobeRES = true;
layout(constant_id = 12) const int scatteringModel = 8;  // numbers of scattering_models.def
layout(constant_id = 13) const bool asPublished = false;
layout(constant_id = 14) const bool chiangColor = false;
#define ATTENUATION_KARIS_H 0
#define ATTENUATION_TAFURI_H0 1
layout(constant_id = 10) const int attenuationModel = ATTENUATION_TAFURI_H0;

// Set by the renderer, not by a material.
layout(constant_id = 20) const bool isStrand = false;  // coverage comes from the projected width
layout(constant_id = 21) const int sampleCount = 1;    // of the target
layout(constant_id = 22) const bool isLightView = false;  // drawn into the shadow map of a light
// 23 to 25: lighting/light.glsl
layout(constant_id = 26) const int subdivisions = 1;  // of strands: drawn segments between two points
#endif

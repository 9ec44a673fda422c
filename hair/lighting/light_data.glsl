// SPDX-License-Identifier: MIT
// A light in the uniform block of set 0.
#ifndef PELAGE_LIGHT_DATA_GLSL
#define PELAGE_LIGHT_DATA_GLSL
#define MAX_LIGHTS 8

struct LightData {
#define PELAGE_LIGHT_MEMBER(type, name) type name;
#include "light.def"
};
#endif

// SPDX-License-Identifier: MIT
// The common subset of GLSL and C++ with GLM that the scattering models are written in: GLSL on the device, float and
// double on the CPU (hair/scattering/shading.inl). `real` is the number; sin, cos, tan, asin, acos, atan are not
// used, because Vulkan allows them errors of 2^-11 and 4096 ULP; numerics.glsl has what is needed of them. No
// constructors of structs, no out parameters, no swizzles beyond one component.
#ifndef PELAGE_REAL_GLSL
#define PELAGE_REAL_GLSL
#ifndef __cplusplus
#define real float
#define real2 vec2
#define real3 vec3
#define real4 vec4
#endif

const real pi = 3.14159265358979324;
const real halfPi = 1.57079632679489662;
#endif

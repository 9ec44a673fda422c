// SPDX-License-Identifier: MIT
// Integer hashing to uniform floats. pcg3d: Jarzynski and Olano, "Hash Functions for GPU Rendering", JCGT 2020.
#ifndef PELAGE_HASH_GLSL
#define PELAGE_HASH_GLSL
uvec3 pcg3d(uvec3 v) {
    v = v * 1664525u + 1013904223u;
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v ^= v >> 16u;
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    return v;
}
// [0, 1)
float hash01(uvec3 v) { return float(pcg3d(v).x >> 8) * (1.0 / 16777216.0); }
float hash01(ivec3 v) { return hash01(uvec3(v)); }
#endif

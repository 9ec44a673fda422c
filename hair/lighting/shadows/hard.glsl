// SPDX-License-Identifier: MIT
// One texel: lit or not.
float shadowHard(ShadowPoint point) {
    return shadowDepthInside(point, vec2(0.0)) > 0.0 ? 0.0 : 1.0;
}

// SPDX-License-Identifier: MIT
// Light falls off exponentially with the distance it travelled inside the hair, so that it fades instead of stopping at
// the first strand; averaged over a window (thesis section 4.5, after Karis 2016).
float shadowExponential(ShadowPoint point) {
    float sum = 0.0;
    for (int y = -pcfRadius; y <= pcfRadius; ++y) {
        for (int x = -pcfRadius; x <= pcfRadius; ++x) {
            sum += exp(-point.density * max(shadowDepthInside(point, vec2(x, y)), 0.0));
        }
    }
    return sum / shadowWindow();
}

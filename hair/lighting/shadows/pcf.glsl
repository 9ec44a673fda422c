// SPDX-License-Identifier: MIT
// Percentage-closer filtering: the share of the texels of a window that see the point (Reeves, Salesin and Cook 1987).
float shadowPcf(ShadowPoint point) {
    float sum = 0.0;
    for (int y = -pcfRadius; y <= pcfRadius; ++y) {
        for (int x = -pcfRadius; x <= pcfRadius; ++x) {
            sum += shadowDepthInside(point, vec2(x, y)) > 0.0 ? 0.0 : 1.0;
        }
    }
    return sum / shadowWindow();
}

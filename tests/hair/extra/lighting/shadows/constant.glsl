// SPDX-License-Identifier: MIT
// A technique that the library does not have: everything is shadowed alike.
float shadowConstant(ShadowPoint point) { return point.density; }

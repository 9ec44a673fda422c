// SPDX-License-Identifier: MIT
#include <pelage/reference/cylinder.hpp>

#include <cmath>
#include <utility>

namespace pelage::reference {
namespace {

struct Vector {
    double x, y, z;
};
Vector operator+(Vector a, Vector b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
Vector operator*(double s, Vector a) {
    return {s * a.x, s * a.y, s * a.z};
}
double dot(Vector a, Vector b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

// From a point on x = axis, radius 1, along d inwards: the distance to the other side.
double across(Vector point, Vector d) {
    return -2.0 * (point.y * d.y + point.z * d.z) / (d.y * d.y + d.z * d.z);
}

// Reflectance of the surface with normal n (against d) for light going from index a into index b, and the refracted
// direction. Equations of Snell and Fresnel for vectors.
std::pair<double, Vector> meet(Vector d, Vector n, double a, double b) {
    const double ci = -dot(d, n), ratio = a / b;
    const double st2 = ratio * ratio * (1.0 - ci * ci);
    if (st2 >= 1.0) return {1.0, d};
    const double ct = std::sqrt(1.0 - st2);
    const double rs = (a * ci - b * ct) / (a * ci + b * ct), rp = (b * ci - a * ct) / (b * ci + a * ct);
    return {0.5 * (rs * rs + rp * rp), ratio * d + (ratio * ci - ct) * n};
}

}  // namespace

std::array<CylinderPath, 3> traceCylinder(double eta, double theta, double h, double sigmaA) {
    // The ray comes from azimuth 0, the +y side: it travels along -y, and its offset along -z: the ray meets the
    // surface at azimuth -gamma_o and turns by -2 gamma_o in all when it is reflected there.
    const double cosine = std::cos(theta);
    const Vector arriving{-std::sin(theta), -cosine, 0.0};
    Vector point{0.0, std::sqrt(1.0 - h * h), -h};
    const Vector outward{0.0, point.y, point.z};
    auto [reflected, inside] = meet(arriving, outward, 1.0, eta);
    const auto leave = [&](Vector d, double length, double weight) {
        return CylinderPath{d.x, std::atan2(d.z, d.y), length, weight};
    };
    std::array<CylinderPath, 3> paths{};
    paths[0] = leave(arriving + 2.0 * (-dot(arriving, outward)) * outward, 0.0, reflected);
    double weight = 1.0 - reflected, length = 0.0;
    for (std::size_t p = 1; p < 3; ++p) {
        const double distance = across(point, inside);
        length += distance;
        weight *= std::exp(-sigmaA * distance);
        point = point + distance * inside;
        const Vector inward{0.0, -point.y, -point.z};
        const auto [inner, leaving] = meet(inside, inward, eta, 1.0);
        paths[p] = leave(leaving, length, weight * (1.0 - inner));
        weight *= inner;
        inside = inside + 2.0 * (-dot(inside, inward)) * inward;
    }
    return paths;
}

}  // namespace pelage::reference

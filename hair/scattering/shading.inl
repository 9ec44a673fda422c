// SPDX-License-Identifier: MIT
// The shared shading source as C++. The including file defines PELAGE_REAL (float or double), PELAGE_SHADING (a
// namespace for it) and PELAGE_SCATTER (the name of the function it makes). float is compiled with single-precision
// literals (hair/CMakeLists.txt), so that no expression is promoted to double on the way.
#include "resolve.hpp"

#include <glm/glm.hpp>

namespace pelage::hair {
namespace PELAGE_SHADING {

using real = PELAGE_REAL;
using real2 = glm::vec<2, real>;
using real3 = glm::vec<3, real>;
using real4 = glm::vec<4, real>;
using namespace glm;

#include "scattering/models/models.glsl"

FiberTable lookUp(const FiberDirections& d, MomentTable* table) {
    FiberTable t;
    t.lobes = t.lengths = t.rest = real4(0);
    if (table == nullptr) return t;
    const MomentTable::Sample s = table->sample(d.cosThetaO, d.phi);
    real4* layers[3] = {&t.lobes, &t.lengths, &t.rest};
    const real wx = static_cast<real>(s.weightX), wy = static_cast<real>(s.weightY);
    for (std::size_t layer = 0; layer < 3; ++layer) {
        const auto at = [&](std::size_t k) {
            const MomentTable::Texel& x = s.texels[layer][k];
            return real4(x[0], x[1], x[2], x[3]);
        };
        *layers[layer] = mix(mix(at(0), at(1), wx), mix(at(2), at(3), wx), wy);
    }
    return t;
}

}  // namespace PELAGE_SHADING

ScatteredLobes PELAGE_SCATTER(ScatteringModel model, bool published, const FiberProperties& fiber,
                              const FiberDirections& directions, MomentTable* table) {
    using namespace PELAGE_SHADING;
    const FiberLobes s = scatterFiber(
        static_cast<int>(model), published, narrowed<FiberAngles>(resolveDirections(directions)),
        narrowed<FiberMaterial>(resolveFiber(fiber, directions.h.has_value())), lookUp(directions, table));
    ScatteredLobes out;
    const real3* lobes[4] = {&s.R, &s.TT, &s.TRT, &s.RES};
    for (std::size_t p = 0; p < 4; ++p) {
        for (std::size_t c = 0; c < 3; ++c) {
            out.lobe[p][c] = static_cast<double>((*lobes[p])[static_cast<glm::length_t>(c)]);
        }
    }
    return out;
}

}  // namespace pelage::hair

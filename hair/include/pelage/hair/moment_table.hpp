// SPDX-License-Identifier: MIT
// The table behind the model `moment_lut`: what a fibre of given index and azimuthal roughness scatters around itself
// when it absorbs nothing, and the mean and variance of the path that light takes inside. See moments.glsl.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pelage::hair {

/// A texture of three layers of RGBA16F over |phi| in [0, pi] (x) and the inclination of the view (y). Texels lie on
/// the ends of both ranges. Texels are computed when they are first asked for, so reading a few is cheap; one object
/// must not be read from two threads.
///   layer 0: N0 of R, TT, TRT, residual (1/rad), the last three without their fall towards 90 degrees (momentRim)
///   layer 1: mean and variance of the path of TT, then of TRT (radii, radii^2)
///   layer 2: the residual: mean segment (radii), and 1 / mean of 1 / (1 + r x) at x = 1/3, 2/3, 1 (moments.glsl)
class MomentTable {
public:
    static constexpr std::uint32_t layers = 3;

    /// eta is clamped to 1.0001..3, betaN to 0.01..1.
    MomentTable(double eta, double betaN);
    ~MomentTable();
    MomentTable(MomentTable&&) noexcept;
    MomentTable& operator=(MomentTable&&) noexcept;

    std::uint32_t width() const;   ///< 64 to 512, by betaN: the sharper the lobes, the more texels
    std::uint32_t height() const;  ///< 64, or 96 with the two larger widths

    using Texel = std::array<float, 4>;  // rounded to half floats
    Texel texel(std::uint32_t layer, std::uint32_t x, std::uint32_t y);

    /// The four texels of each layer around a point and the weight of each: what a bilinear sampler reads.
    struct Sample {
        std::array<std::array<Texel, 4>, layers> texels;  // (x, y), (x+1, y), (x, y+1), (x+1, y+1)
        double weightX, weightY;
    };
    Sample sample(double cosThetaO, double phi);

    /// All texels as half floats, layer by layer, row by row: what is uploaded.
    std::vector<std::uint16_t> halves();

private:
    struct State;
    std::unique_ptr<State> state_;
};

/// The name by which a material asks for a table, "moments:<eta>,<betaN>", and the one for no table.
std::string momentTableName(double eta, double betaN);
inline constexpr std::string_view momentTableNone = "moments:none";
/// The table of such a name; empty for momentTableNone and for any other text.
std::optional<MomentTable> momentTableOf(std::string_view name);

}  // namespace pelage::hair

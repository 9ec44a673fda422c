// SPDX-License-Identifier: MIT
#include <pelage/hair/scattering.hpp>

namespace pelage::hair {

namespace {
using enum ScatteringModel;
constexpr ModelInfo models[] = {
    {.model = KajiyaKay,
     .id = "kajiya_kay",
     .title = "sin(t, l) and a cone of highlight",
     .source = "Kajiya and Kay 1989",
     .corrected = true},
    {.model = Scheuermann,
     .id = "scheuermann",
     .title = "two shifted highlights over a wrapped diffuse part",
     .source = "Scheuermann 2004",
     .corrected = true},
    {.model = Marschner,
     .id = "marschner",
     .title = "R, TT, TRT of a smooth cylinder, TRT by its cubic fit",
     .source = "Marschner et al. 2003",
     .corrected = true,
     .reciprocal = true},
    {.model = Karis, .id = "karis", .title = "fitted R, TT, TRT", .source = "Karis 2016", .corrected = true},
    {.model = Thesis,
     .id = "thesis",
     .title = "Karis' and Tafuri's fits on Marschner's longitudinal lobes",
     .source = "A Framework for Real-Time Physically-Based Hair Rendering, chapter 4",
     .corrected = true,
     .reciprocal = true},
    {.model = Gerard,
     .id = "gerard",
     .title = "Henyey-Greenstein lobes, tabulated azimuth",
     .source = "Gerard, Fast Real-Time Shading for Polygonal Hair",
     .corrected = true,
     .usesTable = true},
    {.model = Chiang,
     .id = "chiang",
     .title = "near field, exact terms",
     .source = "Chiang et al. 2016; d'Eon et al. 2011",
     .usesOffset = true},
    {.model = Pxr,
     .id = "pxr",
     .title = "exact lobes and a glint under artists' controls",
     .source = "after Pekelis et al. 2015",
     .usesTable = true,
     .usesOffset = true},
    {.model = MomentLut,
     .id = "moment_lut",
     .title = "far field by tabulated azimuth and path moments",
     .source = "Pelage",
     .usesTable = true},
    {.model = SegmentCdf,
     .id = "segment_cdf",
     .title = "far field by exact integrals over segments of the offset",
     .source = "Pelage"},
};
}  // namespace

std::span<const ModelInfo> scatteringModels() {
    return models;
}

const ModelInfo* findScatteringModel(std::string_view id) {
    for (const ModelInfo& info : models) {
        if (info.id == id) return &info;
    }
    return nullptr;
}

}  // namespace pelage::hair

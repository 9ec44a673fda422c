// SPDX-License-Identifier: MIT
// A compute pass of this program's own that shades with the library's material `hair`, and the same on the CPU.
#pragma once

#include <pelage/hair/library.hpp>
#include <pelage/hair/renderer.hpp>
#include <pelage/hair/scattering.hpp>

#include <span>
#include <vector>

namespace sample {

/// The preset "brown" of a type that is `hair` with one more shader: points.comp, in the draw list "shade". Its base
/// colour is white, so that all absorption is the material's "absorption.sigma".
pelage::Result<pelage::materials::Material> shadingMaterial(pelage::hair::Library& library);

/// A strand of `count` points that winds about the y axis, in metres.
std::vector<glm::vec4> strand(std::size_t count);

/// A scene with one object that has the material, turned and moved, under two lights.
pelage::hair::Scene shadingScene(pelage::materials::Material material);

/// Radiance of each point toward the scene's camera, by the pass "Shade" of shading.pass.json.
pelage::Result<std::vector<glm::vec4>> shadeOnDevice(const pelage::rhi::Device& device,
                                                     std::shared_ptr<const pelage::passes::PassTree> tree,
                                                     pelage::hair::Scene& scene, std::span<const glm::vec4> points);
/// The same in double on the CPU, by hair::scatterDouble.
std::vector<glm::dvec3> shadeOnCpu(const pelage::hair::Scene& scene, std::span<const glm::vec4> points);

}  // namespace sample

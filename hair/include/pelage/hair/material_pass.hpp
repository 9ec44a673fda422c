// SPDX-License-Identifier: MIT
// Compute passes that shade: a pass class of the host's own that runs, for each object of the scene, the compute shader
// that its material has for the pass's draw list. In the tree and in the material type:
//
//     { "name": "Shade", "class": "ShadePoints", "drawList": "shade", "slots": { … }, "connect": { … } }
//     "shaders": { "points": { "drawList": "shade", "compute": "points.comp", "options": "*" } }
//
// The shader finds the view in set 0 (shaders/frame.glsl), the slots of the pass in set 1, its material in set 2
// (material/fiber_material.glsl) and its object in set 3 (shaders/object.glsl); what it does not use is not bound.
#pragma once

#include <pelage/hair/scene.hpp>
#include <pelage/passes/pass_class.hpp>

#include <functional>

namespace pelage::hair {

/// One object in one pass, its pipeline and bind groups set: what is left is to dispatch. Valid during the call.
struct MaterialDispatch {
    std::size_t index;  // in Scene::objects
    const Object& object;
    const rhi::ComputePipeline& pipeline;
    passes::PassContext& pass;
    rhi::ComputePassEncoder& encoder;  // of the pass
};

struct MaterialPass {
    passes::PassClassInfo info = {};  // as of any class; its kind is Compute
    /// Called in each frame for each object whose material has an enabled compute shader of the pass's list.
    std::function<Result<void>(const MaterialDispatch&)> dispatch = {};
};

}  // namespace pelage::hair

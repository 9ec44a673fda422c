// SPDX-License-Identifier: MIT
// Pipelines of fullscreen and compute passes, made when the graph is built, so that no frame waits for one and a shader
// that does not fit its pass is refused before anything is drawn.
#include "check.hpp"
#include "graph_state.hpp"
#include "pass_kinds.hpp"

namespace pelage::passes {
namespace {

class PipelineMaker {
public:
    PipelineMaker(GraphState& state, const ShaderSource& shaders, const PassClassRegistry& classes,
                  const PassTree::Description& tree, Reporter& reporter)
        : state_(state), shaders_(shaders), classes_(classes), tree_(tree), reporter_(reporter) {}

    void run() {
        for (std::size_t i = 0; i < state_.passes.size(); ++i) {
            const PlanPass& pass = state_.plan.passes[i];
            if (!pass.passClass.empty()) {
                recorder(pass, state_.passes[i]);
                continue;
            }
            if (pass.kind == PassKind::Copy) state_.passes[i].recorder = copyPass();
            if (pass.kind != PassKind::Fullscreen && pass.kind != PassKind::Compute) continue;
            const PassDeclaration* says = tree_.pass(pass.name);
            place_ = says ? says->shader.place : Place{};
            says_ = says;
            const rhi::BindGroupLayout layout = pass.kind == PassKind::Fullscreen ? fullscreen(pass, state_.passes[i])
                                                                                  : compute(pass, state_.passes[i]);
            if (layout) checkGroup(i, layout);
        }
    }

private:
    void recorder(const PlanPass& pass, PassState& own) {
        const PassDeclaration* says = tree_.pass(pass.name);
        const bool draws = says && says->passClass.empty();  // by its list
        const Place place = !says ? Place{} : draws ? says->drawListPlace : says->classPlace;
        const PassClass* found = classes_.find(pass.passClass);
        if (!found) {
            // The host described a class to the linker that the graph's registry lacks, or registered none for lists.
            reporter_.error(
                place, "P053",
                "pass '" + pass.name + "': " +
                    (draws ? "nobody draws the list '" + pass.drawList + "'; there is no class '" : "unknown class '") +
                    pass.passClass + "'",
                "register it in Graph::Descriptor::classes");
            return;
        }
        PassSetup::Asked asked;
        auto made = found->create(setup(pass, asked));
        if (made && *made) {
            own.recorder = std::move(*made);
            unknownConstants(pass, asked, "class '" + pass.passClass + "'");
            return;
        }
        if (!made) return reporter_.forward(place, made.error(), about(pass) + ", class '" + pass.passClass + "'");
        reporter_.error(place, "P072", "class '" + pass.passClass + "' gave no recorder for pass '" + pass.name + "'");
    }

    std::optional<rhi::ShaderModule> module(const std::string& file, const PlanPass& pass) {
        if (!shaders_) {
            reporter_.error(place_, "P070", "no source of shaders was given for '" + file + "'");
            return std::nullopt;
        }
        auto made = shaders_(file);
        if (made && *made) return std::move(*made);
        if (made) {
            reporter_.error(place_, "P070", "there is no shader '" + file + "' for pass '" + pass.name + "'");
        } else {
            reporter_.forward(place_, made.error(), about(pass) + ", shader '" + file + "'", "P070");
        }
        return std::nullopt;
    }

    rhi::ProgrammableStage stage(const rhi::ShaderModule& shader, const PlanPass& pass) {
        PassSetup::Asked asked;
        rhi::ProgrammableStage made = setup(pass, asked).stage(shader);
        unknownConstants(pass, asked, "'" + pass.shader + "'");
        return made;
    }

    PassSetup setup(const PlanPass& pass, PassSetup::Asked& asked) const {
        return {.device = state_.device,
                .plan = state_.plan,
                .pass = pass,
                .targets = state_.passes[static_cast<std::size_t>(&pass - state_.plan.passes.data())].targets,
                .parameters = PassParameters(pass.parameters),
                .shaders = shaders_,
                .asked = asked};
    }

    // Of the file: those that no stage of the pass has.
    void unknownConstants(const PlanPass& pass, const PassSetup::Asked& asked, const std::string& who) {
        if (asked.all) return;
        const PassDeclaration* says = tree_.pass(pass.name);
        for (const auto& [name, value] : pass.constants) {
            if (has(asked.names, name)) continue;
            Place place = place_;
            for (const ConstantDeclaration& each : says ? says->constants : std::vector<ConstantDeclaration>{}) {
                if (each.name == name) place = each.place;
            }
            reporter_.error(place, "P077", who + " has no specialization constant '" + name + "'",
                            didYouMean(name, asked.names));
        }
    }

    // Each gives the layout of the slots' set, empty when the shader uses none or the pass has a fault.
    rhi::BindGroupLayout fullscreen(const PlanPass& pass, PassState& made) {
        const auto vertex = module("fullscreen.vert", pass);
        const auto fragment = module(pass.shader, pass);
        if (!vertex || !fragment) return {};
        rhi::RenderPipelineDescriptor descriptor{.label = pass.name, .vertex = {.module = *vertex}};
        descriptor.fragment = stage(*fragment, pass);
        descriptor.multisample.count = made.targets.samples;
        for (const rhi::ReflectedVariable& output : fragment->reflection().outputs) {
            if (output.location < made.targets.colors.size()) continue;
            reporter_.error(place_, "P076",
                            "'" + pass.shader + "' writes '" + output.name + "' to location " +
                                std::to_string(output.location) + "; '" + pass.name + "' has " +
                                std::to_string(made.targets.colors.size()) + " color target(s)",
                            "give the pass another color slot, or remove the output");
            return {};
        }
        for (const PlanSlot& slot : pass.slots) {
            if (slot.resource == ~0U) continue;
            if (slot.use == SlotUse::Color) {
                rhi::ColorTargetState target{.format = state_.plan.resources[slot.resource].format};
                if (slot.blendPremultiplied) {
                    const rhi::BlendComponent over{rhi::BlendOperation::Add, rhi::BlendFactor::One,
                                                   rhi::BlendFactor::OneMinusSrcAlpha};
                    target.blend = rhi::BlendState{over, over};
                }
                descriptor.targets.push_back(target);
            } else if (slot.use == SlotUse::Depth) {
                const bool reversed = state_.plan.depth == DepthConvention::Reversed;
                const auto nearer = reversed ? rhi::CompareFunction::GreaterEqual : rhi::CompareFunction::LessEqual;
                descriptor.depthStencil = {
                    .format = made.targets.depth,
                    .depthWriteEnabled = slot.access != SlotAccess::Read,
                    .depthCompare = slot.depthTestAlways ? rhi::CompareFunction::Always : nearer};
            }
        }
        auto pipeline = state_.device.createRenderPipeline(descriptor);
        if (!pipeline) return failed(pass, pipeline.error());
        made.recorder = fullscreenPass(*pipeline);
        // Both stages: the vertex stage has none, but a changed one may.
        onlySlotSet(*fragment, pass);
        return slotsAreUsed(pipeline->bindGroupLayout(slotSet), pass);
    }

    rhi::BindGroupLayout compute(const PlanPass& pass, PassState& made) {
        const auto shader = module(pass.shader, pass);
        if (!shader) return {};
        auto pipeline = state_.device.createComputePipeline({.label = pass.name, .compute = stage(*shader, pass)});
        if (!pipeline) return failed(pass, pipeline.error());
        made.recorder = computePass(*pipeline);
        onlySlotSet(*shader, pass);
        return slotsAreUsed(pipeline->bindGroupLayout(slotSet), pass);
    }

    static std::string about(const PlanPass& pass) { return "pass '" + pass.name + "'"; }

    rhi::BindGroupLayout failed(const PlanPass& pass, const Diagnostics& faults) {
        reporter_.forward(place_, faults, "the pipeline of " + about(pass));
        return {};
    }

    void onlySlotSet(const rhi::ShaderModule& shader, const PlanPass& pass) {
        for (const rhi::ReflectedBinding& binding : shader.reflection().bindings) {
            if (binding.group == slotSet) continue;
            reporter_.error(place_, "P074",
                            "'" + pass.shader + "' uses '" + binding.entry.name + "' (set " +
                                std::to_string(binding.group) + ", binding " + std::to_string(binding.entry.binding) +
                                "); slots of '" + pass.name + "' are bound in set 1 only");
        }
    }

    rhi::BindGroupLayout slotsAreUsed(const rhi::BindGroupLayout& layout, const PlanPass& pass) {
        std::vector<std::string> known;
        if (layout) {
            for (const rhi::BindGroupLayoutEntry& entry : layout.entries()) known.push_back(entry.name);
        }
        for (const PlanSlot& slot : pass.slots) {
            if (slot.bind.empty() || has(known, slot.bind)) continue;
            const SlotDeclaration* declared = says_ ? says_->slot(slot.name) : nullptr;
            if (declared && declared->optional) continue;
            reporter_.error(declared ? declared->bindPlace : place_, "P073",
                            "'" + pass.name + "." + slot.name + "' binds '" + slot.bind + "', '" + pass.shader +
                                "' has no such resource",
                            didYouMean(slot.bind, known));
        }
        return layout;
    }

    // Made once now to find what does not fit; groups with images of the host wait for the frame.
    void checkGroup(std::size_t index, const rhi::BindGroupLayout& layout) {
        for (const PlanSlot& slot : state_.plan.passes[index].slots) {
            if (slot.resource != ~0U && state_.plan.resources[slot.resource].kind == PlanResource::Kind::Import) return;
        }
        const auto group = bindGroupFor(state_, index, layout);
        if (!group) reporter_.forward(place_, group.error(), about(state_.plan.passes[index]));
    }

    GraphState& state_;
    const ShaderSource& shaders_;
    const PassClassRegistry& classes_;
    const PassTree::Description& tree_;
    Reporter& reporter_;
    Place place_ = {};
    const PassDeclaration* says_ = nullptr;
};

}  // namespace

void makePipelines(GraphState& state, const ShaderSource& shaders, const PassClassRegistry& classes,
                   const PassTree::Description& tree, Reporter& reporter) {
    PipelineMaker(state, shaders, classes, tree, reporter).run();
}

}  // namespace pelage::passes

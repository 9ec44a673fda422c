// SPDX-License-Identifier: MIT
// Pipelines of fullscreen and compute passes, made when the graph is built, so that no frame waits for one and a shader
// that does not fit its pass is refused before anything is drawn.
#include "check.hpp"
#include "graph_state.hpp"

namespace pelage::passes {
namespace {

constexpr std::uint32_t slotSet = 1;

class PipelineMaker {
public:
    PipelineMaker(Graph::State& state, const ShaderSource& shaders, const PassClassRegistry& classes,
                  const PassTree::Description& tree, Reporter& reporter)
        : state_(state), shaders_(shaders), classes_(classes), tree_(tree), reporter_(reporter) {}

    void run() {
        for (std::size_t i = 0; i < state_.passes.size(); ++i) {
            const PlanPass& pass = state_.plan.passes[i];
            if (!pass.passClass.empty()) {
                recorder(pass, state_.passes[i]);
                continue;
            }
            if (pass.kind != PassKind::Fullscreen && pass.kind != PassKind::Compute) continue;
            const PassDeclaration* says = tree_.pass(pass.name);
            place_ = says ? says->shader.place : Place{};
            says_ = says;
            if (pass.kind == PassKind::Fullscreen) {
                fullscreen(pass, state_.passes[i]);
            } else {
                compute(pass, state_.passes[i]);
            }
            if (state_.passes[i].layout) checkGroup(i);
        }
    }

private:
    void recorder(const PlanPass& pass, PassState& own) {
        const PassDeclaration* says = tree_.pass(pass.name);
        const Place place = says ? says->classPlace : Place{};
        const PassClass* found = classes_.find(pass.passClass);
        if (!found) {
            // The host described a class to the linker that the graph's registry lacks.
            reporter_.error(place, "P053", "pass '" + pass.name + "': unknown class '" + pass.passClass + "'",
                            "register it in Graph::Descriptor::classes");
            return;
        }
        auto made = found->create(PassSetup{.device = state_.device,
                                            .plan = state_.plan,
                                            .pass = pass,
                                            .targets = own.targets,
                                            .parameters = PassParameters(pass.parameters),
                                            .shaders = shaders_});
        if (made && *made) {
            own.recorder = std::move(*made);
            return;
        }
        reporter_.error(place, "P072",
                        "class '" + pass.passClass + "' cannot make pass '" + pass.name +
                            "': " + (made ? std::string("it gave no recorder") : made.error().text()));
    }

    std::optional<rhi::ShaderModule> module(const std::string& file, const PlanPass& pass) {
        if (!shaders_) {
            reporter_.error(place_, "P070", "no source of shaders was given for '" + file + "'");
            return std::nullopt;
        }
        auto made = shaders_(file);
        if (made && *made) return std::move(*made);
        reporter_.error(place_, "P070",
                        "cannot load '" + file + "' of pass '" + pass.name + "'" +
                            (made ? std::string{} : ": " + made.error().text()));
        return std::nullopt;
    }

    rhi::ProgrammableStage stage(const rhi::ShaderModule& shader, const PlanPass& pass) {
        rhi::ProgrammableStage made{.module = shader};
        std::vector<std::string> known;
        for (const rhi::SpecConstant& constant : shader.reflection().specConstants) {
            known.push_back(constant.name);
            if (const std::optional<double> value = constantValue(constant.name, pass))
                made.constants.push_back({constant.name, *value});
        }
        for (const auto& [name, value] : pass.constants) {
            if (has(known, name)) continue;
            Place place = place_;
            for (const ConstantDeclaration& each : says_ ? says_->constants : std::vector<ConstantDeclaration>{}) {
                if (each.name == name) place = each.place;
            }
            reporter_.error(place, "P077", "'" + pass.shader + "' has no specialization constant '" + name + "'",
                            didYouMean(name, known));
        }
        return made;
    }

    // What the pass says; else what the linked image says of itself: u_source_samples, u_source_present.
    std::optional<double> constantValue(const std::string& name, const PlanPass& pass) const {
        if (const auto found = pass.constants.find(name); found != pass.constants.end()) return found->second;
        for (const PlanSlot& slot : pass.slots) {
            if (slot.bind.empty()) continue;
            const bool connected = slot.resource != ~0U;
            if (name == slot.bind + "_present") return connected ? 1 : 0;
            if (name == slot.bind + "_samples") return connected ? state_.plan.resources[slot.resource].samples : 1;
        }
        return std::nullopt;
    }

    void fullscreen(const PlanPass& pass, PassState& made) {
        const auto vertex = module("fullscreen.vert", pass);
        const auto fragment = module(pass.shader, pass);
        if (!vertex || !fragment) return;
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
            return;
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
        made.pipeline = std::move(*pipeline);
        made.layout = made.pipeline.bindGroupLayout(slotSet);
        // Both stages: the vertex stage has none, but a changed one may.
        onlySlotSet(*fragment, pass);
        slotsAreUsed(made.layout, pass);
    }

    void compute(const PlanPass& pass, PassState& made) {
        const auto shader = module(pass.shader, pass);
        if (!shader) return;
        auto pipeline = state_.device.createComputePipeline({.label = pass.name, .compute = stage(*shader, pass)});
        if (!pipeline) return failed(pass, pipeline.error());
        made.compute = std::move(*pipeline);
        made.layout = made.compute.bindGroupLayout(slotSet);
        onlySlotSet(*shader, pass);
        slotsAreUsed(made.layout, pass);
    }

    void failed(const PlanPass& pass, const Diagnostic& error) {
        reporter_.error(place_, "P071",
                        "the pipeline of pass '" + pass.name + "' cannot be made: " + rhi::toString(error));
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

    void slotsAreUsed(const rhi::BindGroupLayout& layout, const PlanPass& pass) {
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
    }

    // Made once now to hear what does not fit; groups with images of the host wait for the frame.
    void checkGroup(std::size_t index) {
        for (const PlanSlot& slot : state_.plan.passes[index].slots) {
            if (slot.resource != ~0U && state_.plan.resources[slot.resource].kind == PlanResource::Kind::Import) return;
        }
        const auto group = bindGroupFor(state_, index, state_.passes[index].layout);
        if (group) return;
        const std::string& message = group.error().message;
        const bool ours = message.size() > 6 && message[0] == 'S' && message[4] == ':';
        reporter_.error(place_, ours ? message.substr(0, 4) : "P071",
                        ours ? message.substr(6) : group.error().text());
    }

    Graph::State& state_;
    const ShaderSource& shaders_;
    const PassClassRegistry& classes_;
    const PassTree::Description& tree_;
    Reporter& reporter_;
    Place place_ = {};
    const PassDeclaration* says_ = nullptr;
};

}  // namespace

void makePipelines(Graph::State& state, const ShaderSource& shaders, const PassClassRegistry& classes,
                   const PassTree::Description& tree, Reporter& reporter) {
    PipelineMaker(state, shaders, classes, tree, reporter).run();
}

}  // namespace pelage::passes

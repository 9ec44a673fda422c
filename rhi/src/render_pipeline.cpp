// SPDX-License-Identifier: MIT
#include "pipeline.hpp"
#include "pipeline_cache.hpp"

#include <algorithm>
#include <bit>

namespace pelage::rhi {
namespace detail {
namespace {

struct VertexInput {
    std::vector<VkVertexInputBindingDescription> bindings;
    std::vector<VkVertexInputAttributeDescription> attributes;
};

/// Attributes that the shader does not read are dropped; those it reads must be there.
Result<VertexInput> vertexInput(const RenderPipelineDescriptor& d, RenderPipelineObject& object,
                                const ShaderModuleObject& shader) {
    VertexInput out;
    const auto& inputs = shader.reflection.inputs;
    std::vector<bool> found(inputs.size());
    if (d.vertexBuffers.size() > 16)  // what Vulkan promises on every device
        return invalid(ErrorCode::OutOfRange,
                       cat(object.describe(), " has ", d.vertexBuffers.size(), " vertex buffers; 16 are allowed."));
    object.vertexSlots.resize(d.vertexBuffers.size());
    for (std::uint32_t slot = 0; slot < d.vertexBuffers.size(); ++slot) {
        const auto& buffer = d.vertexBuffers[slot];
        auto& state = object.vertexSlots[slot];
        state.stepMode = buffer.stepMode;
        state.stride = buffer.arrayStride;
        for (const auto& a : buffer.attributes) {
            const std::uint32_t end = a.offset + vertexFormatBytes(a.format);
            if (buffer.arrayStride != 0 && end > buffer.arrayStride)
                return invalid(ErrorCode::OutOfRange,
                               cat(object.describe(), " vertex buffer ", slot, " has stride ", buffer.arrayStride,
                                   "; its attribute at location ", a.shaderLocation, " ends at byte ", end, '.'));
            const auto input = std::find_if(inputs.begin(), inputs.end(),
                                            [&](const auto& v) { return v.location == a.shaderLocation; });
            if (input == inputs.end()) continue;
            const auto index = static_cast<std::size_t>(input - inputs.begin());
            if (found[index])
                return invalid(ErrorCode::LayoutMismatch,
                               cat(object.describe(), " gives two attributes for location ", a.shaderLocation, '.'));
            if (numericClass(a.format) != numericClass(input->format))
                return invalid(ErrorCode::LayoutMismatch,
                               cat(object.describe(), " gives ", name(a.format), " to the vertex input \"", input->name,
                                   "\" at location ", input->location, ", which is ", name(input->format), '.'));
            found[index] = true;
            state.used = true;
            state.lastByte = std::max(state.lastByte, end);
            out.attributes.push_back({a.shaderLocation, slot, toVk(a.format), a.offset});
        }
        if (state.used)
            out.bindings.push_back({slot, buffer.arrayStride,
                                    buffer.stepMode == VertexStepMode::Vertex ? VK_VERTEX_INPUT_RATE_VERTEX
                                                                              : VK_VERTEX_INPUT_RATE_INSTANCE});
    }
    for (std::size_t i = 0; i < inputs.size(); ++i)
        if (!found[i])
            return invalid(ErrorCode::LayoutMismatch,
                           cat(object.describe(), " has no vertex attribute for location ", inputs[i].location, " \"",
                               inputs[i].name, "\" of ", shader.describe(), '.'));
    return out;
}

Result<std::vector<VkPipelineColorBlendAttachmentState>> blendStates(const DeviceObject& device,
                                                                     const RenderPipelineDescriptor& d,
                                                                     const RenderPipelineObject& object,
                                                                     const Stage* fragment) {
    std::vector<VkPipelineColorBlendAttachmentState> states;
    if (d.targets.size() > device.info.limits.maxColorAttachments)
        return invalid(ErrorCode::OutOfRange,
                       cat(object.describe(), " has ", d.targets.size(), " targets; the device allows ",
                           device.info.limits.maxColorAttachments, '.'));
    for (std::uint32_t i = 0; i < d.targets.size(); ++i) {
        const auto& t = d.targets[i];
        VkPipelineColorBlendAttachmentState s = {};
        const auto& format = formatInfo(t.format);
        const auto target = cat(object.describe(), " target ", i, " (", format.name, ')');
        if (t.format != TextureFormat::Undefined) {
            if (isDepth(t.format))
                return invalid(ErrorCode::TargetMismatch,
                               cat(target, " is a depth format; a colour format is needed."));
            s.colorWriteMask = static_cast<VkColorComponentFlags>(t.writeMask);
            if (t.blend && format.numeric != NumericClass::Float)
                return invalid(ErrorCode::FormatUnsupported,
                               cat(target, " has whole numbers, which cannot be blended."));
            const ReflectedVariable* output = nullptr;
            if (fragment != nullptr)
                for (const auto& o : fragment->module->reflection.outputs)
                    if (o.location == i) output = &o;
            if (s.colorWriteMask != 0 && output == nullptr)
                return invalid(ErrorCode::TargetMismatch,
                               cat(target, " is written by no output of ",
                                   fragment != nullptr ? fragment->module->describe() : "the absent fragment stage",
                                   "; give it ColorWriteMask::None or an output at location ", i, '.'));
            if (s.colorWriteMask != 0 && numericClass(output->format) != format.numeric)
                return invalid(ErrorCode::TargetMismatch, cat(target, " cannot take the output \"", output->name,
                                                              "\", which is ", name(output->format), '.'));
            if (t.blend) {
                s.blendEnable = VK_TRUE;
                s.srcColorBlendFactor = toVk(t.blend->color.srcFactor);
                s.dstColorBlendFactor = toVk(t.blend->color.dstFactor);
                s.colorBlendOp = toVk(t.blend->color.operation);
                s.srcAlphaBlendFactor = toVk(t.blend->alpha.srcFactor);
                s.dstAlphaBlendFactor = toVk(t.blend->alpha.dstFactor);
                s.alphaBlendOp = toVk(t.blend->alpha.operation);
            }
        }
        states.push_back(s);
    }
    return states;
}

std::string keyOf(const RenderPipelineDescriptor& d, std::span<const Stage> stages,
                  const PipelineLayoutObject& layout) {
    std::string key = cat("render;", layout.id, ';');
    for (const auto& stage : stages) key += keyOf(stage);
    const auto put = [&](auto... values) { ((key += cat(+values, ',')), ...); };
    for (const auto& b : d.vertexBuffers) {
        key += 'b';
        put(b.arrayStride, static_cast<int>(b.stepMode));
        for (const auto& a : b.attributes) put(static_cast<int>(a.format), a.offset, a.shaderLocation);
    }
    const auto& p = d.primitive;
    key += 'p';
    put(static_cast<int>(p.topology), static_cast<int>(p.frontFace), static_cast<int>(p.cullMode),
        static_cast<int>(p.unclippedDepth));
    if (d.depthStencil) {
        const auto& z = *d.depthStencil;
        key += 'd';
        put(static_cast<int>(z.format), static_cast<int>(z.depthWriteEnabled), static_cast<int>(z.depthCompare),
            std::bit_cast<std::uint32_t>(z.depthBias), std::bit_cast<std::uint32_t>(z.depthBiasSlopeScale));
    }
    key += 's';
    put(d.multisample.count, d.multisample.mask, static_cast<int>(d.multisample.alphaToCoverageEnabled));
    for (const auto& t : d.targets) {
        key += 't';
        put(static_cast<int>(t.format), static_cast<std::uint32_t>(t.writeMask));
        if (t.blend)
            for (const auto& c : {t.blend->color, t.blend->alpha})
                put(static_cast<int>(c.operation), static_cast<int>(c.srcFactor), static_cast<int>(c.dstFactor));
    }
    return key;
}

Result<void> checkState(const DeviceObject& device, const RenderPipelineDescriptor& d,
                        const RenderPipelineObject& object) {
    const auto count = d.multisample.count;
    const auto attachments = [&](TextureFormat format) -> Result<void> {
        if (format == TextureFormat::Undefined ||
            Device(object.device).supports(format, TextureUsage::RenderAttachment, count))
            return {};
        const bool alone = Device(object.device).supports(format, TextureUsage::RenderAttachment);
        return fail(alone ? ErrorKind::Validation : ErrorKind::Unsupported,
                    alone ? ErrorCode::SampleCount : ErrorCode::FormatUnsupported,
                    cat(object.describe(), " draws to ", name(format), " with ", count,
                        count == 1 ? " sample" : " samples", ", which the device cannot do."));
    };
    for (const auto& t : d.targets)
        if (auto ok = attachments(t.format); !ok) return ok;
    if (d.depthStencil) {
        if (!isDepth(d.depthStencil->format))
            return invalid(ErrorCode::TargetMismatch, cat(object.describe(), " has the depth format ",
                                                          name(d.depthStencil->format), ", which holds no depth."));
        if (auto ok = attachments(d.depthStencil->format); !ok) return ok;
    }
    if (d.targets.empty() && !d.depthStencil)
        return invalid(ErrorCode::TargetMismatch, cat(object.describe(), " has neither targets nor a depth format."));
    if (d.multisample.alphaToCoverageEnabled && count == 1)
        return invalid(ErrorCode::SampleCount,
                       cat(object.describe(), " uses alpha to coverage with 1 sample; more than 1 is needed."));
    if (d.multisample.alphaToCoverageEnabled && !d.fragment)
        return invalid(ErrorCode::TargetMismatch,
                       cat(object.describe(), " uses alpha to coverage and has no fragment stage."));
    if (d.primitive.unclippedDepth && !device.depthClamp)
        return fail(ErrorKind::Unsupported, ErrorCode::MissingFeature,
                    cat(object.describe(), " asks for unclipped depth, which the device does not have."));
    return {};
}

Result<void> build(const RenderPipelineDescriptor& d, RenderPipelineObject& object, std::span<const Stage> stages) {
    auto& device = *object.device;
    auto input = vertexInput(d, object, *stages[0].module);
    if (!input) return forward(input.error());
    auto blends = blendStates(device, d, object, stages.size() > 1 ? &stages[1] : nullptr);
    if (!blends) return forward(blends.error());

    std::vector<VkPipelineShaderStageCreateInfo> shaderStages;
    for (const auto& stage : stages) shaderStages.push_back(stage.create());
    VkPipelineVertexInputStateCreateInfo vertex = {VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO};
    vertex.vertexBindingDescriptionCount = static_cast<std::uint32_t>(input->bindings.size());
    vertex.pVertexBindingDescriptions = input->bindings.data();
    vertex.vertexAttributeDescriptionCount = static_cast<std::uint32_t>(input->attributes.size());
    vertex.pVertexAttributeDescriptions = input->attributes.data();
    VkPipelineInputAssemblyStateCreateInfo assembly = {VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO};
    assembly.topology = toVk(d.primitive.topology);
    VkPipelineViewportStateCreateInfo viewport = {VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO};
    viewport.viewportCount = viewport.scissorCount = 1;
    VkPipelineRasterizationLineStateCreateInfoEXT lines = {
        VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_LINE_STATE_CREATE_INFO_EXT};
    lines.lineRasterizationMode = VK_LINE_RASTERIZATION_MODE_RECTANGULAR_EXT;  // the right area under MSAA
    VkPipelineRasterizationStateCreateInfo raster = {VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO};
    const bool isLine =
        d.primitive.topology == PrimitiveTopology::LineList || d.primitive.topology == PrimitiveTopology::LineStrip;
    if (isLine && device.rectangularLines) raster.pNext = &lines;
    raster.depthClampEnable = d.primitive.unclippedDepth;
    raster.cullMode = toVk(d.primitive.cullMode);
    // The viewport is flipped, so windings mean on screen what they mean in clip space with +Y up.
    raster.frontFace =
        d.primitive.frontFace == FrontFace::CCW ? VK_FRONT_FACE_COUNTER_CLOCKWISE : VK_FRONT_FACE_CLOCKWISE;
    raster.lineWidth = 1;
    VkPipelineMultisampleStateCreateInfo multisample = {VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO};
    multisample.rasterizationSamples = static_cast<VkSampleCountFlagBits>(d.multisample.count);
    multisample.pSampleMask = &d.multisample.mask;
    multisample.alphaToCoverageEnable = d.multisample.alphaToCoverageEnabled;
    VkPipelineDepthStencilStateCreateInfo depth = {VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO};
    if (d.depthStencil) {
        const auto& z = *d.depthStencil;
        depth.depthTestEnable = z.depthWriteEnabled || (z.depthCompare != CompareFunction::Always &&
                                                        z.depthCompare != CompareFunction::Undefined);
        depth.depthWriteEnable = z.depthWriteEnabled;
        depth.depthCompareOp = toVk(z.depthCompare);
        raster.depthBiasEnable = z.depthBias != 0 || z.depthBiasSlopeScale != 0;
        raster.depthBiasConstantFactor = z.depthBias;
        raster.depthBiasSlopeFactor = z.depthBiasSlopeScale;
    }
    VkPipelineColorBlendStateCreateInfo blend = {VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO};
    blend.attachmentCount = static_cast<std::uint32_t>(blends->size());
    blend.pAttachments = blends->data();
    const VkDynamicState states[] = {VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR, VK_DYNAMIC_STATE_LINE_WIDTH};
    VkPipelineDynamicStateCreateInfo dynamic = {VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO};
    dynamic.dynamicStateCount = static_cast<std::uint32_t>(std::size(states));
    dynamic.pDynamicStates = states;
    std::vector<VkFormat> formats;
    for (const auto format : object.colorFormats) formats.push_back(toVk(format));
    VkPipelineRenderingCreateInfo rendering = {VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO};
    rendering.colorAttachmentCount = static_cast<std::uint32_t>(formats.size());
    rendering.pColorAttachmentFormats = formats.data();
    rendering.depthAttachmentFormat = toVk(object.depthFormat);
    VkGraphicsPipelineCreateInfo info = {VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO, &rendering};
    info.stageCount = static_cast<std::uint32_t>(shaderStages.size());
    info.pStages = shaderStages.data();
    info.pVertexInputState = &vertex;
    info.pInputAssemblyState = &assembly;
    info.pViewportState = &viewport;
    info.pRasterizationState = &raster;
    info.pMultisampleState = &multisample;
    info.pDepthStencilState = &depth;
    info.pColorBlendState = &blend;
    info.pDynamicState = &dynamic;
    info.layout = object.layout->handle;
    CreationFeedback feedback;
    info.pNext = feedback.chain(info.pNext);
    const auto r = device.functions.vkCreateGraphicsPipelines(device.handle, device.pipelineCache, 1, &info,
                                                              device.allocator, &object.handle);
    if (r != VK_SUCCESS) return forward(vulkanError(r, "vkCreateGraphicsPipelines", object.describe()));
    feedback.count(device);
    return {};
}

Result<RenderPipeline> makeRenderPipeline(const std::shared_ptr<DeviceObject>& device,
                                          const RenderPipelineDescriptor& d) {
    auto object = std::make_shared<RenderPipelineObject>(device, "RenderPipeline", d.label);
    std::vector<Stage> stages;
    auto vertex = makeStage(*device, d.vertex, ShaderStage::Vertex, object->describe());
    if (!vertex) return forward(vertex.error());
    stages.push_back(std::move(*vertex));
    if (d.fragment) {
        auto fragment = makeStage(*device, *d.fragment, ShaderStage::Fragment, object->describe());
        if (!fragment) return forward(fragment.error());
        stages.push_back(std::move(*fragment));
    }
    if (auto ok = checkState(*device, d, *object); !ok) return forward(ok.error());
    auto layout = layoutFor(device, d.layout, stages, d.label, object->describe());
    if (!layout) return forward(layout.error());
    object->layout = *layout;
    const auto key = keyOf(d, stages, **layout);
    if (auto known = findPipeline(*device, key))
        return RenderPipeline(std::static_pointer_cast<RenderPipelineObject>(known));
    for (const auto& t : d.targets) object->colorFormats.push_back(t.format);
    if (d.depthStencil) {
        object->depthFormat = d.depthStencil->format;
        object->writesDepth = d.depthStencil->depthWriteEnabled;
    }
    object->sampleCount = d.multisample.count;
    if (auto ok = build(d, *object, stages); !ok) return forward(ok.error());
    object->key = key;
    ++device->livePipelines;
    device->nameObject(VK_OBJECT_TYPE_PIPELINE, object->handle, d.label);
    return RenderPipeline(std::static_pointer_cast<RenderPipelineObject>(enterPipeline(*device, std::move(object))));
}

}  // namespace
}  // namespace detail

Result<RenderPipeline> Device::createRenderPipeline(const RenderPipelineDescriptor& descriptor) const {
    if (auto ok = detail::needHandle(*this, "the device"); !ok) return detail::forward(ok.error());
    return object_->reported(detail::makeRenderPipeline(object_, descriptor));
}
const std::string& RenderPipeline::label() const {
    return object_->label;
}
BindGroupLayout RenderPipeline::bindGroupLayout(std::uint32_t group) const {
    if (!object_ || group >= object_->layout->sets.size()) return {};
    const auto& set = object_->layout->sets[group];
    return set->entries.empty() ? BindGroupLayout() : BindGroupLayout(set);
}
std::uint32_t RenderPipeline::bindGroupCount() const {
    return object_ ? static_cast<std::uint32_t>(object_->layout->sets.size()) : 0;
}

}  // namespace pelage::rhi

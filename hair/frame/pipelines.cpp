// SPDX-License-Identifier: MIT
#include "pipelines.hpp"

#include <algorithm>

namespace pelage::hair {
namespace {

bool same(const rhi::ProgrammableStage& a, const rhi::ProgrammableStage& b) {
    return a.module == b.module && a.constants == b.constants;
}

bool same(const rhi::VertexBufferLayout& a, const rhi::VertexBufferLayout& b) {
    return a.arrayStride == b.arrayStride && a.stepMode == b.stepMode &&
           std::equal(a.attributes.begin(), a.attributes.end(), b.attributes.begin(), b.attributes.end(),
                      [](const rhi::VertexAttribute& x, const rhi::VertexAttribute& y) {
                          return x.format == y.format && x.offset == y.offset && x.shaderLocation == y.shaderLocation;
                      });
}

bool same(const rhi::DepthStencilState& a, const rhi::DepthStencilState& b) {
    return a.format == b.format && a.depthWriteEnabled == b.depthWriteEnabled && a.depthCompare == b.depthCompare &&
           a.depthBias == b.depthBias && a.depthBiasSlopeScale == b.depthBiasSlopeScale;
}

bool same(const rhi::ColorTargetState& a, const rhi::ColorTargetState& b) {
    return a.format == b.format && a.blend == b.blend && a.writeMask == b.writeMask;
}

template <class T>
bool same(const std::optional<T>& a, const std::optional<T>& b) {
    return a.has_value() == b.has_value() && (!a || same(*a, *b));
}

template <class T>
bool same(const std::vector<T>& a, const std::vector<T>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const T& x, const T& y) { return same(x, y); });
}

}  // namespace

bool samePipeline(const rhi::RenderPipelineDescriptor& a, const rhi::RenderPipelineDescriptor& b) {
    return a.layout == b.layout && same(a.vertex, b.vertex) && same(a.vertexBuffers, b.vertexBuffers) &&
           a.primitive.topology == b.primitive.topology && a.primitive.frontFace == b.primitive.frontFace &&
           a.primitive.cullMode == b.primitive.cullMode && a.primitive.unclippedDepth == b.primitive.unclippedDepth &&
           same(a.depthStencil, b.depthStencil) && a.multisample.count == b.multisample.count &&
           a.multisample.mask == b.multisample.mask &&
           a.multisample.alphaToCoverageEnabled == b.multisample.alphaToCoverageEnabled &&
           same(a.fragment, b.fragment) && same(a.targets, b.targets);
}

bool samePipeline(const rhi::ComputePipelineDescriptor& a, const rhi::ComputePipelineDescriptor& b) {
    return a.layout == b.layout && same(a.compute, b.compute);
}

Pipelines::Pipelines(rhi::Device device, PipelineMode mode, std::function<void(const std::string&)> beforeMaking)
    : device_(std::move(device)), mode_(mode), beforeMaking_(std::move(beforeMaking)) {}

Pipelines::~Pipelines() = default;

Pipelines::Handle Pipelines::request(Descriptor descriptor) {
    const auto isWanted = [&](const std::shared_ptr<Entry>& entry) {
        if (entry->descriptor_.index() != descriptor.index()) return false;
        return std::visit(
            [&](const auto& wanted) {
                return samePipeline(std::get<std::decay_t<decltype(wanted)>>(entry->descriptor_), wanted);
            },
            descriptor);
    };
    const auto known = std::find_if(entries_.begin(), entries_.end(), isWanted);
    if (known != entries_.end() && (*known)->state() != Entry::State::Failed) return *known;
    auto entry = std::make_shared<Entry>(std::move(descriptor));
    if (known != entries_.end()) {
        *known = entry;  // tried again
    } else {
        entries_.push_back(entry);
    }
    {
        const std::lock_guard lock(mutex_);
        ++pending_;
        if (mode_ == PipelineMode::Background) {
            jobs_.push_back(entry);
            // The thread is there once it is needed.
            if (!worker_.joinable()) worker_ = std::jthread([this](const std::stop_token& stop) { work(stop); });
        }
    }
    if (mode_ == PipelineMode::Background) {
        changed_.notify_all();
    } else {
        make(*entry);
    }
    return entry;
}

void Pipelines::make(Entry& entry) {
    const auto keep = [&](auto made, auto& pipeline) {
        if (made) {
            pipeline = *made;
        } else {
            entry.error_ = made.error();
        }
        return made.has_value();
    };
    bool isReady = false;
    if (const auto* render = std::get_if<rhi::RenderPipelineDescriptor>(&entry.descriptor_)) {
        if (beforeMaking_) beforeMaking_(render->label);
        isReady = keep(device_.createRenderPipeline(*render), entry.render_);
    } else {
        const auto& compute = std::get<rhi::ComputePipelineDescriptor>(entry.descriptor_);
        if (beforeMaking_) beforeMaking_(compute.label);
        isReady = keep(device_.createComputePipeline(compute), entry.compute_);
    }
    {
        const std::lock_guard lock(mutex_);
        entry.state_.store(isReady ? Entry::State::Ready : Entry::State::Failed, std::memory_order_release);
        made_ += isReady ? 1 : 0;
        --pending_;
    }
    changed_.notify_all();
}

void Pipelines::work(const std::stop_token& stop) {
    while (true) {
        std::shared_ptr<Entry> entry;
        {
            std::unique_lock lock(mutex_);
            if (!changed_.wait(lock, stop, [&] { return !jobs_.empty(); }) || stop.stop_requested()) return;
            entry = std::move(jobs_.front());
            jobs_.pop_front();
        }
        make(*entry);
    }
}

void Pipelines::wait() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return pending_ == 0; });
}

std::uint32_t Pipelines::pending() const {
    const std::lock_guard lock(mutex_);
    return pending_;
}

std::uint32_t Pipelines::made() const {
    const std::lock_guard lock(mutex_);
    return made_;
}

}  // namespace pelage::hair

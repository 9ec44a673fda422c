// SPDX-License-Identifier: MIT
#include "pipelines.hpp"

#include <algorithm>
#include <bit>

namespace pelage::hair {
namespace {

// FNV-1a: https://www.rfc-editor.org/rfc/rfc9923. Fed byte by byte, so that no platform's byte order or padding counts.
class Hash {
public:
    void add(std::uint64_t value, int bytes = 8) {
        for (int i = 0; i < bytes; ++i) {
            value_ = (value_ ^ (value & 0xFF)) * 0x100000001B3ULL;
            value >>= 8;
        }
    }
    template <class Enum>
    requires std::is_enum_v<Enum>
    void add(Enum value) { add(static_cast<std::uint64_t>(value), 4); }
    void add(bool value) { add(value ? 1U : 0U, 1); }
    void add(float value) { add(std::bit_cast<std::uint32_t>(value == 0 ? 0.0F : value), 4); }  // -0 is 0
    void add(double value) { add(std::bit_cast<std::uint64_t>(value == 0 ? 0.0 : value)); }
    void add(std::string_view text) {
        add(text.size());
        for (const char c : text) add(static_cast<unsigned char>(c), 1);
    }
    void add(const rhi::BlendComponent& blend) {
        add(blend.operation);
        add(blend.srcFactor);
        add(blend.dstFactor);
    }
    void add(std::vector<rhi::ConstantEntry> constants) {
        std::sort(constants.begin(), constants.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
        add(constants.size());
        for (const rhi::ConstantEntry& constant : constants) {
            add(std::string_view(constant.name));
            add(constant.value);
        }
    }
    std::uint64_t value() const { return value_; }

private:
    std::uint64_t value_ = 0xCBF29CE484222325ULL;
};

}  // namespace

std::uint64_t codeHash(std::span<const std::uint32_t> code) {
    Hash hash;
    for (const std::uint32_t word : code) hash.add(word, 4);
    return hash.value();
}

std::uint64_t pipelineKey(const rhi::RenderPipelineDescriptor& descriptor, std::uint64_t vertex,
                          std::uint64_t fragment) {
    Hash hash;
    hash.add(vertex);
    hash.add(descriptor.vertex.constants);
    hash.add(descriptor.vertexBuffers.size());
    for (const rhi::VertexBufferLayout& buffer : descriptor.vertexBuffers) {
        hash.add(buffer.arrayStride, 4);
        hash.add(buffer.stepMode);
        hash.add(buffer.attributes.size());
        for (const rhi::VertexAttribute& attribute : buffer.attributes) {
            hash.add(attribute.format);
            hash.add(attribute.offset, 4);
            hash.add(attribute.shaderLocation, 4);
        }
    }
    hash.add(descriptor.primitive.topology);
    hash.add(descriptor.primitive.frontFace);
    hash.add(descriptor.primitive.cullMode);
    hash.add(descriptor.primitive.unclippedDepth);
    hash.add(descriptor.depthStencil.has_value());
    if (const auto& depth = descriptor.depthStencil) {
        hash.add(depth->format);
        hash.add(depth->depthWriteEnabled);
        hash.add(depth->depthCompare);
        hash.add(depth->depthBias);
        hash.add(depth->depthBiasSlopeScale);
    }
    hash.add(descriptor.multisample.count, 4);
    hash.add(descriptor.multisample.mask, 4);
    hash.add(descriptor.multisample.alphaToCoverageEnabled);
    hash.add(descriptor.fragment.has_value());
    if (descriptor.fragment) {
        hash.add(fragment);
        hash.add(descriptor.fragment->constants);
    }
    hash.add(descriptor.targets.size());
    for (const rhi::ColorTargetState& target : descriptor.targets) {
        hash.add(target.format);
        hash.add(target.writeMask);
        hash.add(target.blend.has_value());
        if (target.blend) {
            hash.add(target.blend->color);
            hash.add(target.blend->alpha);
        }
    }
    return hash.value();
}

Pipelines::Pipelines(rhi::Device device, PipelineMode mode, std::function<void(std::uint64_t)> beforeMaking)
    : device_(std::move(device)), mode_(mode), beforeMaking_(std::move(beforeMaking)) {}

Pipelines::~Pipelines() = default;

Pipelines::Handle Pipelines::request(rhi::RenderPipelineDescriptor descriptor) {
    const auto hashOf = [&](const rhi::ShaderModule& module) {
        const auto [known, isNew] = codeHashes_.try_emplace(module.get(), module, 0);
        if (isNew) known->second.second = codeHash(module.code());
        return known->second.second;
    };
    const std::uint64_t key = pipelineKey(descriptor, hashOf(descriptor.vertex.module),
                                          descriptor.fragment ? hashOf(descriptor.fragment->module) : 0);
    std::shared_ptr<Entry>& entry = entries_[key];
    if (entry && entry->state() != Entry::State::Failed) return entry;
    entry = std::make_shared<Entry>();
    entry->key_ = key;
    Job job{entry, std::move(descriptor)};
    {
        const std::lock_guard lock(mutex_);
        ++pending_;
        if (mode_ == PipelineMode::Background) {
            jobs_.push_back(std::move(job));
            // The thread is there once it is needed.
            if (!worker_.joinable()) worker_ = std::jthread([this](const std::stop_token& stop) { work(stop); });
        }
    }
    if (mode_ == PipelineMode::Background) {
        changed_.notify_all();
    } else {
        make(job);
    }
    return entry;
}

void Pipelines::make(Job& job) {
    if (beforeMaking_) beforeMaking_(job.entry->key_);
    auto made = device_.createRenderPipeline(job.descriptor);
    if (made) {
        job.entry->pipeline_ = *made;
    } else {
        job.entry->error_ = made.error();
    }
    {
        const std::lock_guard lock(mutex_);
        job.entry->state_.store(made ? Entry::State::Ready : Entry::State::Failed, std::memory_order_release);
        made_ += made ? 1 : 0;
        --pending_;
    }
    changed_.notify_all();
}

void Pipelines::work(const std::stop_token& stop) {
    while (true) {
        Job job;
        {
            std::unique_lock lock(mutex_);
            if (!changed_.wait(lock, stop, [&] { return !jobs_.empty(); }) || stop.stop_requested()) return;
            job = std::move(jobs_.front());
            jobs_.pop_front();
        }
        make(job);
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

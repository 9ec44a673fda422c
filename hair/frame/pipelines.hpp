// SPDX-License-Identifier: MIT
// Pipelines by what they are made of. A request gives a handle at once; the pipeline is made in the call or, in the
// background, by one thread that ends with this object. Equal requests share one pipeline, which is kept: a material
// that is switched back to earlier options finds its pipeline there.
#pragma once

#include <pelage/hair/renderer.hpp>

#include <atomic>
#include <condition_variable>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <variant>
#include <vector>

namespace pelage::hair {

/// Whether both describe the same pipeline, whatever their labels.
bool samePipeline(const rhi::RenderPipelineDescriptor& a, const rhi::RenderPipelineDescriptor& b);
bool samePipeline(const rhi::ComputePipelineDescriptor& a, const rhi::ComputePipelineDescriptor& b);

class Pipelines {
public:
    using Descriptor = std::variant<rhi::RenderPipelineDescriptor, rhi::ComputePipelineDescriptor>;
    /// One pipeline, perhaps still being made. Its state goes from Pending to one of the others and stays there.
    class Entry {
    public:
        enum class State : std::uint8_t { Pending, Ready, Failed };
        explicit Entry(Descriptor descriptor) : descriptor_(std::move(descriptor)) {}
        State state() const { return state_.load(std::memory_order_acquire); }
        const rhi::RenderPipeline& render() const { return render_; }     // Ready, of a RenderPipelineDescriptor
        const rhi::ComputePipeline& compute() const { return compute_; }  // Ready, of a ComputePipelineDescriptor
        const Diagnostics& error() const { return error_; }               // Failed

    private:
        friend class Pipelines;
        std::atomic<State> state_ = State::Pending;
        Descriptor descriptor_;
        rhi::RenderPipeline render_ = {};
        rhi::ComputePipeline compute_ = {};
        Diagnostics error_ = {};
    };
    using Handle = std::shared_ptr<const Entry>;

    /// `beforeMaking`, if there is one, is called with the label on the thread that makes a pipeline.
    Pipelines(rhi::Device device, PipelineMode mode, std::function<void(const std::string&)> beforeMaking);
    ~Pipelines();

    /// Never waits for a pipeline in background mode. A failed request is tried again when it is made again.
    Handle request(Descriptor descriptor);
    /// Until nothing is pending.
    void wait();
    std::uint32_t pending() const;
    std::uint32_t made() const;  // successfully, so far

private:
    void make(Entry& entry);
    void work(const std::stop_token& stop);

    rhi::Device device_;
    PipelineMode mode_;
    std::function<void(const std::string&)> beforeMaking_;
    std::vector<std::shared_ptr<Entry>> entries_;  // few, and asked for only when a material or the plan has changed
    mutable std::mutex mutex_;                     // of what follows
    std::condition_variable_any changed_;
    std::deque<std::shared_ptr<Entry>> jobs_;
    std::uint32_t pending_ = 0, made_ = 0;
    std::jthread worker_;  // last: it ends before what it uses goes
};

}  // namespace pelage::hair

// SPDX-License-Identifier: MIT
// Render pipelines by what they are made of. A request gives a handle at once; the pipeline is made in the call or, in
// the background, by one thread that ends with this object. Equal requests share one pipeline.
#pragma once

#include <pelage/hair/renderer.hpp>

#include <atomic>
#include <condition_variable>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <thread>

namespace pelage::hair {

/// 64-bit FNV-1a over the words of a shader, lowest byte first.
std::uint64_t codeHash(std::span<const std::uint32_t> code);

/// A number for everything a pipeline is made of but its label: code, constants (in any order), vertex buffers, states,
/// formats, samples. The same on every platform and in every run. `vertex` and `fragment` are the hashes of the code of
/// the descriptor's modules, which are not looked at; 0 where there is none.
std::uint64_t pipelineKey(const rhi::RenderPipelineDescriptor& descriptor, std::uint64_t vertex,
                          std::uint64_t fragment);

class Pipelines {
public:
    /// One pipeline, perhaps still being made. Its state goes from Pending to one of the others and stays there.
    class Entry {
    public:
        enum class State : std::uint8_t { Pending, Ready, Failed };
        State state() const { return state_.load(std::memory_order_acquire); }
        const rhi::RenderPipeline& pipeline() const { return pipeline_; }  // Ready
        const Diagnostic& error() const { return error_; }                 // Failed

    private:
        friend class Pipelines;
        std::atomic<State> state_ = State::Pending;
        std::uint64_t key_ = 0;
        rhi::RenderPipeline pipeline_ = {};
        Diagnostic error_ = {};
    };
    using Handle = std::shared_ptr<const Entry>;

    /// `beforeMaking`, if there is one, is called with the key on the thread that makes a pipeline.
    Pipelines(rhi::Device device, PipelineMode mode, std::function<void(std::uint64_t)> beforeMaking);
    ~Pipelines();

    /// Never waits for a pipeline in background mode. A failed request is tried again when it is made again.
    Handle request(rhi::RenderPipelineDescriptor descriptor);
    /// Until nothing is pending.
    void wait();
    std::uint32_t pending() const;
    std::uint32_t made() const;  // successfully, so far

private:
    struct Job {
        std::shared_ptr<Entry> entry = {};
        rhi::RenderPipelineDescriptor descriptor = {};
    };
    void make(Job& job);
    void work(const std::stop_token& stop);

    rhi::Device device_;
    PipelineMode mode_;
    std::function<void(std::uint64_t)> beforeMaking_;
    std::map<const void*, std::pair<rhi::ShaderModule, std::uint64_t>> codeHashes_;  // by module, which is kept alive
    std::map<std::uint64_t, std::shared_ptr<Entry>> entries_;                        // by key
    mutable std::mutex mutex_;                                                       // of what follows
    std::condition_variable_any changed_;
    std::deque<Job> jobs_;
    std::uint32_t pending_ = 0, made_ = 0;
    std::jthread worker_;  // last: it ends before what it uses goes
};

}  // namespace pelage::hair

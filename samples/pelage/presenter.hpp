// SPDX-License-Identifier: MIT
// Puts the display picture into a window's texture. The two differ in channel order and perhaps in encoding, so it is
// drawn, not copied.
#pragma once

#include "failure.hpp"

#include <pelage/rhi/rhi.hpp>

namespace pelage::app {

class Presenter {
public:
    explicit Presenter(rhi::Device device) : device_(std::move(device)) {}

    Result<void> encode(rhi::CommandEncoder& encoder, const rhi::Texture& picture, const rhi::Texture& window);

private:
    Result<void> makePipeline(rhi::TextureFormat format);
    /// The picture as something a shader may read: itself, or a copy when the frame did not make it readable.
    Result<rhi::Texture> readable(rhi::CommandEncoder& encoder, const rhi::Texture& picture);

    rhi::Device device_;
    rhi::RenderPipeline pipeline_ = {};
    rhi::TextureFormat format_ = rhi::TextureFormat::Undefined;
    rhi::Texture copy_ = {};
};

}  // namespace pelage::app

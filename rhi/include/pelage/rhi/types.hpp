// SPDX-License-Identifier: MIT
// The enumerations and small structs of the library: WebGPU's vocabulary in C++.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>

namespace pelage::rhi {

#define PELAGE_RHI_FLAGS(E)                                                                   \
    constexpr E operator|(E a, E b) {                                                         \
        return static_cast<E>(static_cast<std::uint32_t>(a) | static_cast<std::uint32_t>(b)); \
    }                                                                                         \
    constexpr E operator&(E a, E b) {                                                         \
        return static_cast<E>(static_cast<std::uint32_t>(a) & static_cast<std::uint32_t>(b)); \
    }                                                                                         \
    constexpr bool contains(E set, E part) {                                                  \
        return (set & part) == part;                                                          \
    }                                                                                         \
    constexpr bool any(E set) {                                                               \
        return static_cast<std::uint32_t>(set) != 0;                                          \
    }

struct Extent3D {
    std::uint32_t width = 1, height = 1, depthOrArrayLayers = 1;
    bool operator==(const Extent3D&) const = default;
};
struct Origin3D {
    std::uint32_t x = 0, y = 0, z = 0;
};

enum class TextureFormat : std::uint8_t {
    Undefined,
    R8Unorm,
    RG8Unorm,
    RGBA8Unorm,
    RGBA8UnormSrgb,
    BGRA8Unorm,
    BGRA8UnormSrgb,
    RGB10A2Unorm,
    R8Uint,
    R16Float,
    RG16Float,
    RGBA16Float,
    RG11B10Ufloat,
    R32Float,
    RG32Float,
    RGBA32Float,
    R32Uint,
    RG32Uint,
    RGBA32Uint,
    Depth32Float,
    Depth24PlusStencil8,
    Depth32FloatStencil8,
};
/// Bytes per texel; 0 for Undefined and for combined depth-stencil formats.
std::uint32_t bytesPerTexel(TextureFormat format);
bool isDepth(TextureFormat format);
/// "RGBA16Float"; the inverse gives Undefined for an unknown word.
std::string_view name(TextureFormat format);
TextureFormat textureFormatFromName(std::string_view name);

enum class BufferUsage : std::uint32_t {
    None = 0,
    MapRead = 1,
    MapWrite = 2,
    CopySrc = 4,
    CopyDst = 8,
    Index = 16,
    Vertex = 32,
    Uniform = 64,
    Storage = 128,
    Indirect = 256,
    QueryResolve = 512,
};
PELAGE_RHI_FLAGS(BufferUsage)

enum class TextureUsage : std::uint32_t {
    None = 0,
    CopySrc = 1,
    CopyDst = 2,
    TextureBinding = 4,
    StorageBinding = 8,
    RenderAttachment = 16,
};
PELAGE_RHI_FLAGS(TextureUsage)

enum class TextureDimension : std::uint8_t { E2D, E3D };
enum class TextureViewDimension : std::uint8_t { E2D, E2DArray, Cube, E3D };
enum class TextureAspect : std::uint8_t { All, DepthOnly, StencilOnly };

enum class AddressMode : std::uint8_t { ClampToEdge, Repeat, MirrorRepeat, ClampToBorderZero, ClampToBorderOne };
enum class FilterMode : std::uint8_t { Nearest, Linear };
enum class CompareFunction : std::uint8_t {
    Undefined,
    Never,
    Less,
    Equal,
    LessEqual,
    Greater,
    NotEqual,
    GreaterEqual,
    Always,
};

enum class ShaderStage : std::uint32_t { None = 0, Vertex = 1, Fragment = 2, Compute = 4 };
PELAGE_RHI_FLAGS(ShaderStage)

enum class BindingType : std::uint8_t {
    UniformBuffer,
    StorageBuffer,
    ReadOnlyStorageBuffer,
    Sampler,
    ComparisonSampler,
    SampledTexture,
    MultisampledTexture,
    DepthTexture,
    StorageTexture,
    ReadOnlyStorageTexture,
};
std::string_view name(BindingType type);

enum class VertexFormat : std::uint8_t {
    Float32,
    Float32x2,
    Float32x3,
    Float32x4,
    Uint32,
    Unorm8x4,
    Uint32x2,
    Uint32x3,
    Uint32x4,
    Sint32,
    Sint32x2,
    Sint32x3,
    Sint32x4,
};
enum class VertexStepMode : std::uint8_t { Vertex, Instance };
enum class IndexFormat : std::uint8_t { Uint16, Uint32 };
enum class PrimitiveTopology : std::uint8_t { PointList, LineList, LineStrip, TriangleList, TriangleStrip };
enum class FrontFace : std::uint8_t { CCW, CW };
enum class CullMode : std::uint8_t { None, Front, Back };

enum class BlendFactor : std::uint8_t {
    Zero,
    One,
    Src,
    OneMinusSrc,
    SrcAlpha,
    OneMinusSrcAlpha,
    Dst,
    OneMinusDst,
    DstAlpha,
    OneMinusDstAlpha,
};
enum class BlendOperation : std::uint8_t { Add, Subtract, ReverseSubtract, Min, Max };
struct BlendComponent {
    BlendOperation operation = BlendOperation::Add;
    BlendFactor srcFactor = BlendFactor::One, dstFactor = BlendFactor::Zero;
    bool operator==(const BlendComponent&) const = default;
};
struct BlendState {
    BlendComponent color = {}, alpha = {};
    bool operator==(const BlendState&) const = default;
};
enum class ColorWriteMask : std::uint32_t { None = 0, Red = 1, Green = 2, Blue = 4, Alpha = 8, All = 15 };
PELAGE_RHI_FLAGS(ColorWriteMask)

enum class LoadOp : std::uint8_t { Load, Clear, DontCare };
enum class StoreOp : std::uint8_t { Store, Discard };
struct Color {
    double r = 0, g = 0, b = 0, a = 0;
    bool operator==(const Color&) const = default;
};

enum class QueryType : std::uint8_t { Timestamp, PipelineStatistics };
/// One result of a PipelineStatistics query, in this order.
struct PipelineStatistics {
    std::uint64_t inputVertices = 0, vertexShaderInvocations = 0, clippedPrimitives = 0, fragmentShaderInvocations = 0,
                  computeShaderInvocations = 0;
};

enum class AdapterType : std::uint8_t { DiscreteGPU, IntegratedGPU, VirtualGPU, CPU, Unknown };
enum class PowerPreference : std::uint8_t { Undefined, LowPower, HighPerformance };

/// Optional features of a device; asked for by name, granted or refused by name. What Pelage needs always (dynamic
/// rendering, synchronization2, timeline semaphores, maintenance4, independent blend, sample-rate shading off) is not
/// listed: an adapter without it is not offered.
enum class Feature : std::uint32_t {
    None = 0,
    WideLines = 1,
    PipelineStatistics = 2,
    Timestamps = 4,
    Int64BufferAtomics = 8,
    FillModeNonSolid = 16,
    AnisotropicFiltering = 32,
    FragmentStores = 64,
};
PELAGE_RHI_FLAGS(Feature)
std::string_view name(Feature feature);

struct Limits {
    std::uint32_t maxTextureDimension2D = 0, maxTextureArrayLayers = 0, maxBindGroups = 4, maxColorAttachments = 0,
                  maxPushConstantsSize = 0, minUniformBufferOffsetAlignment = 256,
                  minStorageBufferOffsetAlignment = 256, maxComputeWorkgroupsPerDimension = 0;
    std::uint64_t maxUniformBufferBindingSize = 0, maxStorageBufferBindingSize = 0, maxBufferSize = 0;
    float maxLineWidth = 1, timestampPeriod = 0;  // ns per tick
};

enum class LogLevel : std::uint8_t { Verbose, Info, Warning, Error };

}  // namespace pelage::rhi

// SPDX-License-Identifier: MIT
// What a device keeps of its driver: pipelines between two starts, and workarounds by name and version.
#include <filesystem>
#include <fstream>

#include <unistd.h>

#include "null_device.hpp"

namespace pelage::test {
namespace {

namespace fs = std::filesystem;

class PipelineCache : public ::testing::Test {
protected:
    fs::path directory = fs::temp_directory_path() / ("pelage_pipelines_" + std::to_string(::getpid()));
    ~PipelineCache() override { fs::remove_all(directory); }

    struct Start {
        std::uint64_t compiled = 0;
        std::uint32_t made = 0, cached = 0;
        std::vector<std::string> notes;
    };
    /// A run of a program that makes three pipelines.
    Start start(std::uint32_t driverVersion = 1) const {
        Start s;
        NullDriver driver;
        driver.driverVersion = driverVersion;
        {
            const auto instance = NullDevice::get(vulkan::createInstance({.onMessage =
                                                                              [&](const Message& m) {
                                                                                  if (m.id == "pipelines")
                                                                                      s.notes.push_back(m.text);
                                                                              }},
                                                                         NullDriver::entry()));
            const auto device = NullDevice::get(
                NullDevice::get(instance.requestAdapter()).requestDevice({.pipelines = fileCache(directory.string())}));
            const auto shader = [&](std::string_view name) {
                const auto code = embeddedShader(name);
                return NullDevice::get(device.createShaderModule({.code = {code.begin(), code.end()}}));
            };
            for (const char* name : {"add.comp", "copy.comp"})
                NullDevice::get(device.createComputePipeline({.compute = {.module = shader(name)}}));
            NullDevice::get(device.createRenderPipeline({.vertex = {.module = shader("full.vert")},
                                                         .fragment = ProgrammableStage{.module = shader("white.frag")},
                                                         .targets = {{.format = TextureFormat::RGBA8Unorm}}}));
            s.made = device.memoryStatistics().pipelinesMade;
            s.cached = device.memoryStatistics().pipelinesCached;
        }
        s.compiled = driver.pipelinesCompiled;
        EXPECT_TRUE(driver.alive().empty());
        return s;
    }
    fs::path file() const { return fs::directory_iterator(directory)->path(); }
};

TEST_F(PipelineCache, ASecondStartCompilesNone) {
    const auto first = start(), second = start();
    EXPECT_EQ(first.compiled, 3U);
    EXPECT_EQ(first.cached, 0U);
    EXPECT_EQ(second.compiled, 0U);
    EXPECT_EQ(second.made, 3U);
    EXPECT_EQ(second.cached, 3U);
}

TEST_F(PipelineCache, AnotherVersionOfTheDriverFindsNothing) {
    start(1);
    EXPECT_EQ(start(2).compiled, 3U);
    EXPECT_EQ(start(1).compiled, 0U) << "and takes nothing away";
}

TEST_F(PipelineCache, ADamagedFileIsSaidAndReplaced) {
    start();
    for (const std::size_t cut : {std::size_t{0}, std::size_t{5}, std::size_t{30}}) {
        std::string bytes;
        {
            std::ifstream in(file(), std::ios::binary);
            bytes.assign(std::istreambuf_iterator<char>(in), {});
        }
        ASSERT_GT(bytes.size(), 40U);
        auto broken = bytes;
        if (cut == 0)
            broken.back() = static_cast<char>(broken.back() + 1);
        else
            broken.resize(cut);
        std::ofstream(file(), std::ios::binary | std::ios::trunc) << broken;
        const auto next = start();
        EXPECT_EQ(next.compiled, 3U);
        ASSERT_EQ(next.notes.size(), 1U) << "cut at " << cut;
        EXPECT_NE(next.notes[0].find("will be replaced"), std::string::npos);
        EXPECT_EQ(start().compiled, 0U);
    }
}

TEST(Toggles, FollowTheDriverAndItsVersion) {
    const auto on = [](VkDriverId driver, std::uint32_t version, std::vector<Toggle> wanted = {}) {
        NullDriver null;
        null.driverId = driver;
        null.driverVersion = version;
        const auto instance = NullDevice::get(vulkan::createInstance({}, NullDriver::entry()));
        return NullDevice::get(NullDevice::get(instance.requestAdapter()).requestDevice({.toggles = std::move(wanted)}))
            .toggles();
    };
    using Names = std::vector<std::string>;
    constexpr auto debian12 = VK_MAKE_API_VERSION(0, 22, 3, 6), later = VK_MAKE_API_VERSION(0, 23, 1, 0);
    EXPECT_EQ(on(VK_DRIVER_ID_MESA_RADV, debian12), Names());
    EXPECT_EQ(on(VK_DRIVER_ID_MESA_LLVMPIPE, debian12),
              (Names{"barrierAfterBeginTimestamp", "resolveToFirstLayerOnly", "drawInBatches"}));
    EXPECT_EQ(on(VK_DRIVER_ID_MESA_LLVMPIPE, later), (Names{"barrierAfterBeginTimestamp", "drawInBatches"}));
    EXPECT_EQ(on(VK_DRIVER_ID_MESA_LLVMPIPE, debian12, {{"resolveToFirstLayerOnly", false}}),
              (Names{"barrierAfterBeginTimestamp", "drawInBatches"}));
    EXPECT_EQ(on(VK_DRIVER_ID_MESA_RADV, debian12, {{"resolveToFirstLayerOnly", true}}),
              Names{"resolveToFirstLayerOnly"});
}

TEST(Limits, EveryOneThatFallsShortIsNamed) {
    NullDriver null;
    const auto instance = NullDevice::get(vulkan::createInstance({}, NullDriver::entry()));
    const auto adapter = NullDevice::get(instance.requestAdapter());
    EXPECT_TRUE(adapter.requestDevice({.requiredLimits = adapter.info().limits}));
    Limits wanted;
    wanted.maxBindGroups = 99;
    wanted.maxBufferSize = 1ULL << 50;
    wanted.minUniformBufferOffsetAlignment = 1;
    const auto device = adapter.requestDevice({.requiredLimits = wanted});
    ASSERT_FALSE(device);
    for (const char* word : {"maxBindGroups 99 (it has 8)", "maxBufferSize", "minUniformBufferOffsetAlignment 1"})
        EXPECT_NE(device.error().first().text.find(word), std::string::npos) << device.error().first().text;
}

TEST(MapAsync, TellsWhenTheWorkThatUsesTheBufferIsDone) {
    NullDevice n;
    n.driver.holdSignals = true;  // submissions stay unfinished
    const auto back = n.buffer("back", 256, BufferUsage::MapRead | BufferUsage::CopyDst);
    std::size_t told = 0, calls = 0;
    const auto tell = [&](std::span<std::byte> bytes) {
        told = bytes.size();
        ++calls;
    };
    auto encoder = n.device.createCommandEncoder();
    encoder.clearBuffer(back);
    n.submit(encoder);
    EXPECT_TRUE(back.mapAsync(tell));
    n.device.collect();
    EXPECT_EQ(calls, 0U) << "the device is not done";
    n.driver.releaseSignals();
    n.device.collect();
    EXPECT_EQ(calls, 1U);
    EXPECT_EQ(told, 256U);
    EXPECT_TRUE(back.mapAsync(tell));
    EXPECT_EQ(calls, 2U) << "at once when nothing uses it";
    const auto refused = n.buffer("plain", 64, BufferUsage::CopyDst).mapAsync(tell);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().first().code, ErrorCode::NotMapped);
}

TEST(Toggles, AnUnknownNameListsTheKnown) {
    NullDriver null;
    const auto instance = NullDevice::get(vulkan::createInstance({}, NullDriver::entry()));
    const auto device = NullDevice::get(instance.requestAdapter()).requestDevice({.toggles = {{"noSuchThing"}}});
    ASSERT_FALSE(device);
    EXPECT_EQ(device.error().first().code, ErrorCode::UnknownToggle);
    EXPECT_NE(device.error().first().text.find("resolveToFirstLayerOnly"), std::string::npos)
        << device.error().first().text;
}

}  // namespace
}  // namespace pelage::test

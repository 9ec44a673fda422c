// SPDX-License-Identifier: MIT
// The generators' own random numbers: SplitMix64 (Steele, Lea, Flood 2014), the same on every machine.
#pragma once

#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>

namespace pelage::hair {

class Random {
public:
    /// Streams with different (seed, stream) are unrelated, so strand 7 looks the same however many strands there are.
    explicit Random(std::uint64_t seed, std::uint64_t stream = 0)
        : state_(seed * 0xD1342543DE82EF95ULL + stream * 0xDA942042E4DD58B5ULL + 0x2545F4914F6CDD1DULL) {
        next();
    }

    std::uint64_t next() {
        std::uint64_t x = state_ += 0x9E3779B97F4A7C15ULL;
        x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9ULL;
        x = (x ^ (x >> 27)) * 0x94D049BB133111EBULL;
        return x ^ (x >> 31);
    }
    /// In [0, 1).
    float unit() { return static_cast<float>(next() >> 40) * 0x1p-24F; }
    float between(float low, float high) { return low + (high - low) * unit(); }
    /// About normal: the sum of four uniforms, deviation 1, never beyond 3.5.
    float bell() { return (unit() + unit() + unit() + unit() - 2.0F) * 1.7320508F; }
    glm::vec3 onSphere() {
        const float z = between(-1, 1), a = between(0, 6.2831853F), r = std::sqrt(std::fmax(0.0F, 1 - z * z));
        return {r * std::cos(a), r * std::sin(a), z};
    }

private:
    std::uint64_t state_;
};

}  // namespace pelage::hair

// SPDX-License-Identifier: MIT
// Collects strands from a file, keeps only those that can be drawn, and counts what it leaves out.
#pragma once

#include <pelage/base/diagnostic.hpp>
#include <pelage/hair/geometry.hpp>

#include <span>

namespace pelage::hair {

class GroomBuilder {
public:
    /// `family` is the first letter of the reader's codes, for example 'T'.
    GroomBuilder(std::string name, char family) : family_(family) { groom_.name = std::move(name); }

    void reserve(std::size_t strands, std::size_t points, bool withWidths);
    void setDefaultWidth(float width);
    /// `widths` is empty or has one entry per point.
    void add(std::span<const glm::vec3> points, std::span<const float> widths);
    /// The groom, or the error (family)006 when no strand is left; warnings about dropped strands go to `notes`.
    Result<Groom> finish(Diagnostics& notes);

private:
    std::string code(const char* number) const { return family_ + std::string(number); }

    Groom groom_;
    char family_;
    std::uint64_t seen_ = 0, notFinite_ = 0, tooShort_ = 0, noLength_ = 0, mergedPoints_ = 0, badWidths_ = 0;
};

}  // namespace pelage::hair

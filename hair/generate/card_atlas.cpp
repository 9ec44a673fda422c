// SPDX-License-Identifier: MIT
#include "card_atlas.hpp"

#include "geometry/vectors.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace pelage::hair {
namespace {

constexpr float kCellAspect = 8.0F;   // height to width, as cards are
constexpr std::uint32_t kGutter = 2;  // texels that stay empty at the sides and below, against bleeding
constexpr float kFill = 2.5F;  // summed widths of the strands drawn, in widths of the card: 1 - exp(-2.5) is covered
constexpr float kStrandWidth = 1.35F;  // texels, at the root; the narrowest that a texel grid shows well

/// One strand in the frame of its card: across (-1..1) for each row from `first` on, until it ends.
struct DrawnStrand {
    std::uint8_t id = 1;
    float depth = 0;  // m outward of the card: outer strands are drawn over inner ones
    float end = 1;    // v of the tip
    std::uint32_t first = 0;
    std::vector<float> across = {};
};

DrawnStrand flatten(std::span<const glm::vec3> strand, float start, const CardFrame& frame, std::uint32_t rows,
                    std::uint8_t id) {
    DrawnStrand drawn;
    drawn.id = id;
    for (std::uint32_t row = 0; row < rows; ++row) {
        const float v = (static_cast<float>(row) + 0.5F) / static_cast<float>(rows);
        glm::vec3 p;
        if (!pointAtArc(strand, v * frame.length - start, p)) {
            if (drawn.across.empty()) continue;  // not begun
            drawn.end = v;
            break;
        }
        if (drawn.across.empty()) drawn.first = row;
        const CardFrame::Station station = frame.at(v);
        const float x = glm::dot(p - station.middle, station.side);
        drawn.across.push_back(x / station.halfWidth);
        drawn.depth += glm::dot(p - station.middle, station.outward) - CardFrame::height(station, x);
    }
    if (!drawn.across.empty()) drawn.depth /= static_cast<float>(drawn.across.size());
    return drawn;
}

}  // namespace

CardAtlas::CardAtlas(std::uint32_t cards, std::uint32_t size)
    : size_(std::clamp(std::bit_floor(std::max(size, 64U)), 64U, 16384U)) {
    // Of all ways to fill the square with at least that many cells, the one whose cells are nearest to kCellAspect.
    float best = 1e9F;
    for (std::uint32_t rows = 1; rows <= std::max(cards, 1U); ++rows) {
        const std::uint32_t columns = (std::max(cards, 1U) + rows - 1) / rows;
        const float off = std::abs(std::log(static_cast<float>(columns) / static_cast<float>(rows) / kCellAspect));
        if (off < best) best = off, rows_ = rows, columns_ = columns;
    }
    coverage_.assign(std::size_t{size_} * size_, 0.0F);
    ids_.assign(std::size_t{size_} * size_, 0);
}

CardAtlas::Cell CardAtlas::cellOf(std::uint32_t card) const {
    const std::uint32_t column = card % columns_, row = card / columns_;
    const auto edge = [&](std::uint32_t i, std::uint32_t count) {
        return static_cast<std::uint32_t>(std::uint64_t{size_} * i / count);
    };
    const std::uint32_t x = edge(column, columns_), y = edge(row, rows_);
    return {x, y, edge(column + 1, columns_) - x, edge(row + 1, rows_) - y};
}

glm::vec2 CardAtlas::uv(std::uint32_t card, float across, float down) const {
    const Cell c = cellOf(card);
    // Half a texel inside the drawn part above, so that the row of another card's tips never shows at a root.
    const float x = static_cast<float>(c.x) + 0.5F + across * (static_cast<float>(c.width) - 1.0F);
    const float y = static_cast<float>(c.y) + 0.5F + down * (static_cast<float>(c.height) - 1.0F);
    return glm::vec2(x, y) / static_cast<float>(size_);
}

void CardAtlas::draw(std::uint32_t card, const Strands& groom, std::span<const std::uint32_t> members,
                     const CardFrame& frame) {
    const Cell cell = cellOf(card);
    if (cell.width < 2 * kGutter + 2 || cell.height < kGutter + 2) return;
    const std::uint32_t rows = cell.height - kGutter;
    const auto inner = static_cast<float>(cell.width - 2 * kGutter);
    // The cell is too coarse for every strand at its width, so fewer and wider ones stand for all.
    const auto wanted = static_cast<std::size_t>(std::max(3.0F, kFill * inner / kStrandWidth));
    const std::size_t count = std::min(wanted, members.size());
    const float width = kFill * inner / static_cast<float>(std::max<std::size_t>(count, 3));
    const float base = std::min(width, 2.2F * kStrandWidth);
    std::vector<DrawnStrand> strands;
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t member = i * members.size() / count;
        const std::uint32_t s = members[member];
        const auto id = static_cast<std::uint8_t>(1 + static_cast<int>(254.0F * hashUnit(s)));
        strands.push_back(flatten(groom.strand(s), frame.starts[member], frame, rows, id));
    }
    std::stable_sort(strands.begin(), strands.end(), [](const auto& a, const auto& b) { return a.depth < b.depth; });

    const float left = static_cast<float>(cell.x + kGutter), right = left + inner;
    for (const DrawnStrand& strand : strands) {
        for (std::size_t step = 0; step < strand.across.size(); ++step) {
            const std::size_t row = strand.first + step;
            const float v = (static_cast<float>(row) + 0.5F) / static_cast<float>(rows);
            const float x = left + 0.5F * inner * (1.0F + strand.across[step]);
            const std::size_t next = std::min(step + 1, strand.across.size() - 1);
            const float slope = 0.5F * inner * (strand.across[next] - strand.across[step]);
            // Strands thin out towards their tips; a slanted strand crosses more of a row.
            const float rest = std::clamp((strand.end - v) / 0.22F, 0.0F, 1.0F);
            const float half = 0.5F * base * (0.35F + 0.65F * rest) * std::min(std::sqrt(1 + slope * slope), 4.0F);
            const float low = std::max(x - half, left), high = std::min(x + half, right);
            for (auto column = static_cast<std::int64_t>(std::floor(low)); static_cast<float>(column) < high;
                 ++column) {
                const auto texel = static_cast<float>(column);
                const float part = std::min(high, texel + 1) - std::max(low, texel);
                if (part <= 0) continue;
                const std::size_t at = (cell.y + row) * size_ + static_cast<std::size_t>(column);
                coverage_[at] = 1 - (1 - coverage_[at]) * (1 - std::min(part, 1.0F));
                if (part > 0.35F || ids_[at] == 0) ids_[at] = strand.id;
            }
        }
    }
    // Outside the strands the ID goes on as that of the nearest strand in the row, so that filtering mixes no nonsense.
    for (std::uint32_t row = 0; row < cell.height; ++row) {
        std::uint8_t* const line = ids_.data() + std::size_t{cell.y + row} * size_ + cell.x;
        const std::uint8_t* const above = line - size_;
        const std::vector<std::uint8_t> drawn(line, line + cell.width);
        for (std::uint32_t x = 0; x < cell.width; ++x) {
            if (drawn[x] != 0) continue;
            if (row > 0) line[x] = above[x];
            for (std::uint32_t step = 1; step < cell.width; ++step) {
                const std::uint8_t a = step <= x ? drawn[x - step] : std::uint8_t{0};
                const std::uint8_t b = x + step < cell.width ? drawn[x + step] : std::uint8_t{0};
                if (a == 0 && b == 0) continue;
                line[x] = a != 0 ? a : b;
                break;
            }
        }
    }
}

void CardAtlas::finish(Mesh& cards) {
    Image8& colour = cards.colorMap;
    colour.width = colour.height = size_;
    colour.channels = 4;
    colour.srgb = true;
    colour.texels.assign(coverage_.size() * 4, 255);
    for (std::size_t i = 0; i < coverage_.size(); ++i) {
        colour.texels[4 * i + 3] =
            static_cast<std::uint8_t>(std::lround(255.0F * std::clamp(coverage_[i], 0.0F, 1.0F)));
    }
    Image8& ids = cards.strandIdMap;
    ids.width = ids.height = size_;
    ids.channels = 1;
    ids.texels = ids_;
}

}  // namespace pelage::hair

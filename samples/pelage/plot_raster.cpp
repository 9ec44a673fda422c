// SPDX-License-Identifier: MIT
// Drawings as pixels. A pixel is covered as far as its centre lies inside a shape, over a ramp one pixel wide.
#include "plot_canvas.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wunused-variable"
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wsign-conversion"
#pragma GCC diagnostic ignored "-Wshadow"
#include <stb/stb_easy_font.h>
#pragma GCC diagnostic pop

namespace pelage::app {

namespace {

class Raster {
public:
    Raster(std::uint32_t width, std::uint32_t height)
        : width_(static_cast<int>(width)),
          height_(static_cast<int>(height)),
          pixels_(std::size_t{width} * height * 4, 255),
          coverage_(std::size_t{width} * height, 0.0F) {}

    /// Adds a part of a shape; parts of one shape do not darken each other.
    void segment(PlotPoint a, PlotPoint b, double width) {
        // Thinner than a pixel is a pixel that is fainter.
        const double radius = 0.5 * std::max(width, 1.0), reach = radius + 1.0;
        const double strength = std::min(width, 1.0);
        const double dx = b.x - a.x, dy = b.y - a.y, square = dx * dx + dy * dy;
        const auto distance = [&](double x, double y) {
            const double t = square > 0 ? std::clamp(((x - a.x) * dx + (y - a.y) * dy) / square, 0.0, 1.0) : 0.0;
            return std::hypot(x - a.x - t * dx, y - a.y - t * dy);
        };
        cover(std::min(a.x, b.x) - reach, std::min(a.y, b.y) - reach, std::max(a.x, b.x) + reach,
              std::max(a.y, b.y) + reach,
              [&](double x, double y) { return strength * std::clamp(radius + 0.5 - distance(x, y), 0.0, 1.0); });
    }
    void box(PlotPoint from, PlotPoint to) {
        const auto overlap = [](double centre, double low, double high) {
            return std::clamp(std::min(centre + 0.5, high) - std::max(centre - 0.5, low), 0.0, 1.0);
        };
        cover(from.x - 1, from.y - 1, to.x + 1, to.y + 1,
              [&](double x, double y) { return overlap(x, from.x, to.x) * overlap(y, from.y, to.y); });
    }
    /// Lays the parts added over the picture, in one colour.
    void paint(PlotColor color) {
        for (const std::size_t i : touched_) {
            const float c = coverage_[i];
            const float parts[3] = {static_cast<float>(color.r), static_cast<float>(color.g),
                                    static_cast<float>(color.b)};
            for (std::size_t k = 0; k < 3; ++k) {
                std::uint8_t& under = pixels_[i * 4 + k];
                under = static_cast<std::uint8_t>(std::lround(static_cast<float>(under) * (1 - c) + parts[k] * c));
            }
            coverage_[i] = 0;
        }
        touched_.clear();
    }
    std::vector<std::uint8_t> take() { return std::move(pixels_); }

private:
    template <class Coverage>
    void cover(double left, double top, double right, double bottom, const Coverage& coverageAt) {
        // Clamped as doubles: what lies far outside fits no int.
        const int x0 = static_cast<int>(std::clamp(std::floor(left), 0.0, static_cast<double>(width_)));
        const int y0 = static_cast<int>(std::clamp(std::floor(top), 0.0, static_cast<double>(height_)));
        const int x1 = static_cast<int>(std::clamp(std::ceil(right), 0.0, static_cast<double>(width_)));
        const int y1 = static_cast<int>(std::clamp(std::ceil(bottom), 0.0, static_cast<double>(height_)));
        for (int y = y0; y < y1; ++y) {
            for (int x = x0; x < x1; ++x) {
                const auto c = static_cast<float>(coverageAt(x + 0.5, y + 0.5));
                const std::size_t i =
                    static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
                if (c <= coverage_[i]) continue;
                if (coverage_[i] == 0) touched_.push_back(i);
                coverage_[i] = c;
            }
        }
    }

    int width_, height_;
    std::vector<std::uint8_t> pixels_;
    std::vector<float> coverage_;       // of the shape at hand
    std::vector<std::size_t> touched_;  // pixels where that is not 0
};

/// The font knows printable ASCII.
std::string spelt(std::string words) {
    constexpr std::pair<std::string_view, std::string_view> spellings[] = {
        {"θ", "theta"}, {"φ", "phi"},  {"β", "beta"},  {"α", "alpha"}, {"σ", "sigma"},
        {"η", "eta"},   {"°", " deg"}, {"√", "sqrt "}, {"−", "-"}};
    for (const auto& [symbol, name] : spellings) {
        for (std::size_t at = 0; (at = words.find(symbol, at)) != std::string::npos; at += name.size()) {
            words.replace(at, symbol.size(), name);
        }
    }
    std::replace_if(
        words.begin(), words.end(), [](char c) { return c < 0x20 || c > 0x7e; }, '?');
    return words;
}

struct RasterShape {
    Raster& raster;

    void operator()(const Drawing::Polyline& line) const {
        for (std::size_t i = 0; i + 1 < line.points.size(); ++i) {
            raster.segment(line.points[i], line.points[i + 1], line.width);
        }
        raster.paint(line.color);
    }
    void operator()(const Drawing::Rectangle& box) const {
        raster.box(box.from, box.to);
        raster.paint(box.color);
    }
    void operator()(const Drawing::Text& text) const {
        struct Vertex {
            float x, y, z;
            unsigned char color[4];
        };
        std::string words = spelt(text.words);
        // 64 bytes a quad; no letter has more than 16 of them.
        std::vector<Vertex> vertices(words.size() * 64 + 4);
        const int quads = stb_easy_font_print(0, 0, words.data(), nullptr, vertices.data(),
                                              static_cast<int>(vertices.size() * sizeof(Vertex)));
        // Letters are 7 units high on the base line, and as high as 0.72 of the size elsewhere.
        const double scale = text.size * 0.72 / 7.0;
        const double shift = scale * 0.5 * static_cast<double>(text.anchor) * stb_easy_font_width(words.data());
        const auto place = [&](const Vertex& v) {
            return PlotPoint{text.at.x - shift + scale * v.x, text.at.y + scale * (v.y - 7.0)};
        };
        for (std::size_t quad = 0; quad < static_cast<std::size_t>(quads); ++quad) {
            raster.box(place(vertices[quad * 4]), place(vertices[quad * 4 + 2]));
        }
        raster.paint(text.color);
    }
};

}  // namespace

std::vector<std::uint8_t> rasterised(const Drawing& drawing) {
    Raster raster(drawing.width(), drawing.height());
    for (const Drawing::Shape& shape : drawing.shapes()) std::visit(RasterShape{raster}, shape);
    return raster.take();
}

}  // namespace pelage::app

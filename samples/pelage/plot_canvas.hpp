// SPDX-License-Identifier: MIT
// Line drawings for plots. A drawing is a list of shapes; it becomes SVG text for documents or a PNG for a quick look.
#pragma once

#include "failure.hpp"

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace pelage::app {

struct PlotPoint {
    double x = 0, y = 0;  // pixels from the top left
};

struct PlotColor {
    std::uint8_t r = 0, g = 0, b = 0;
};

enum class TextAnchor : std::uint8_t { Start, Middle, End };

class Drawing {
public:
    struct Polyline {
        std::vector<PlotPoint> points;
        PlotColor color;
        double width;
    };
    struct Rectangle {
        PlotPoint from, to;
        PlotColor color;
    };
    struct Text {
        PlotPoint at;  // on the base line
        std::string words;
        TextAnchor anchor;
        double size;  // pixels
        PlotColor color;
    };
    using Shape = std::variant<Polyline, Rectangle, Text>;

    Drawing(std::uint32_t width, std::uint32_t height) : width_(width), height_(height) {}

    void line(PlotPoint from, PlotPoint to, PlotColor color, double width = 1) { polyline({from, to}, color, width); }
    void polyline(std::vector<PlotPoint> points, PlotColor color, double width) {
        shapes_.emplace_back(Polyline{std::move(points), color, width});
    }
    void rectangle(PlotPoint from, PlotPoint to, PlotColor color) { shapes_.emplace_back(Rectangle{from, to, color}); }
    /// UTF-8; a PNG spells out what is not ASCII ("θ" becomes "theta").
    void text(PlotPoint at, std::string words, TextAnchor anchor = TextAnchor::Start, double size = 13,
              PlotColor color = {40, 40, 40}) {
        shapes_.emplace_back(Text{at, std::move(words), anchor, size, color});
    }

    std::uint32_t width() const { return width_; }
    std::uint32_t height() const { return height_; }
    const std::vector<Shape>& shapes() const { return shapes_; }

private:
    std::uint32_t width_, height_;
    std::vector<Shape> shapes_;
};

std::string svgText(const Drawing& drawing);
/// RGBA8 on white, rows from the top.
std::vector<std::uint8_t> rasterised(const Drawing& drawing);

/// Fails when the ending is neither .svg nor .png, or the directory does not exist: ask before computing.
Result<void> checkDrawingPath(const std::string& path);
/// By the ending; the file is either whole or not there.
Result<void> writeDrawing(const std::string& path, const Drawing& drawing);

}  // namespace pelage::app

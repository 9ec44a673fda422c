// SPDX-License-Identifier: MIT
#include "plot_canvas.hpp"

#include "picture_file.hpp"
#include "text_file.hpp"

#include <charconv>
#include <cmath>
#include <filesystem>

namespace pelage::app {

namespace {

/// A tenth of a pixel is enough, and keeps files in a repository small.
std::string number(double x) {
    char room[400];
    const auto result = std::to_chars(room, room + sizeof room, x, std::chars_format::fixed, 1);
    std::string text(room, result.ptr);
    if (text.ends_with(".0")) text.resize(text.size() - 2);
    return text == "-0" ? "0" : text;
}

std::string hex(PlotColor color) {
    constexpr char digits[] = "0123456789abcdef";
    std::string text = "#";
    for (const unsigned part : {color.r, color.g, color.b}) {
        text += digits[part / 16];
        text += digits[part % 16];
    }
    return text;
}

std::string escaped(const std::string& words) {
    std::string text;
    for (const char c : words) {
        if (c == '&') {
            text += "&amp;";
        } else if (c == '<') {
            text += "&lt;";
        } else {
            text += c;
        }
    }
    return text;
}

/// Marks what a line from `first` to `last` needs to pass every point at less than `tolerance` (Douglas and Peucker).
void markNeeded(const std::vector<PlotPoint>& points, std::size_t first, std::size_t last, std::vector<bool>& needed) {
    constexpr double tolerance = 0.08;
    const PlotPoint a = points[first], b = points[last];
    const double dx = b.x - a.x, dy = b.y - a.y, length = std::hypot(dx, dy);
    std::size_t farthest = first;
    double most = tolerance;
    for (std::size_t i = first + 1; i < last; ++i) {
        const double x = points[i].x - a.x, y = points[i].y - a.y;
        const double distance = length > 0 ? std::abs(x * dy - y * dx) / length : std::hypot(x, y);
        if (distance <= most) continue;
        most = distance;
        farthest = i;
    }
    if (farthest == first) return;
    needed[farthest] = true;
    markNeeded(points, first, farthest, needed);
    markNeeded(points, farthest, last, needed);
}

struct SvgShape {
    std::string operator()(const Drawing::Polyline& line) const {
        std::vector<bool> needed(line.points.size(), line.points.size() < 3);
        if (line.points.size() > 2) {
            needed.front() = needed.back() = true;
            markNeeded(line.points, 0, line.points.size() - 1, needed);
        }
        std::string text = "<polyline fill=\"none\" stroke-linejoin=\"round\" stroke=\"" + hex(line.color) +
                           "\" stroke-width=\"" + number(line.width) + "\" points=\"";
        for (std::size_t i = 0; i < line.points.size(); ++i) {
            if (needed[i]) text += number(line.points[i].x) + "," + number(line.points[i].y) + " ";
        }
        if (!line.points.empty()) text.pop_back();
        return text + "\"/>\n";
    }
    std::string operator()(const Drawing::Rectangle& box) const {
        return "<rect x=\"" + number(box.from.x) + "\" y=\"" + number(box.from.y) + "\" width=\"" +
               number(box.to.x - box.from.x) + "\" height=\"" + number(box.to.y - box.from.y) + "\" fill=\"" +
               hex(box.color) + "\"/>\n";
    }
    std::string operator()(const Drawing::Text& text) const {
        const char* anchors[] = {"start", "middle", "end"};
        return "<text x=\"" + number(text.at.x) + "\" y=\"" + number(text.at.y) + "\" font-size=\"" +
               number(text.size) + "\" text-anchor=\"" + anchors[static_cast<int>(text.anchor)] + "\" fill=\"" +
               hex(text.color) + "\">" + escaped(text.words) + "</text>\n";
    }
};

}  // namespace

std::string svgText(const Drawing& drawing) {
    const std::string width = std::to_string(drawing.width()), height = std::to_string(drawing.height());
    std::string text = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + width + "\" height=\"" + height +
                       "\" viewBox=\"0 0 " + width + " " + height + "\" font-family=\"sans-serif\">\n" +
                       "<rect width=\"" + width + "\" height=\"" + height + "\" fill=\"#ffffff\"/>\n";
    for (const Drawing::Shape& shape : drawing.shapes()) text += std::visit(SvgShape(), shape);
    return text + "</svg>\n";
}

Result<void> checkDrawingPath(const std::string& path) {
    if (path.ends_with(".png")) return checkPicturePath(path);
    if (!path.ends_with(".svg")) {
        return tl::unexpected(failure("A096", "the plot \"" + path + "\" ends in neither .svg nor .png"));
    }
    const std::filesystem::path directory = std::filesystem::path(path).parent_path();
    std::error_code ignored;
    if (!directory.empty() && !std::filesystem::is_directory(directory, ignored)) {
        return tl::unexpected(failure("A094", path + ": the file cannot be written: there is no directory " +
                                                  directory.string() + "; make it first"));
    }
    return {};
}

Result<void> writeDrawing(const std::string& path, const Drawing& drawing) {
    if (!path.ends_with(".png")) return writeTextFile(path, svgText(drawing));
    hair::Picture picture{.width = drawing.width(), .height = drawing.height()};
    picture.display = rasterised(drawing);
    return writePicture(path, picture);
}

}  // namespace pelage::app

// SPDX-License-Identifier: MIT
#include "scatter_plot.hpp"

#include "scatter_curves.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>

namespace pelage::app {

namespace {

using reference::degree;

constexpr double headings = 106;  // below the title and three rows of legend
constexpr PlotColor ink{40, 40, 40}, faint{222, 222, 222}, truthColor{175, 175, 175};
// Apart for most kinds of colour blindness (after Okabe and Ito).
constexpr PlotColor palette[] = {{213, 94, 0},   {0, 114, 178},  {0, 158, 115},  {204, 121, 167}, {230, 159, 0},
                                 {86, 180, 233}, {110, 70, 160}, {120, 110, 20}, {20, 20, 20},    {150, 30, 40}};

struct Line {
    std::string name;
    ScatterMethod method;
    PlotColor color;
    double width;
};

/// What a value becomes on paper.
using Placement = std::function<PlotPoint(const CurvePoint&)>;

std::string shortNumber(double x) {
    char digits[32] = {};
    std::snprintf(digits, sizeof digits, "%.4g", x);
    return digits;
}

/// 1, 2 or 5 times a power of ten, for about `count` steps up to `top`.
double tickStep(double top, double count) {
    const double power = std::pow(10.0, std::floor(std::log10(top / count)));
    for (const double factor : {1.0, 2.0, 5.0}) {
        if (top / (factor * power) <= count) return factor * power;
    }
    return 10.0 * power;
}

/// The end of an axis: room for the truth, and for models unless they leave it far behind. Those are cut off there.
double axisTop(const std::vector<Curve>& curves) {
    const auto largest = [](const Curve& curve) {
        double top = 0;
        for (const CurvePoint& point : curve) top = std::isfinite(point.value) ? std::max(top, point.value) : top;
        return top;
    };
    const double truth = largest(curves.front());
    double top = truth;
    for (const Curve& curve : curves) top = std::max(top, std::min(largest(curve), 1.8 * truth));
    return top > 0 ? 1.06 * top : 1.0;
}

/// A curve as far as it stays below the end of its axis.
void drawCurve(Drawing& drawing, const Curve& curve, double top, const Placement& place, const Line& line) {
    std::vector<PlotPoint> run;
    const auto finish = [&] {
        if (run.size() > 1) drawing.polyline(run, line.color, line.width);
        run.clear();
    };
    for (std::size_t i = 0; i < curve.size(); ++i) {
        if (!std::isfinite(curve[i].value)) {
            finish();
            continue;
        }
        const bool below = curve[i].value <= top;
        if (i > 0 && std::isfinite(curve[i - 1].value) && below != (curve[i - 1].value <= top)) {
            const double t = (top - curve[i - 1].value) / (curve[i].value - curve[i - 1].value);
            run.push_back(place({curve[i - 1].degrees + t * (curve[i].degrees - curve[i - 1].degrees), top}));
        }
        if (below) run.push_back(place(curve[i]));
        if (!below) finish();
    }
    finish();
}

Curve wholeCircle(Curve half) {
    Curve all = half;
    for (auto point = half.rbegin(); point != half.rend(); ++point)
        all.push_back({360.0 - point->degrees, point->value});
    return all;
}

void drawPolar(Drawing& drawing, const std::vector<Line>& lines, const std::vector<Curve>& curves) {
    constexpr PlotPoint centre{320, 352};
    constexpr double radius = 200;
    const double top = axisTop(curves);
    // A square root shows lobes of very different strength at once.
    const auto place = [&](const CurvePoint& point) {
        const double r = radius * std::sqrt(std::max(point.value, 0.0) / top), a = point.degrees * degree;
        return PlotPoint{centre.x + r * std::cos(a), centre.y - r * std::sin(a)};
    };
    const auto ring = [&](double value, PlotColor color) {
        std::vector<PlotPoint> points;
        for (int i = 0; i <= 180; ++i) points.push_back(place({2.0 * i, value}));
        drawing.polyline(points, color, 1);
    };
    for (int angle = 0; angle < 360; angle += 30) {
        drawing.line(centre, place({1.0 * angle, top}), faint);
        const double a = angle * degree, r = radius + 17;
        const TextAnchor anchor = std::abs(std::cos(a)) < 0.1 ? TextAnchor::Middle
                                  : std::cos(a) > 0           ? TextAnchor::Start
                                                              : TextAnchor::End;
        drawing.text(
            {centre.x + (r - (anchor == TextAnchor::Middle ? 0 : 7)) * std::cos(a), centre.y - r * std::sin(a) + 5},
            std::to_string(angle), anchor, 12);
    }
    const double step = tickStep(top, 4);
    for (double value = step; value < top; value += step) ring(value, faint);
    ring(top, ink);
    for (std::size_t i = 0; i < lines.size(); ++i) drawCurve(drawing, wholeCircle(curves[i]), top, place, lines[i]);
    for (double value = step; value < top; value += step) {
        if (value > 0.92 * top) continue;  // the rim would go through it
        // On a ray between two labels, where lobes are seldom drawn.
        drawing.text(place({75, value}), shortNumber(value), TextAnchor::Middle, 11, {110, 110, 110});
    }
    drawing.text({centre.x, headings}, "around the fibre: A N (1/rad) over φ (degrees), radius as square root",
                 TextAnchor::Middle);
    drawing.text({centre.x, 592}, "0: the side of the view, 180: straight through", TextAnchor::Middle, 12);
}

void drawAlong(Drawing& drawing, const std::vector<Line>& lines, const std::vector<Curve>& curves, double upper,
               const std::string& title) {
    constexpr double left = 680, right = 1170, height = 175;
    const double lower = upper + height, top = axisTop(curves);
    const auto place = [&](const CurvePoint& point) {
        return PlotPoint{left + (right - left) * (point.degrees + 90) / 180, lower - height * point.value / top};
    };
    for (int angle = -90; angle <= 90; angle += 30) {
        const PlotPoint foot = place({1.0 * angle, 0});
        drawing.line(foot, {foot.x, upper}, faint);
        drawing.line(foot, {foot.x, lower + 5}, ink);
        drawing.text({foot.x, lower + 19}, std::to_string(angle), TextAnchor::Middle, 12);
    }
    const double step = tickStep(top, 5);
    for (int i = 0; i * step < top; ++i) {
        const PlotPoint at = place({-90, i * step});
        drawing.line(at, {right, at.y}, faint);
        drawing.line({at.x - 5, at.y}, at, ink);
        drawing.text({at.x - 9, at.y + 4}, shortNumber(i * step), TextAnchor::End, 12);
    }
    for (std::size_t i = 0; i < lines.size(); ++i) drawCurve(drawing, curves[i], top, place, lines[i]);
    drawing.polyline({{left, upper}, {left, lower}, {right, lower}, {right, upper}, {left, upper}}, ink, 1);
    drawing.text({0.5 * (left + right), upper - 8}, title, TextAnchor::Middle);
}

std::string parametersOf(const ScatterTuple& f) {
    return "θ_o " + shortNumber(f.thetaO) + "°, η " + shortNumber(f.eta) + ", β_M " + shortNumber(f.betaM) + ", β_N " +
           shortNumber(f.betaN) + ", α " + shortNumber(f.alpha) + "°, σ_a " + shortNumber(f.sigmaA) + " per radius";
}

}  // namespace

Drawing drawScatterPlot(const ScatterPlot& plot) {
    std::vector<Line> lines{{"truth", {}, truthColor, 6}};
    for (const hair::ModelInfo* model : plot.models) {
        const bool published = plot.published && model->corrected;
        lines.push_back({std::string(model->id) + (published ? " (published)" : ""),
                         {model, published, false},
                         palette[(lines.size() - 1) % std::size(palette)],
                         1.8});
    }
    std::vector<Curve> around, front, back;
    for (const Line& line : lines) {
        around.push_back(azimuthalCurve(line.method, plot.fiber));
        front.push_back(longitudinalCurve(line.method, plot.fiber, 0));
        back.push_back(longitudinalCurve(line.method, plot.fiber, 180));
    }
    Drawing drawing(1200, 600);
    const std::string title = plot.title.empty() ? "Far field of one fibre" : plot.title;
    drawing.text({20, 30}, title + ": " + parametersOf(plot.fiber), TextAnchor::Start, 16, {0, 0, 0});
    drawPolar(drawing, lines, around);
    drawAlong(drawing, lines, front, headings + 8, "along the fibre: S (1/sr) over θ_i (degrees) at φ = 0°");
    drawAlong(drawing, lines, back, 368, "the same at φ = 180°");
    for (std::size_t i = 0; i < lines.size(); ++i) {
        const double x = 20 + 290.0 * static_cast<double>(i % 4), y = 52 + 17.0 * static_cast<double>(i / 4);
        drawing.line({x, y - 4}, {x + 24, y - 4}, lines[i].color, lines[i].width);
        char share[48] = {};
        std::snprintf(share, sizeof share, ": scatters %.3f", scatteredShare(around[i]));
        drawing.text({x + 32, y}, lines[i].name + share, TextAnchor::Start, 12);
    }
    return drawing;
}

}  // namespace pelage::app

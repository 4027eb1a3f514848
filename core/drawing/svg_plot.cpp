#include "drawing/svg_plot.h"

#include <cmath>

#include "io/format.h"

namespace mrose {
namespace {

Attributes classed(std::string_view cssClass) { return {{"class", cssClass}}; }

}  // namespace

SvgPlot::SvgPlot(const Layout& layout, PlotRange x, PlotRange y, std::string_view description)
    : layout_(layout), x_(usable(x)), y_(usable(y)), description_(description) {}

SvgPlot SvgPlot::equalScale(const Layout& layout, PlotRange x, PlotRange y, std::string_view description) {
    SvgPlot plot(layout, x, y, description);
    const double perPixel =
        std::max((plot.x_.high - plot.x_.low) / plot.innerWidth(), (plot.y_.high - plot.y_.low) / plot.innerHeight());
    const auto centred = [&](PlotRange range, double pixels) {
        const double middle = (range.low + range.high) / 2, half = perPixel * pixels / 2;
        return PlotRange{middle - half, middle + half};
    };
    plot.x_ = centred(plot.x_, plot.innerWidth());
    plot.y_ = centred(plot.y_, plot.innerHeight());
    return plot;
}

Point SvgPlot::pixel(const Point& at) const {
    return {layout_.left + (at.x - x_.low) / (x_.high - x_.low) * innerWidth(),
            layout_.top + (y_.high - at.y) / (y_.high - y_.low) * innerHeight()};
}

void SvgPlot::axes(std::string_view xTitle, std::string_view yTitle) {
    levelAxis(xTitle);
    uprightAxis(yTitle);
}

void SvgPlot::levelAxis(std::string_view title) {
    const AxisTicks xTicks = axisTicks(x_, static_cast<int>(innerWidth() / 70));
    for (const double value : xTicks.values) {
        const Point foot = pixel({value, y_.low});
        grid_.moveTo(foot).lineTo(pixel({value, y_.high}));
        around_ += svgText(foot + Point{0, 17}, fixed(value, xTicks.decimals), classed("tick middle"));
    }
    const Point foot = pixel({x_.low, y_.low});
    if (!title.empty())
        around_ += svgText({foot.x + innerWidth() / 2, layout_.height - 8}, title, classed("title middle"));
}

void SvgPlot::rowName(double y, std::string_view name) {
    around_ += svgText(pixel({x_.low, y}) + Point{-10, 4}, name, classed("tick end"));
}

void SvgPlot::uprightAxis(std::string_view title) {
    const Point corner = pixel({x_.low, y_.low});
    const AxisTicks yTicks = axisTicks(y_, std::max(2, static_cast<int>(innerHeight() / 42)));
    for (const double value : yTicks.values) {
        const Point foot = pixel({x_.low, value});
        grid_.moveTo(foot).lineTo(pixel({x_.high, value}));
        around_ += svgText(foot + Point{-8, 4}, fixed(value, yTicks.decimals), classed("tick end"));
    }
    const Point ends[] = {pixel({x_.low, y_.high}), corner, pixel({x_.high, y_.low})};
    around_ += svgPath(SvgPath(ends), classed("axis"));
    const Point left{14, corner.y - innerHeight() / 2};
    around_ += svgText(left, title, {{"class", "title middle"}, {"transform", cat("rotate(-90 14 ", px(left.y), ")")}});
}

void SvgPlot::grid(double step) {
    if (!(step > 0)) return;
    for (auto i = std::ceil(x_.low / step); i * step < x_.high; ++i)
        grid_.moveTo(pixel({i * step, y_.low})).lineTo(pixel({i * step, y_.high}));
    for (auto i = std::ceil(y_.low / step); i * step < y_.high; ++i)
        grid_.moveTo(pixel({x_.low, i * step})).lineTo(pixel({x_.high, i * step}));
}

SvgPath SvgPlot::path(std::span<const Point> points) const {
    std::vector<Point> pixels;
    for (const Point& point : points) pixels.push_back(pixel(point));
    return SvgPath(pixels);
}

void SvgPlot::add(const SvgPath& path, std::string_view cssClass) {
    if (!path.text().empty()) marks_ += svgPath(path, classed(cssClass));
}

void SvgPlot::line(std::span<const Point> points, std::string_view cssClass) {
    add(path(points), cat("line ", cssClass));
}

void SvgPlot::steps(std::span<const Point> points, std::string_view cssClass) {
    std::vector<Point> corners;
    for (const Point& point : points) {
        if (!corners.empty()) corners.push_back({point.x, corners.back().y});
        corners.push_back(point);
    }
    line(corners, cssClass);
}

void SvgPlot::band(std::span<const Point> low, std::span<const Point> high, std::string_view cssClass) {
    std::vector<Point> outline(low.begin(), low.end());
    outline.insert(outline.end(), high.rbegin(), high.rend());
    if (SvgPath around = path(outline); !around.text().empty()) add(around.close(), cssClass);
}

void SvgPlot::area(std::span<const Polygon> pieces, std::string_view cssClass) {
    SvgPath all;
    for (const Polygon& piece : pieces) all += path(piece).close();
    if (!all.text().empty()) add(all, cssClass);
}

void SvgPlot::bar(double x, double width, double height, std::string_view cssClass, std::string_view tooltip) {
    const Point top = pixel({x, height}), foot = pixel({x + width, 0});
    marks_ += element("rect",
                      {{"class", cssClass},
                       {"x", top.x},
                       {"y", top.y},
                       {"width", foot.x - top.x},
                       {"height", std::max(0.0, foot.y - top.y)}},
                      element("title", {}, escaped(tooltip)));
}

void SvgPlot::circle(const Point& centre, double pixels, std::string_view cssClass) {
    if (isFinite(centre)) marks_ += svgCircle(pixel(centre), pixels, classed(cssClass));
}

void SvgPlot::dot(const Point& centre, double pixels, std::string_view cssClass) {
    if (isFinite(centre)) around_ += svgCircle(pixel(centre), pixels, classed(cssClass));
}

void SvgPlot::arrow(const Point& from, double direction, double pixels, std::string_view cssClass) {
    if (!isFinite(from) || !std::isfinite(direction)) return;
    const Point start = pixel(from);
    // y points down on the page.
    SvgArrow arrow(start, start + pixels * Point{std::cos(direction), -std::sin(direction)}, 4.5, 5.6);
    add(arrow.shaft += arrow.head, cssClass);
}

void SvgPlot::label(const Point& at, double dx, double dy, std::string_view text, std::string_view cssClass) {
    if (isFinite(at)) marks_ += svgText(pixel(at) + Point{dx, dy}, text, classed(cssClass));
}

void SvgPlot::scaleBar(double length, std::string_view text) {
    const Point left{layout_.left + 6, layout_.height - 10}, right = left + Point{length / unitsPerPixel(), 0};
    around_ += svgPath(svgBar(left, right, 4, 0), classed("axis"));
    around_ += svgText(right + Point{7, 0}, text, classed("tick"));
}

std::string SvgPlot::text() const {
    const std::string width = px(layout_.width), grid = svgPath(grid_, classed("grid"));
    return element("svg",
                   {{"class", "plot"},
                    {"role", "img"},
                    {"viewBox", cat("0 0 ", width, " ", px(layout_.height))},
                    {"style", cat("max-width:", width, "px")},
                    {"aria-label", description_}},
                   svgClip({layout_.left, layout_.top}, innerWidth(), innerHeight(), cat(grid, marks_)) + around_);
}

}  // namespace mrose

#include "drawing/svg_plot.h"

#include <cmath>
#include <numbers>

#include "drawing/markup.h"
#include "io/format.h"

namespace mrose {
namespace {

bool isFinite(const PlotPoint& p) { return std::isfinite(p.x) && std::isfinite(p.y); }

std::string classed(std::string_view tag, std::string_view cssClass) {
    return cat("<", tag, " class=\"", cssClass, "\"");
}

std::string textAt(double x, double y, std::string_view cssClass, std::string_view text, std::string_view more = {}) {
    return cat(classed("text", cssClass), " x=\"", px(x), "\" y=\"", px(y), "\"", more, ">", escaped(text),
               "</text>\n");
}

PlotRange usable(PlotRange range) {
    if (!std::isfinite(range.low) || !std::isfinite(range.high) || range.high <= range.low)
        return {std::isfinite(range.low) ? range.low : 0, (std::isfinite(range.low) ? range.low : 0) + 1};
    return range;
}

}  // namespace

Ticks niceTicks(PlotRange range, int wanted) {
    range = usable(range);
    const double raw = (range.high - range.low) / wanted;
    const double power = std::pow(10, std::floor(std::log10(raw)));
    const double lead = raw / power;
    Ticks ticks;
    ticks.step = power * (lead < 1.5 ? 1 : lead < 3.5 ? 2 : lead < 7.5 ? 5 : 10);
    ticks.decimals = std::max(0, static_cast<int>(-std::floor(std::log10(ticks.step) + 1e-9)));
    const auto first = static_cast<long>(std::ceil(range.low / ticks.step - 1e-9));
    for (long i = first; static_cast<double>(i) * ticks.step <= range.high + 1e-9 * ticks.step; ++i)
        ticks.values.push_back(static_cast<double>(i) * ticks.step);
    return ticks;
}

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

void SvgPlot::gridLine(bool vertical, double value) {
    const std::string at = px(vertical ? pixelX(value) : pixelY(value));
    grid_ +=
        vertical
            ? cat("<line class=\"grid\" x1=\"", at, "\" x2=\"", at, "\" y1=\"0\" y2=\"", px(innerHeight()), "\"/>\n")
            : cat("<line class=\"grid\" y1=\"", at, "\" y2=\"", at, "\" x1=\"0\" x2=\"", px(innerWidth()), "\"/>\n");
}

void SvgPlot::axes(std::string_view xTitle, std::string_view yTitle) {
    const double bottom = layout_.top + innerHeight(), right = layout_.left + innerWidth();
    const Ticks xTicks = niceTicks(x_, static_cast<int>(innerWidth() / 70));
    for (const double value : xTicks.values) {
        gridLine(true, value);
        around_ += textAt(layout_.left + pixelX(value), bottom + 17, "tick middle", fixed(value, xTicks.decimals));
    }
    const Ticks yTicks = niceTicks(y_, std::max(2, static_cast<int>(innerHeight() / 42)));
    for (const double value : yTicks.values) {
        gridLine(false, value);
        around_ += textAt(layout_.left - 8, layout_.top + pixelY(value) + 4, "tick end", fixed(value, yTicks.decimals));
    }
    around_ += cat("<path class=\"axis\" d=\"M", px(layout_.left), " ", px(layout_.top), "V", px(bottom), "H",
                   px(right), "\"/>\n");
    if (!xTitle.empty()) around_ += textAt(layout_.left + innerWidth() / 2, layout_.height - 8, "title middle", xTitle);
    const double middle = layout_.top + innerHeight() / 2;
    around_ += textAt(14, middle, "title middle", yTitle, cat(" transform=\"rotate(-90 14 ", px(middle), ")\""));
}

void SvgPlot::grid(double step) {
    if (!(step > 0)) return;
    for (auto i = std::ceil(x_.low / step); i * step < x_.high; ++i) gridLine(true, i * step);
    for (auto i = std::ceil(y_.low / step); i * step < y_.high; ++i) gridLine(false, i * step);
}

std::string SvgPlot::path(std::span<const PlotPoint> points, bool staircase) const {
    std::string d;
    bool lifted = true;
    for (const PlotPoint& point : points) {
        const bool draws = isFinite(point);
        if (draws) {
            const std::string x = px(pixelX(point.x)), y = px(pixelY(point.y));
            d += lifted ? cat("M", x, " ", y) : staircase ? cat("H", x, "V", y) : cat("L", x, " ", y);
        }
        lifted = !draws;
    }
    return d;
}

void SvgPlot::line(std::span<const PlotPoint> points, std::string_view cssClass) {
    if (const std::string d = path(points, false); !d.empty())
        marks_ += cat(classed("path", cat("line ", cssClass)), " d=\"", d, "\"/>\n");
}

void SvgPlot::steps(std::span<const PlotPoint> points, std::string_view cssClass) {
    if (const std::string d = path(points, true); !d.empty())
        marks_ += cat(classed("path", cat("line ", cssClass)), " d=\"", d, "\"/>\n");
}

void SvgPlot::band(std::span<const PlotPoint> low, std::span<const PlotPoint> high, std::string_view cssClass) {
    std::vector<PlotPoint> outline(low.begin(), low.end());
    outline.insert(outline.end(), high.rbegin(), high.rend());
    if (const std::string d = path(outline, false); !d.empty())
        marks_ += cat(classed("path", cssClass), " d=\"", d, "Z\"/>\n");
}

void SvgPlot::bar(double x, double width, double height, std::string_view cssClass, std::string_view tooltip) {
    const double left = pixelX(x), right = pixelX(x + width), top = pixelY(height), base = pixelY(0);
    marks_ += cat(classed("rect", cssClass), " x=\"", px(left), "\" y=\"", px(top), "\" width=\"", px(right - left),
                  "\" height=\"", px(std::max(0.0, base - top)), "\"><title>", escaped(tooltip), "</title></rect>\n");
}

void SvgPlot::circle(PlotPoint centre, double pixels, std::string_view cssClass) {
    if (!isFinite(centre)) return;
    marks_ += cat(classed("circle", cssClass), " cx=\"", px(pixelX(centre.x)), "\" cy=\"", px(pixelY(centre.y)),
                  "\" r=\"", px(pixels), "\"/>\n");
}

void SvgPlot::arrow(PlotPoint from, double direction, double pixels, std::string_view cssClass) {
    if (!isFinite(from) || !std::isfinite(direction)) return;
    // y points down on the page, so that a counter-clockwise turn is a negative one there.
    const std::string turn = px(-direction * 180 / std::numbers::pi), tip = px(pixels), neck = px(pixels - 4.5);
    marks_ += cat(classed("path", cssClass), " transform=\"translate(", px(pixelX(from.x)), " ", px(pixelY(from.y)),
                  ") rotate(", turn, ")\" d=\"M0 0H", neck, "M", neck, " -2.8L", tip, " 0L", neck, " 2.8Z\"/>\n");
}

void SvgPlot::label(PlotPoint at, double dx, double dy, std::string_view text, std::string_view cssClass) {
    if (isFinite(at)) marks_ += textAt(pixelX(at.x) + dx, pixelY(at.y) + dy, cssClass, text);
}

void SvgPlot::scaleBar(double length, std::string_view text) {
    const double y = layout_.height - 10, left = layout_.left + 6, right = left + length / unitsPerPixel();
    around_ += cat("<path class=\"axis\" d=\"M", px(left), " ", px(y - 4), "V", px(y), "H", px(right), "V", px(y - 4),
                   "\"/>\n");
    around_ += textAt(right + 7, y, "tick", text);
}

std::string SvgPlot::text() const {
    const std::string width = px(layout_.width), height = px(layout_.height);
    const std::string inner =
        cat("<svg x=\"", px(layout_.left), "\" y=\"", px(layout_.top), "\" width=\"", px(innerWidth()), "\" height=\"",
            px(innerHeight()), "\">\n", grid_, marks_, "</svg>\n");
    return cat("<svg class=\"plot\" role=\"img\" viewBox=\"0 0 ", width, " ", height, "\" style=\"max-width:", width,
               "px\" aria-label=\"", escaped(description_), "\">\n", inner, around_, "</svg>\n");
}

}  // namespace mrose

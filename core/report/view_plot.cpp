#include "report/view_plot.h"

#include <algorithm>
#include <cmath>

#include "io/format.h"

namespace mrose {
namespace {

constexpr double margin = 1.12;  // for the labels at the outer arc

/// How far a side reaches from the middle, at least so much of the range.
double sideWidth(double range, double bearing) {
    constexpr double least = 0.2;
    return range * (margin - 1 + (bearing < 1.57 ? std::max(least, sine(bearing)) : 1));
}

SvgPlot plotFor(double range, PlotRange bearings, std::string_view description) {
    const double left = sideWidth(range, bearings.high), right = sideWidth(range, -bearings.low);
    const bool ahead = std::max(bearings.high, -bearings.low) < 1.57;
    const double back = ahead ? -0.06 * range : -margin * range;
    const double width = 560, scale = (width - 16) / (left + right);
    const SvgPlot::Layout layout{width, std::min(620.0, scale * (margin * range - back) + 16), 8, 8, 8, 8};
    return SvgPlot::equalScale(layout, {-left, right}, {back, margin * range}, description);
}

std::vector<Point> arcPoints(double range, double right, double left) {
    constexpr double step = 0.035;  // rad
    const int parts = std::max(1, static_cast<int>(std::ceil((left - right) / step)));
    std::vector<Point> points;
    for (int i = 0; i <= parts; ++i) points.push_back(ViewPlot::place(range, right + (left - right) * i / parts));
    return points;
}

}  // namespace

ViewPlot::ViewPlot(double range, PlotRange bearings, std::string_view description)
    : range_(range), bearings_(bearings), plot_(plotFor(range, bearings, description)) {}

Point ViewPlot::place(double range, double bearing) { return {-range * sine(bearing), range * cosine(bearing)}; }

void ViewPlot::cell(double from, double to, double right, double left, std::string_view cssClass) {
    plot_.band(arcPoints(from, right, left), arcPoints(to, right, left), cssClass);
}

void ViewPlot::arc(double range, double right, double left, std::string_view cssClass) {
    plot_.line(arcPoints(range, right, left), cssClass);
}

void ViewPlot::ray(double from, double to, double bearing, std::string_view cssClass) {
    const Point ends[] = {place(from, bearing), place(to, bearing)};
    plot_.line(ends, cssClass);
}

void ViewPlot::scale() {
    constexpr double besideEdge = 0.15;  // rad: a label there would be on another
    const double step = roundStep(range_ / 5);
    for (int i = 1; i * step <= range_ + 1e-9; ++i) {
        arc(i * step, bearings_.low, bearings_.high, "arc");
        plot_.label(place(i * step, bearings_.low), 5, 12, cat(fixed(i * step, step < 1 ? 1 : 0), " m"), "tick");
    }
    for (const double bearing : {bearings_.low, 0.0, bearings_.high}) {
        if (bearing == 0 && (bearings_.high < besideEdge || bearings_.low > -besideEdge)) continue;
        ray(0, range_, bearing, "arc");
        const char* const side = bearing == 0 ? "" : bearing > 0 ? " left" : " right";
        // Beside a corner the outer arc rises.
        const double rise = std::max(0.0, 16 * sine(2 * std::abs(bearing)));
        plot_.label(place(range_, bearing), 0, -7 - rise, cat(fixed(degrees * std::abs(bearing), 0), "°", side),
                    "tick middle");
    }
    plot_.circle({0, 0}, 6, "own");
}

}  // namespace mrose

#include "report/view_plot.h"

#include <algorithm>
#include <cmath>

#include "io/format.h"

namespace mrose {
namespace {

constexpr double margin = 1.12;  // for the labels at the outer arc

double halfWidth(double range, double bearing) {
    return margin * range * (bearing < 1.57 ? std::max(0.35, sine(bearing)) : 1);
}

SvgPlot plotFor(double range, double bearing, std::string_view description) {
    const double wide = halfWidth(range, bearing), back = bearing < 1.57 ? -0.06 * range : -margin * range;
    const double width = 560, scale = (width - 16) / (2 * wide);
    const SvgPlot::Layout layout{width, std::min(620.0, scale * (margin * range - back) + 16), 8, 8, 8, 8};
    return SvgPlot::equalScale(layout, {-wide, wide}, {back, margin * range}, description);
}

std::vector<Point> arcPoints(double range, double right, double left) {
    constexpr double step = 0.035;  // rad
    const int parts = std::max(1, static_cast<int>(std::ceil((left - right) / step)));
    std::vector<Point> points;
    for (int i = 0; i <= parts; ++i) points.push_back(ViewPlot::place(range, right + (left - right) * i / parts));
    return points;
}

}  // namespace

ViewPlot::ViewPlot(double range, double bearing, std::string_view description)
    : range_(range), bearing_(bearing), plot_(plotFor(range, bearing, description)) {}

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
    const double step = roundStep(range_ / 5);
    for (int i = 1; i * step <= range_ + 1e-9; ++i) {
        arc(i * step, -bearing_, bearing_, "arc");
        plot_.label(place(i * step, -bearing_), 5, 12, cat(fixed(i * step, step < 1 ? 1 : 0), " m"), "tick");
    }
    for (const double bearing : {-bearing_, 0.0, bearing_}) {
        ray(0, range_, bearing, "arc");
        const char* const side = bearing == 0 ? "" : bearing > 0 ? " left" : " right";
        plot_.label(place(range_, bearing), 0, -7, cat(fixed(degrees * std::abs(bearing), 0), "°", side),
                    "tick middle");
    }
    plot_.circle({0, 0}, 6, "own");
}

}  // namespace mrose

#pragma once

#include <span>
#include <string>
#include <string_view>

#include "drawing/axis_ticks.h"
#include "drawing/svg.h"
#include "geometry/polygon.h"

namespace mrose {

/// One diagram as an <svg> element. Colours, widths and dashes come from the page's style sheet: each mark has the CSS
/// classes that it is given. Lines are interrupted at points that are not finite; what lies outside the frame is
/// clipped.
class SvgPlot {
public:
    struct Layout {
        double width = 540, height = 300;
        double left = 54, right = 16, top = 12, bottom = 46;  ///< margins
    };

    /// `description` is what a screen reader says.
    SvgPlot(const Layout& layout, PlotRange x, PlotRange y, std::string_view description);

    /// The same scale on both axes around the ranges' middle, x to the right and y up; no axes are drawn by itself.
    static SvgPlot equalScale(const Layout& layout, PlotRange x, PlotRange y, std::string_view description);

    /// Frame, grid lines, tick labels and axis titles with units (plain text).
    void axes(std::string_view xTitle, std::string_view yTitle);
    void uprightAxis(std::string_view title);       ///< the frame with y's grid lines and labels alone: x is no number
    void levelAxis(std::string_view title);         ///< x's grid lines and labels alone: y is no number
    void rowName(double y, std::string_view name);  ///< left of the frame
    void grid(double step);                         ///< lines at the multiples of `step`, no labels

    void line(std::span<const Point> points, std::string_view cssClass);
    void steps(std::span<const Point> points, std::string_view cssClass);  ///< a staircase: up at each point
    void band(std::span<const Point> low, std::span<const Point> high, std::string_view cssClass);
    void area(std::span<const Polygon> pieces, std::string_view cssClass);  ///< as one where they overlap
    void bar(double x, double width, double height, std::string_view cssClass, std::string_view tooltip);
    void circle(const Point& centre, double pixels, std::string_view cssClass);
    void dot(const Point& centre, double pixels, std::string_view cssClass);  ///< whole at the edge of the frame, too
    /// An arrow of the given length in pixels from a point, in a direction in the plot's own coordinates.
    void arrow(const Point& from, double direction, double pixels, std::string_view cssClass);
    void label(const Point& at, double dx, double dy, std::string_view text, std::string_view cssClass);
    /// A bar of `length` (in x) at the lower left with its text beside it.
    void scaleBar(double length, std::string_view text);

    std::string text() const;
    double unitsPerPixel() const { return (x_.high - x_.low) / innerWidth(); }

private:
    double innerWidth() const { return layout_.width - layout_.left - layout_.right; }
    double innerHeight() const { return layout_.height - layout_.top - layout_.bottom; }
    Point pixel(const Point& at) const;
    SvgPath path(std::span<const Point> points) const;
    void add(const SvgPath& path, std::string_view cssClass);

    Layout layout_;
    PlotRange x_, y_;
    std::string description_;
    SvgPath grid_;
    std::string marks_, around_;  ///< grid and marks are clipped to the frame
};

}  // namespace mrose

#pragma once

#include <string>
#include <string_view>

#include "drawing/svg_plot.h"

namespace mrose {

/// A picture of what a sensor has before it, from above: its robot at the bottom looks up, left is left.
class ViewPlot {
public:
    /// `range` m and `bearing` rad to either side are in it.
    ViewPlot(double range, double bearing, std::string_view description)
        : ViewPlot(range, PlotRange{-bearing, bearing}, description) {}
    /// From the right (low) to the left (high).
    ViewPlot(double range, PlotRange bearings, std::string_view description);

    /// Where something is on the plot. Bearing in rad, counter-clockwise.
    static Point place(double range, double bearing);

    /// Of a ring about the robot the part between two ranges and two bearings.
    void cell(double from, double to, double right, double left, std::string_view cssClass);
    void arc(double range, double right, double left, std::string_view cssClass);
    void ray(double from, double to, double bearing, std::string_view cssClass);
    /// The robot, arcs of ranges with their labels, and bearings at the outer one.
    void scale();

    SvgPlot& plot() { return plot_; }
    std::string text() const { return plot_.text(); }

private:
    double range_;
    PlotRange bearings_;
    SvgPlot plot_;
};

}  // namespace mrose

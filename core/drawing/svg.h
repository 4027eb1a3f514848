#pragma once

#include <span>
#include <string>
#include <string_view>

#include "drawing/markup.h"
#include "geometry/point.h"

namespace mrose {

// Elements of SVG, in pixels, y down; `look` is the rest of their attributes: CSS classes, or colours and widths.

/// Where a line runs.
class SvgPath {
public:
    SvgPath() = default;
    /// Through all points, and back to the first where it is closed. What is not finite interrupts it.
    explicit SvgPath(std::span<const Point> points, bool closed = false);

    SvgPath& moveTo(const Point& to) { return add('M', to); }
    SvgPath& lineTo(const Point& to) { return add('L', to); }
    SvgPath& close();
    SvgPath& operator+=(const SvgPath& more);
    const std::string& text() const { return text_; }

private:
    SvgPath& add(char command, const Point& to);

    std::string text_;
};

/// A line from `from` with a filled head, as long as that and `headWidth` wide, that ends at `to`.
struct SvgArrow {
    SvgArrow(const Point& from, const Point& to, double headLength, double headWidth);

    SvgPath shaft, head;
};

/// A bar with an upright stroke of so many pixels at both ends, up and down from it.
SvgPath svgBar(const Point& from, const Point& to, double up, double down);

std::string svgPath(const SvgPath& path, const Attributes& look);
std::string svgCircle(const Point& centre, double radius, const Attributes& look);
/// `at` is where its base line begins, unless `look` says otherwise.
std::string svgText(const Point& at, std::string_view text, const Attributes& look);
/// Upon copies of that colour, so far aside all round: not every viewer knows SVG's paint-order, nor how wide a stroke
/// of letters is.
std::string svgHaloText(const Point& at, std::string_view text, const Attributes& look, std::string_view fill,
                        std::string_view halo, double haloWidth);
/// Content of which only what lies in a rectangle is seen.
std::string svgClip(const Point& corner, double width, double height, std::string_view content);

}  // namespace mrose

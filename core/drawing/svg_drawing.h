#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/area.h"
#include "geometry/polygon.h"
#include "geometry/shape.h"

namespace mrose {

/// A picture of the plane, x to the right and y up, that needs nothing else to be seen: marks in metres, lines and
/// letters in pixels unless said. It is as large as what it shows, all or a part.
class SvgDrawing {
public:
    struct Style {
        std::optional<Colour> fill, stroke;
        double strokeWidth = 1;       ///< pixels ...
        bool strokeInMetres = false;  ///< ... or metres
        double opacity = 1;
        bool dashed = false;
        bool dotted = false;
        bool labelsAvoid = false;  ///< labels that are put beside a point keep off it, where they can
    };
    /// What a mark means: a sample of it, and words.
    struct LegendEntry {
        enum class Symbol { line, dot, pointer } symbol = Symbol::line;
        Style style;
        std::string text;
    };
    struct Frame {
        std::string title, subtitle;
        std::vector<LegendEntry> legend = {};
        double longestSide = 900;                  ///< pixels, of what is shown
        bool grid = false;                         ///< faint lines as far apart as the scale bar is long
        std::optional<Area> shown = std::nullopt;  ///< only what lies in it; nullopt: all
    };

    void polygon(std::span<const Point> corners, const Style& style) { outline(corners, true, style); }
    /// What is not finite interrupts it.
    void line(std::span<const Point> points, const Style& style) { outline(points, false, style); }
    /// Pieces of one sense of turning that may overlap, as one area.
    void area(std::vector<Polygon> pieces, const Style& style);
    void circle(const Point& centre, double radius, const Style& style);
    /// A pixel size however large the picture is.
    void dot(const Point& centre, double pixels, const Style& style);
    /// An arrow with a filled head, with a halo.
    void arrow(const Point& from, const Point& to, const Colour& colour);
    /// An arrow head of a pixel size about a point, which shows a heading (rad).
    void pointer(const Point& at, double heading, double pixels, const Colour& colour);
    /// Text with a halo, its middle so many pixels below a point.
    void label(const Point& at, double below, std::string_view text);
    /// Text with a halo beside a point, where it covers least.
    void labelBeside(const Point& at, std::string_view text);

    std::string text(const Frame& frame) const;

private:
    struct Page;
    struct LabelBeside {
        Point at;
        std::string text;
    };

    std::string labels(const Page& page) const;
    void outline(std::span<const Point> points, bool closed, const Style& style);
    void avoid(const Style& style, std::span<const Point> points);

    std::vector<std::function<std::string(const Page&)>> marks_;
    std::vector<LabelBeside> labelsBeside_;
    std::vector<std::vector<Point>> avoided_;  ///< lines and points that those keep off
    Area drawn_{{1, 1}, {-1, -1}};
};

}  // namespace mrose

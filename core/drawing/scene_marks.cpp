#include "drawing/scene_marks.h"

#include <cmath>

namespace mrose {
namespace {

using Style = SvgDrawing::Style;

double brightness(const Colour& c) { return 0.299 * c.red + 0.587 * c.green + 0.114 * c.blue; }
Colour contrast(const Colour& c) { return brightness(c) > 140 ? black : white; }

Colour mixed(const Colour& a, const Colour& b, double shareOfB) {
    const auto mix = [&](std::uint8_t from, std::uint8_t to) {
        return static_cast<std::uint8_t>(std::lround(from + shareOfB * (to - from)));
    };
    return {mix(a.red, b.red), mix(a.green, b.green), mix(a.blue, b.blue)};
}

Colour darker(const Colour& c) { return mixed(c, {0, 0, 0}, 0.4); }

Polygon placedAt(const Polygon& polygon, const Placement& placement) {
    Polygon moved;
    for (const Point& corner : polygon) moved.push_back(placement.place(corner));
    return moved;
}

}  // namespace

void addShape(SvgDrawing& drawing, const Shape& shape, const Placement& at, const DrawingOptions& options) {
    for (const ShapePart& part : shape.parts) {
        const Style style{.fill = part.colour, .stroke = darker(part.colour)};
        if (part.polygon.empty())
            drawing.circle(at.place(part.centre), part.radius, style);
        else
            drawing.polygon(placedAt(part.polygon, at), style);
    }
    if (!options.pieces) return;
    for (std::size_t i = 0; i < shape.pieces.size(); ++i) {
        const ConvexPiece& piece = shape.pieces[i];
        const Style thin{.stroke = contrast(shape.parts[shape.partOfPiece[i]].colour), .strokeWidth = 0.8};
        if (piece.isCircle()) continue;
        drawing.polygon(placedAt({piece.corners.begin(), piece.corners.begin() + static_cast<long>(piece.count)}, at),
                        thin);
    }
}

void addEnvironment(SvgDrawing& drawing, const Environment& environment, const DrawingOptions& options, bool pale) {
    const Colour floor = pale ? mixed(environment.floor.colour, white, 0.88) : environment.floor.colour;
    if (!environment.floor.area.empty()) drawing.polygon(environment.floor.area, {.fill = floor});
    for (const Goal& goal : environment.goals) {
        drawing.polygon(goal.area, {.fill = white, .opacity = 0.25});
        drawing.polygon(goal.area, {.stroke = pale ? darker(floor) : white, .dashed = true});
    }
    for (const Marking& marking : environment.markings) {
        const Style style{.stroke = pale ? mixed(floor, black, 0.15) : marking.colour,
                          .strokeWidth = marking.width,
                          .strokeInMetres = true};
        if (marking.radius > 0)
            drawing.circle(marking.centre, marking.radius, style);
        else if (marking.closed)
            drawing.polygon(marking.points, style);
        else
            drawing.line(marking.points, style);
    }
    for (Obstacle obstacle : environment.obstacles) {
        // What is nearly white would be lost on a light ground.
        if (pale)
            for (ShapePart& part : obstacle.shape.parts) part.colour = mixed(part.colour, black, 0.35);
        addShape(drawing, obstacle.shape, {}, options);
    }
}

}  // namespace mrose

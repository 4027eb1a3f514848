#pragma once

#include <string>
#include <string_view>

#include "geometry/pose.h"
#include "geometry/shape.h"
#include "io/toml_table.h"
#include "scene/environment.h"
#include "world/time.h"
#include "world/toml_values.h"

namespace mrose {

// What description files have in common.

/// Kinds of description files; `format = "mrose shape"` in a file says which it is.
enum class DescriptionKind { shape, environment, robot, scenario, sensor, experiment, tuning, settings };

/// The root of a file of the given kind; anything else is remembered as its error.
TomlTable openDescription(const Value& content, const std::string& file, DescriptionKind kind);

/// The kind that a file says it is. Error: it says none.
Expected<DescriptionKind> descriptionKind(const Value& content, const std::string& file);

// Values beyond those of world/toml_values.h.

constexpr double shapeReach = 20;      ///< the farthest coordinate of a shape
constexpr double leastLength = 0.001;  ///< m: shorter edges, smaller circles and thinner polygons are mistakes
constexpr std::size_t mostCorners = 100;

/// "#rrggbb"
Colour colourOr(TomlTable& table, std::string_view key, const Colour& fallback);
/// { friction, restitution }
Surface surfaceOr(TomlTable& table, std::string_view key, const Surface& fallback);

/// A list of points, of which neighbours are apart; empty after an error.
Polygon points(TomlTable& table, std::string_view key, std::size_t least, double far, bool closed);
/// A simple polygon that is not too small; empty after an error.
Polygon polygon(TomlTable& table, std::string_view key, double far);
/// `polygon_m`, or `circle = { centre_m, radius_m }`, with name and colour: something solid, about `origin`.
ShapePart part(TomlTable& table, const Colour& colour, double far, const Point& origin = {});
/// Why contact cannot be with all of a simple polygon, given about `origin`; "" for nothing.
std::string contactProblem(const Polygon& corners, const Point& origin = {});

}  // namespace mrose

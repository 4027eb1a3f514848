#pragma once

#include <string>
#include <string_view>

#include "geometry/pose.h"
#include "geometry/shape.h"
#include "io/toml_table.h"
#include "scene/environment.h"
#include "world/time.h"

namespace mrose {

// What description files have in common.

/// Kinds of description files; `format = "mrose shape"` in a file says which it is.
enum class DescriptionKind { shape, environment, robot, scenario };

/// The root of a file of the given kind; anything else is remembered as its error.
TomlTable openDescription(const Value& content, const std::string& file, DescriptionKind kind);

/// The kind that a file says it is. Error: it says none.
Expected<DescriptionKind> descriptionKind(const Value& content, const std::string& file);

// Values, with their units in the keys: lengths and positions `_m`, angles `_deg`, which become radians here.

constexpr double metresFar = 1000;     ///< the farthest coordinate of an environment
constexpr double shapeReach = 20;      ///< the farthest coordinate of a shape
constexpr double leastLength = 0.001;  ///< m: shorter edges, smaller circles and thinner polygons are mistakes
constexpr std::size_t mostCorners = 100;

double radians(double degrees);
double angle(TomlTable& table, std::string_view key, NumberRange degrees);
double angleOr(TomlTable& table, std::string_view key, double fallback, NumberRange degrees);
Nanoseconds duration(TomlTable& table, std::string_view key, NumberRange seconds);
Nanoseconds durationOr(TomlTable& table, std::string_view key, Nanoseconds fallback, NumberRange seconds);
Point point(TomlTable& table, std::string_view key, double far);
Point pointOr(TomlTable& table, std::string_view key, const Point& fallback, double far);
/// { x_m, y_m, heading_deg }, or heading_rad, which is exact; the heading may be missing.
Pose pose(TomlTable table);
/// A name of a body, a file's part ...: not empty, at most 64 bytes, printable.
std::string name(TomlTable& table, std::string_view key);
std::string nameOr(TomlTable& table, std::string_view key, const std::string& fallback);
/// "#rrggbb"
Colour colourOr(TomlTable& table, std::string_view key, const Colour& fallback);
/// { friction, restitution }
Surface surfaceOr(TomlTable& table, std::string_view key, const Surface& fallback);

/// A list of points, of which neighbours are apart; empty after an error.
Polygon points(TomlTable& table, std::string_view key, std::size_t least, double far, bool closed);
/// A simple polygon that is not too small; empty after an error.
Polygon polygon(TomlTable& table, std::string_view key, double far);
/// `polygon_m`, or `circle = { centre_m, radius_m }`, with name and colour: something solid, in convex pieces.
ShapePart part(TomlTable& table, const Colour& colour, double far);

}  // namespace mrose

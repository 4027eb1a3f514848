#pragma once

#include <string>
#include <string_view>

#include "geometry/pose.h"
#include "io/toml_table.h"
#include "world/time.h"

namespace mrose {

// Values of description files, with their units in the keys: lengths and positions `_m`, angles `_deg`, which become
// radians here.

constexpr double metresFar = 1000;  ///< the farthest coordinate of an environment

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

}  // namespace mrose

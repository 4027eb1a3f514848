#include "world/toml_values.h"

#include <algorithm>
#include <numbers>

namespace mrose {

double radians(double degrees) { return degrees * (std::numbers::pi / 180); }

double angle(TomlTable& table, std::string_view key, NumberRange degrees) {
    return radians(table.number(key, degrees));
}

double angleOr(TomlTable& table, std::string_view key, double fallback, NumberRange degrees) {
    return table.has(key) ? angle(table, key, degrees) : fallback;
}

Nanoseconds duration(TomlTable& table, std::string_view key, NumberRange seconds) {
    return fromSeconds(table.number(key, seconds));
}

Nanoseconds durationOr(TomlTable& table, std::string_view key, Nanoseconds fallback, NumberRange seconds) {
    return table.has(key) ? duration(table, key, seconds) : fallback;
}

Point point(TomlTable& table, std::string_view key, double far) {
    const std::vector<double> values = table.numbers(key, 2, {-far, far});
    return {values[0], values[1]};
}

Point pointOr(TomlTable& table, std::string_view key, const Point& fallback, double far) {
    return table.has(key) ? point(table, key, far) : fallback;
}

Pose pose(TomlTable table) {
    const NumberRange metres{-metresFar, metresFar};
    Pose pose{table.number("x_m", metres), table.number("y_m", metres), 0};
    if (table.has("heading_rad")) {
        if (table.has("heading_deg")) table.reject("heading_rad", "heading_deg is there too; expected one of them");
        pose.heading = table.number("heading_rad", {-1e6, 1e6});
    } else {
        pose.heading = angleOr(table, "heading_deg", 0, {-360, 360});
    }
    table.rejectUnknown();
    return pose;
}

std::string name(TomlTable& table, std::string_view key) {
    std::string text = table.string(key);
    const auto printable = [](char c) { return static_cast<unsigned char>(c) >= 0x20 && c != 0x7f; };
    if (!table.failed() && (text.empty() || text.size() > 64 || !std::all_of(text.begin(), text.end(), printable)))
        table.reject(key, "expected a name of 1 to 64 printable characters");
    return text;
}

std::string nameOr(TomlTable& table, std::string_view key, const std::string& fallback) {
    return table.has(key) ? name(table, key) : fallback;
}

}  // namespace mrose

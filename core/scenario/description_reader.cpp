#include "scenario/description_reader.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "geometry/contact_corners.h"
#include "io/format.h"

namespace mrose {
namespace {

constexpr std::array<std::string_view, 8> formats{"mrose shape",    "mrose environment", "mrose robot",
                                                  "mrose scenario", "mrose sensor",      "mrose experiment",
                                                  "mrose tuning",   "mrose settings"};
constexpr std::int64_t formatVersion = 1;

std::optional<Colour> parseColour(std::string_view text) {
    const auto hexadecimal = [](char c) {
        return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f') || (c >= 'A' && c <= 'F');
    };
    if (text.size() != 7 || text[0] != '#' || !std::all_of(text.begin() + 1, text.end(), hexadecimal))
        return std::nullopt;
    const auto value = std::stoul(std::string(text.substr(1)), nullptr, 16);
    return Colour{static_cast<std::uint8_t>(value >> 16), static_cast<std::uint8_t>(value >> 8),
                  static_cast<std::uint8_t>(value)};
}

/// The least distance between two parallel lines that hold all points between them, of which one lies along an edge.
double width(const Polygon& corners) {
    double least = metresFar;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const Point edge = corners[(i + 1) % corners.size()] - corners[i];
        double low = 0, high = 0;
        for (const Point& p : corners) {
            const double aside = cross(edge, p - corners[i]) / length(edge);
            low = std::min(low, aside);
            high = std::max(high, aside);
        }
        least = std::min(least, high - low);
    }
    return least;
}

double areaOf(const std::vector<Polygon>& pieces) {
    double area = 0;
    for (const Polygon& piece : pieces) area += signedArea(piece);
    return area;
}

bool holdsArea(const std::vector<Polygon>& pieces, double area) {
    return std::abs(areaOf(pieces) - area) <= 1e-3 * area;
}

constexpr const char* tooThin = "is too thin in places to be divided into convex pieces";

std::string nearCorner(const Polygon& piece, const Point& origin) {
    return " near (" + numberText(piece[0].x + origin.x) + ", " + numberText(piece[0].y + origin.y) + ')';
}

/// What is wrong with a polygon as something solid; "" for nothing. Its edges are long enough and do not meet.
std::string solidityProblem(const Polygon& corners) {
    if (width(corners) < leastLength) return "is thinner than 0.001 m";
    const std::vector<Polygon> pieces = convexPieces(corners);
    if (!holdsArea(pieces, std::abs(signedArea(corners)))) return tooThin;
    for (const Polygon& piece : pieces)
        if (width(piece) < 1e-4) return "is thinner than 0.0001 m" + nearCorner(piece, {});
    return {};
}

ShapePart circle(TomlTable table, double far) {
    ShapePart part;
    part.centre = pointOr(table, "centre_m", {}, far);
    part.radius = table.number("radius_m", {leastLength, far});
    table.rejectUnknown();
    return part;
}

}  // namespace

std::string contactProblem(const Polygon& corners, const Point& origin) {
    std::vector<Polygon> left;
    for (const Polygon& piece : convexPieces(corners)) {
        left.push_back(contactCorners(piece));
        if (left.back().empty())
            return "is thinner than 0.0003 m, or than a millionth of its length," + nearCorner(piece, origin);
    }
    return holdsArea(left, std::abs(signedArea(corners))) ? "" : tooThin;
}

TomlTable openDescription(const Value& content, const std::string& file, DescriptionKind kind) {
    TomlTable root = TomlTable::of(content, file);
    root.choice("format", {formats[static_cast<std::size_t>(kind)]});
    root.integer("version", formatVersion, formatVersion);
    return root;
}

Expected<DescriptionKind> descriptionKind(const Value& content, const std::string& file) {
    TomlTable root = TomlTable::of(content, file);
    const auto kind = static_cast<DescriptionKind>(root.choice("format", formats));
    if (root.failed()) return tl::unexpected(root.error());
    return kind;
}

Colour colourOr(TomlTable& table, std::string_view key, const Colour& fallback) {
    if (!table.has(key)) return fallback;
    const std::string text = table.string(key);
    const auto colour = parseColour(text);
    if (!colour) table.reject(key, "expected a colour such as \"#3050c0\"");
    return colour.value_or(fallback);
}

Surface surfaceOr(TomlTable& table, std::string_view key, const Surface& fallback) {
    if (!table.has(key)) return fallback;
    TomlTable inner = table.table(key);
    const Surface surface{inner.numberOr("friction", fallback.friction, {0, 10}),
                          inner.numberOr("restitution", fallback.restitution, {0, 1})};
    inner.rejectUnknown();
    return surface;
}

Polygon points(TomlTable& table, std::string_view key, std::size_t least, double far, bool closed) {
    Polygon corners;
    const std::vector<double> values = table.rows(key, 2, least, mostCorners, {-far, far});
    for (std::size_t i = 0; i < values.size(); i += 2) corners.push_back({values[i], values[i + 1]});
    for (std::size_t i = 0; i + (closed ? 0 : 1) < corners.size(); ++i)
        if (distance(corners[i], corners[(i + 1) % corners.size()]) < leastLength)
            table.rejectElement(key, i, "is nearer than 0.001 m to the next corner; edges need some length");
    return table.failed() ? Polygon() : corners;
}

Polygon polygon(TomlTable& table, std::string_view key, double far) {
    Polygon corners = points(table, key, 3, far, true);
    if (corners.empty()) return corners;
    if (const auto edges = selfIntersection(corners))
        table.rejectElement(key, edges->second,
                            "begins an edge that meets the edge from corner " + std::to_string(edges->first + 1) +
                                "; expected a simple polygon");
    else if (const std::string problem = solidityProblem(corners); !problem.empty())
        table.reject(key, problem);
    return table.failed() ? Polygon() : corners;
}

ShapePart part(TomlTable& table, const Colour& colour, double far, const Point& origin) {
    const std::string called = nameOr(table, "name", "");
    table.expectOneOf("circle", "polygon_m", "polygon_m = [[x, y], ...] or circle = { centre_m, radius_m }");
    ShapePart part;
    if (table.has("circle"))
        part = circle(table.table("circle"), far);
    else
        part.polygon = polygon(table, "polygon_m", far);
    part.centre = part.centre - origin;
    for (Point& corner : part.polygon) corner = corner - origin;
    if (!part.polygon.empty())
        if (const std::string problem = contactProblem(part.polygon, origin); !problem.empty())
            table.reject("polygon_m", problem);
    part.name = called;
    part.colour = colourOr(table, "colour", colour);
    return part;
}

}  // namespace mrose

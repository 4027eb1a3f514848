#include "scenario/shape_file.h"

#include "io/format.h"
#include "io/toml_text.h"
#include "scenario/description_reader.h"

namespace mrose {
namespace {

constexpr std::size_t mostParts = 64;
constexpr Colour grey{128, 128, 128};
/// A robot's pose is its reference point's, and where that is a long way off the least turn would carry the robot away.
constexpr double mostAside = 100;

}  // namespace

Expected<Shape> readShape(const Value& content, const std::string& file) {
    TomlTable root = openDescription(content, file, DescriptionKind::shape);
    const std::string called = name(root, "name");
    const Point reference = pointOr(root, "reference_m", {}, shapeReach);
    std::vector<ShapePart> parts;
    std::vector<TomlTable> tables = root.tables("part");
    if (tables.empty() || tables.size() > mostParts) root.reject("part", "expected 1 to 64 parts");
    for (TomlTable& table : tables) {
        if (root.failed()) break;
        parts.push_back(part(table, grey, shapeReach, reference));
        table.rejectUnknown();
    }
    root.rejectUnknown();
    if (root.failed()) return tl::unexpected(root.error());
    Shape shape = Shape::fromParts(called, std::move(parts));
    if (const double aside = length(shape.centroid); aside > mostAside * shape.gyration) {
        root.reject("part", "lies " + fixed(aside, 3) + " m beside the reference point; expected at most " +
                                fixed(mostAside * shape.gyration, 3) + " m, 100 times the radius of gyration");
        return tl::unexpected(root.error());
    }
    return shape;
}

Expected<Shape> parseShape(std::string_view text, const std::string& file) {
    const auto content = parseToml(text, file);
    return content ? readShape(*content, file) : tl::unexpected(content.error());
}

}  // namespace mrose

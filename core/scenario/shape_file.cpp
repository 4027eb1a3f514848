#include "scenario/shape_file.h"

#include "io/toml_text.h"
#include "scenario/description_reader.h"

namespace mrose {
namespace {

constexpr std::size_t mostParts = 64;
constexpr Colour grey{128, 128, 128};

ShapePart moved(ShapePart part, const Point& origin) {
    for (Point& corner : part.polygon) corner = corner - origin;
    part.centre = part.centre - origin;
    return part;
}

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
        parts.push_back(moved(part(table, grey, shapeReach), reference));
        table.rejectUnknown();
    }
    root.rejectUnknown();
    if (root.failed()) return tl::unexpected(root.error());
    return Shape::fromParts(called, std::move(parts));
}

Expected<Shape> parseShape(std::string_view text, const std::string& file) {
    const auto content = parseToml(text, file);
    return content ? readShape(*content, file) : tl::unexpected(content.error());
}

}  // namespace mrose

#include "scenario/shape_file.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace mrose {
namespace {

const std::string shapeHead = "format = \"mrose shape\"\nversion = 1\nname = \"s\"\n";

Expected<Shape> parse(const std::string& body) { return parseShape(shapeHead + body, "f"); }

std::string shapeRefusal(const std::string& body) {
    const auto shape = parse(body);
    return shape ? "" : shape.error().message();
}

/// The refusal of one part whose polygon is given.
std::string polygonRefusal(const std::string& corners) { return shapeRefusal("[[part]]\npolygon_m = " + corners); }

/// Area by counting the centres of small squares that lie in the polygon: no formula in common with ours.
double countedArea(const Polygon& polygon, double cell) {
    double area = 0;
    for (double x = -1 + cell / 2; x < 1; x += cell)
        for (double y = -1 + cell / 2; y < 1; y += cell) {
            double turns = 0;
            for (std::size_t i = 0; i < polygon.size(); ++i) {
                const Point a = polygon[i] - Point{x, y}, b = polygon[(i + 1) % polygon.size()] - Point{x, y};
                turns += std::atan2(cross(a, b), dot(a, b));
            }
            if (std::abs(turns) > std::numbers::pi) area += cell * cell;
        }
    return area;
}

TEST(ShapeFile, GivesPartsAboutTheReferencePoint) {
    const auto shape = parse(R"(reference_m = [0.1, -0.2]
[[part]]
name = "body"
colour = "#0A80ff"
polygon_m = [[0, 0], [0.4, 0], [0.4, 0.2], [0, 0.2]]
[[part]]
circle = { centre_m = [0.4, 0.1], radius_m = 0.05 }
)");
    ASSERT_TRUE(shape) << shape.error().message();
    EXPECT_EQ(shape->name, "s");
    ASSERT_EQ(shape->parts.size(), 2u);
    EXPECT_EQ(shape->parts[0].name, "body");
    EXPECT_EQ(shape->parts[0].colour, (Colour{10, 128, 255}));
    EXPECT_EQ(shape->parts[1].colour, (Colour{128, 128, 128}));
    const Polygon expected{{-0.1, 0.2}, {0.3, 0.2}, {0.3, 0.4}, {-0.1, 0.4}};
    ASSERT_EQ(shape->parts[0].polygon.size(), 4u);
    for (std::size_t i = 0; i < 4; ++i) EXPECT_LT(distance(shape->parts[0].polygon[i], expected[i]), 1e-15);
    EXPECT_NEAR(shape->parts[1].centre.x, 0.3, 1e-15);
    EXPECT_NEAR(shape->parts[1].centre.y, 0.3, 1e-15);
    EXPECT_EQ(shape->parts[1].radius, 0.05);
    EXPECT_EQ(shape->pieces.size(), 2u);
}

TEST(ShapeFile, AnySimplePolygonIsDividedIntoPiecesThatCoverIt) {
    // A comb, a star, a thin L, and a spiral given clockwise.
    std::string star = "[";
    for (int i = 0; i < 14; ++i) {
        const double r = i % 2 == 0 ? 0.9 : 0.3, angle = i * std::numbers::pi / 7;
        star +=
            (i ? ", [" : "[") + std::to_string(r * std::cos(angle)) + ", " + std::to_string(r * std::sin(angle)) + "]";
    }
    star += "]";
    for (const std::string& corners :
         {std::string("[[-0.9,-0.9],[0.9,-0.9],[0.9,0.8],[0.6,0.8],[0.6,-0.5],[0.3,-0.5],[0.3,0.8],[0,0.8],[0,-0.5],"
                      "[-0.4,-0.5],[-0.4,0.8],[-0.9,0.8]]"),
          star, std::string("[[-0.9,-0.9],[0.9,-0.9],[0.9,-0.85],[-0.8,-0.85],[-0.8,0.9],[-0.9,0.9]]"),
          std::string("[[-0.9,0.9],[0.9,0.9],[0.9,-0.9],[-0.6,-0.9],[-0.6,0.5],[0.5,0.5],[0.5,-0.5],[-0.2,-0.5],[-0.2,"
                      "0.1],[0.1,0.1],[0.1,-0.2],[0.2,-0.2],[0.2,0.2],[-0.4,0.2],[-0.4,-0.7],[0.7,-0.7],[0.7,0.7],[-0."
                      "9,0.7]]")}) {
        const auto shape = parse("[[part]]\npolygon_m = " + corners);
        ASSERT_TRUE(shape) << shape.error().message();
        double pieces = 0;
        for (const ConvexPiece& piece : shape->pieces) {
            EXPECT_LE(piece.count, 8u);
            const Polygon own(piece.corners.begin(), piece.corners.begin() + static_cast<long>(piece.count));
            pieces += signedArea(own);
            for (std::size_t i = 0; i < own.size(); ++i)
                EXPECT_GE(cross(own[(i + 1) % own.size()] - own[i], own[(i + 2) % own.size()] - own[i]), -1e-12);
        }
        const double counted = countedArea(shape->parts[0].polygon, 0.004);
        EXPECT_NEAR(pieces, counted, 0.01 * counted + 0.005);
        EXPECT_NEAR(pieces, std::abs(signedArea(shape->parts[0].polygon)), 1e-12);
    }
}

TEST(ShapeFile, PolygonsWithoutSizeAreRefusedWhereTheyStand) {
    EXPECT_EQ(polygonRefusal("[[0, 0], [0, 0],\n  [0, 0]]"),
              "f:5:14: part[1].polygon_m[1]: is nearer than 0.001 m to the next corner; edges need some length");
    EXPECT_EQ(polygonRefusal("[[0, 0], [0.1, 0],\n  [0.1, 0.1], [0.1, 0.1005]]"),
              "f:6:3: part[1].polygon_m[3]: is nearer than 0.001 m to the next corner; edges need some length");
    EXPECT_EQ(polygonRefusal("[[0, 0], [0.1, 0], [0.1, 0.1],\n [0.0005, 0]]"),
              "f:6:2: part[1].polygon_m[4]: is nearer than 0.001 m to the next corner; edges need some length");
    EXPECT_EQ(polygonRefusal("[[0, 0], [0.1, 0], [0.05, 0.0005]]"),
              "f:5:13: part[1].polygon_m: is thinner than 0.001 m");
    EXPECT_EQ(
        polygonRefusal("[[0, 0], [0.1, 0], [0.2, 0]]"),
        "f:5:32: part[1].polygon_m[3]: begins an edge that meets the edge from corner 2; expected a simple polygon");
    EXPECT_EQ(polygonRefusal("[[0, 0], [0.1, 0]]"),
              "f:5:13: part[1].polygon_m: has 2 elements; expected 3 to 100 arrays of 2 numbers");
}

TEST(ShapeFile, PolygonsThatAreNotSimpleAreRefused) {
    // A bow tie: the edges from corners 1 and 3 cross.
    EXPECT_EQ(
        polygonRefusal("[[0, 0], [1, 0], [0, 1],\n [1, 1]]"),
        "f:6:2: part[1].polygon_m[4]: begins an edge that meets the edge from corner 2; expected a simple polygon");
    // A corner that touches another edge.
    EXPECT_NE(polygonRefusal("[[0, 0], [1, 0], [1, 1], [0.5, 0], [0, 1]]").find("expected a simple polygon"),
              std::string::npos);
    // An edge that runs back along its neighbour.
    EXPECT_NE(polygonRefusal("[[0, 0], [1, 0], [0.5, 0], [0.5, 1]]").find("expected a simple polygon"),
              std::string::npos);
    // A bridge of 0.05 mm between two blocks.
    EXPECT_NE(polygonRefusal("[[-1, -1], [-0.5, -1], [-0.5, 0], [0.5, 0], [0.5, -1], [1, -1], [1, 1], [0.5, 1],"
                             "[0.5, 0.00005], [-0.5, 0.00005], [-0.5, 1], [-1, 1]]")
                  .find("thin"),
              std::string::npos);
}

TEST(ShapeFile, EveryOtherMistakeNamesItsPlace) {
    const std::pair<const char*, const char*> cases[] = {
        {"", "f:1:1: part: is missing"},
        {"part = []", "f:4:8: part: expected 1 to 64 parts"},
        {"[[part]]\ncircle = { radius_m = 0.0005 }",
         "f:5:23: part[1].circle.radius_m: is 5e-04; expected 0.001 to 20.0"},
        {"[[part]]\ncircle = { radius_m = 21 }", "f:5:23: part[1].circle.radius_m: is 21.0; expected 0.001 to 20.0"},
        {"[[part]]\ncircle = { radius = 1 }",
         "f:5:21: part[1].circle.radius: is not a known key; did you mean radius_m?"},
        {"[[part]]\ncircle = { radius_m = 1, colour = 1 }",
         "f:5:35: part[1].circle.colour: is not a known key; expected one of centre_m, radius_m"},
        {"[[part]]\nname = \"a\"",
         "f:4:1: part[\"a\"].polygon_m: expected either polygon_m = [[x, y], ...] or circle = { centre_m, radius_m }"},
        {"[[part]]\npolygon_m = [[0, 0], [1, 0], [0, 1]]\ncircle = { radius_m = 1 }",
         "f:6:10: part[1].circle: expected either polygon_m = [[x, y], ...] or circle = { centre_m, radius_m }"},
        {"[[part]]\npolygon_m = [[0, 0], [1, 0],\n [0, 30]]",
         "f:6:6: part[1].polygon_m: is 30.0; expected -20.0 to 20.0"},
        {"[[part]]\npolygon_m = [[0, 0], [1, 0],\n [0, 1, 2]]", "f:6:2: part[1].polygon_m: has 3 numbers; expected 2"},
        {"[[part]]\npolygon_m = \"square\"", "f:5:13: part[1].polygon_m: expected 3 to 100 arrays of 2 numbers"},
        {"[[part]]\ncolour = \"red\"\ncircle = { radius_m = 1 }",
         "f:5:10: part[1].colour: expected a colour such as \"#3050c0\""},
        {"[[part]]\ncolour = \"#12345g\"\ncircle = { radius_m = 1 }",
         "f:5:10: part[1].colour: expected a colour such as \"#3050c0\""},
        {"[[part]]\nname = \"\"\ncircle = { radius_m = 1 }",
         "f:5:8: part[1].name: expected a name of 1 to 64 printable characters"},
        {"[[part]]\ncircle = { radius_m = 1 }\ncolor = \"#102030\"",
         "f:6:9: part[1].color: is not a known key; did you mean colour?"},
        {"colour = \"#102030\"\n[[part]]\ncircle = { radius_m = 1 }",
         "f:4:10: colour: is not a known key; expected one of format, name, part, reference_m, version"},
        {"reference_m = [0]\n[[part]]\ncircle = { radius_m = 1 }", "f:4:15: reference_m: has 1 number; expected 2"},
    };
    for (const auto& [body, message] : cases) EXPECT_EQ(shapeRefusal(body), message) << body;
}

TEST(ShapeFile, AnotherKindOrVersionOfFileIsRefused) {
    const auto refused = [](const char* text) { return parseShape(text, "f").error().message(); };
    EXPECT_EQ(refused(""), "f:1:1: format: is missing");
    EXPECT_EQ(refused("format = \"mrose robot\""),
              "f:1:10: format: is \"mrose robot\"; expected one of \"mrose shape\"");
    EXPECT_EQ(refused("format = \"mrose shape\"\nversion = 2"), "f:2:11: version: expected a whole number from 1 to 1");
    EXPECT_EQ(refused("format = \"mrose shape\"\nversion = 1\nname = = 1").substr(0, 19), "f:3:8: is not TOML:");
}

}  // namespace
}  // namespace mrose

#include "scenario/environment_file.h"

#include <cmath>

#include <gtest/gtest.h>

#include "scenario/descriptions.h"

namespace mrose {
namespace {

const std::string environmentHead = "format = \"mrose environment\"\nversion = 1\nname = \"e\"\n";

Environment parsed(const std::string& body) {
    const auto environment = parseEnvironment(environmentHead + body, "f");
    EXPECT_TRUE(environment) << environment.error().message();
    return environment.value_or(Environment{});
}

std::string environmentRefusal(const std::string& body) {
    const auto environment = parseEnvironment(environmentHead + body, "f");
    return environment ? "" : environment.error().message();
}

double areaOf(const Shape& shape) {
    double area = 0;
    for (const ShapePart& part : shape.parts) area += std::abs(signedArea(part.polygon));
    return area;
}

/// Whether a point lies in one of the shape's pieces.
bool holds(const Shape& shape, const Point& point) {
    for (const ConvexPiece& piece : shape.pieces)
        if (distance(ConvexPiece::circle(point, 1e-9), piece) <= 0) return true;
    return false;
}

TEST(EnvironmentFile, GivesWhatTheFileHolds) {
    const auto environment = parseEnvironment(smallWorld().at("e.toml"), "f");
    ASSERT_TRUE(environment) << environment.error().message();
    EXPECT_EQ(environment->name, "yard");
    EXPECT_EQ(environment->floor.slidingFriction, 0.25);
    EXPECT_EQ(environment->floor.traction, 0.7);
    EXPECT_EQ(environment->floor.rollingDeceleration, 0.5);
    EXPECT_EQ(environment->floor.colour, (Colour{16, 32, 48}));
    EXPECT_EQ(environment->floor.area.size(), 4u);
    ASSERT_EQ(environment->obstacles.size(), 2u);
    EXPECT_EQ(environment->obstacles[0].name, "fence");
    EXPECT_EQ(environment->obstacles[0].surface, (Surface{0.6, 0.3}));
    EXPECT_EQ(environment->obstacles[1].name, "post");
    EXPECT_EQ(environment->obstacles[1].surface, (Surface{0.6, 0.9})) << "what it leaves out is the environment's";
    EXPECT_EQ(environment->obstacles[1].shape.parts[0].colour, (Colour{255, 0, 0}));
    ASSERT_EQ(environment->goals.size(), 1u);
    EXPECT_EQ(environment->goals[0].name, "east");
    EXPECT_NEAR(signedArea(environment->goals[0].area), 1, 1e-12);
    ASSERT_EQ(environment->markings.size(), 2u);
    EXPECT_EQ(environment->markings[0].points, (std::vector<Point>{{0, -3}, {0, 3}}));
    EXPECT_EQ(environment->markings[0].width, 0.05);
    EXPECT_EQ(environment->markings[1].radius, 1);
    EXPECT_EQ(environment->markings[1].width, 0.02);
    EXPECT_EQ(environment->markings[1].colour, (Colour{0, 255, 0}));
}

TEST(EnvironmentFile, SaysAsWhatCamerasSeeWhatStands) {
    const std::string wall = "[[wall]]\npoints_m = [[0, 0], [1, 0]]\nthickness_m = 0.1\n",
                      post = "[[obstacle]]\ncircle = { centre_m = [5, 5], radius_m = 0.1 }\n";
    const Environment plain = parsed(wall + post);
    EXPECT_EQ(plain.obstacles[0].colourClass, ColourClass::wall);
    EXPECT_EQ(plain.obstacles[1].colourClass, ColourClass::obstacle);
    const Environment said = parsed(wall + "colour_class = \"yellow_goal\"\n" + post + "colour_class = \"robot\"\n");
    EXPECT_EQ(said.obstacles[0].colourClass, ColourClass::yellowGoal);
    EXPECT_EQ(said.obstacles[1].colourClass, ColourClass::robot);
    for (const char* const word : {"nothing", "opponent", "red"})
        EXPECT_EQ(environmentRefusal(wall + "colour_class = \"" + word + "\"\n"),
                  "f:7:16: wall[1].colour_class: is \"" + std::string(word) +
                      "\"; expected one of \"floor\", \"marking\", \"wall\", \"obstacle\", \"yellow_goal\", "
                      "\"blue_goal\", \"ball\", \"box\", \"person\", \"robot\"");
}

TEST(EnvironmentFile, LandmarksAreListedInTheOrderOfTheirObstacles) {
    const Environment environment = parsed(
        "[[wall]]\npoints_m = [[0, 0], [1, 0]]\nthickness_m = 0.1\n"
        "[[obstacle]]\nlandmark = \"b\"\ncircle = { centre_m = [0.1, 0.7], radius_m = 0.3 }\n"
        "[[obstacle]]\ncircle = { radius_m = 0.3 }\n"
        "[[obstacle]]\nname = \"post\"\nlandmark = \"a\"\npolygon_m = [[2, 0], [4, 0], [4, 1], [2, 1]]\n");
    const std::vector<Landmark> landmarks = landmarksOf(environment);
    ASSERT_EQ(landmarks.size(), 2u);
    EXPECT_EQ(landmarks[0].name, "b");
    EXPECT_EQ(landmarks[0].position, (Point{0.1, 0.7})) << "exactly as the file says";
    EXPECT_EQ(landmarks[0].obstacle, 1u);
    EXPECT_EQ(landmarks[1].name, "a");
    EXPECT_NEAR(distance(landmarks[1].position, {3, 0.5}), 0, 1e-12);
    EXPECT_EQ(landmarks[1].obstacle, 3u);
    EXPECT_EQ(environment.obstacles[3].name, "post");
}

TEST(EnvironmentFile, ClosedWallIsAFrameOfTheThicknessOnItsSide) {
    const std::string points =
        "[[wall]]\npoints_m = [[0, 0], [4, 0], [4, 3], [0, 3]]\nclosed = true\nthickness_m = 0.2\n";
    // Frames between rectangles: outside, inside and astride of 4 x 3 m.
    EXPECT_NEAR(areaOf(parsed(points + "side = \"right\"").obstacles[0].shape), 4.4 * 3.4 - 4 * 3, 1e-12);
    EXPECT_NEAR(areaOf(parsed(points + "side = \"left\"").obstacles[0].shape), 4 * 3 - 3.6 * 2.6, 1e-12);
    const Shape astride = parsed(points).obstacles[0].shape;
    EXPECT_NEAR(areaOf(astride), 4.2 * 3.2 - 3.8 * 2.8, 1e-12);
    for (const Point& corner : {Point{-0.09, -0.09}, Point{4.09, 3.09}, Point{0.09, 2.91}})
        EXPECT_TRUE(holds(astride, corner));
    for (const Point& free : {Point{0.11, 0.11}, Point{4.11, 3}, Point{2, 1.5}}) EXPECT_FALSE(holds(astride, free));
}

TEST(EnvironmentFile, OpenWallEndsWhereItsLineEnds) {
    const Shape wall =
        parsed("[[wall]]\npoints_m = [[0, 0], [2, 0], [3, 1]]\nthickness_m = 0.1\nside = \"left\"").obstacles[0].shape;
    ASSERT_EQ(wall.parts.size(), 2u);
    EXPECT_TRUE(holds(wall, {0.001, 0.05}) && holds(wall, {1, 0.099}) && holds(wall, {2.9, 0.95}));
    EXPECT_FALSE(holds(wall, {-0.001, 0.05}) || holds(wall, {1, -0.001}) || holds(wall, {1, 0.101}) ||
                 holds(wall, {3.05, 1.05}));
    // The mitre at a bend by 45 degrees: no gap and no overlap.
    const double bend = 0.1 * std::tan(22.5 * std::acos(-1) / 180);
    EXPECT_NEAR(areaOf(wall), 0.1 * (2 - bend / 2) + 0.1 * (std::sqrt(2) - bend / 2), 1e-12);
}

TEST(EnvironmentFile, EveryMistakeNamesItsPlace) {
    const std::pair<const char*, const char*> cases[] = {
        {"[[wall]]\npoints_m = [[0, 0], [1, 0]]", "f:4:1: wall[1].thickness_m: is missing"},
        {"[[wall]]\npoints_m = [[0, 0]]\nthickness_m = 0.1",
         "f:5:12: wall[1].points_m: has 1 elements; expected 2 to 100 arrays of 2 numbers"},
        {"[[wall]]\npoints_m = [[0, 0], [0, 0.0001]]\nthickness_m = 0.1",
         "f:5:13: wall[1].points_m[1]: is nearer than 0.001 m to the next corner; edges need some length"},
        {"[[wall]]\npoints_m = [[0, 0], [1, 0], [0.4, 0.9]]\nthickness_m = 0.1",
         "f:5:21: wall[1].points_m[2]: turns by more than 120 degrees; expected two walls"},
        {"[[wall]]\npoints_m = [[0, 0], [1, 0], [1, 0.1],\n [0, 0.1]]\nclosed = true\nthickness_m = 0.3",
         "f:5:21: wall[1].points_m[2]: begins a segment that is too short for the wall's thickness"},
        {"[[wall]]\npoints_m = [[0, 0], [1, 0]]\nthickness_m = 0",
         "f:6:15: wall[1].thickness_m: is 0.0; expected 0.001 to 10.0"},
        {"[[wall]]\npoints_m = [[0, 0], [1, 0]]\nthickness_m = 0.1\nside = \"top\"",
         "f:7:8: wall[1].side: is \"top\"; expected one of \"both\", \"left\", \"right\""},
        {"[[wall]]\npoints_m = [[0, 0], [1001, 0]]\nthickness_m = 0.1",
         "f:5:22: wall[1].points_m: is 1001.0; expected -1000.0 to 1000.0"},
        {"[[wall]]\npoints_m = [[0, 0], [1, 0]]\nthickness_m = 0.1\nclosed = 1",
         "f:7:10: wall[1].closed: expected true or false"},
        {"[[wall]]\npoints_m = [[0, 0], [1, 0]]\nthickness_m = 0.1\nheight_m = 1",
         "f:7:12: wall[1].height_m: is not a known key; expected one of closed, colour, colour_class, name, points_m, "
         "side, surface, "
         "thickness_m"},
        {"[[obstacle]]\nname = \"a\"",
         "f:4:1: obstacle[\"a\"].polygon_m: expected either polygon_m = [[x, y], ...] or circle = { centre_m, radius_m "
         "}"},
        {"[[obstacle]]\npolygon_m = [[0, 0], [1, 1], [1, 0], [0, 1]]",
         "f:5:30: obstacle[1].polygon_m[3]: begins an edge that meets the edge from corner 1; expected a simple "
         "polygon"},
        {"[[obstacle]]\nlandmark = \"6\"\ncircle = { radius_m = 1 }\n[[obstacle]]\nlandmark = \"6\"\n"
         "circle = { radius_m = 2 }",
         "f:8:12: obstacle[2].landmark: \"6\" is another obstacle's too"},
        {"[[obstacle]]\nlandmark = 6\ncircle = { radius_m = 1 }",
         "f:5:12: obstacle[1].landmark: expected a text in quotes"},
        {"[[wall]]\npoints_m = [[0, 0], [1, 0]]\nthickness_m = 0.1\nlandmark = \"6\"",
         "f:7:12: wall[1].landmark: is not a known key; expected one of closed, colour, colour_class, name, points_m, "
         "side, surface, "
         "thickness_m"},
        {"[[goal]]\narea_m = [[0, 0], [1, 0], [0, 1]]", "f:4:1: goal[1].name: is missing"},
        {"[[goal]]\nname = \"a\"\narea_m = [[0, 0], [1, 0], [0, 1]]\n[[goal]]\nname = \"a\"\narea_m = [[0, 0], [1, 0], "
         "[0, 1]]",
         "f:8:8: goal[\"a\"].name: \"a\" is the name of another goal too"},
        {"[[marking]]\nwidth_m = 0.1",
         "f:4:1: marking[1].points_m: expected either points_m = [[x, y], ...] or circle = { centre_m, radius_m }"},
        {"[floor]\nsliding_friction = -1", "f:5:20: floor.sliding_friction: is -1.0; expected 0.0 to 10.0"},
        {"[floor]\ntraction = -1", "f:5:12: floor.traction: is -1.0; expected 0.0 to 10.0"},
        {"[floor]\nrolling_deceleration = 0.4",
         "f:5:24: floor.rolling_deceleration: is not a known key; did you mean rolling_deceleration_mps2?"},
        {"surface = { friction = 0.1, bounce = 1 }",
         "f:4:38: surface.bounce: is not a known key; expected one of friction, restitution"},
        {"surface = { restitution = 1.5 }", "f:4:27: surface.restitution: is 1.5; expected 0.0 to 1.0"},
        {"surface = 0.3", "f:4:11: surface: expected a table"},
        {"wall = 1", "f:4:8: wall: expected an array of tables"},
        {"[[walls]]", "f:4:1: walls: is not a known key; did you mean wall?"},
    };
    for (const auto& [body, message] : cases) EXPECT_EQ(environmentRefusal(body), message) << body;
}

}  // namespace
}  // namespace mrose

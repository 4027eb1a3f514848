#include "drawing/scene_drawing.h"

#include <cmath>
#include <numbers>
#include <regex>

#include <gtest/gtest.h>

#include "drawing/svg_drawing.h"
#include "support/markup.h"

namespace mrose {
namespace {

/// All numbers of the first attribute of that name behind `from`.
std::vector<double> numbersOf(const std::string& svg, const std::string& from, const std::string& attribute) {
    const auto begin = svg.find(attribute + "=\"", svg.find(from)) + attribute.size() + 2;
    const std::string value = svg.substr(begin, svg.find('"', begin) - begin);
    std::vector<double> numbers;
    const std::regex number("-?[0-9]+\\.?[0-9]*");
    for (std::sregex_iterator it(value.begin(), value.end(), number), end; it != end; ++it)
        numbers.push_back(std::stod(it->str()));
    return numbers;
}

Shape wedge() {
    ShapePart body{"body", {{-0.2, -0.1}, {0.3, -0.1}, {0.3, 0.1}, {-0.2, 0.1}}, {}, 0, {200, 30, 30}};
    ShapePart wheel{"wheel", {}, {0, 0.2}, 0.05, {10, 10, 10}};
    return Shape::fromParts("a <shape> & more", {body, wheel});
}

TEST(SceneDrawing, EveryPictureIsOneWellFormedSvgElement) {
    RobotType robot;
    robot.name = "r \"1\"";
    robot.shape = std::make_shared<const Shape>(wedge());
    robot.manipulators.push_back({"kicker", {0.3, 0}, 0.2});
    robot.perception.objects.fieldOfView = std::numbers::pi / 2;
    Environment environment{.name = "e", .obstacles = {{"o", wedge(), {}}}};
    environment.goals.push_back({"goal", {{0, 0}, {1, 0}, {0, 1}}});
    environment.markings.push_back({.points = {{0, 0}, {1, 1}}});
    environment.markings.push_back({.radius = 2});
    Scene scene;
    scene.environment = environment;
    scene.robotTypes.push_back(robot);
    scene.robots.push_back({"one", 0, 0, 0, {1, 2, 3}});
    for (const DrawingOptions options : {DrawingOptions{false}, DrawingOptions{true}})
        for (const std::string& svg :
             {drawShape(wedge(), options), drawRobot(robot, options), drawEnvironment(environment, options),
              drawScene(scene, "s", options), drawEnvironment({}), drawScene({}, "")}) {
            EXPECT_EQ(markupError(svg), "");
            EXPECT_EQ(svg.find("nan"), std::string::npos);
            EXPECT_TRUE(svg.starts_with("<svg xmlns=\"http://www.w3.org/2000/svg\""));
        }
    EXPECT_NE(drawShape(wedge()).find("a &lt;shape&gt; &amp; more"), std::string::npos);
}

TEST(SceneDrawing, ScaleIsTheSameAlongBothAxesAndAsTheBarSays) {
    SvgDrawing drawing;
    drawing.polygon(Polygon{{0, 0}, {4, 0}, {4, 1}, {0, 1}}, {.fill = Colour{1, 2, 3}});
    drawing.circle({1, 0.5}, 0.25, {.fill = Colour{4, 5, 6}});
    const std::string svg = drawing.text({.title = "t", .longestSide = 800});
    const auto corners = numbersOf(svg, "fill=\"#ffffff\"/>", "d");
    ASSERT_EQ(corners.size(), 8u);
    EXPECT_NEAR(corners[2] - corners[0], 800, 0.02) << "4 m are the longest side";
    EXPECT_NEAR(corners[3] - corners[5], 200, 0.02) << "1 m up is less on the page";
    EXPECT_NEAR(numbersOf(svg, "<circle", "cx")[0] - corners[0], 200, 0.02);
    EXPECT_NEAR(numbersOf(svg, "<circle", "r")[0], 50, 0.02);
    // The bar of 1 m, the largest round length up to a quarter of the page, is the last path.
    const auto bar = numbersOf(svg.substr(svg.rfind("<path")), "<path", "d");
    EXPECT_NEAR(bar[2] - bar[0], 200, 0.02);
    EXPECT_EQ(bar[3], bar[1]);
    EXPECT_NE(svg.find(">1 m</text>"), std::string::npos);
}

TEST(SceneDrawing, BodiesStandWhereTheyStartAndLookWhereTheyHead) {
    Scene scene;
    scene.environment.floor.area = {{-5, -5}, {5, -5}, {5, 5}, {-5, 5}};
    RobotType disc;
    disc.shape = std::make_shared<const Shape>(Shape::fromParts("d", {{"", {}, {}, 0.5, {1, 2, 3}}}));
    scene.robotTypes.push_back(disc);
    scene.robots.push_back({"one", 0, 0, 0, {2, 3, std::numbers::pi / 2}});
    const std::string svg = drawScene(scene, "s");
    // 10 m are 900 pixels from x = 28 on; y = 5 m is at 66.
    EXPECT_NEAR(numbersOf(svg, "<circle", "cx")[0], 28 + 7 * 90, 0.02);
    EXPECT_NEAR(numbersOf(svg, "<circle", "cy")[0], 66 + 2 * 90, 0.02);
    EXPECT_NEAR(numbersOf(svg, "<circle", "r")[0], 45, 0.02);
    const auto tip = numbersOf(svg.substr(svg.find("Z\" fill=\"#ffffff\"") - 80), "<path", "d");
    ASSERT_GE(tip.size(), 2u);
    EXPECT_NEAR(tip[0], 28 + 7 * 90, 0.02);
    EXPECT_NEAR(tip[1], 66 + 2 * 90 - 45, 0.02) << "half a metre up the page";
    EXPECT_NE(svg.find(">one</text>"), std::string::npos);
}

TEST(SceneDrawing, PiecesAreShownWhenAskedFor) {
    ShapePart comb{"comb", {{0, 0}, {3, 0}, {3, 2}, {2, 2}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}, {}, 0, {200, 200, 200}};
    const Shape shape = Shape::fromParts("u", {comb});
    EXPECT_GE(shape.pieces.size(), 3u);
    EXPECT_EQ(countOf(drawShape(shape, {.pieces = true}), "<path") - countOf(drawShape(shape), "<path"),
              shape.pieces.size());
}

TEST(SceneDrawing, ManyBodiesHaveNoNames) {
    Scene scene;
    RobotType disc;
    disc.shape = std::make_shared<const Shape>(Shape::fromParts("d", {{"", {}, {}, 0.1, {1, 2, 3}}}));
    scene.robotTypes.push_back(disc);
    for (int i = 0; i < 61; ++i) scene.robots.push_back({"called", 0, 0, 0, {0.3 * i, 0, 0}});
    EXPECT_EQ(countOf(drawScene(scene, "s"), "called"), 0u);
    scene.robots.pop_back();
    EXPECT_EQ(countOf(drawScene(scene, "s"), "fill=\"#222222\">called"), 60u);
}

}  // namespace
}  // namespace mrose

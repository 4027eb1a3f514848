#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "io/format.h"
#include "scenario/environment_file.h"
#include "scenario/shape_file.h"
#include "simulation/running_into.h"
#include "world/noise.h"

// Whatever a description's reader takes for a shape, contact can be with it.

namespace mrose {
namespace {

/// Random numbers of one polygon.
class Dice {
public:
    explicit Dice(std::int64_t which) : which_(which) {}
    double operator()(double least, double most) {
        return least + (most - least) * uniformNoise({29, which_, 0, next_++});
    }
    double power(double least, double most) { return std::pow(10, (*this)(least, most)); }
    std::size_t below(double end) { return static_cast<std::size_t>((*this)(0, end)); }

private:
    std::int64_t which_;
    std::uint32_t next_ = 0;
};

Polygon randomNeedle(Dice& dice, double far) {
    const double length = dice.power(-2, std::log10(far)), width = dice.power(-4, -1);
    Polygon polygon{{0, 0}, {length, 0}, {length * dice(0, 1), width}};
    if (dice.below(2) == 0) polygon.insert(polygon.begin() + 2, {length * dice(0.5, 1), width * dice(0, 1)});
    return polygon;
}

/// Two blocks that hang together by a waist; or, with it below zero, overlap.
Polygon hourglass(Dice& dice) {
    const double waist = dice.power(-5, -2), below = dice(-0.5, 0.5);
    return {{0.1, -0.5}, {waist / 2, 0}, {0.5, below}, {0, 0.5 + below}, {-0.5, below}, {-waist / 2, 0}, {-0.1, -0.5}};
}

/// Corners at any distance in order of their angles, of which some are close together.
Polygon star(Dice& dice, double far) {
    const std::size_t corners = 3 + dice.below(20);
    const double reach = std::min(0.5 * far, dice.power(-2.5, 3)), least = dice.power(-4, 0);
    std::vector<double> angles;
    for (std::size_t i = 0; i < corners; ++i) {
        const double angle = dice(0, 2 * std::numbers::pi);
        angles.push_back(i > 0 && dice.below(3) == 0 ? angles.back() + dice.power(-5, -1) : angle);
    }
    std::sort(angles.begin(), angles.end());
    Polygon polygon;
    for (const double angle : angles) {
        const double radius = reach * std::pow(least, dice(0, 1));
        polygon.push_back({radius * std::cos(angle), radius * std::sin(angle)});
    }
    return polygon;
}

/// Teeth on a back, thin and with little between them.
Polygon comb(Dice& dice) {
    const double tooth = dice.power(-3.5, -1), gap = dice.power(-3.5, -1), back = dice.power(-4, -1);
    Polygon polygon;
    double x = 0;
    for (int i = 0; i < 6; ++i) {
        polygon.insert(polygon.end(), {{x, back}, {x, 0.5}, {x + tooth, 0.5 + dice(0, 1e-4)}, {x + tooth, back}});
        x += tooth + gap;
    }
    polygon.insert(polygon.end(), {{x - gap, 0}, {0, 0}});
    return polygon;
}

/// Elsewhere and turned, within `far`.
Polygon nasty(std::int64_t which, double far) {
    Dice dice(which);
    const std::size_t kind = dice.below(4);
    Polygon polygon = kind == 0   ? randomNeedle(dice, far)
                      : kind == 1 ? hourglass(dice)
                      : kind == 2 ? star(dice, far)
                                  : comb(dice);
    const double away = dice.below(2) == 0 ? 0 : 0.5 * far;
    const Placement placement(Pose{dice(-away, away), dice(-away, away), dice(-3, 3)});
    for (Point& p : polygon) p = placement.place(p);
    return polygon;
}

std::string polygonText(const Polygon& polygon) {
    std::string text;
    for (const Point& p : polygon)
        text += (text.empty() ? "[" : ", [") + numberText(p.x) + ", " + numberText(p.y) + ']';
    return "polygon_m = [" + text + "]\n";
}

Expected<Environment> withObstacle(const Polygon& polygon) {
    return parseEnvironment(
        "format = \"mrose environment\"\nversion = 1\nname = \"e\"\n[[obstacle]]\n" + polygonText(polygon), "f");
}
Expected<Shape> shapeOf(const Polygon& polygon) {
    return parseShape("format = \"mrose shape\"\nversion = 1\nname = \"s\"\n[[part]]\n" + polygonText(polygon), "f");
}

TEST(AnyShape, ObstacleThatIsReadCanBeRunInto) {
    int taken = 0, refused = 0, welded = 0;
    for (std::int64_t which = 0; which < 3000; ++which) {
        SCOPED_TRACE(which);
        const auto environment = withObstacle(nasty(which, which % 8 == 0 ? 1000 : 30));
        (environment ? taken : refused) += 1;
        if (!environment) {
            welded += environment.error().message().find("millionth") != std::string::npos ? 1 : 0;
            continue;
        }
        const std::vector<ConvexPiece>& pieces = environment->obstacles[0].shape.pieces;
        ASSERT_FALSE(pieces.empty());
        const ConvexPiece& piece = pieces[static_cast<std::size_t>(which) % pieces.size()];
        ASSERT_TRUE(finite(afterRunningInto(SmallWorld(*environment), piece, 20)));
    }
    EXPECT_GT(taken, 700);
    EXPECT_GT(refused, 700);
    EXPECT_GT(welded, 20);
}

TEST(AnyShape, RobotOfAShapeThatIsReadCanDriveAndBeTouched) {
    int taken = 0;
    for (std::int64_t which = 0; which < 3000; ++which) {
        SCOPED_TRACE(which);
        const auto shape = shapeOf(nasty(which, 20));
        if (!shape) continue;
        ++taken;
        RobotType type = discRobot();
        type.shape = std::make_shared<const Shape>(*shape);
        SmallWorld world;
        world.robot(type, {}, std::make_shared<const Told>(Command{0.5, 1}), ideal());
        const ConvexPiece& piece = shape->pieces[static_cast<std::size_t>(which) % shape->pieces.size()];
        ASSERT_TRUE(finite(afterRunningInto(world, piece, 20)));
    }
    EXPECT_GT(taken, 700);
}

/// A waist of 0.2 mm, the corners of which are one to the contact solver.
TEST(AnyShape, PlaceTooThinForContactIsRefused) {
    const Polygon arrow{{0.1, -0.5}, {0.0001, 0}, {0.5, -0.3}, {0, 0.5}, {-0.5, -0.3}, {-0.0001, 0}, {-0.1, -0.5}};
    const auto refused = withObstacle(arrow);
    ASSERT_FALSE(refused);
    EXPECT_TRUE(refused.error().message().starts_with(
        "f:5:13: obstacle[1].polygon_m: is thinner than 0.0003 m, or than a millionth of its length, near ("))
        << refused.error().message();
    Polygon wider = arrow;
    wider[1].x = 0.0003;
    const auto taken = withObstacle(wider);
    ASSERT_TRUE(taken) << taken.error().message();
    EXPECT_TRUE(finite(afterRunningInto(SmallWorld(*taken), taken->obstacles[0].shape.pieces[0], 20)));
}

/// Its moment about the reference point would swallow its own.
TEST(AnyShape, SmallShapeFarFromItsReferencePointIsRefused) {
    const auto disc = [](const char* centre) {
        return parseShape(
            "format = \"mrose shape\"\nversion = 1\nname = \"s\"\n[[part]]\ncircle = { radius_m = 0.001, centre_m = " +
                std::string(centre) + " }\n",
            "f");
    };
    EXPECT_EQ(disc("[20, 0]").error().message(),
              "f:4:1: part: lies 20.000 m beside the reference point; expected at most 0.071 m, 100 times the radius "
              "of gyration");
    const auto near = disc("[0.07, 0]");
    ASSERT_TRUE(near) << near.error().message();
    RobotType type = discRobot();
    type.shape = std::make_shared<const Shape>(*near);
    SmallWorld world;
    world.robot(type, {}, std::make_shared<const Told>(Command{0.5, 1}), ideal());
    EXPECT_TRUE(finite(afterRunningInto(world, near->pieces[0], 20)));
}

TEST(AnyShape, WallsAreSolidOverAllTheirLength) {
    const auto wall = [](const std::string& end) {
        return parseEnvironment(
            "format = \"mrose environment\"\nversion = 1\nname = \"e\"\n[[wall]]\nthickness_m = 0.001\n"
            "points_m = [[-700, -700], " +
                end + "]\n",
            "f");
    };
    EXPECT_TRUE(wall("[-7, -7]"));
    const auto refused = wall("[700, 700]");
    ASSERT_FALSE(refused);
    EXPECT_TRUE(refused.error().message().starts_with(
        "f:6:13: wall[1].points_m[1]: begins a segment that is thinner than 0.0003 m, or than a millionth"))
        << refused.error().message();
}

}  // namespace
}  // namespace mrose

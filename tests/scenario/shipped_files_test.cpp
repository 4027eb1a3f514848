// The files that ship load, and mean what they say.
#include <algorithm>
#include <optional>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/file.h"
#include "scenario/description_file.h"
#include "scenario/descriptions.h"
#include "support/places.h"
#include "support/test_data.h"
#include "support/units.h"
#include "synthetic/reference_model.h"
#include "world/state_hash.h"

namespace mrose {
namespace {

DiskDescriptions disk(std::vector<std::filesystem::path> logs = {}) {
    return DiskDescriptions({sourceFolder(), std::move(logs), ""});
}

template <class T>
T loaded(const std::string& name) {
    DiskDescriptions source = disk();
    auto description = loadDescription(name, source);
    EXPECT_TRUE(description) << description.error().message();
    return description ? std::get<T>(std::move(*description)) : T{};
}

double areaOf(const ShapePart& part) {
    return part.polygon.empty() ? pi * part.radius * part.radius : std::abs(signedArea(part.polygon));
}

bool holdsWithin(const Shape& shape, const Point& point) {
    return std::any_of(shape.pieces.begin(), shape.pieces.end(),
                       [&](const ConvexPiece& piece) { return distance(ConvexPiece::circle(point, 1e-9), piece) < 0; });
}

/// All that stands in the way, as points of a fine grid.
std::vector<Point> solidPoints(const Environment& environment, double width, double height) {
    std::vector<Point> points;
    for (double x = -width / 2; x <= width / 2; x += 0.0173)
        for (double y = -height / 2; y <= height / 2; y += 0.0173)
            for (const Obstacle& obstacle : environment.obstacles)
                if (holdsWithin(obstacle.shape, {x, y})) points.push_back({x, y});
    return points;
}

TEST(ShippedFiles, EveryDescriptionLoads) {
    for (const char* folder : {"shapes", "resources/robots", "resources/environments"})
        for (const auto& entry : std::filesystem::directory_iterator(sourceFolder() / folder)) {
            if (entry.path().extension() != ".toml") continue;
            DiskDescriptions source = disk();
            const auto description = loadDescription(entry.path().string(), source);
            EXPECT_TRUE(description) << description.error().message();
        }
}

TEST(ShippedFiles, ShapesHaveTheSizesOfTheirRobots) {
    const std::pair<const char*, double> circles[] = {
        {"b21", 0.267}, {"nomad200", 0.225}, {"create", 0.170}, {"ball", 0.110}};
    for (const auto& [name, radius] : circles) {
        const auto shape = loaded<Shape>(std::string("shapes/") + name + ".toml");
        ASSERT_EQ(shape.parts.size(), 1u) << name;
        EXPECT_NEAR(areaOf(shape.parts[0]), pi * radius * radius, 1e-12) << name;
        EXPECT_EQ(shape.centroid, Point{}) << name;
        EXPECT_NEAR(shape.gyration, radius / std::sqrt(2), 1e-12) << name;
    }
    const auto box = loaded<Shape>("shapes/box.toml");
    EXPECT_NEAR(areaOf(box.parts.at(0)), 0.4 * 0.3, 1e-12);
    EXPECT_NEAR(box.gyration, std::sqrt((0.4 * 0.4 + 0.3 * 0.3) / 12), 1e-12);
    // A trapezium ahead (0.07 m), a rectangle (0.3 m), a trapezium behind (0.08 m).
    const auto pioneer = loaded<Shape>("shapes/pioneer1.toml");
    ASSERT_EQ(pioneer.parts.size(), 3u);
    EXPECT_NEAR(areaOf(pioneer.parts[0]), 0.07 * (0.28 + 0.38) / 2 + 0.3 * 0.38 + 0.08 * (0.38 + 0.24) / 2, 1e-12);
}

TEST(ShippedFiles, ShapesAreSymmetricAboutTheirHeading) {
    for (const char* name : {"pioneer1", "b21", "nomad200", "create", "husky", "ball", "box", "human"}) {
        const auto shape = loaded<Shape>(std::string("shapes/") + name + ".toml");
        EXPECT_NEAR(shape.centroid.y, 0, 1e-12) << name;
        for (double x = -0.6; x < 0.6; x += 0.0131)
            for (double y = 0.0011; y < 0.6; y += 0.0131)
                EXPECT_EQ(holdsWithin(shape, {x, y}), holdsWithin(shape, {x, -y})) << name << ' ' << x << ' ' << y;
    }
}

/// The horns lead a ball to the middle and do not hold it: between their tips there is room for it.
TEST(ShippedFiles, BallFitsBetweenThePioneersHorns) {
    const auto pioneer = loaded<Shape>("shapes/pioneer1.toml");
    const auto ball = loaded<Shape>("shapes/ball.toml");
    const auto clear = [&](const Point& centre) {
        return std::all_of(pioneer.pieces.begin(), pioneer.pieces.end(), [&](const ConvexPiece& piece) {
            return distance(ConvexPiece::circle(centre, ball.reach), piece) >= 0;
        });
    };
    EXPECT_TRUE(clear({0.170 + 0.110 + 1e-9, 0})) << "against the body's front";
    EXPECT_FALSE(clear({0.170 + 0.109, 0}));
    EXPECT_TRUE(clear({0.3, 0.05}));
    EXPECT_FALSE(clear({0.24, 0.15})) << "on a horn";
}

TEST(ShippedFiles, RobotsWeighAndDriveAsTheyShould) {
    const auto nomad = loaded<RobotDescription>("resources/robots/nomad200.toml");
    const auto kinematics = [](const RobotDescription& robot) {
        return dynamic_cast<const KinematicModel&>(*robot.model).parameters();
    };
    ASSERT_TRUE(nomad.model);
    EXPECT_EQ(kinematics(nomad).v.limit, 0.508);
    EXPECT_NEAR(kinematics(nomad).w.limit, pi / 4, 1e-12);
    const auto b21 = loaded<RobotDescription>("resources/robots/b21.toml");
    ASSERT_TRUE(b21.model);
    EXPECT_EQ(b21.type.mass, 122);
    EXPECT_NEAR(kinematics(b21).w.limit, 0.8, 1e-3);
    const auto synthetic = loaded<RobotDescription>("resources/robots/reference.toml");
    EXPECT_TRUE(dynamic_cast<const ReferenceModel*>(synthetic.model.get()));
    EXPECT_NE(synthetic.type.name.find("synthetic"), std::string::npos);
    EXPECT_NE(motionKind(synthetic).find("synthetic"), std::string::npos);
    EXPECT_EQ(synthetic.deadTime, 0.315);
    const auto pioneer = loaded<RobotDescription>("resources/robots/pioneer1.toml");
    EXPECT_EQ(synthetic.type.perception, pioneer.type.perception);
    const auto reality = loaded<RobotDescription>("resources/robots/reality.toml");
    EXPECT_TRUE(dynamic_cast<const ReferenceModel*>(reality.model.get()));
    EXPECT_NE(reality.type.name.find("synthetic"), std::string::npos);
    EXPECT_EQ(reality.type.perception.model, Perception::Model::reference);
    EXPECT_EQ(reality.type.shape->name, pioneer.type.shape->name);
    ASSERT_EQ(reality.type.manipulators.size(), 1u);
    EXPECT_EQ(reality.type.manipulators[0].position, pioneer.type.manipulators[0].position);
    EXPECT_EQ(reality.type.perception.objects.fieldOfView, pioneer.type.perception.objects.fieldOfView);
    ASSERT_TRUE(pioneer.motion);
    EXPECT_EQ(pioneer.type.mass, 7.5);
    EXPECT_TRUE(pioneer.motion->network().synthetic);
    ASSERT_EQ(pioneer.type.manipulators.size(), 1u);
    EXPECT_NEAR(toSeconds(pioneer.type.manipulators[0].deadTime), 0.3, 0.05) << "the paper's 300 ms, as identified";
    const auto create = loaded<RobotDescription>("resources/robots/create.toml");
    EXPECT_EQ(create.motion->network().robotType, "irobot-create");
    EXPECT_EQ(loaded<RobotDescription>("resources/robots/husky.toml").motion->network().robotType, "husky");
}

TEST(ShippedFiles, FieldIsSymmetricAndClosed) {
    const auto field = loaded<Environment>("resources/environments/midsize_2001.toml");
    // 9 x 5 m and two goals of 2 x 0.5 m, but for the corners, which panels cut off 0.2 m along each wall.
    EXPECT_NEAR(signedArea(field.floor.area), 9 * 5 + 2 * 2 * 0.5 - 4 * 0.2 * 0.2 / 2, 1e-9);
    EXPECT_FALSE(contains(field.floor.area, {4.45, 2.4})) << "a ball cannot lie in the corner";
    EXPECT_TRUE(contains(field.floor.area, {4.39, 2.29}));
    const std::vector<Point> solid = solidPoints(field, 10.2, 5.2);
    EXPECT_GT(solid.size(), 1000u);
    const auto solidAt = [&](const Point& p) {
        return std::any_of(field.obstacles.begin(), field.obstacles.end(),
                           [&](const Obstacle& obstacle) { return holdsWithin(obstacle.shape, p); });
    };
    for (const Point& p : solid) {
        EXPECT_TRUE(solidAt({-p.x, p.y}) && solidAt({p.x, -p.y})) << p.x << ' ' << p.y;
        EXPECT_FALSE(contains(field.floor.area, p)) << "walls stand outside of the floor";
    }
    // No ray from the middle leaves the field.
    for (double angle = 0; angle < 2 * pi; angle += 0.01) {
        bool met = false;
        for (double r = 0; r < 7 && !met; r += 0.01) met = solidAt({r * std::cos(angle), r * std::sin(angle)});
        EXPECT_TRUE(met) << angle;
    }
    ASSERT_EQ(field.goals.size(), 2u);
    for (const Goal& goal : field.goals) {
        EXPECT_NEAR(std::abs(areaMoments(goal.area).centroid.x), (4.61 + 5) / 2, 1e-9);
        EXPECT_NEAR(std::abs(signedArea(goal.area)), 2 * 0.39, 1e-9);
    }
}

/// How many of the data set's landmarks stand in the arena within `tolerance` metres; nullopt where it is not there.
std::optional<std::size_t> landmarksFound(const Environment& arena, const std::string& dataset, double tolerance) {
    const auto data = realData();
    const auto truth = data ? readFile(*data / "mrclam" / dataset / "Landmark_Groundtruth.dat")
                            : Expected<std::string>(fail("", "no real logs"));
    if (!truth) return std::nullopt;
    std::istringstream lines(*truth);
    std::size_t found = 0;
    for (std::string line; std::getline(lines, line);) {
        std::istringstream cells(line);
        int subject = 0;
        double x = 0, y = 0;
        if (!(cells >> subject >> x >> y)) continue;
        for (const Obstacle& obstacle : arena.obstacles)
            found += obstacle.name == "landmark " + std::to_string(subject) &&
                     distance(obstacle.shape.parts[0].centre, {x, y}) < tolerance;
    }
    return found;
}

TEST(ShippedFiles, ArenaHasTheLandmarksOfTheLogs) {
    const auto arena = loaded<Environment>("resources/environments/mrclam_arena.toml");
    EXPECT_EQ(arena.obstacles.size(), 15u);
    const auto six = landmarksFound(arena, "MRCLAM_Dataset6", 0.001),
               seven = landmarksFound(arena, "MRCLAM_Dataset7", 0.0015);
    if (!six && !seven) GTEST_SKIP() << "no real logs: set MROSE_DATA";
    EXPECT_EQ(six.value_or(15), 15u) << "rounded to millimetres";
    EXPECT_EQ(seven.value_or(15), 15u) << "measured anew";
}

TEST(ShippedFiles, SoccerIsFourAgainstFourWithABallInTheMiddle) {
    DiskDescriptions source = disk();
    const auto soccer = loadScenario("soccer.toml", source);
    ASSERT_TRUE(soccer) << soccer.error().message();
    EXPECT_EQ(soccer->value.name(), "mrose:resources/scenarios/soccer.toml") << "found where it ships";
    const Scene& scene = soccer->parts.scene;
    std::map<std::string, int> kinds;
    for (std::size_t i = 0; i < scene.robots.size(); ++i) ++kinds[scene.typeOf(i).name];
    EXPECT_EQ(kinds, (std::map<std::string, int>{{"Nomad 200", 4}, {"Pioneer 1", 4}}));
    EXPECT_EQ(scene.models.size(), 2u) << "one learned, one kinematic";
    ASSERT_EQ(scene.objects.size(), 1u);
    EXPECT_EQ(scene.objects[0].start, Pose{});
    EXPECT_EQ(scene.typeOfObject(0).mass, 0.43);
}

TEST(ShippedFiles, CorridorHasPeopleInIt) {
    const auto corridor = loaded<LoadedScenario>("resources/scenarios/b21_corridor.toml");
    const Scene& scene = corridor.parts.scene;
    int people = 0;
    for (std::size_t i = 0; i < scene.robots.size(); ++i) people += scene.typeOf(i).person;
    EXPECT_EQ(people, 3);
    EXPECT_EQ(scene.robots.size(), 4u);
}

/// A recording carries the value: what it gives is the same world, to the last bit, without any file.
TEST(ShippedFiles, ValueOfSoccerGivesSoccerWithoutADisk) {
    DiskDescriptions source = disk();
    const auto onDisk = loadScenario("soccer.toml", source);
    ASSERT_TRUE(onDisk) << onDisk.error().message();
    const auto again = loadScenario(ScenarioValue::parse(onDisk->value.bytes()).value());
    ASSERT_TRUE(again) << again.error().message();
    EXPECT_EQ(again->value, onDisk->value);
    EXPECT_EQ(hashOf(stateAfter(onDisk->parts, 250)), hashOf(stateAfter(again->parts, 250)));
}

TEST(ShippedFiles, ReplayWithoutItsLogSaysWhatToDo) {
    DiskDescriptions source = disk();
    const auto replay = loadScenario("mrclam_replay.toml", source);
    ASSERT_FALSE(replay);
    EXPECT_THAT(replay.error().message(),
                testing::ContainsRegex(
                    "mrclam_replay.toml:[0-9]+:43: robot\\[\"create 1\"\\].controller.log: \"MRCLAM_Dataset6\" was "
                    "not found; expected a log of that name beside this file"));
}

}  // namespace
}  // namespace mrose

#include "sensing/line_camera.h"

#include <map>

#include <gtest/gtest.h>

#include "geometry/normal_distribution.h"
#include "sensing/colour_rows.h"
#include "support/shipped.h"

namespace mrose {
namespace {

using std::numbers::pi;
using Spacing = BeamFan::Spacing;

TEST(LineCamera, PixelsAreEquallySpacedInTheImageOrInAngle) {
    for (const Spacing spacing : {Spacing::tangents, Spacing::angles}) {
        LineCamera::Options options = rowOf(97, 1.9, 10, spacing);
        options.mount.heading = 2.5;
        const ColourRow look = rowSeen(options);
        ASSERT_EQ(look.pixels.size(), 97u);
        for (std::size_t i = 0; i < 97; ++i) {
            EXPECT_NEAR(look.pixels[i].bearing, wrapAngle(2.5 + angleOf(options, i)), 1e-14) << i;
            EXPECT_EQ(look.pixels[i].colourClass, ColourClass::nothing);
        }
    }
}

/// Its tangents are seen at the sine of radius over distance, to either side of its middle.
TEST(LineCamera, ABallIsAsWideAsItsTangentsSay) {
    for (const double away : {0.3, 1.0, 2.7, 5.0})
        for (const double aside : {0.0, 0.2, -0.35}) {
            const LineCamera::Options options = rowOf(320, 1.6);
            const Point ball = away * towards(aside);
            const ColourRow look =
                rowSeen(sensing(lineCamera(options)).object(ballType(), {ball.x, ball.y, 0}).scenario());
            const double half = std::asin(0.11 / away);
            std::size_t pixels = 0;
            for (std::size_t i = 0; i < options.width; ++i)
                if (std::abs(angleOf(options, i) - aside) < half) ++pixels;
            const ColourBlob blob = look.blob(ColourClass::ball);
            EXPECT_EQ(blob.pixels, pixels) << away << ' ' << aside;
            EXPECT_EQ(look.count(ColourClass::ball), pixels);
            // Edges fall between pixels: each is off by half a pixel at most, which are narrowest in angle outward.
            const double pixel = 2 * std::tan(0.8) / 320;
            EXPECT_NEAR(blob.bearing, aside, 0.5 * pixel);
            EXPECT_NEAR(blob.width, 2 * half, pixel);
        }
}

/// Goals are 2 m wide on lines 4.5 m from the field's middle. Ends of the walls, 50 mm thick, are their posts.
TEST(LineCamera, AGoalIsSeenFromPostToPost) {
    for (const Pose& start : {Pose{0, 0, 0}, Pose{1.3, -0.8, 0.4}, Pose{-2, 1.9, -0.3}, Pose{0.4, 0.2, pi}}) {
        const LineCamera::Options options = rowOf(640, 1.4);
        const Scenario scenario = sensing(lineCamera(options), shippedEnvironment("midsize_2001"), start).scenario();
        const ColourRow look = rowSeen(scenario);
        const bool east = std::cos(start.heading) > 0;
        const ColourClass goal = east ? ColourClass::blueGoal : ColourClass::yellowGoal;
        const double line = east ? 4.5 : -4.5, behind = east ? 4.55 : -4.55;
        for (std::size_t i = 0; i < options.width; ++i) {
            const double direction = start.heading + angleOf(options, i);
            const auto yAt = [&](double x) { return start.y + (x - start.x) * std::tan(direction); };
            const bool between = std::abs(yAt(line)) < 1 && std::abs(yAt(behind)) < 1;
            const ColourClass expected = between ? goal : ColourClass::wall;
            EXPECT_EQ(look.pixels[i].colourClass, expected) << start.heading << ' ' << i;
        }
        EXPECT_GT(look.blob(goal).pixels, 50u);
    }
}

Environment striped() {
    Environment environment;
    Marking line, ring;
    line.points = {{0, -3}, {2, -3}, {2, 3}, {0, 3}};
    line.closed = true;
    line.width = 0.1;
    ring.centre = {0, 0};
    ring.radius = 1;
    ring.width = 0.06;
    environment.markings = {line, ring};
    return environment;
}

/// A pinhole's row meets the floor on a line across: here along the marking, or across the ring.
TEST(LineCamera, APinholesRowMeetsTheFloorOnALineAcross) {
    LineCamera::Options options = rowOf(200, 1.5);
    options.floor = 2.04;
    ColourRow look = rowSeen(options, striped());
    EXPECT_EQ(look.count(ColourClass::marking), 200u);
    options.floor = 2.06;
    look = rowSeen(options, striped());
    EXPECT_EQ(look.count(ColourClass::floor), 200u);
    options.floor = 0.8;
    look = rowSeen(options, striped());
    for (std::size_t i = 0; i < options.width; ++i) {
        const double away = std::hypot(0.8, 0.8 * middleOf(options, i));
        EXPECT_EQ(look.pixels[i].colourClass, std::abs(away - 1) < 0.03 ? ColourClass::marking : ColourClass::floor)
            << i;
    }
    EXPECT_GT(look.count(ColourClass::marking), 3u);
    // As far as the range allows.
    options.range = 0.9;
    look = rowSeen(options, striped());
    for (std::size_t i = 0; i < options.width; ++i)
        EXPECT_EQ(look.pixels[i].colourClass == ColourClass::nothing, 0.8 * std::hypot(1, middleOf(options, i)) > 0.9)
            << i;
}

TEST(LineCamera, AnEquiangularRowMeetsTheFloorOnACircle) {
    LineCamera::Options options = rowOf(360, 2 * pi, 12, Spacing::angles);
    options.floor = 1.02;
    EXPECT_EQ(rowSeen(options, striped()).count(ColourClass::marking), 360u);
    options.floor = 2.5;
    const ColourRow look = rowSeen(options, striped());
    for (const ColourPixel& pixel : look.pixels) {
        const Point at = 2.5 * Point{std::cos(pixel.bearing), std::sin(pixel.bearing)};
        // Of the rectangle the circle meets the two lines with x = 0 and 2; corners and the others are farther.
        const bool marked = std::abs(at.y) < 3 && (std::abs(at.x) < 0.05 || std::abs(at.x - 2) < 0.05);
        EXPECT_EQ(pixel.colourClass, marked ? ColourClass::marking : ColourClass::floor) << pixel.bearing;
    }
    EXPECT_EQ(std::ranges::count_if(look.blobs, [](auto& blob) { return blob.colourClass == ColourClass::marking; }),
              4);
}

TEST(LineCamera, PixelsAreWhatSolvingForEachRaySays) {
    std::map<ColourClass, int> met;
    for (std::uint32_t seed = 1; seed <= 60; ++seed) {
        const bool pinhole = seed % 2 == 0;
        const double view = pinhole ? 0.2 + 2.6 * uniformNoise({seed, 1, 0, 0})
                                    : std::min(2 * pi, 0.5 + 7 * uniformNoise({seed, 1, 0, 0}));
        LineCamera::Options options = rowOf(1 + seed * 7, view, 5, pinhole ? Spacing::tangents : Spacing::angles);
        options.mount = {0.1, -0.05, 0.3 * seed};
        if (seed % 4 >= 2) options.floor = 0.3 + 2 * uniformNoise({seed, 1, 0, 1});
        const Scenario scenario = colouredScene(lineCamera(options), seed);
        const WorldState state = scenario.initialState();
        const ColourRow look = rowSeen(scenario);
        ASSERT_EQ(look.pixels.size(), options.width);
        for (std::size_t i = 0; i < options.width; ++i) {
            const ColourClass expected = solvedClass(scenario, state, options, i);
            ASSERT_EQ(look.pixels[i].colourClass, expected) << seed << ' ' << i;
            ++met[expected];
        }
    }
    EXPECT_EQ(met.size(), colourClassWords.size() - 1) << "all but obstacles";
    for (const auto& [its, count] : met) EXPECT_GT(count, 40) << static_cast<int>(its);
}

TEST(LineCamera, WhatIsNearerHidesWhatIsBehind) {
    LineCamera::Options options = rowOf(101, 0.6);
    options.floor = 3;
    SmallWorld world = sensing(lineCamera(options), wallAhead(4));
    world.object(ballType(), {2, 0, 0}).object(ballType(), {3.5, 0.3, 0});
    // The second lies behind where the row meets the floor, and the wall does.
    ColourRow look = rowSeen(world.scenario());
    EXPECT_EQ(look.blob(ColourClass::ball).pixels + look.count(ColourClass::floor), 101u);
    world.robot(discRobot(0.3), {1, 0, 0}, still(), ideal());
    look = rowSeen(world.scenario());
    EXPECT_EQ(look.count(ColourClass::ball), 0u);
    EXPECT_EQ(look.pixels[50].colourClass, ColourClass::robot);
}

TEST(LineCamera, BlobsAreTheRunsOfTheRow) {
    std::size_t blobs = 0;
    for (std::uint32_t seed = 1; seed <= 20; ++seed) {
        LineCamera::Options options = rowOf(90, seed % 2 == 0 ? 1.8 : 2 * pi, 5, Spacing::angles);
        options.misclassification = 0.2;  // many short ones
        options.leastBlob = seed % 3 + 1;
        options.blobClasses = {ColourClass::robot, ColourClass::ball, ColourClass::teamMate, ColourClass::wall};
        const ColourRow look = rowSeen(colouredScene(lineCamera(options), seed));
        const auto wanted = [&](ColourClass its) {
            return std::ranges::find(options.blobClasses, its) != options.blobClasses.end();
        };
        const double pixel = options.view / 90;
        std::size_t inBlobs = 0, inRuns = 0;
        for (const ColourBlob& blob : look.blobs) {
            EXPECT_TRUE(wanted(blob.colourClass));
            EXPECT_GE(blob.pixels, options.leastBlob);
            EXPECT_NEAR(blob.width, pixel * blob.pixels, 1e-12);
            // All pixels within it are of its class, and those beside it are not.
            for (const ColourPixel& p : look.pixels) {
                const double off = std::abs(wrapAngle(p.bearing - blob.bearing)) - blob.width / 2;
                if (off < pixel) {
                    EXPECT_EQ(p.colourClass == blob.colourClass, off < 0);
                }
            }
            inBlobs += blob.pixels;
        }
        // Runs counted pixel by pixel, by their lengths to either side.
        const bool circle = options.view > 6;
        const auto sameBeside = [&](std::size_t from, std::size_t step) {
            std::size_t same = 0;
            for (std::size_t at = from; same < 90; ++same) {
                const std::size_t next = (at + step) % 90;
                if (!circle && (next > at) != (step == 1)) break;
                if (look.pixels[next].colourClass != look.pixels[from].colourClass) break;
                at = next;
            }
            return same;
        };
        for (std::size_t i = 0; i < 90; ++i)
            if (wanted(look.pixels[i].colourClass) && 1 + sameBeside(i, 1) + sameBeside(i, 89) >= options.leastBlob)
                ++inRuns;
        EXPECT_EQ(inBlobs, inRuns) << seed;
        blobs += look.blobs.size();
    }
    EXPECT_GT(blobs, 100u);
}

TEST(LineCamera, ARowAllRoundHasNoEnds) {
    LineCamera::Options options = rowOf(60, 2 * pi, 12, Spacing::angles);
    ColourRow look = rowSeen(sensing(lineCamera(options)).object(ballType(), {-0.5, 0.01, 0}).scenario());
    ASSERT_EQ(look.blobs.size(), 1u);
    EXPECT_NEAR(std::abs(look.blobs[0].bearing), pi, 0.06);
    EXPECT_EQ(look.blobs[0].pixels, look.count(ColourClass::ball));
    EXPECT_GE(look.blobs[0].pixels, 4u);
    options.floor = 1;
    look = rowSeen(options);
    ASSERT_EQ(look.blobs.size(), 1u);
    EXPECT_EQ(look.blobs[0].pixels, 60u);
    EXPECT_NEAR(look.blobs[0].width, 2 * pi, 1e-12);
}

/// A pixel has another class as often as it should, and each other one as often.
TEST(LineCamera, MisclassifiedPixelsHaveAnyOtherClass) {
    LineCamera::Options options = rowOf(100, 1);
    options.misclassification = 0.12;
    const Scenario scenario = sensing(lineCamera(options), wallAhead(2)).scenario();
    SensorWatch watch(scenario, 4);
    std::map<ColourClass, int> classes;
    int wrong = 0, pairs = 0;
    constexpr int looks = 2000;
    for (int k = 0; k < looks; ++k) {
        bool before = false;
        for (const ColourPixel& pixel : watch.next().records<ColourPixel>("row")) {
            const bool errs = pixel.colourClass != ColourClass::obstacle;
            wrong += errs;
            pairs += errs && before;
            before = errs;
            ++classes[pixel.colourClass];
        }
    }
    expectRate(wrong, looks * 100, 0.12);
    expectRate(pairs, looks * 99, 0.12 * 0.12);
    EXPECT_EQ(classes.size(), colourClassWords.size());
    for (const auto& [its, count] : classes)
        if (its != ColourClass::obstacle) {
            expectRate(count, wrong, 1.0 / 12);
        }
}

/// A wall's edge anywhere in the image: how often a pixel shows the wall is the share of its rays that meet it.
TEST(LineCamera, EdgesAreBlurredByTheNoiseOfPixelsRays) {
    const auto compare = [](LineCamera::Options options, double edge, double noise) {
        options.edgeNoise = noise;
        const double pixel = middleOf(options, 1) - middleOf(options, 0);
        // The wall begins at the edge's direction and lies to the left of it.
        const double direction = options.spacing == Spacing::tangents ? std::atan(edge) : edge;
        options.mount.heading = 0.4 - direction;
        const Point corner = 2 * towards(0.4), end = 2 * towards(0.4 + 1.5);
        ShapePart part;
        part.polygon = {corner, 1.2 * corner, 1.2 * end, end};
        Environment environment;
        environment.obstacles.push_back({"wall", Shape::fromParts("wall", {part}), {}});
        const Scenario scenario = sensing(lineCamera(options), environment).scenario();
        SensorWatch watch(scenario, 4);
        std::vector<int> walls(options.width);
        constexpr int looks = 4000;
        for (int k = 0; k < looks; ++k) {
            const auto pixels = watch.next().records<ColourPixel>("row");
            for (std::size_t i = 0; i < options.width; ++i) walls[i] += pixels[i].colourClass == ColourClass::obstacle;
        }
        int between = 0;
        for (std::size_t i = 0; i < options.width; ++i) {
            double beside = (middleOf(options, i) - edge) / pixel;
            if (options.spacing == Spacing::angles) beside = wrapAngle(middleOf(options, i) - edge) / pixel;
            const double expected = normalProbability(beside / noise);
            if (std::abs(beside) > 5 * noise + 2) continue;
            EXPECT_NEAR(walls[i] / static_cast<double>(looks), expected,
                        sigmas * std::sqrt(expected * (1 - expected) / looks) + 1e-4)
                << edge << ' ' << i;
            between += expected > 0.01 && expected < 0.99;
        }
        EXPECT_GE(between, 1);
    };
    compare(rowOf(120, 1.6), 0.2, 0.5);
    compare(rowOf(120, 1.6), -0.7013, 1.3);
    compare(rowOf(120, 2 * pi, 12, Spacing::angles), 0.71, 1.1);
    compare(rowOf(120, 2 * pi, 12, Spacing::angles), -pi + 0.03, 1.7);
    compare(rowOf(120, 2 * pi, 12, Spacing::angles), pi - 0.03, 0.6);
}

/// Whatever the noise, of few pixels and of very wide ones too.
TEST(LineCamera, TurnedRaysMeetWhatTheySee) {
    for (const std::size_t width : {1, 2, 3, 11})
        for (const auto& [view, spacing] : {std::pair(170 * pi / 180, Spacing::tangents),
                                            std::pair(2 * pi, Spacing::angles), std::pair(0.1, Spacing::angles)}) {
            LineCamera::Options options = rowOf(width, view, 50, spacing);
            options.edgeNoise = 10;
            const Scenario scenario = sensing(lineCamera(options), walledField(8, 8), {4, 4, 0.3}).scenario();
            SensorWatch watch(scenario, 4);
            for (int k = 0; k < 100; ++k)
                for (const ColourPixel& pixel : watch.next().records<ColourPixel>("row"))
                    ASSERT_EQ(pixel.colourClass, ColourClass::obstacle) << "walls are all round";
        }
}

/// A late camera beside one that is not late says the same of the same instant.
TEST(LineCamera, LateLooksAreThoseOfTheirInstant) {
    constexpr Nanoseconds ms = 1'000'000;
    LineCamera::Options options = rowOf(80, 1.5);
    options.floor = 0.7;
    RobotType type = discRobot(0.2);
    type.sensors = {lineCamera(options, 50 * ms)};
    options.latency = 70 * ms;
    type.sensors.push_back(std::make_shared<const LineCamera>(SensorTraits{"late", 50 * ms}, options));
    Environment field = walledField(6, 6);
    field.markings = striped().markings;
    const Scenario scenario =
        SmallWorld(field)
            .robot(type, {1, 3, 0}, std::make_shared<const Told>(Command{0.3, 0.5}), ideal())
            .robot(discRobot(0.2), {4, 3, 1}, std::make_shared<const Told>(Command{-0.2, 0}), ideal())
            .object(ballType(), {2, 3, 0}, {0.5, 0.2, 0})
            .scenario();
    WorldState state = scenario.initialState();
    StepBuffers buffers;
    StepTrace trace;
    std::map<Nanoseconds, std::vector<ColourPixel>> looks;
    int late = 0;
    for (int k = 0; k < 200; ++k) {
        step(scenario, state, buffers, {}, &trace);
        if (!trace.robots[0].observed) continue;
        const Observation& observation = trace.robots[0].observation;
        for (const Reading& reading : observation.readings()) {
            const auto pixels = observation.records<ColourPixel>(&reading);
            if (reading.name == ReadingName("row")) looks[reading.measured] = {pixels.begin(), pixels.end()};
            if (reading.name != ReadingName("late") || reading.measured < 0) continue;
            EXPECT_GE(observation.time - reading.measured, 70 * ms);
            ASSERT_TRUE(looks.contains(reading.measured)) << reading.measured;
            EXPECT_EQ(looks[reading.measured], std::vector<ColourPixel>(pixels.begin(), pixels.end()));
            ++late;
        }
    }
    EXPECT_GT(late, 70);
}

TEST(LineCamera, RepeatsItsReadingsFromEveryTick) {
    constexpr Nanoseconds ms = 1'000'000;
    LineCamera::Options options = rowOf(70, 2);
    options.edgeNoise = 0.7;
    options.misclassification = 0.05;
    options.floor = 1.5;
    options.latency = 50 * ms;
    expectSameFromEveryTick(colouredScene(lineCamera(options, 30 * ms), 5), 60);
}

TEST(LineCamera, SummaryHasTheLargestBlobOfEachClass) {
    LineCamera::Options options = rowOf(200, 1.5);
    options.blobClasses = {ColourClass::ball, ColourClass::blueGoal};
    const auto sensor = lineCamera(options);
    const Scenario scenario =
        sensing(sensor, wallAhead(4)).object(ballType(), {2, 0.5, 0}).object(ballType(), {1, -0.5, 0}).scenario();
    WorldState state = scenario.initialState();
    Observation out;
    perceive(scenario, state, 0, out);
    std::map<std::string, double> entries;
    for (const MemoryEntry& entry : sensor->summary(out, *out.find("row"))) entries[entry.name] = entry.value;
    ASSERT_EQ(entries.size(), 4u);
    EXPECT_NEAR(entries.at("ball_bearing"), std::atan2(-0.5, 1), 0.01);
    const auto blobs = out.records<ColourBlob>("row.blobs");
    ASSERT_EQ(blobs.size(), 2u);
    EXPECT_EQ(entries.at("ball_pixels"), blobs[0].pixels) << "the nearer one, on the right";
    EXPECT_GT(blobs[0].pixels, blobs[1].pixels);
    EXPECT_EQ(entries.at("blue_goal_pixels"), 0);
    EXPECT_EQ(entries.at("blue_goal_bearing"), 0);
    EXPECT_EQ(sensor->summary({}, {}).size(), entries.size()) << "the same entries without any reading";
}

TEST(LineCamera, ItsElementsAreItsPixelsRays) {
    LineCamera::Options options = rowOf(5, 1.2, 3);
    options.mount = {0.1, 0.05, 0.2};
    options.floor = 2;
    const auto elements = lineCamera(options)->elements();
    ASSERT_EQ(elements.size(), 5u);
    for (std::size_t i = 0; i < 5; ++i) {
        EXPECT_EQ(elements[i].mount.x, 0.1);
        EXPECT_NEAR(elements[i].mount.heading, 0.2 + angleOf(options, i), 1e-12);
        EXPECT_NEAR(elements[i].range, 2 / std::cos(angleOf(options, i)), 1e-12);
    }
}

/// What the goalkeeper of the shipped game sees of it: goals, markings, ball and robots of the real field.
TEST(LineCamera, SeesTheShippedGame) {
    ScenarioParts parts = shippedScenario("soccer").parts();
    LineCamera::Options options = rowOf(360, 2 * pi, 11, Spacing::angles);
    LineCamera::Options down = options;
    down.floor = 1.5;
    Scene& scene = parts.scene;
    scene.robotTypes.push_back(scene.typeOf(0));
    scene.robotTypes.back().sensors = {lineCamera(options),
                                       std::make_shared<const LineCamera>(SensorTraits{"down"}, down)};
    scene.robots[0].type = static_cast<std::uint32_t>(scene.robotTypes.size() - 1);
    for (std::size_t i = 0; i < scene.robots.size(); ++i) scene.robots[i].team = i < 4 ? "red" : "blue";
    const Scenario scenario(std::move(parts));
    WorldState state = scenario.initialState();
    StepBuffers buffers;
    std::map<ColourClass, int> met;
    for (int second = 0; second < 20; ++second) {
        for (int k = 0; k < 50; ++k) step(scenario, state, buffers);
        Observation out;
        perceive(scenario, state, 0, out);
        for (const auto& [name, row] : {std::pair("row", options), std::pair("down", down)}) {
            const auto pixels = out.records<ColourPixel>(out.newest(name));
            ASSERT_EQ(pixels.size(), 360u);
            for (std::size_t i = 0; i < 360; ++i) {
                ASSERT_EQ(pixels[i].colourClass, solvedClass(scenario, state, row, i))
                    << name << ' ' << second << ' ' << i;
                ++met[pixels[i].colourClass];
            }
        }
    }
    for (const ColourClass its :
         {ColourClass::floor, ColourClass::marking, ColourClass::wall, ColourClass::yellowGoal, ColourClass::blueGoal,
          ColourClass::ball, ColourClass::teamMate, ColourClass::opponent})
        EXPECT_GT(met[its], 5) << static_cast<int>(its);
    EXPECT_EQ(met[ColourClass::robot], 0);
}

}  // namespace
}  // namespace mrose

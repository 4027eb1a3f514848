#include <gtest/gtest.h>

#include "sensing/infrared_ring.h"
#include "sensing/ranging.h"
#include "sensing/sonar_ring.h"

namespace mrose {
namespace {

using std::numbers::pi;
constexpr double silence = std::numeric_limits<double>::infinity();

SonarRing::Options sonarAt(const std::vector<Pose>& sonars, double cone, double reflection, double range = 5) {
    SonarRing::Options options;
    options.sonars = sonars;
    options.cone = cone;
    options.reflection = reflection;
    options.errors.range = range;
    return options;
}

std::shared_ptr<const SonarRing> sonar(const SonarRing::Options& options) {
    return std::make_shared<const SonarRing>(SensorTraits{"sonar"}, options);
}

double heard(const SonarRing::Options& options, Environment environment) {
    const Scenario scenario = sensing(sonar(options), std::move(environment)).scenario();
    WorldState state = scenario.initialState();
    return recordsNow<RangeEcho>(scenario, state, "sonar").at(0).range;
}

TEST(SonarRing, AWallAnswersWhereItsNormalIsInTheCone) {
    // Facing the wall, turned so that the foot of the perpendicular is just within the cone, and just out of it.
    EXPECT_NEAR(heard(sonarAt({{0.1, 0, 0}}, 0.5, 0.2), wallAhead(2)), 1.9, 1e-12);
    EXPECT_NEAR(heard(sonarAt({{0.1, 0, 0.24}}, 0.5, 0.2), wallAhead(2)), 1.9, 1e-12);
    // Beyond that the nearest point is at the cone's edge, as far as the surface reflects there.
    EXPECT_NEAR(heard(sonarAt({{0.1, 0, 0.4}}, 0.5, 0.2), wallAhead(2)), 1.9 / std::cos(0.15), 1e-9);
    EXPECT_EQ(heard(sonarAt({{0.1, 0, 0.46}}, 0.5, 0.2), wallAhead(2)), silence);
    EXPECT_EQ(heard(sonarAt({{0.1, 0, pi}}, 0.5, 0.2), wallAhead(2)), silence);
}

TEST(SonarRing, ACircleAnswersWhereItIsMetSteeplyEnough) {
    const auto post = [](const Point& centre, double radius) {
        ShapePart part;
        part.centre = centre;
        part.radius = radius;
        Environment environment;
        environment.obstacles.push_back({"post", Shape::fromParts("post", {part}), {}});
        return environment;
    };
    EXPECT_NEAR(heard(sonarAt({{}}, 0.5, 0.3), post({2, 0.3}, 0.4)), std::hypot(2, 0.3) - 0.4, 1e-12);
    // Its centre is beside the cone: the cone's edge meets it at an angle whose sine is aside / radius.
    const double bearing = 0.35, away = 2, radius = 0.4, aside = away * std::sin(bearing - 0.25);
    const Environment beside = post({away * std::cos(bearing), away * std::sin(bearing)}, radius);
    const double steepness = std::asin(aside / radius);
    const double range = away * std::cos(bearing - 0.25) - std::sqrt(radius * radius - aside * aside);
    EXPECT_NEAR(heard(sonarAt({{}}, 0.5, steepness + 1e-6), beside), range, 1e-9);
    EXPECT_EQ(heard(sonarAt({{}}, 0.5, steepness - 1e-6), beside), silence);
}

/// What a slanted board hides is not heard, though the board itself sends nothing back.
TEST(SonarRing, HearsNothingThroughWhatDoesNotReflect) {
    Environment environment = wallAhead(3);
    ShapePart board;
    board.polygon = {{1, -0.5}, {1.1, -0.5}, {2.6, 0.5}, {2.5, 0.5}};
    environment.obstacles.push_back({"board", Shape::fromParts("board", {board}), {}});
    EXPECT_EQ(heard(sonarAt({{}}, 0.3, 0.4), environment), silence);
    // The wall is heard past the board's far end, and where that is out of the cone past its near one.
    EXPECT_NEAR(heard(sonarAt({{}}, 1.4, 0.4), environment), 3 / std::cos(std::atan2(0.5, 2.5)), 1e-6);
    EXPECT_NEAR(heard(sonarAt({{0, 0, -0.3}}, 0.9, 0.5), environment), 3 / std::cos(std::atan2(0.5, 1)), 1e-6);
}

/// The nearest of very many rays that meet a surface within the angle, in random scenes.
TEST(SonarRing, EchoesAreThoseOfManyRays) {
    int echoes = 0, silent = 0;
    for (std::uint32_t seed = 1; seed <= 60; ++seed) {
        const double cone = 0.1 + uniformNoise({seed, 1, 0, 0}), reflection = 0.1 + 0.5 * uniformNoise({seed, 1, 0, 1});
        const auto options = sonarAt({{0.2, 0.1, 0.4}, {-0.1, 0.2, 2}, {0, 0, -2.5}}, cone, reflection, 4);
        const Scenario scenario = randomScene(sonar(options), seed, 10, 6);
        WorldState state = scenario.initialState();
        const auto heardNow = recordsNow<RangeEcho>(scenario, state, "sonar");
        ASSERT_EQ(heardNow.size(), options.sonars.size());
        for (std::size_t i = 0; i < options.sonars.size(); ++i) {
            const Pose eye = state.robots[0].pose * options.sonars[i];
            double nearest = silence;
            constexpr int rays = 10'000;
            for (int ray = 0; ray <= rays; ++ray) {
                const Point along = towards(eye.heading + cone * (static_cast<double>(ray) / rays - 0.5));
                const RayHit hit = solvedRay(scenario, state, 0, position(eye), along);
                if (hit.incidence >= std::cos(reflection)) nearest = std::min(nearest, hit.range);
            }
            if (nearest > 4) nearest = silence;
            if (std::isinf(nearest)) {
                EXPECT_EQ(heardNow[i].range, silence) << seed << ' ' << i;
                ++silent;
                continue;
            }
            ++echoes;
            EXPECT_LE(heardNow[i].range, nearest + 1e-6) << seed << ' ' << i;
            EXPECT_GE(heardNow[i].range, nearest - 1e-3) << seed << ' ' << i;
        }
    }
    EXPECT_GT(echoes, 60);
    EXPECT_GT(silent, 30);
}

TEST(SonarRing, CrossTalkIsTheEchoOfANeighbour) {
    auto options = sonarAt({{0, 0, 0}, {0, 0, pi / 2}, {0, 0, pi}, {0, 0, -pi / 2}}, 0.5, 0.2);
    const auto rateOf = [&](double probability) {
        options.crossTalk = probability;
        const Scenario scenario = sensing(sonar(options), wallAhead(2)).scenario();
        SensorWatch watch(scenario, 5);
        int wrong = 0, count = 0;
        for (int i = 0; i < 1000; ++i) {
            const auto echoes = watch.next().records<RangeEcho>("sonar");
            EXPECT_NEAR(echoes[0].range, 2, 1e-12);
            EXPECT_EQ(echoes[2].range, silence) << "it is beside none that hears anything";
            for (const std::size_t beside : {1, 3}) {
                ++count;
                if (std::isinf(echoes[beside].range)) continue;
                EXPECT_NEAR(echoes[beside].range, 2, 1e-12);
                ++wrong;
            }
        }
        expectRate(wrong, count, probability);
        return wrong;
    };
    EXPECT_EQ(rateOf(0), 0);
    EXPECT_GT(rateOf(0.2), 0);
}

TEST(SonarRing, SummaryHasEachElement) {
    const auto sensor = sonar(sonarAt({{0, 0, 0}, {0, 0, 2}}, 0.5, 0.2));
    const Scenario scenario = sensing(sensor, wallAhead(2)).scenario();
    WorldState state = scenario.initialState();
    Observation out;
    perceive(scenario, state, 0, out);
    std::map<std::string, double> entries;
    for (const MemoryEntry& entry : sensor->summary(out, *out.find("sonar"))) entries[entry.name] = entry.value;
    EXPECT_NEAR(entries.at("nearest"), 2, 1e-12);
    EXPECT_NEAR(entries.at("range_1"), 2, 1e-12);
    EXPECT_EQ(entries.at("range_2"), silence);
    EXPECT_EQ(entries.at("echoes"), 1);
    EXPECT_EQ(sensor->summary({}, {}).size(), entries.size()) << "the same entries without any reading";
}

InfraredRing::Options infraredAt(const std::vector<Pose>& elements) {
    InfraredRing::Options options;
    options.elements = elements;
    options.beam = 1e-3;
    options.range = 0.8;
    options.reference = 0.1;
    return options;
}

std::vector<InfraredEcho> shone(const InfraredRing::Options& options, Environment environment) {
    const Scenario scenario =
        sensing(std::make_shared<const InfraredRing>(SensorTraits{"infrared"}, options), std::move(environment))
            .scenario();
    WorldState state = scenario.initialState();
    return recordsNow<InfraredEcho>(scenario, state, "infrared");
}

TEST(InfraredRing, IntensityFallsWithTheSquareOfTheRangeAndTheSlant) {
    for (const double near : {0.15, 0.3, 0.5, 0.75}) {
        const auto echoes = shone(infraredAt({{0, 0, 0}, {0, 0, 0.5}, {0, 0, pi}}), wallAhead(near));
        EXPECT_NEAR(echoes[0].intensity, 0.01 / (near * near), 1e-6);
        const double slanted = near / std::cos(0.5);
        EXPECT_NEAR(echoes[1].intensity, slanted > 0.8 ? 0 : 0.01 / (slanted * slanted) * std::cos(0.5), 1e-5);
        EXPECT_EQ(echoes[2].intensity, 0);
    }
    EXPECT_EQ(shone(infraredAt({{0, 0, 0}}), wallAhead(0.85))[0].intensity, 0) << "beyond its range";
    EXPECT_EQ(shone(infraredAt({{0.2, 0, 0}}), wallAhead(0.25))[0].intensity, 1) << "no more than all of it";
}

/// A beam half of which passes by gives half.
TEST(InfraredRing, ABeamIsTheMeanOverItsWidth) {
    InfraredRing::Options options = infraredAt({{0, 0, 0}});
    options.beam = 0.2;
    // Two of its five rays, at -0.08 and -0.04, meet the wall.
    const auto echoes = shone(options, wallAhead(0.4, 10, -5.005));
    const auto share = [](double angle) { return 0.0625 * std::cos(angle) * std::cos(angle) * std::cos(angle); };
    EXPECT_NEAR(echoes[0].intensity, (share(0.08) + share(0.04)) / 5, 1e-9);
}

TEST(InfraredRing, AmbientLightAndNoiseAreAdded) {
    InfraredRing::Options options = infraredAt({{0, 0, 0}, {0, 0, pi / 2}, {0, 0, pi}});
    options.ambient = 0.3;
    options.noise = 0.02;
    const Scenario scenario =
        sensing(std::make_shared<const InfraredRing>(SensorTraits{"infrared"}, options), wallAhead(0.3)).scenario();
    SensorWatch watch(scenario, 5);
    StandardNormals normals;
    for (int i = 0; i < 2000; ++i) {
        const auto echoes = watch.next().records<InfraredEcho>("infrared");
        normals.add((echoes[0].intensity - 0.3 - 0.01 / 0.09) / 0.02);
        normals.add((echoes[1].intensity - 0.3) / 0.02);
        normals.add((echoes[2].intensity - 0.3) / 0.02);
    }
    normals.expectStandard("intensities");
}

TEST(RingSensors, RepeatTheirReadingsFromEveryTick) {
    constexpr Nanoseconds ms = 1'000'000;
    auto sonars = sonarAt({{0, 0, 0}, {0, 0, 2}, {0.1, 0, 4}}, 0.6, 0.4);
    sonars.errors.noise = 0.02;
    sonars.errors.dropOut = 0.1;
    sonars.crossTalk = 0.1;
    sonars.latency = 50 * ms;
    InfraredRing::Options infrared = infraredAt({{0, 0, 0}, {0, 0, 3}});
    infrared.noise = 0.01;
    Scenario scenario = randomScene(sonar(sonars), 5, 8, 6);
    RobotType type = scenario.scene().robotTypes[0];
    type.sensors.push_back(std::make_shared<const InfraredRing>(SensorTraits{"infrared", 30 * ms}, infrared));
    scenario = SmallWorld(walledField(3, 3))
                   .robot(type, {1, 1, 0}, std::make_shared<const Told>(Command{0.3, 0.5}), ideal())
                   .robot(discRobot(0.2), {2, 1, 1}, std::make_shared<const Told>(Command{0.2, 0.9}), ideal())
                   .scenario();
    expectSameFromEveryTick(scenario, 60);
}

}  // namespace
}  // namespace mrose

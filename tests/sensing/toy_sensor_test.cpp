// A sensor that no other file knows: with a record, a memory, a clock, keys and draws of its own, by the walk in
// core/sensing/README.md.
#include <cmath>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/toml_text.h"
#include "quantities/value_key.h"
#include "scenario/carry_over.h"
#include "sensing/sensor_keys.h"
#include "sensing/sensor_kinds.h"
#include "sensing/sensor_view.h"
#include "simulation/small_world.h"
#include "world/state_bytes.h"
#include "world/state_hash.h"

namespace mrose {
namespace {

using testing::HasSubstr;

/// How far the first object is, as its echo tells.
struct Echo {
    double range = 0;
    std::uint32_t number = 0;  ///< so many have been heard before
};

}  // namespace

template <>
const RecordType& recordType<Echo>() {
    static const RecordType type{"echo",
                                 sizeof(Echo),
                                 {field<double>("range", "m", offsetof(Echo, range)),
                                  field<std::uint32_t>("number", "", offsetof(Echo, number))}};
    return type;
}

namespace {

class EchoSounder final : public Sensor {
public:
    EchoSounder(SensorTraits traits, double noise, Nanoseconds latency)
        : traits_(std::move(traits)), noise_(noise), latency_(latency) {}

    static SensorPointer read(TomlTable& table, const SensorTraits& traits, const SensorSources& /*sources*/) {
        const double noise = table.numberOr("noise_m", 0, metresOff);
        return std::make_shared<const EchoSounder>(traits, noise, durationOr(table, "latency_s", 0, latencies));
    }

    std::string name() const override { return traits_.name; }
    std::vector<ReadingKind> gives() const override { return {{traits_.name, &recordType<Echo>()}}; }
    Nanoseconds period() const override { return traits_.period; }
    Nanoseconds latency() const override { return latency_; }
    std::size_t memorySize() const override { return sizeof(std::uint64_t); }
    void explain(std::span<const std::byte> memory, MemoryEntries& entries) const override {
        entries.add("heard", static_cast<double>(as<std::uint64_t>(memory)));
    }
    void sense(const SensorView& view, std::span<std::byte> memory, Observation& out) const override {
        std::uint64_t& heard = as<std::uint64_t>(memory);
        const std::int64_t lag = view.lagOf(latency_);
        const double range = distance(position(view.poseBefore(view.robot, lag)),
                                      position(view.poseBefore(view.state.robots.size(), lag)));
        const double off = noise_ == 0 ? 0 : noise_ * normalNoise(view.key(0));
        if (view.wants(0))
            out.add(traits_.name, view.timeBefore(lag), Echo{range + off, static_cast<std::uint32_t>(heard)});
        ++heard;
    }

private:
    SensorTraits traits_;
    double noise_;
    Nanoseconds latency_;
};

constexpr Nanoseconds ms = 1'000'000;

/// Drives by what it hears.
class Listener final : public Controller {
public:
    void decide(const Observation& observation, std::span<std::byte> /*memory*/, Decision& decision) const override {
        double range = 1;
        for (const Reading& reading : observation.readings())
            if (reading.name == "sounder") range = reinterpret_cast<const Echo*>(observation.recordsOf(reading))->range;
        decision.command = Command{0.3 * range, 0.2};
    }
};

Scenario sounding(SensorTraits traits, double noise, Nanoseconds latency, Nanoseconds period = 100'000'000) {
    RobotType type = discRobot(0.2);
    type.perception.objects.present = true;
    type.sensors = {std::make_shared<const EchoSounder>(std::move(traits), noise, latency)};
    return SmallWorld()
        .robot(type, {0, 0, 0.3}, std::make_shared<const Listener>(),
               std::make_shared<const KinematicModel>(KinematicParameters{}, period), 2)
        .object(ballType(), {3, 1, 0}, {-0.5, 0.1, 0})
        .scenario();
}

/// Its echoes of each control instant.
std::vector<std::vector<std::pair<Nanoseconds, Echo>>> echoesOf(const Scenario& scenario, int ticks,
                                                                std::vector<WorldState>* states = nullptr) {
    std::vector<std::vector<std::pair<Nanoseconds, Echo>>> all;
    WorldState state = scenario.initialState(4);
    StepBuffers buffers;
    StepTrace trace;
    for (int k = 0; k < ticks; ++k) {
        if (states != nullptr) states->push_back(state);
        step(scenario, state, buffers, {}, &trace);
        if (!trace.robots[0].observed) continue;
        auto& now = all.emplace_back();
        const Observation& seen = trace.robots[0].observation;
        for (const Reading& reading : seen.readings())
            if (reading.name == "sounder")
                now.emplace_back(reading.measured, *reinterpret_cast<const Echo*>(seen.recordsOf(reading)));
    }
    return all;
}

TEST(ToySensor, MeasuresAtEachControlInstantWhatWasItsLatencyAgo) {
    std::vector<WorldState> states;
    const auto echoes = echoesOf(sounding({"sounder"}, 0, 60 * ms), 200, &states);
    ASSERT_EQ(echoes.size(), 40u);
    for (std::size_t i = 1; i < echoes.size(); ++i) {
        ASSERT_EQ(echoes[i].size(), 1u);
        const std::size_t tick = 2 + 5 * i - 3;
        EXPECT_EQ(echoes[i][0].first, static_cast<Nanoseconds>(tick) * 20 * ms);
        EXPECT_EQ(echoes[i][0].second.number, i);
        EXPECT_DOUBLE_EQ(echoes[i][0].second.range,
                         distance(position(poseOf(states[tick], 0)), position(poseOf(states[tick], 1))));
    }
}

/// 30 ms are no whole number of ticks, and three to four of them a control period: each is told once.
TEST(ToySensor, ByAClockOfItsOwnEachMeasurementArrivesOnce) {
    std::vector<WorldState> states;
    const auto echoes = echoesOf(sounding({"sounder", 30 * ms}, 0, 40 * ms), 300, &states);
    std::vector<std::pair<Nanoseconds, Echo>> all;
    ASSERT_FALSE(echoes.empty());
    for (std::size_t i = 1; i < echoes[0].size(); ++i)
        EXPECT_GT(echoes[0][i].first, echoes[0][i - 1].first) << "before the start, too, each tick is measured once";
    for (std::size_t i = 1; i < echoes.size(); ++i) {
        EXPECT_GE(echoes[i].size(), 3u);
        EXPECT_LE(echoes[i].size(), 4u);
        all.insert(all.end(), echoes[i].begin(), echoes[i].end());
    }
    for (std::size_t i = 0; i < all.size(); ++i) {
        const Nanoseconds planned =
            static_cast<Nanoseconds>(std::llround(all[0].first / (30.0 * ms)) + static_cast<long>(i)) * 30 * ms;
        const auto tick = static_cast<std::size_t>((planned + 10 * ms) / (20 * ms));
        EXPECT_EQ(all[i].first, static_cast<Nanoseconds>(tick) * 20 * ms) << i;
        EXPECT_DOUBLE_EQ(all[i].second.range,
                         distance(position(poseOf(states[tick], 0)), position(poseOf(states[tick], 1))))
            << i;
        EXPECT_EQ(all[i].second.number, all[0].second.number + i);
    }
}

/// Also where the control period changes meanwhile, and the robot decides before its instant had come.
TEST(ToySensor, EachMeasurementArrivesOnceWhateverThePeriods) {
    const Scenario from = sounding({"sounder", 40 * ms}, 0, 40 * ms);
    const Scenario to = sounding({"sounder", 40 * ms}, 0, 40 * ms, 140 * ms);
    for (int before = 50; before < 60; ++before) {
        WorldState state = from.initialState();
        StepBuffers buffers;
        StepTrace trace;
        std::vector<Nanoseconds> measured;
        const auto drive = [&](const Scenario& scenario, int ticks) {
            for (int k = 0; k < ticks; ++k) {
                step(scenario, state, buffers, {}, &trace);
                if (!trace.robots[0].observed) continue;
                for (const Reading& reading : trace.robots[0].observation.readings())
                    if (reading.name == "sounder") measured.push_back(reading.measured);
            }
        };
        drive(from, before);
        state = carriedOver(from, state, to);
        drive(to, 50);
        ASSERT_GT(measured.size(), 40u);
        for (std::size_t i = 1; i < measured.size(); ++i)
            ASSERT_EQ(measured[i] - measured[i - 1], 40 * ms) << before << ' ' << i;
    }
}

TEST(ToySensor, NewestIsTheLastOfItsName) {
    Observation all;
    all.add("sounder", 1, Echo{1, 1});
    all.add("sounder", 2, Echo{2, 2});
    all.add("other", 3, Echo{3, 3});
    EXPECT_EQ(all.records<Echo>("sounder")[0].range, 1);
    EXPECT_EQ(all.records<Echo>(all.newest("sounder"))[0].range, 2);
    EXPECT_EQ(all.newest("none"), nullptr);
    EXPECT_TRUE(all.records<Echo>(all.newest("none")).empty());
    EXPECT_THROW(all.find(std::string(32, 'n')), std::length_error);
}

/// However many draws one takes, they are not those of the next sensor.
TEST(ToySensor, DrawsAreItsAlone) {
    const Scenario scenario = sounding({"sounder"}, 0, 0);
    const WorldState state = scenario.initialState(4);
    SensingBuffers buffers;
    std::set<std::uint64_t> bits;
    std::size_t draws = 0;
    for (const std::uint32_t sensor : {0u, 1u, 255u})
        for (const std::uint32_t draw : {0u, 1u, 65535u, 65536u, 65537u, 200'000u, 1u << 30, 1u << 31}) {
            SensorView view{scenario.scene(), scenario.obstacles(), scenario.past(), state, 0, buffers, sensor};
            for (view.arrivedAgo = -1; view.arrivedAgo <= 1; ++view.arrivedAgo, ++draws)
                bits.insert(noiseBits(view.key(draw)));
        }
    EXPECT_EQ(bits.size(), draws);
}

TEST(ToySensor, DrawsOfItsOwnAreThoseOfTheMeasurement) {
    const auto exact = echoesOf(sounding({"sounder", 50 * ms}, 0, 0), 5);
    double squares = 0;
    int count = 0;
    // The robot is led by what it hears: the first readings alone are of the same way.
    for (int seed = 0; seed < 400; ++seed) {
        const Scenario scenario = sounding({"sounder", 50 * ms}, 0.1, 0);
        WorldState state = scenario.initialState(static_cast<std::uint64_t>(seed));
        StepBuffers buffers;
        StepTrace trace;
        while (!trace.robots.empty() ? !trace.robots[0].observed : true) step(scenario, state, buffers, {}, &trace);
        const auto echo = trace.robots[0].observation.records<Echo>("sounder");
        ASSERT_EQ(echo.size(), 1u);
        const double z = (echo[0].range - exact[0][0].second.range) / 0.1;
        squares += z * z;
        ++count;
    }
    EXPECT_NEAR(squares / count, 1, 4.5 * std::sqrt(2.0 / count));
}

TEST(ToySensor, GoesOnToTheSameBitsFromEveryTick) {
    const Scenario scenario = sounding({"sounder", 30 * ms}, 0.05, 40 * ms);
    WorldState state = scenario.initialState(9);
    StepBuffers buffers, others;
    for (int k = 0; k < 300; ++k) {
        auto restored = parseState(stateBytes(state), "saved");
        ASSERT_TRUE(restored);
        step(scenario, state, buffers);
        step(scenario, *restored, others);
        ASSERT_EQ(hashOf(state), hashOf(*restored)) << k;
    }
}

TEST(ToySensor, WhatItRemembersIsAQuantity) {
    const Scenario scenario = sounding({"sounder"}, 0, 0);
    WorldState state = scenario.initialState();
    run(scenario, state, 13);
    const auto value = boundValue(scenario, {"sounder", "1", "heard"});
    ASSERT_TRUE(value) << value.error().message();
    EXPECT_EQ(pathOf(scenario, *value), "robot[\"1\"].sounder[\"heard\"]");
    EXPECT_EQ(value->shownNumber(Moment{&scenario, &state}), 3);
}

/// So is what it reported last.
TEST(ToySensor, WhatItReportsIsAQuantity) {
    const Scenario scenario = sounding({"sounder", 30 * ms}, 0.05, 0);
    WorldState state = scenario.initialState(4);
    StepBuffers buffers;
    StepTrace trace;
    std::vector<RobotInsight> insights(1);
    for (int k = 0; k < 13; ++k) {
        const std::vector<std::byte> before = state.memory;
        step(scenario, state, buffers, {}, &trace);
        noteInsights(scenario, trace, state.tick, before, insights);
    }
    const auto range = boundValue(scenario, {"sounder", "1", "range", "m"});
    ASSERT_TRUE(range) << range.error().message();
    const Observation& all = insights[0].observation;
    EXPECT_EQ(numberOf(range->value({&scenario, &state, &trace, insights})),
              all.records<Echo>(all.newest("sounder"))[0].range);
    EXPECT_TRUE(std::isnan(numberOf(range->value({&scenario, &state}))));
    const auto seen = boundValue(scenario, {"sight", "1", "objects"});
    ASSERT_TRUE(seen);
    EXPECT_EQ(numberOf(seen->value({&scenario, &state, &trace, insights})), 1);
}

std::vector<SensorPointer> sensorsOf(const std::string& text, std::string& error) {
    static constexpr SensorKind kinds[] = {{"echo_sounder", EchoSounder::read}};
    const auto content = parseToml(text, "r.toml");
    TomlTable root = TomlTable::of(*content, "r.toml");
    auto sensors = readSensors(root.tablesOrNone("sensor"), {}, kinds);
    error = root.failed() ? root.error().message() : "";
    return sensors;
}

TEST(ToySensor, IsAskedForInARobotFile) {
    std::string error;
    const auto sensors =
        sensorsOf("[[sensor]]\nkind = \"echo_sounder\"\nname = \"sounder\"\nperiod_s = 0.05\nlatency_s = 0.1\n", error);
    EXPECT_EQ(error, "");
    ASSERT_EQ(sensors.size(), 1u);
    EXPECT_EQ(sensors[0]->name(), "sounder");
    EXPECT_EQ(sensors[0]->period(), 50 * ms);
    EXPECT_EQ(sensors[0]->latency(), 100 * ms);
    const auto errorOf = [&](const std::string& text) {
        sensorsOf(text, error);
        return error;
    };
    const std::string head = "[[sensor]]\nkind = \"echo_sounder\"\n";
    EXPECT_THAT(errorOf("[[sensor]]\nkind = \"echo\"\nname = \"a\"\n"),
                HasSubstr("r.toml:2:8: sensor[\"a\"].kind: is \"echo\""));
    EXPECT_THAT(errorOf(head), HasSubstr("name: is missing"));
    EXPECT_THAT(errorOf(head + "name = \"robots\"\n"), HasSubstr("r.toml:3:8: sensor[\"robots\"].name: is taken"));
    EXPECT_THAT(errorOf(head + "name = \"a b\"\n"), HasSubstr("expected letters, digits and _"));
    EXPECT_EQ(errorOf(head + "name = \"" + std::string(23, 'a') + "\"\n"), "");
    EXPECT_THAT(errorOf(head + "name = \"" + std::string(24, 'a') + "\"\n"), HasSubstr("and _, at most 23"));
    std::string many;
    for (int i = 0; i < 254; ++i) many += head + "name = \"a" + std::to_string(i) + "\"\n";
    EXPECT_THAT(errorOf(many), HasSubstr("sensor[\"a253\"].name: is of too many sensors; expected at most 253"));
    EXPECT_THAT(errorOf(head + "name = \"a\"\nlatency_s = 2\n"), HasSubstr("expected 0.0 to 1.0"));
    EXPECT_THAT(errorOf(head + "name = \"a\"\nperiod_s = 0\n"), HasSubstr("sensor[\"a\"].period_s: is 0.0; expected"));
    EXPECT_THAT(errorOf(head + "name = \"a\"\nbeams = 2\n"), HasSubstr("sensor[\"a\"].beams: is not a known key"));
    EXPECT_THAT(errorOf(head + "name = \"a\"\n" + head + "name = \"a\"\n"),
                HasSubstr("r.toml:6:8: sensor[\"a\"].name: is taken"));
}

}  // namespace
}  // namespace mrose

// Every value of every shipped scenario is the same number in a condition, in a plot and from a recording.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <map>
#include <set>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "condition/condition.h"
#include "io/file.h"
#include "recording/body_names.h"
#include "recording/mcap_walk.h"
#include "recording/playback.h"
#include "recording/recording_writer.h"
#include "support/shipped.h"
#include "support/temporary_folder.h"
#include "support/values_at.h"

namespace mrose {
namespace {

/// Real robots that stand beside where the simulated ones began, and one motion model.
class Beside final : public RealRobots {
public:
    explicit Beside(const Scenario& scenario) : scenario_(scenario) {}
    std::optional<Pose> poseOf(const std::string& robot, Nanoseconds) const override {
        const Pose& start = scenario_.scene().robots[bodyNamed(scenario_.scene(), robot)].start;
        return Pose{start.x + 0.25, start.y - 0.5, start.heading + 7};
    }
    std::optional<Velocity> velocityOf(const std::string&, Nanoseconds) const override { return Velocity{0.3, -0.2}; }
    std::vector<std::string> modelNames() const override { return {"velocity = command"}; }
    std::optional<PoseError> errorOf(const std::string&, const std::string&, Nanoseconds) const override {
        return PoseError{0.125, 0.75};
    }

private:
    const Scenario& scenario_;
};

/// A run with all that is known of its ticks.
struct Known {
    WorldState state;
    StepTrace trace;
    std::vector<RobotInsight> insights;
};

bool same(double a, double b) {
    return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b) || (std::isnan(a) && std::isnan(b));
}
bool same(const QuantityValue& a, const QuantityValue& b) {
    const auto* const x = std::get_if<double>(&a);
    const auto* const y = std::get_if<double>(&b);
    return x != nullptr && y != nullptr ? same(*x, *y) : a == b;
}

class SameValue : public testing::TestWithParam<const char*> {
protected:
    static constexpr std::int64_t ticks = 400;
    static constexpr std::array<std::int64_t, 3> asked{7, 203, 400};

    Moment momentOf(const Known& known) const {
        return {&scenario_, &known.state, &known.trace, known.insights, &real_};
    }

    /// Runs and records; keeps what is known at the ticks that are asked.
    void record() {
        auto writer = RecordingWriter::create(path(), scenario_, scenario_.initialState());
        ASSERT_TRUE(writer) << writer.error().message();
        Known now{scenario_.initialState(), {}, std::vector<RobotInsight>(scenario_.scene().robots.size())};
        StepBuffers buffers;
        while (now.state.tick < ticks) {
            const std::vector<std::byte> before = now.state.memory;
            step(scenario_, now.state, buffers, {}, &now.trace);
            noteInsights(scenario_, now.trace, now.state.tick, before, now.insights);
            writer->add(now.state, now.trace);
            states_[now.state.tick] = now.state;
            if (std::count(asked.begin(), asked.end(), now.state.tick) > 0) known_.emplace(now.state.tick, now);
        }
        ASSERT_TRUE(writer->close());
    }
    std::filesystem::path path() const { return folder_.path() / "run.mcap"; }

    TemporaryFolder folder_;
    Scenario scenario_ = shippedScenario(GetParam());
    Beside real_{scenario_};
    std::map<std::int64_t, Known> known_;
    std::map<std::int64_t, WorldState> states_;
};

TEST_P(SameValue, InAConditionAndInAPlot) {
    record();
    std::set<std::string> read, known;
    std::map<std::string, WorldValue> expressions;
    for (const auto& [tick, at] : known_) {
        const Moment moment = momentOf(at);
        for (const ValueKey& key : valuesAt(moment)) {
            const auto bound = boundValue(scenario_, key);
            ASSERT_TRUE(bound) << bound.error().message();
            const std::string path = pathOf(scenario_, *bound);
            SCOPED_TRACE(path + " at " + std::to_string(tick));
            EXPECT_EQ(keyOf(scenario_, *bound), key);
            if (bound->quantity->isOfBody() || bound->quantity == &partQuantity()) {
                const ValueKey found = keyOfPath(scenario_, path).value_or(ValueKey{});
                EXPECT_EQ(found.words(), (ValueKey{key.quantity, key.body, key.of, found.unit}.words()));
            }
            const QuantityValue value = bound->value(moment);
            if (const auto* const text = std::get_if<std::string>(&value)) {
                auto condition = compileCondition(path + " == \"" + *text + '"', scenario_, "", &real_);
                ASSERT_TRUE(condition) << condition.error().message();
                EXPECT_TRUE(condition->holds(moment).value_or(false));
                continue;
            }
            auto found = expressions.find(path);
            if (found == expressions.end()) {
                auto compiled = compileWorldValue(path, scenario_, "", &real_);
                ASSERT_TRUE(compiled) << compiled.error().message();
                found = expressions.emplace(path, std::move(*compiled)).first;
            }
            const auto answer = found->second.value(moment);
            ASSERT_TRUE(answer) << answer.error().message();
            EXPECT_TRUE(same(*answer, numberOf(value))) << *answer << ' ' << numberOf(value);
            read.insert(key.quantity);
            if (std::isfinite(*answer)) known.insert(key.quantity);
        }
    }
    EXPECT_GT(read.size(), 45u);
    EXPECT_GT(known.size(), 40u);
}

TEST_P(SameValue, FromARecording) {
    record();
    const auto recording = openRecording(path());
    ASSERT_TRUE(recording) << recording.error().message();
    const Timeline& timeline = recording->branches.front().timeline;
    Playback playback(scenario_);
    for (const auto& [tick, expected] : known_) {
        // From so much earlier that every robot has decided on the way.
        const std::int64_t from = std::max<std::int64_t>(0, tick - 150);
        auto reached = playback.reach(timeline, from);
        ASSERT_TRUE(reached) << reached.error().message();
        Known again{{}, {}, std::vector<RobotInsight>(scenario_.scene().robots.size())};
        while (reached->state.tick < tick) {
            const std::vector<std::byte> before = reached->state.memory;
            ASSERT_TRUE(playback.advance(timeline, *reached, again.trace));
            noteInsights(scenario_, again.trace, reached->state.tick, before, again.insights);
        }
        again.state = reached->state;
        std::size_t count = 0;
        for (const ValueKey& key : valuesAt(momentOf(expected))) {
            const auto bound = boundValue(scenario_, key);
            EXPECT_TRUE(same(bound->value(momentOf(again)), bound->value(momentOf(expected))))
                << pathOf(scenario_, *bound) << " at " << tick;
            ++count;
        }
        EXPECT_GT(count, 100u);
    }
}

/// Rounded, ten times a second, under the same names.
TEST_P(SameValue, InWhatOtherProgramsSeeOfARecording) {
    record();
    const std::vector<std::string> names = bodyNames(scenario_.scene());
    std::set<std::string> seen;
    for (const WalkedMessage& message : walkMessages(*readFile(path()))) {
        if (message.topic != "/bodies") continue;
        const std::int64_t tick = message.time / scenario_.scene().tickLength;
        if (tick == 0) continue;
        const Moment moment{&scenario_, &states_.at(tick)};
        const auto json = nlohmann::json::parse(message.json);
        ASSERT_EQ(json.size(), names.size());
        for (std::uint32_t body = 0; body < names.size(); ++body) {
            const auto& numbers = json[names[body]];
            for (const auto& [name, number] : numbers.items()) {
                if (name == "pressed") continue;  // since the last sample: no quantity of an instant
                const auto bound = boundValue(scenario_, {name, nameOfBody(scenario_.scene(), body)});
                ASSERT_TRUE(bound) << name;
                EXPECT_TRUE(bound->quantity->sampled) << name;
                EXPECT_NEAR(number.get<double>(), numberOf(bound->value(moment)), 5.1e-4) << name << ' ' << tick;
                seen.insert(name);
            }
        }
    }
    for (const Quantity& quantity : quantities())
        if (quantity.sampled && (quantity.of != Quantity::Of::object || !scenario_.scene().objects.empty())) {
            EXPECT_TRUE(seen.contains(quantity.name)) << quantity.name;
        }
}

INSTANTIATE_TEST_SUITE_P(Shipped, SameValue, testing::Values("soccer", "b21_corridor"));

}  // namespace
}  // namespace mrose

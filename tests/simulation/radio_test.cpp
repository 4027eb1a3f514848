// Messages by a radio with latency, jitter, loss and range, and within teams.
#include <cmath>

#include <gtest/gtest.h>

#include "scenario/carry_over.h"
#include "scenario/state_validation.h"
#include "simulation/radio_world.h"
#include "world/state_bytes.h"
#include "world/state_hash.h"

namespace mrose {
namespace {

constexpr Nanoseconds ms = 1'000'000;

/// A test whose statistic is standard normal fails without cause once in a million times.
constexpr double mostDeviation = 4.9;

/// Four robots of different periods and phases, 2 m apart, that all talk; the first drives.
SmallWorld four(const Radio& radio) {
    SmallWorld world;
    world.robot(discRobot(0.2), {0, 0, 0}, announcer(3, 2, {1, 0.2}), everyTicks(5))
        .robot(discRobot(0.2), {2, -1, 0}, announcer(2, 0), everyTicks(3), 1)
        .robot(discRobot(0.2), {4, 0, 0}, announcer(1), everyTicks(10), 3)
        .robot(discRobot(0.2), {0, 4, 0}, announcer(4, 1), everyTicks(1));
    world.parts().scene.radio = radio;
    return world;
}

/// Latencies between ticks, of whole ticks, shorter and longer than periods.
TEST(Radio, MessagesAreGivenAtTheFirstInstantAfterTheirLatency) {
    for (const Nanoseconds latency : {Nanoseconds{0}, Nanoseconds{1}, 19 * ms, 20 * ms, 20 * ms + 1, 60 * ms, 95 * ms,
                                      100 * ms, 100 * ms + 1, 333 * ms, 1000 * ms}) {
        const Scenario scenario = four({.latency = latency}).scenario();
        const Heard heard = listen(scenario, 400);
        EXPECT_EQ(heard.at, expectedOf(scenario, heard, 400)) << latency;
        EXPECT_GT(heard.at.size(), 1000u);
        for (const auto& [said, arrivals] : heard.arrival)
            EXPECT_EQ(arrivals, std::vector{said.tick * 20 * ms + latency});
        for (const std::vector<Said>& order : heard.order)
            for (std::size_t i = 1; i < order.size(); ++i) EXPECT_LE(order[i - 1].tick, order[i].tick);
        // Each says at most four things a tick, for as long as the longest way and the longest period last.
        EXPECT_LE(heard.mostKept, 4u * 4 * static_cast<std::size_t>(latency / (20 * ms) + 12));
    }
}

TEST(Radio, JitterIsEvenlyDrawnAndMessagesAreGivenInTheOrderOfArrival) {
    constexpr Nanoseconds latency = 50 * ms, jitter = 170 * ms;
    const Scenario scenario = four({.latency = latency, .jitter = jitter}).scenario();
    constexpr int ticks = 6000;
    const Heard heard = listen(scenario, ticks);
    const Radio none{.latency = latency + jitter};
    const auto latest = expectedOf(four(none).scenario(), heard, ticks);
    double count = 0, sum = 0, squares = 0, below = 0;
    for (const auto& [said, at] : latest) {
        ASSERT_TRUE(heard.at.contains(said)) << "by its latest arrival it has been given";
        ASSERT_EQ(heard.at.at(said).size(), 1u) << "once";
        const Nanoseconds arrival = heard.arrival.at(said).front(), sent = said.tick * 20 * ms;
        const double share = static_cast<double>(arrival - sent - latency) / static_cast<double>(jitter);
        ASSERT_GE(share, 0);
        ASSERT_LT(share, 1);
        const Scene& scene = scenario.scene();
        std::int64_t instant = scene.robots[said.to].phase;
        while (instant <= said.tick || instant * 20 * ms < arrival) instant += scene.periodTicks(said.to);
        ASSERT_EQ(heard.at.at(said).front(), instant);
        ++count, sum += share, squares += share * share, below += share < 0.25 ? 1 : 0;
    }
    EXPECT_GT(count, 50'000);
    // Mean 1/2, variance 1/12; mean square 1/3, variance 4/45; a quarter below 1/4.
    EXPECT_LT(std::abs(sum / count - 0.5) * std::sqrt(12 * count), mostDeviation);
    EXPECT_LT(std::abs(squares / count - 1.0 / 3) * std::sqrt(count * 45 / 4), mostDeviation);
    EXPECT_LT(std::abs(below / count - 0.25) / std::sqrt(0.25 * 0.75 / count), mostDeviation);
    for (std::size_t to = 0; to < heard.order.size(); ++to)
        for (std::size_t i = 1; i < heard.order[to].size(); ++i) {
            const Said &a = heard.order[to][i - 1], &b = heard.order[to][i];
            if (heard.at.at(a) == heard.at.at(b)) {
                ASSERT_LE(heard.arrival.at(a), heard.arrival.at(b));
            }
        }
}

/// Shares of lost messages, of one receiver and of pairs: receivers, things said at once, instants that follow.
TEST(Radio, LossIsIndependentForEachMessageAndReceiver) {
    constexpr double loss = 0.3;
    constexpr std::uint32_t receivers = 3, kinds = 4;
    constexpr int ticks = 8000;
    SmallWorld world;
    world.robot(discRobot(0.2), {0, 0, 0}, announcer(kinds), everyTicks(1));
    for (std::uint32_t i = 0; i < receivers; ++i)
        world.robot(discRobot(0.2), {1.0 + i, 0, 0}, announcer(0), everyTicks(1));
    world.parts().scene.radio.loss = loss;
    const Heard heard = listen(world.scenario(), ticks);
    const auto lost = [&](int tick, std::uint32_t kind, std::uint32_t to) {
        return heard.at.contains({tick, 0, kind, to}) ? 0.0 : 1.0;
    };
    constexpr int said = ticks - 1;  // what is said last has not arrived
    double all = 0;
    for (int t = 0; t < said; ++t)
        for (std::uint32_t kind = 0; kind < kinds; ++kind)
            for (std::uint32_t to = 1; to <= receivers; ++to) all += lost(t, kind, to);
    EXPECT_EQ(all, heard.lost);
    const double count = static_cast<double>(said) * kinds * receivers;
    EXPECT_LT(std::abs(all / count - loss) / std::sqrt(loss * (1 - loss) / count), mostDeviation);
    const auto expectIndependent = [&](auto first, auto second, const char* what) {
        double sum = 0;
        int pairs = 0;
        for (int t = 0; t + 1 < said; ++t, ++pairs) sum += (first(t) - loss) * (second(t) - loss);
        EXPECT_LT(std::abs(sum) / (loss * (1 - loss) * std::sqrt(pairs)), mostDeviation) << what;
    };
    for (std::uint32_t k = 0; k < kinds; ++k) {
        expectIndependent([&](int t) { return lost(t, k, 1); }, [&](int t) { return lost(t, k, 2); }, "receivers");
        expectIndependent([&](int t) { return lost(t, k, 2); }, [&](int t) { return lost(t + 1, k, 2); }, "instants");
        expectIndependent([&](int t) { return lost(t, k, 3); }, [&](int t) { return lost(t, (k + 1) % kinds, 3); },
                          "messages");
    }
}

TEST(Radio, LossOfNothingAndOfAll) {
    const Scenario none = four({.loss = 0}).scenario(), all = four({.loss = 1}).scenario();
    const Heard heard = listen(none, 200);
    EXPECT_EQ(heard.at, expectedOf(none, heard, 200));
    EXPECT_TRUE(listen(all, 200).at.empty());
}

/// From where the sender was to where the receiver is: the first robot drives in circles of 5 m.
TEST(Radio, RangeIsFromWhereItWasSentToWhereItIsReceived) {
    for (const double range : {1.0, 2.0, 3.7, 5.0, 30.0}) {
        const Scenario scenario = four({.latency = 400 * ms, .range = range}).scenario();
        const Heard heard = listen(scenario, 1500);
        EXPECT_EQ(heard.at, expectedOf(scenario, heard, 1500)) << range;
        EXPECT_EQ(heard.outOfRange > 0, range < 20) << range;
    }
    // At the very range it is received; the smallest number less is not enough.
    for (const double range : {2.0, std::nextafter(2.0, 0)}) {
        SmallWorld world;
        world.robot(discRobot(0.2), {0, 0, 0}, announcer(1), everyTicks(2))
            .robot(discRobot(0.2), {2, 0, 0}, announcer(0), everyTicks(2));
        world.parts().scene.radio.range = range;
        const Heard heard = listen(world.scenario(), 20);
        EXPECT_EQ(heard.at.size(), range == 2.0 ? 9u : 0u);
    }
}

TEST(Radio, ReachesTeamMatesOnly) {
    SmallWorld world = four({.latency = 30 * ms});
    for (int i = 0; i < 6; ++i)
        world.robot(discRobot(0.2), {-2.0 - i, -3, 0}, announcer(2, static_cast<std::uint32_t>(i)), everyTicks(2 + i),
                    1);
    const char* const teams[] = {"red", "blue", "red", "red", "", "blue", "red", "", "blue", "green"};
    for (std::size_t i = 0; i < 10; ++i) world.parts().scene.robots[i].team = teams[i];
    const Scenario scenario = world.scenario();
    const Heard heard = listen(scenario, 300);
    EXPECT_EQ(heard.at, expectedOf(scenario, heard, 300));
    bool toOthers = false;
    for (const auto& [when, messages] : heard.sent)
        for (const RadioMessage& m : messages)
            toOthers = toOthers || (m.to != broadcast && std::string(teams[m.to]) != teams[when.first]);
    EXPECT_TRUE(toOthers) << "is no fault, and is not received";
}

/// Says what the radio cannot carry, or just so.
class LongTalker final : public Controller {
public:
    explicit LongTalker(std::uint32_t size) : size_(size) {}
    void decide(const Observation&, std::span<std::byte>, Decision& decision) const override {
        RadioMessage& message = decision.messages.emplace_back();
        message.size = size_;
        message.bytes.fill(std::byte{7});
    }

private:
    std::uint32_t size_;
};

TEST(Radio, MessagesUpToItsLimitAreCarried) {
    for (const std::uint32_t limit : {1u, 33u, 127u, 128u})
        for (const std::uint32_t size : {limit, limit + 1}) {
            SmallWorld world;
            world.robot(discRobot(0.2), {}, std::make_shared<const LongTalker>(size), ideal());
            world.robot(discRobot(0.2), {1, 0, 0}, announcer(0), ideal());
            world.parts().scene.radio.messageBytes = limit;
            const Scenario scenario = world.scenario();
            WorldState state = scenario.initialState();
            StepBuffers buffers;
            StepTrace trace;
            step(scenario, state, buffers, {}, &trace);
            ASSERT_EQ(trace.faults.size(), size > limit ? 1u : 0u);
            ASSERT_EQ(state.messages.size(), size > limit ? 0u : 1u);
            if (size > limit) {
                EXPECT_EQ(trace.faults[0].what, "its controller sent a message of " + std::to_string(size) +
                                                    " bytes; the radio carries " + std::to_string(limit));
            } else {
                EXPECT_EQ(state.messages[0].bytes[size - 1], std::byte{7});
            }
        }
}

/// From every tick, with all that is random, from the state's bytes alone: as the whole run goes.
TEST(Radio, IsRewoundFromEveryTick) {
    SmallWorld world = four({.latency = 70 * ms, .jitter = 250 * ms, .loss = 0.2, .range = 5});
    const Scenario scenario = world.scenario();
    WorldState state = scenario.initialState();
    StepBuffers buffers, others;
    std::vector<std::string> saved;
    std::vector<StateHash> hashes;
    std::vector<std::vector<std::size_t>> heard;
    StepTrace trace;
    const auto counts = [&] {
        std::vector<std::size_t> of;
        for (const StepTrace::Robot& robot : trace.robots)
            of.push_back(robot.decided ? robot.observation.messages().size() : 0);
        return of;
    };
    constexpr std::size_t ticks = 150, onwards = 25;
    for (std::size_t k = 0; k < ticks; ++k) {
        EXPECT_EQ(validate(scenario, state), "") << k;
        saved.push_back(stateBytes(state));
        hashes.push_back(hashOf(state));
        step(scenario, state, buffers, {}, &trace);
        heard.push_back(counts());
    }
    for (std::size_t from = 0; from + onwards < ticks; ++from) {
        auto restored = parseState(saved[from], "saved");
        ASSERT_TRUE(restored);
        for (std::size_t k = from; k < from + onwards; ++k) {
            ASSERT_EQ(hashOf(*restored), hashes[k]) << from << ' ' << k;
            step(scenario, *restored, others, {}, &trace);
            ASSERT_EQ(counts(), heard[k]) << from << ' ' << k;
        }
    }
}

/// Who is there besides, and what is traced, changes nothing.
TEST(Radio, DrawsOfOthersLeaveAMessageAlone) {
    const Radio radio{.latency = 20 * ms, .jitter = 100 * ms, .loss = 0.4};
    SmallWorld alone = four(radio), more = four(radio);
    for (int i = 0; i < 5; ++i) more.robot(discRobot(0.2), {-2.0 - i, -3, 0}, announcer(2), everyTicks(3));
    const Heard heard = listen(alone.scenario(), 300), among = listen(more.scenario(), 300);
    for (const auto& [said, at] : heard.at) EXPECT_EQ(among.at.at(said), at);
    for (const auto& [said, at] : among.at)
        if (said.from < 4 && said.to < 4) {
            EXPECT_TRUE(heard.at.contains(said));
        }
}

/// Where the radio becomes another one, what is on its way arrives as it was sent.
TEST(Radio, ThatIsExchangedDeliversEachMessageOnce) {
    const Radio radios[] = {{}, {.latency = 200 * ms}, {.latency = 50 * ms, .jitter = 150 * ms}, {.latency = 900 * ms}};
    for (const Radio& before : radios)
        for (const Radio& after : radios)
            for (const int then : {20, 33, 57}) {
                const Scenario from = four(before).scenario(), to = four(after).scenario();
                WorldState state = from.initialState();
                StepBuffers buffers;
                StepTrace trace;
                std::map<Said, int> times;
                std::map<Said, int> said;
                for (int k = 0; k < 200; ++k) {
                    if (k == then) state = carriedOver(from, state, to);
                    step(k < then ? from : to, state, buffers, {}, &trace);
                    for (std::uint32_t i = 0; i < 4; ++i) {
                        if (!trace.robots[i].decided) continue;
                        for (const ReceivedMessage& m : trace.robots[i].observation.messages())
                            ++times[{m.sent / (20 * ms), m.from, m.kind, i}];
                        for (const RadioMessage& m : trace.robots[i].decision.messages)
                            for (std::uint32_t other = 0; k < 120 && other < 4; ++other)
                                if (other != i && (m.to == broadcast || m.to == other)) said[{k, i, m.kind, other}] = 1;
                    }
                }
                std::erase_if(times, [](const auto& one) { return one.first.tick >= 120; });
                EXPECT_EQ(times, said) << before.latency << " to " << after.latency << " at " << then;
            }
}

TEST(Radio, StatesWithMessagesThatCannotBeAreRefused) {
    const Scenario scenario = four({.latency = 100 * ms}).scenario();
    WorldState state = scenario.initialState();
    run(scenario, state, 20);
    ASSERT_EQ(validate(scenario, state), "");
    const std::function<void(SentMessage&)> wrongs[] = {
        [](SentMessage& m) { m.latency = -1; },    [](SentMessage& m) { m.jitter = 1001 * ms; },
        [](SentMessage& m) { m.size = 129; },      [](SentMessage& m) { m.from = 4; },
        [](SentMessage& m) { m.number = 64; },     [](SentMessage& m) { m.tick = 21; },
        [](SentMessage& m) { m.position.x = NAN; }};
    for (const auto& spoil : wrongs) {
        WorldState broken = state;
        spoil(broken.messages.back());
        EXPECT_NE(validate(scenario, broken), "");
    }
}

}  // namespace
}  // namespace mrose

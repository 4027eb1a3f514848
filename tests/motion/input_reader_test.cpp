#include "motion/input_reader.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "motion/network_fixture.h"
#include "support/units.h"
#include "world/noise.h"

namespace mrose {
namespace {

using Quantity = NetworkInput::Quantity;

constexpr Velocity velocity{0.3, -0.7};

MotionNetwork readingNothing(double turnOffset = 0) {
    MotionNetwork network;
    network.robots = {"1"};
    network.wheelPhase = {0.13, 0.0084};
    network.turnOffset = turnOffset;
    return network;
}

NetworkInput inputOf(Quantity quantity, double newest, double oldest) {
    NetworkInput input;
    input.quantity = quantity;
    input.newest = newest;
    input.oldest = oldest;
    input.robot = "1";
    return input;
}

/// One input alone, not standardised.
double readOne(Quantity quantity, double newest, double oldest, const CommandHistory& history, Nanoseconds start,
               double turnOffset = 0) {
    MotionNetwork network = readingNothing(turnOffset);
    network.inputs = {inputOf(quantity, newest, oldest)};
    double value = NAN;
    InputReader(network).readRaw({&history, start, velocity}, 0, &value);
    return value;
}

TEST(InputReader, MeanOfCommandsIsThatOfTheHistory) {
    CommandHistory history;
    history.issue(0, {0.1, 0.5});
    history.issue(130 * ms, {0.3, -0.5});
    history.issue(180 * ms, {-0.2, 1.5});
    history.issue(190 * ms, {0.7, 0});
    for (const auto& [newest, oldest] : {std::pair{0.0, 0.05}, {0.0, 0.2}, {0.013, 0.111}, {0.05, 0.3}, {0.15, 0.5}}) {
        const Command mean = history.mean(200 * ms - fromSeconds(oldest), 200 * ms - fromSeconds(newest));
        EXPECT_NEAR(readOne(Quantity::commandV, newest, oldest, history, 200 * ms), mean.v, 1e-14);
        EXPECT_NEAR(readOne(Quantity::commandW, newest, oldest, history, 200 * ms), mean.w, 1e-14);
    }
}

TEST(InputReader, ReadsNoCommandIssuedAfterThePeriodsStart) {
    CommandHistory without, with;
    without.issue(0, {0.1, 0.5});
    with = without;
    with.issue(100 * ms + 1, {9, 9});
    const InputReader reader(arbitraryNetwork(MotionNetwork::Form::history));
    std::vector<float> a(reader.width()), b(reader.width());
    reader.read({&without, 100 * ms, {}}, 0, a.data());
    reader.read({&with, 100 * ms, {}}, 0, b.data());
    EXPECT_EQ(a, b);
    with.issue(100 * ms + 2, {9, 9});
    reader.read({&with, 101 * ms, {}}, 0, b.data());
    EXPECT_NE(a, b);
}

TEST(InputReader, StandsBeforeTheFirstCommand) {
    CommandHistory history;
    EXPECT_EQ(readOne(Quantity::commandV, 0, 0.4, history, 500 * ms), 0);
    history.issue(400 * ms, {0.2, 0});
    EXPECT_NEAR(readOne(Quantity::commandV, 0, 0.4, history, 500 * ms), 0.2 * 0.1 / 0.4, 1e-15);
}

TEST(InputReader, TurnSenseIsToldForTinyRotationsOfADrivingRobotOnly) {
    const auto sense = [](const Command& command) {
        CommandHistory history;
        history.issue(0, command);
        return readOne(Quantity::turnSense, 0, 0.1, history, 100 * ms, 0.005);
    };
    EXPECT_EQ(sense({0.1, 0.0}), 0);
    EXPECT_EQ(sense({0.1, -0.0}), -1);
    EXPECT_EQ(sense({0.1, 0.007}), 1);
    EXPECT_EQ(sense({0.1, 0.003}), -1);
    EXPECT_EQ(sense({0.1, -0.4}), -1);
    EXPECT_EQ(sense({0.0, 0.4}), 0);
}

TEST(InputReader, WheelPhasesAreThoseOfTheCommandedWheelSpeeds) {
    const Command command{0.0613, -0.171};
    CommandHistory history;
    history.issue(0, command);
    const auto read = [&](Quantity q) { return readOne(q, 0.02, 0.07, history, 100 * ms); };
    const double turn = 2 * std::numbers::pi / 0.0084;
    EXPECT_NEAR(read(Quantity::leftSine), std::sin(turn * (command.v - 0.13 * command.w)), 1e-12);
    EXPECT_NEAR(read(Quantity::leftCosine), std::cos(turn * (command.v - 0.13 * command.w)), 1e-12);
    EXPECT_NEAR(read(Quantity::rightSine), std::sin(turn * (command.v + 0.13 * command.w)), 1e-12);
    EXPECT_NEAR(read(Quantity::rightCosine), std::cos(turn * (command.v + 0.13 * command.w)), 1e-12);
    EXPECT_NEAR(read(Quantity::forwardSine), std::sin(turn / 2 * command.v), 1e-12);
    EXPECT_NEAR(read(Quantity::forwardCosine), std::cos(turn / 2 * command.v), 1e-12);
}

TEST(InputReader, CommandPushedOutLastHoldsForeverOnceTheHistoryIsFull) {
    CommandHistory history;
    const int last = int(CommandHistory::capacity) + 3;
    for (int i = 0; i <= last; ++i) history.issue(i * ms, {0.001 * i, 0});
    const double before = 0.001 * 3;  // the last one for which there was no room
    EXPECT_NEAR(readOne(Quantity::commandV, 0.2, 0.3, history, last * ms), before, 1e-15);
    const Command mean = history.mean((last - 200) * ms, last * ms);
    EXPECT_NEAR(readOne(Quantity::commandV, 0, 0.2, history, last * ms), mean.v, 1e-14);
}

TEST(InputReader, ReadsCommandsAsTheDriveFollowsThem) {
    MotionNetwork network = readingNothing();
    network.inputs = {inputOf(Quantity::commandV, 0.1, 0.3), inputOf(Quantity::commandW, 0.1, 0.3),
                      inputOf(Quantity::turnSense, 0.1, 0.3)};
    EXPECT_EQ(InputReader(network).lookBack(), 300 * ms);
    CommandHistory history;
    history.issue(0, {0.2, 0.5});
    history.issue(800 * ms, {0.4, -1});
    const auto read = [&] {
        std::array<double, 3> row{};
        InputReader(network).readRaw({&history, 1000 * ms, velocity}, 0, row.data());
        return row;
    };
    const auto jumping = read();
    network.limits.accelerationV = 1;
    EXPECT_EQ(InputReader(network).lookBack(), 2700 * ms);  // where a ramp began that may still last
    const auto ramped = read();
    EXPECT_NEAR(ramped[0], (0.1 * 0.2 + 0.1 * 0.25) / 0.2, 1e-14);
    EXPECT_EQ(ramped[1], jumping[1]);
    EXPECT_EQ(ramped[2], jumping[2]);
    network.limits = {0, 15, 0, 0};
    EXPECT_EQ(read()[0], jumping[0]);
    EXPECT_NEAR(read()[1], (0.1 * 0.5 - 0.1 * 0.25) / 0.2, 1e-14);
    network.limits = {0, 0, 0.25, 0.1};
    const Command within = network.limits.withinWheelSpeed({jumping[0], jumping[1]});
    EXPECT_EQ(read()[0], within.v);
    EXPECT_EQ(read()[1], within.w);
    EXPECT_NE(read()[0], jumping[0]);
    network.limits = {1, 15, 0.23, 0.1};  // cut is what the ramps have come to
    const double w = (0.1 * 0.5 - 0.1 * 0.25) / 0.2;
    EXPECT_EQ(read()[0], network.limits.withinWheelSpeed({ramped[0], w}).v);
    EXPECT_NE(read()[0], ramped[0]);
}

TEST(InputReader, WhatIsFollowedIsRememberedAsTheWholeHistoryTellsIt) {
    for (const double begin : {0.0, 0.2}) {  // what is read is shorter than a period, and longer
        MotionNetwork network = readingNothing();
        for (const Quantity quantity : {Quantity::commandV, Quantity::commandW})
            network.inputs.insert(network.inputs.end(), {inputOf(quantity, begin, begin + 0.02),
                                                         inputOf(quantity, begin + 0.02, begin + 0.07)});
        network.limits = {1.2, 5, 0.5, 0.17, 0.1};
        const InputReader reader(network);
        network.limits.longestRamp = 99;
        const InputReader ofAll(network);  // of 3 s, in which what was followed before is forgotten
        CommandHistory history;
        InputReader::Followed followed;
        double most = 0;
        for (int i = 0; i < 100; ++i) {
            const Nanoseconds start = i * network.period;
            history.issue(start, {0.6 * uniformNoise({1, i, 0, 0}) - 0.2, normalNoise({1, i, 0, 1})});
            std::array<double, 4> told{}, remembered{}, forgotten{}, recalled{};
            ofAll.readRaw({&history, start, velocity}, 0, told.data());
            reader.readRaw({&history, start, velocity}, 0, remembered.data(), &followed);
            reader.readRaw({&history, start, velocity}, 0, forgotten.data());
            InputReader::Followed known = reader.followedFrom(history, start);
            reader.readRaw({&history, start, velocity}, 0, recalled.data(), &known);
            for (std::size_t k = 0; k < told.size(); ++k) {
                ASSERT_NEAR(remembered[k], told[k], 1e-12) << i << ", input " << k;
                ASSERT_NEAR(recalled[k], told[k], 1e-12) << i << ", input " << k;
                most = std::max(most, std::abs(forgotten[k] - told[k]));
            }
        }
        EXPECT_GT(most, 0.05) << "it need not be remembered";
    }
}

/// As where a run goes on with another tick, and a robot decides in the middle of its period.
TEST(InputReader, WhatIsFollowedAtAnotherInstantIsNotRead) {
    MotionNetwork network = readingNothing();
    network.inputs = {inputOf(Quantity::commandV, 0.1, 0.3)};
    network.limits = {0.5, 2, 0, 0};
    const InputReader reader(network);
    CommandHistory history;
    history.issue(0, {0.5, 0});
    InputReader::Followed followed;
    double told = 0, read = 0;
    reader.readRaw({&history, 500 * ms, velocity}, 0, &read, &followed);
    followed.command = {9, 9};
    reader.readRaw({&history, 650 * ms, velocity}, 0, &read, &followed);
    reader.readRaw({&history, 650 * ms, velocity}, 0, &told);
    EXPECT_EQ(read, told);
    followed.command = {9, 9};
    reader.readRaw({&history, 750 * ms, velocity}, 0, &read, &followed);
    EXPECT_GT(read, 5);
}

TEST(InputReader, WhatWasReachedLongAgoDoesNotMatterToTheLastBit) {
    MotionNetwork network = readingNothing();
    network.inputs = {inputOf(Quantity::commandV, 0.1, 0.3), inputOf(Quantity::commandW, 0.1, 0.3)};
    network.limits = {0.7, 1.3, 0.4, 0.17};
    const auto read = [&](const CommandHistory& history) {
        std::array<double, 2> row{};
        InputReader(network).readRaw({&history, 10'000 * ms, velocity}, 0, row.data());
        return row;
    };
    CommandHistory longAgo, justBefore, crowded;
    longAgo.issue(0, {0.3, 0.9});
    justBefore.issue(7'299 * ms, {0.3, 0.9});
    for (int i = 0; i < 200; ++i) crowded.issue(i * ms, {0.001 * i, 0});
    crowded.issue(7'000 * ms, {0.3, 0.9});
    for (CommandHistory* history : {&longAgo, &justBefore, &crowded}) history->issue(9'500 * ms, {-0.2, 0.1});
    EXPECT_EQ(read(longAgo), read(justBefore));
    EXPECT_EQ(read(longAgo), read(crowded));
    EXPECT_EQ(read(CommandHistory()), (std::array<double, 2>{}));
    for (int i = 0; i < 200; ++i) crowded.issue((9'800 + i) * ms, {0.1, 0.1});
    EXPECT_NE(read(crowded), read(longAgo));
}

TEST(InputReader, ManyInputsInAnyOrderReadLikeEachAlone) {
    constexpr std::pair<double, double> bins[] = {{0.1, 0.125}, {0, 0.05}, {0.02, 0.4}, {0.1, 0.3}, {0.05, 0.1}};
    CommandHistory history;
    for (int i = 0; i < 9; ++i)
        history.issue(i * 47 * ms, {0.1 * uniformNoise({1, i, 0, 0}), normalNoise({1, i, 0, 1})});
    MotionNetwork network = readingNothing();
    for (int k = 0; k < 60; ++k) {
        const auto [newest, oldest] = bins[3 * k % 5];
        network.inputs.push_back(inputOf(static_cast<Quantity>(7 * k % 12), newest, oldest));
    }
    for (const Nanoseconds start : {150 * ms, 376 * ms, 400 * ms, 1000 * ms}) {
        std::vector<double> row(network.inputs.size());
        InputReader(network).readRaw({&history, start, velocity}, 0, row.data());
        for (std::size_t i = 0; i < row.size(); ++i) {
            const NetworkInput& input = network.inputs[i];
            EXPECT_EQ(row[i], readOne(input.quantity, input.newest, input.oldest, history, start)) << i;
        }
    }
}

TEST(InputReader, UnknownRobotCountsAsTheMeanOfTheKnown) {
    MotionNetwork network = arbitraryNetwork(MotionNetwork::Form::state);
    const InputReader reader(network);
    EXPECT_EQ(reader.robotIndex("a"), 0);
    EXPECT_EQ(reader.robotIndex("b"), 1);
    EXPECT_EQ(reader.robotIndex("c"), -1);
    CommandHistory history;
    std::vector<float> row(reader.width());
    reader.read({&history, 0, {}}, -1, row.data());
    EXPECT_EQ(row[2], 0);
    reader.read({&history, 0, {}}, 1, row.data());
    EXPECT_FLOAT_EQ(row[2], static_cast<float>((1 - network.inputs[2].mean) / network.inputs[2].scale));
}

}  // namespace
}  // namespace mrose

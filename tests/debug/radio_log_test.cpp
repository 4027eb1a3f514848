// What the window knows of messages at a tick, whichever way it came there.
#include <gtest/gtest.h>

#include "debug/debugger.h"
#include "debug/run_frame.h"
#include "quantities/catalogue.h"
#include "simulation/radio_world.h"

namespace mrose {
namespace {

class RadioLogTest : public testing::Test {
protected:
    RadioLogTest() {
        SmallWorld world;
        world.robot(discRobot(0.2), {0, 0, 0}, announcer(2, 2), everyTicks(5))
            .robot(discRobot(0.2), {2, 0, 0}, announcer(1), everyTicks(7), 1)
            .robot(discRobot(0.2), {5, 0, 0}, announcer(0), everyTicks(4), 3);
        world.parts().scene.radio = {.latency = 50'000'000, .jitter = 200'000'000, .loss = 0.3, .range = 4};
        world.parts().duration = 10 * nanosecondsPerSecond;
        scenario = std::make_shared<const Scenario>(world.parts());
        OpenedRun run;
        run.start = scenario->initialState();
        run.setup = std::make_shared<const BranchSetup>(BranchSetup{{}, scenario});
        debugger.open(run);
        WorldState state = run.start;
        StepBuffers buffers;
        for (int k = 0; k < 300; ++k) step(*scenario, state, buffers, {}, &traces.emplace_back());
    }

    /// Of the ticks from 50 before it on, by stepping.
    void expectFrame(std::int64_t tick) const {
        const RadioLog log = frameOf(debugger.run()).radio;
        std::size_t due = 0, sent = 0;
        for (std::int64_t k = std::max<std::int64_t>(0, tick - 50); k < tick; ++k) {
            const StepTrace& trace = traces[static_cast<std::size_t>(k)];
            for (const Transmission& one : trace.transmissions) {
                ASSERT_LT(due, log.due.size());
                const RadioLog::Entry& entry = log.due[due++];
                EXPECT_EQ(entry.tick, k);
                EXPECT_EQ(entry.message.from, trace.messages[one.message].from);
                EXPECT_EQ(entry.message.tick, trace.messages[one.message].tick);
                EXPECT_EQ(entry.transmission.to, one.to);
                EXPECT_EQ(entry.transmission.outcome, one.outcome);
            }
            for (std::uint32_t robot = 0; robot < 3; ++robot)
                for (std::size_t n = 0; trace.robots[robot].decided && n < trace.robots[robot].decision.messages.size();
                     ++n) {
                    ASSERT_LT(sent, log.sent.size());
                    EXPECT_EQ(log.sent[sent].from, robot);
                    EXPECT_EQ(log.sent[sent++].tick, k);
                }
        }
        EXPECT_EQ(due, log.due.size());
        EXPECT_EQ(sent, log.sent.size());
    }

    std::shared_ptr<const Scenario> scenario;
    std::vector<StepTrace> traces;
    Debugger debugger;
};

TEST_F(RadioLogTest, IsOfTheLastSecondWhicheverWayOneComes) {
    for (const std::int64_t tick : {200, 17, 18, 120, 119, 0, 260, 70}) {
        debugger.goTo(tick, false);
        SCOPED_TRACE(tick);
        expectFrame(tick);
    }
    debugger.stepBy(9);
    expectFrame(79);
}

/// At each tick what the last control instant says.
TEST_F(RadioLogTest, QuantitiesCountMessages) {
    const auto value = [&](const FieldFrame& frame, const char* name, std::uint32_t robot) {
        return numberOf(quantityNamed(name, Quantity::Of::robot).value({frame.moment(), robot}));
    };
    std::int64_t newest[3] = {-1, -1, -1};
    double received[3] = {}, sent[3] = {}, age[3] = {};
    std::fill_n(received, 3, std::nan(""));
    std::fill_n(sent, 3, std::nan(""));
    std::fill_n(age, 3, std::nan(""));
    const auto same = [](double a, double b) { return (std::isnan(a) && std::isnan(b)) || std::abs(a - b) < 1e-9; };
    for (std::int64_t tick = 1; tick <= 100; ++tick) {
        debugger.goTo(tick, false);
        const FieldFrame frame = frameOf(debugger.run());
        const StepTrace& trace = traces[static_cast<std::size_t>(tick - 1)];
        for (std::uint32_t i = 0; i < 3; ++i) {
            if (trace.robots[i].decided) {
                received[i] = 0;
                newest[i] = -1;
                for (const Transmission& one : trace.transmissions) {
                    if (one.to != i || one.outcome != Transmission::Outcome::received) continue;
                    ++received[i];
                    newest[i] = std::max(newest[i], trace.messages[one.message].tick);
                }
                sent[i] = i == 0 ? 2 : i == 1 ? 1 : 0;
            }
            age[i] = newest[i] < 0 ? std::nan("") : 0.02 * static_cast<double>(tick - newest[i]);
            EXPECT_TRUE(same(value(frame, "messages_received", i), received[i])) << tick << ' ' << i;
            EXPECT_TRUE(same(value(frame, "messages_sent", i), sent[i])) << tick << ' ' << i;
            EXPECT_TRUE(same(value(frame, "message_age", i), age[i])) << tick << ' ' << i;
        }
    }
}

}  // namespace
}  // namespace mrose

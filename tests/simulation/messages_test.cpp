// What robots tell each other.
#include <gtest/gtest.h>

#include "scenario/carry_over.h"
#include "simulation/small_world.h"
#include "world/state_bytes.h"
#include "world/state_hash.h"

namespace mrose {
namespace {

/// Tells what it has counted so far, and keeps the sum of what it is told.
class Teller final : public Controller {
public:
    struct Memory {
        std::uint64_t count = 0, sum = 0, received = 0, late = 0;
    };
    explicit Teller(std::uint32_t to, bool listens = true) : to_(to), listens_(listens) {}
    std::size_t memorySize() const override { return sizeof(Memory); }
    Attention attention() const override { return listens_ ? Attention() : Attention::ofItself(); }
    void decide(const Observation& observation, std::span<std::byte> bytes, Decision& decision) const override {
        auto& memory = as<Memory>(bytes);
        if (!listens_)
            for (const Reading& reading : observation.readings()) memory.received += reading.name == messagesReading;
        for (const ReceivedMessage& message : listens_ ? observation.messages() : std::span<const ReceivedMessage>()) {
            std::uint64_t told = 0;
            std::memcpy(&told, message.bytes.data(), sizeof told);
            memory.sum += told;
            ++memory.received;
            memory.late += message.sent >= observation.time || message.size != sizeof told || message.kind != 7 ||
                                   message.from == observation.robot
                               ? 1
                               : 0;
        }
        decision.messages.push_back(RadioMessage::of(++memory.count, 7, to_));
    }

private:
    std::uint32_t to_;
    bool listens_;
};

std::shared_ptr<const MotionModel> every(Nanoseconds period) {
    return std::make_shared<const KinematicModel>(KinematicParameters{}, period);
}

/// `slower`: by how much the control period of the first is longer.
Scenario three(std::uint32_t firstTells, bool thirdListens = true, Nanoseconds tick = 20'000'000,
               Nanoseconds slower = 0) {
    const auto teller = [](std::uint32_t to, bool listens = true) {
        return std::make_shared<const Teller>(to, listens);
    };
    SmallWorld world;
    world.robot(discRobot(0.2), {0, 0, 0}, teller(firstTells), every(100'000'000 + slower))
        .robot(discRobot(0.2), {2, 0, 0}, teller(2), every(60'000'000), 1)
        .robot(discRobot(0.2), {4, 0, 0}, teller(broadcast, thirdListens), every(200'000'000), 3);
    world.parts().scene.tickLength = tick;
    return world.scenario();
}

Teller::Memory memoryOf(const Scenario& scenario, const WorldState& state, std::size_t robot) {
    return as<Teller::Memory>(scenario.memoryOf(state, robot));
}

/// Each message reaches whom it is for once, at the first control instant after it was sent, whatever the periods.
TEST(Messages, EachArrivesOnceAtTheNextInstant) {
    const Scenario scenario = three(broadcast);
    WorldState state = scenario.initialState();
    run(scenario, state, 1000);
    const Teller::Memory first = memoryOf(scenario, state, 0), second = memoryOf(scenario, state, 1),
                         third = memoryOf(scenario, state, 2);
    EXPECT_EQ(first.count, 200u);
    EXPECT_EQ(second.count, 333u);
    EXPECT_EQ(third.count, 100u);
    // The last instants: robot 1 at tick 995, robot 2 at 997, robot 3 at 993. It was told what was sent before.
    EXPECT_EQ(first.received, 100u);
    EXPECT_EQ(second.received, 200u + 100u);
    EXPECT_EQ(third.received, 199u + 331u);
    EXPECT_EQ(third.sum, 199u * 200 / 2 + 331u * 332 / 2);
    EXPECT_EQ(first.late + second.late + third.late, 0u);
    EXPECT_LT(state.messages.size(), 12u) << "old ones are forgotten";
}

TEST(Messages, ToOneReachOneAndWhoDoesNotListenHearsNothing) {
    const Scenario scenario = three(1, false);
    WorldState state = scenario.initialState();
    run(scenario, state, 500);
    EXPECT_EQ(memoryOf(scenario, state, 0).received, 50u);
    EXPECT_EQ(memoryOf(scenario, state, 1).received, 100u + 50u);
    EXPECT_EQ(memoryOf(scenario, state, 2).received, 0u);
}

TEST(Messages, AreRewoundWithAllElse) {
    const Scenario scenario = three(broadcast);
    WorldState state = scenario.initialState();
    StepBuffers buffers, others;
    for (int k = 0; k < 200; ++k) {
        auto restored = parseState(stateBytes(state), "saved");
        ASSERT_TRUE(restored);
        step(scenario, state, buffers);
        step(scenario, *restored, others);
        ASSERT_EQ(hashOf(state), hashOf(*restored)) << k;
    }
}

/// Where a robot's period changes, and with it when it is told, or the length of a tick.
TEST(Messages, ArriveOnceAlsoWherePeriodsChange) {
    constexpr Nanoseconds ms = 1'000'000;
    const Scenario from = three(broadcast);
    const Scenario others[] = {three(broadcast, true, 20 * ms, 60 * ms), three(broadcast, true, 20 * ms, -40 * ms),
                               three(broadcast, true, 10 * ms)};
    for (const Scenario& to : others)
        for (int before = 100; before < 120; ++before) {
            WorldState state = from.initialState();
            run(from, state, before);
            state = carriedOver(from, state, to);
            run(to, state, 40);
            std::uint64_t waiting = 0;
            for (const SentMessage& message : state.messages)
                waiting += message.from != 0 && message.tick >= state.robots[0].lastControl &&
                                   (message.to == noBody || message.to == 0)
                               ? 1
                               : 0;
            // All that the third has sent, which tells everybody.
            EXPECT_EQ(memoryOf(to, state, 0).received + waiting, memoryOf(to, state, 2).count) << before;
            EXPECT_EQ(memoryOf(to, state, 0).late, 0u);
        }
}

class Shouter final : public Controller {
public:
    void decide(const Observation&, std::span<std::byte>, Decision& decision) const override {
        decision.command = Command{1, 0};
        decision.messages.emplace_back().size = RadioMessage::most + 1;
    }
};

/// What is said in the first tick, in which nothing is sent.
std::string faultOf(const Scenario& scenario, StepTrace& trace, WorldState& state) {
    StepBuffers buffers;
    step(scenario, state, buffers, {}, &trace);
    EXPECT_TRUE(state.messages.empty());
    EXPECT_EQ(trace.faults.size(), 1u);
    return trace.faults.empty() ? "" : trace.faults[0].what;
}

TEST(Messages, ToARobotThatIsNotThereAreAFault) {
    const Scenario scenario = three(7);
    WorldState state = scenario.initialState();
    StepTrace trace;
    EXPECT_EQ(faultOf(scenario, trace, state), "its controller sent a message to a robot that is not there");
}

/// Says less than its bytes hold.
class Mumbler final : public Controller {
public:
    void decide(const Observation&, std::span<std::byte>, Decision& decision) const override {
        RadioMessage& message = decision.messages.emplace_back();
        message.bytes.fill(std::byte{9});
        message.size = 3;
    }
};

TEST(Messages, BytesBeyondTheirSizeAreNotSent) {
    const Scenario scenario =
        SmallWorld().robot(discRobot(0.2), {}, std::make_shared<const Mumbler>(), ideal()).scenario();
    WorldState state = scenario.initialState();
    run(scenario, state, 1);
    ASSERT_EQ(state.messages.size(), 1u);
    EXPECT_EQ(state.messages[0].bytes[2], std::byte{9});
    EXPECT_EQ(state.messages[0].bytes[3], std::byte{0});
}

TEST(Messages, ThatAreTooLargeAreAFault) {
    const Scenario scenario =
        SmallWorld().robot(discRobot(0.2), {}, std::make_shared<const Shouter>(), ideal()).scenario();
    WorldState state = scenario.initialState();
    StepTrace trace;
    EXPECT_EQ(faultOf(scenario, trace, state), "its controller sent a message of 129 bytes; the radio carries 128");
    EXPECT_TRUE(trace.robots[0].decision.messages.empty()) << "it is recorded";
    EXPECT_EQ(state.robots[0].velocity_B.x, 0);
}

}  // namespace
}  // namespace mrose

// The benchmarks' scene is as crowded here as in the plain Box2D that it is compared with (bench/).
#include <gtest/gtest.h>

#include "bench/plain_box2d.h"
#include "simulation/small_world.h"
#include "world/noise.h"

namespace mrose {
namespace {

/// As RandomCommands, other ones for each run.
class OtherCommands final : public Controller {
public:
    OtherCommands(std::uint64_t run, bool heavy) : run_(run), heavy_(heavy) {}
    void decide(const Observation& observation, std::span<std::byte> /*memory*/, Decision& decision) const override {
        const NoisePair u = uniformPair({run_, observation.time, observation.robot, 0});
        decision.command = Command{heavy_ ? u.first : 2 * u.first - 1, (heavy_ ? 4 : 2) * (2 * u.second - 1)};
    }

private:
    std::uint64_t run_;
    bool heavy_;
};

constexpr int seconds = 60;

/// Touching pairs in a tick of a minute, on average over so many runs.
double contactsHere(std::uint64_t runs, bool heavy) {
    FieldOptions options;
    options.heavy = heavy;
    std::size_t sum = 0;
    for (std::uint64_t r = 1; r <= runs; ++r) {
        ScenarioParts parts = fieldScenario(options).parts();
        for (auto& controller : parts.controllers) controller = std::make_shared<const OtherCommands>(r, heavy);
        const Scenario scenario(std::move(parts));
        WorldState state = scenario.initialState(r);
        StepBuffers buffers;
        StepTrace trace;
        for (int k = 0; k < 50 * seconds; ++k) {
            step(scenario, state, buffers, {}, &trace);
            sum += trace.contacts.size();
        }
    }
    return static_cast<double>(sum) / (50.0 * seconds * static_cast<double>(runs));
}

double contactsThere(std::uint64_t runs, bool heavy) {
    int sum = 0;
    for (std::uint64_t r = 1; r <= runs; ++r) {
        bench::PlainBox2d world(8, heavy, r);
        for (int k = 0; k < 10 * seconds; ++k) {
            world.run();
            sum += world.contacts();
        }
    }
    return sum / (10.0 * seconds * static_cast<double>(runs));
}

/// About 7 where robots collide, next to none where they hardly touch.
TEST(ContactsOfThePeer, AreAsManyAsHere) {
    const double here = contactsHere(20, true), there = contactsThere(20, true);
    EXPECT_NEAR(here, 7, 1);
    EXPECT_NEAR(there, 7, 1);
    EXPECT_NEAR(here / there, 1, 0.2);
    EXPECT_LT(contactsHere(5, false), 0.4);
    EXPECT_LT(contactsThere(5, false), 0.4);
}

}  // namespace
}  // namespace mrose

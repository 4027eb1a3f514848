#include "simulation/rewind_check.h"

#include <gtest/gtest.h>

#include "plugin/load_plugin.h"
#include "plugin/test_plugins.h"
#include "world/state_difference.h"

namespace mrose {
namespace {

std::shared_ptr<const Controller> plugin(const std::string& name, const std::string& options) {
    const auto loaded = loadPlugin(testPlugin(name), options);
    EXPECT_TRUE(loaded) << loaded.error().message();
    return loaded ? *loaded : nullptr;
}

/// What the first tick that cannot be taken back says.
std::vector<RewindDifference> firstHidden(const Scenario& scenario) {
    WorldState state = scenario.initialState();
    StepBuffers buffers;
    StepTrace trace;
    for (int i = 0; i < 50; ++i) {
        auto differences = stepTwice(scenario, state, buffers, trace);
        if (!differences.empty()) return differences;
    }
    return {};
}

TEST(RewindCheck, NamesWhoHidesSomething) {
    const std::string prefix = "its controller decided otherwise when it was asked again: ";
    const struct {
        const char* what;
        std::string said;
    } cases[] = {{"hidden command", prefix + "v 0.3, w "},
                 {"hidden kick", prefix + "other earlier commands or kicks"},
                 {"hidden fault", prefix},
                 {"hidden memory", "its controller remembered something else when it was asked again"}};
    for (const auto& [what, said] : cases) {
        const auto hidden = firstHidden(
            drivenBy({plugin("well_behaved", ""), plugin("misbehaving", how(what, 0.3)), plugin("well_behaved", "")}));
        ASSERT_EQ(hidden.size(), 1u) << what;
        EXPECT_EQ(hidden[0].robot, 1u);
        EXPECT_TRUE(hidden[0].what.starts_with(said)) << hidden[0].what;
    }
}

TEST(RewindCheck, SaysNothingOfHonestOnes) {
    EXPECT_TRUE(firstHidden(drivenBy({plugin("well_behaved", "kicks = true\n"), plugin("well_behaved", "")})).empty());
    // A fault, and what is only to be looked at, may recur.
    EXPECT_TRUE(firstHidden(drivenBy({plugin("misbehaving", how("nan"))})).empty());
    EXPECT_TRUE(firstHidden(drivenBy({plugin("misbehaving", how("hidden note"))})).empty());
}

TEST(RewindCheck, SeesThroughIsolation) {
    const auto apart = isolatePlugin(testPlugin("misbehaving"), how("hidden memory", 0.3), isolation());
    ASSERT_TRUE(apart) << apart.error().message();
    const auto hidden = firstHidden(drivenBy({*apart}));
    ASSERT_EQ(hidden.size(), 1u);
    EXPECT_EQ(hidden[0].robot, 0u);
}

TEST(RewindCheck, StepsAsStepDoes) {
    const Scenario scenario = drivenBy({plugin("well_behaved", ""), plugin("misbehaving", how("throw", 0.2))});
    WorldState checked = scenario.initialState(), plain = checked;
    StepBuffers buffers;
    StepTrace checkedTrace, plainTrace;
    for (int i = 0; i < 50; ++i) {
        stepTwice(scenario, checked, buffers, checkedTrace);
        step(scenario, plain, buffers, {}, &plainTrace);
        const auto difference = firstDifference(checked, plain);
        ASSERT_FALSE(difference) << difference->message();
        EXPECT_EQ(checkedTrace.faults.size(), plainTrace.faults.size());
    }
}

}  // namespace
}  // namespace mrose

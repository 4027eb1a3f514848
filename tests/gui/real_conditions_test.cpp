// Conditions that ask how far the simulated robots are from the real ones, against a walk over every tick.
#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>

#include "debug/plotted_value.h"
#include "gui/rollout_fixture.h"
#include "scripting/window_script.h"

namespace mrose::gui {
namespace {

using testing::HasSubstr;

class RealConditionsTest : public RolloutTest {
protected:
    static double errorIn(const WorldState& state, const Scene& scene, const Reality& real) {
        const Reality::Robot* const robot = real.robotNamed(scene.robots[0].name);
        const auto there = robot->poseAt(scene.timeOf(state.tick));
        return there ? poseError(*there, state.robots[0].pose).position : std::nan("");
    }
    /// At each tick of a rollout.
    std::vector<double> errorsOf(std::size_t rollout) const {
        const auto run = openRollout(*overlay.rollouts().log(), overlay.rollouts().requests()[rollout], false);
        EXPECT_TRUE(run);
        const Scene& scene = run->setup->scene();
        WorldState world = run->start;
        StepBuffers buffers;
        std::vector<double> errors{errorIn(world, scene, *run->reality)};
        while (world.tick < scene.ticksOf(run->setup->scenario->parts().duration)) {
            step(*run->setup->scenario, world, buffers);
            errors.push_back(errorIn(world, scene, *run->reality));
        }
        return errors;
    }
    static double mostOf(const std::vector<double>& errors) { return *std::max_element(errors.begin(), errors.end()); }
    static std::int64_t firstAbove(const std::vector<double>& errors, double bound) {
        return std::find_if(errors.begin(), errors.end(), [&](double error) { return error > bound; }) - errors.begin();
    }
    void stopAbove(double bound) {
        char text[60];
        std::snprintf(text, sizeof text, "robot[1].error > %.17g", bound);
        stopOn(text);
    }
    double shownError() const { return errorIn(state(), window.shown()->frame->scene(), reality()); }
};

TEST_F(RealConditionsTest, ErrorStopsForwardAndInReverse) {
    const std::vector<double> errors = errorsOf(0);
    const double bound = 0.6 * mostOf(errors);
    const std::int64_t first = firstAbove(errors, bound);
    ASSERT_GT(first, 5);
    stopAbove(bound);
    press();
    EXPECT_EQ(shownRollout(), 0u);
    EXPECT_EQ(window.shown()->tick(), first);
    EXPECT_TRUE(window.shown()->atBreak);
    // Of what has been simulated before the question was asked, too.
    const auto end = static_cast<std::int64_t>(errors.size()) - 1;
    window.session().seek(end);
    settleAll();
    stopAbove(bound);
    std::int64_t last = end - 1;
    while (errors[static_cast<std::size_t>(last)] <= bound || errors[static_cast<std::size_t>(last - 1)] > bound)
        --last;
    press(Qt::ShiftModifier);
    EXPECT_EQ(window.shown()->tick(), last);
    EXPECT_GT(shownError(), bound);
}

TEST_F(RealConditionsTest, ErrorIsFoundInTheRolloutThatHasIt) {
    std::vector<std::vector<double>> errors;
    double before = 0;
    std::size_t rollout = 0;
    for (std::size_t i = 0; i < 6; ++i) {
        errors.push_back(errorsOf(i));
        const double most = mostOf(errors.back());
        if (i > 0 && most > 1.05 * before) rollout = i;
        if (rollout > 0) break;
        before = std::max(before, most);
    }
    ASSERT_GT(rollout, 0u) << "a rollout that is worse than those before it";
    const double bound = (before + mostOf(errors[rollout])) / 2;
    stopAbove(bound);
    press();
    EXPECT_EQ(shownRollout(), rollout);
    EXPECT_EQ(window.shown()->tick(), firstAbove(errors[rollout], bound));
    const std::int64_t tick = window.shown()->tick();
    open(rollout + 1);
    // Of the next one only what lies before its first tick.
    press(Qt::ShiftModifier);
    EXPECT_EQ(shownRollout(), rollout);
    EXPECT_GE(window.shown()->tick(), tick);
}

TEST_F(RealConditionsTest, BranchHasTheSameRealRobot) {
    ASSERT_LT(mostOf(errorsOf(0)), 0.8);
    moveAside(0.5);
    ASSERT_EQ(window.shown()->branch, 1u);
    const std::int64_t begin = window.shown()->tick();
    EXPECT_NEAR(shownError(), 1, 0.2);
    window.session().seek(begin + 40);
    settleAll();
    stopOn("robot[1].error > 0.8 and abs(robot[1].real_y - robot[1].y) > 0.8");
    press(Qt::ShiftModifier);
    EXPECT_EQ(window.shown()->branch, 1u);
    EXPECT_EQ(window.shown()->tick(), begin);
    EXPECT_TRUE(window.shown()->atBreak);
}

TEST_F(RealConditionsTest, WithoutTheLogTheyFitNothingUntilItIsBack) {
    const double bound = 0.6 * mostOf(errorsOf(0));
    stopAbove(bound);
    press();
    const std::int64_t first = window.shown()->tick();
    ASSERT_TRUE(window.shown()->atBreak);
    const auto log = window.shown()->frame->reality;
    window.session().setReality(window.shown()->run, nullptr);
    settleAll();
    const BreakpointState& asked = window.shown()->breakpoints[0];
    EXPECT_EQ(asked.unfit, "'error' needs a real log beside the run: none is open (at character 10)");
    EXPECT_EQ(asked.hits, 0);
    window.session().seek(0);
    window.session().setReality(window.shown()->run, log);
    settleAll();
    EXPECT_EQ(window.shown()->breakpoints[0].unfit, "");
    press();
    EXPECT_EQ(window.shown()->tick(), first);
    EXPECT_EQ(window.shown()->breakpoints[0].hits, 1);
}

TEST_F(RealConditionsTest, ScriptsAndPlotsKnowThemToo) {
    window.session().seek(ticksOf(1.5));
    settleAll();
    const double error = shownError();
    ASSERT_GT(error, 0);
    std::string words;
    const ScriptOutput output{[&](const std::string& text) { words += text; },
                              [&](const std::string& text) { words += text; }};
    char text[200];
    std::snprintf(text, sizeof text,
                  "expect(robot[1].error == %.17g) expect(abs(robot[1].real_x - robot[1].x) <= robot[1].error)\n"
                  "run_until('robot[1].error ~= %.17g', 1) say(tick)",
                  error, error);
    const auto outcome = runScript(window.scripted(), text, "s.lua", output);
    ASSERT_TRUE(outcome) << outcome.error().message();
    EXPECT_EQ(outcome->failed, 0);
    EXPECT_EQ(words, std::to_string(ticksOf(1.5) + 1));
    const auto value =
        plottedValue(*window.shown()->frame->scenario, {expressionQuantity, "", "100 * robot[1].error", "cm"});
    ASSERT_TRUE(value) << value.error().message();
    EXPECT_DOUBLE_EQ(value->read(window.shown()->frame->moment()), 100 * shownError());
    FieldFrame alone = *window.shown()->frame;
    alone.reality = nullptr;
    EXPECT_TRUE(std::isnan(value->read(alone.moment())));
}

}  // namespace
}  // namespace mrose::gui

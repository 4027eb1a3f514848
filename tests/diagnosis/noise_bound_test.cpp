#include "diagnosis/noise_bound.h"

#include <cmath>
#include <memory>

#include <gtest/gtest.h>

#include "assessment/test_models.h"
#include "support/places.h"

namespace mrose {
namespace {

using At = DivergenceBound::At;

constexpr Nanoseconds between = 100 * ms, held = 300 * ms;
constexpr int tenSeconds = 100;

/// A Create of a kind that no log knew, as it moves in the simulator.
LearnedModel shippedCreate() {
    return {std::make_shared<const LearnedMotion>(*loadNetwork(sourceFolder() / "nets/create.net")), "another"};
}

/// Something new every 0.7 s, as the robots of the logs are driven, and everything `times` as fast.
Trajectory drivenTrajectory(int number, double times = 1) {
    return obedientTrajectory(0, 14 * second, [number, times](double t) {
        const auto turn = static_cast<int>(t / 0.7) + 31 * number;
        return turn % 4 == 0 ? Command{0.1 * times, 0}
                             : Command{times * (0.05 + 0.03 * (turn % 3)), times * 0.25 * (turn % 5 - 2)};
    });
}

/// `truth`: of the steps, from the start on. The simulated robot moves as the mean.
ComparedRollout comparedWith(const Trajectory& trajectory, const std::vector<Pose>& truth, const LearnedModel& model) {
    const RolloutStart start{&trajectory, 3 * second, {}, StampedVelocity{3 * second, {}}, tenSeconds};
    ComparedRollout rollout;
    rollout.real.start = start.time;
    rollout.real.measuredVelocity = start.velocity;
    rollout.simulated = rollOut(*model.drawn(MotionDraw::mean), {&start, 1})->front();
    rollout.real.truth = {Pose{}};
    rollout.real.truth.insert(rollout.real.truth.end(), truth.begin(), truth.end());
    rollout.errors = windowErrors(rollout.real.truth, rollout.simulated);
    return rollout;
}

/// So many runs of the robot itself.
std::vector<std::vector<Pose>> ownRuns(const Trajectory& trajectory, const LearnedModel& model, std::size_t count) {
    std::vector<RolloutStart> starts(count, {&trajectory, 3 * second, {}, StampedVelocity{3 * second, {}}, tenSeconds});
    for (std::size_t i = 0; i < count; ++i) {
        starts[i].body = static_cast<std::uint32_t>(i);
        starts[i].seed = 4711;
    }
    return *rollOut(*model.drawn(MotionDraw::noisy), starts);
}

TEST(NoiseBound, OneInAHundredOfARobotsOwnRunsLeaves) {
    const LearnedModel model = shippedCreate();
    int left = 0, all = 0, leftHalf = 0;
    for (int number = 0; number < 8; ++number) {
        const Trajectory trajectory = drivenTrajectory(number);
        std::optional<DivergenceBound> bound;
        for (const std::vector<Pose>& run : ownRuns(trajectory, model, 125)) {
            const ComparedRollout rollout = comparedWith(trajectory, run, model);
            if (!bound) bound = noiseBound(model, trajectory, rollout, between, held);
            DivergenceBound half = *bound;
            for (At& at : half.bySteps) at = {at.position / 2, at.heading / 2};
            ++all;
            left += firstDivergence(rollout, between, *bound).has_value();
            leftHalf += firstDivergence(rollout, between, half).has_value();
        }
    }
    EXPECT_LE(left, all / 50);
    EXPECT_GE(left, all / 1000);
    EXPECT_GE(leftHalf, all / 10);
}

TEST(NoiseBound, ARobotThatIsFasterThanItsKindLeaves) {
    const LearnedModel model = shippedCreate();
    for (int number = 0; number < 5; ++number) {
        const Trajectory trajectory = drivenTrajectory(number);
        ComparedRollout rollout = comparedWith(trajectory, ownRuns(trajectory, model, 1).front(), model);
        const DivergenceBound bound = noiseBound(model, trajectory, rollout, between, held);
        EXPECT_FALSE(firstDivergence(rollout, between, bound)) << number;
        rollout = comparedWith(trajectory, ownRuns(drivenTrajectory(number, 1.6), model, 1).front(), model);
        EXPECT_TRUE(firstDivergence(rollout, between, bound))
            << number << ": " << rollout.errors.positionFinal << " m off, beyond " << bound.bySteps.back().position;
    }
}

TEST(NoiseBound, OfARobotAtRestOnlyTheTrackersNoiseRemains) {
    const LearnedModel model = shippedCreate();
    const Trajectory still = obedientTrajectory(0, 14 * second, [](double) { return Command{}; });
    const ComparedRollout rollout = comparedWith(still, std::vector<Pose>(tenSeconds), model);
    const DivergenceBound bound = noiseBound(model, still, rollout, between, held);
    ASSERT_EQ(bound.bySteps.size(), static_cast<std::size_t>(tenSeconds));
    EXPECT_EQ(bound.held, held);
    EXPECT_EQ(bound.bySteps.front(), NoiseBoundOptions{}.least);
    EXPECT_LT(bound.bySteps.back().position, 0.02);
}

TEST(NoiseBound, IsTheSameAgainAndGrows) {
    const LearnedModel model = shippedCreate();
    const Trajectory trajectory = drivenTrajectory(1);
    const ComparedRollout rollout = comparedWith(trajectory, ownRuns(trajectory, model, 1).front(), model);
    const DivergenceBound bound = noiseBound(model, trajectory, rollout, between, held);
    EXPECT_EQ(bound.bySteps, noiseBound(model, trajectory, rollout, between, held).bySteps);
    EXPECT_GT(bound.bySteps[99].position, 2 * bound.bySteps[19].position);
    NoiseBoundOptions wary;
    wary.leaving = 0.1;
    EXPECT_LT(noiseBound(model, trajectory, rollout, between, held, wary).bySteps[99].position,
              bound.bySteps[99].position);
}

}  // namespace
}  // namespace mrose

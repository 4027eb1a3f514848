#include "identification/network_trainer.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include "identification/driven_log.h"
#include "identification/recipes.h"
#include "learning/initial_weights.h"
#include "motion/kinematic.h"
#include "motion/learned_model.h"
#include "support/units.h"
#include "world/noise.h"

namespace mrose {
namespace {

KinematicParameters laggedRobot() {
    KinematicParameters p;
    p.v = {0.12, 0.1, 0.9, 0, 0, 0};
    p.w = {0.12, 0.15, 0.95, 0, 0, 0};
    return p;
}

const ResponseTimes times{0.12, 0.1, 0.12, 0.15, 0.1, 0.15};

struct Planted {
    std::vector<Log> logs;
    MotionNetwork blueprint;
    MotionSamples samples;

    explicit Planted(MotionNetwork network) : blueprint(std::move(network)) {
        logs.push_back(drivenLog(KinematicModel(laggedRobot(), 20 * ms), 12, 30, 11));
        SampleOptions options;
        options.phases = 1;
        samples = *motionSamples(logs, blueprint, options);
    }
};

const Planted& plantedHistory() {
    static const Planted planted(historyBlueprint(RobotTraits{"test", {}, 0, false}, {"1"}, times));
    return planted;
}
const Planted& plantedPaper() {
    static const Planted planted(paperBlueprint(RobotTraits{"test", {}, 0, false}, {"1"}, times));
    return planted;
}

NetworkTrainerOptions quick(LearningLoss loss) {
    NetworkTrainerOptions options;
    options.loss = loss;
    options.hidden = 8;
    options.members = 2;
    options.epochs = 30;
    options.rolloutLength = 6;
    return options;
}

TEST(RolloutBatch, BackpropagationThroughTimeEqualsDirectionalDifferences) {
    const Planted& p = plantedPaper();
    MotionNetwork network = p.blueprint;
    for (NetworkInput& input : network.inputs) input.scale = 0.3;
    network.outputs.assign(5, {0.01, 0.03});
    const MlpGradient engine({4, 6, 5});
    const RolloutBatch batch(p.samples, network, {3, 40, 77, 200}, 8);
    std::vector<float> parameters = randomMlp({4, 6, 5}, {.seed = 3}).parameters;
    std::vector<double> gradient(parameters.size()), unused(parameters.size());
    const RolloutLoss loss;
    batch.lossAndGradient(engine, parameters, loss, gradient);
    for (std::uint32_t direction = 0; direction < 5; ++direction) {
        auto above = parameters, below = parameters;
        double expected = 0;
        for (std::size_t i = 0; i < parameters.size(); ++i) {
            const double d = normalNoise({8, std::int64_t(i), direction, 0});
            above[i] = static_cast<float>(parameters[i] + 1e-3 * d);
            below[i] = static_cast<float>(parameters[i] - 1e-3 * d);
            expected += gradient[i] * (double(above[i]) - double(below[i]));
        }
        const double difference =
            batch.lossAndGradient(engine, above, loss, unused) - batch.lossAndGradient(engine, below, loss, unused);
        EXPECT_NEAR(difference, expected, 0.01 * std::abs(expected) + 1e-7) << direction;
    }
}

class RolloutBatchOfBothForms : public testing::TestWithParam<MotionNetwork::Form> {};

TEST_P(RolloutBatchOfBothForms, DrivesLikeTheModelThatIsUsed) {
    const bool state = GetParam() == MotionNetwork::Form::state;
    const Planted& p = state ? plantedPaper() : plantedHistory();
    NetworkTrainerOptions options = quick(state ? LearningLoss::oneStep : LearningLoss::rollout);
    options.members = 1;
    const auto summary = trainNetwork(p.blueprint, p.samples, options);
    ASSERT_TRUE(summary);
    const MotionNetwork& network = summary->network;
    const MlpGradient engine(network.mlp.shape);
    const std::size_t first = p.samples.runs[1].first;
    const RolloutBatch batch(p.samples, network, {first}, 30);
    const std::vector<Pose> increments = batch.predict(engine, network.mlp.parameters);
    const LearnedModel model(std::make_shared<const LearnedMotion>(network), "1");
    CommandHistory history;
    std::size_t issued = 0;
    Velocity velocity = p.samples.samples[first].before;
    // The history form starts as its commands say; without that it would recover from the difference first.
    LearnedMotion::Memory memory{velocity, 1};
    const Trajectory& trajectory = p.logs[0].robots[0].trajectories[1];
    for (std::size_t k = 0; k < 30; ++k) {
        const Nanoseconds start = p.samples.samples[first + k].start;
        for (; trajectory.commands[issued].time <= start; ++issued)
            history.issue(trajectory.commands[issued].time, trajectory.commands[issued].command);
        const MotionStep step =
            model.predictOne({&history, start, velocity, std::as_writable_bytes(std::span(&memory, 1))});
        velocity = step.velocity;
        EXPECT_NEAR(step.increment.x, increments[k].x, 1e-5);
        EXPECT_NEAR(step.increment.heading, increments[k].heading, 1e-5);
    }
}

INSTANTIATE_TEST_SUITE_P(Forms, RolloutBatchOfBothForms,
                         testing::Values(MotionNetwork::Form::state, MotionNetwork::Form::history),
                         [](const auto& instance) {
                             return instance.param == MotionNetwork::Form::state ? "State" : "History";
                         });

TEST(TrainNetwork, HistoryFormLearnsALaggedRobotOpenLoop) {
    const Planted& p = plantedHistory();
    NetworkTrainerOptions options = quick(LearningLoss::rollout);
    options.hidden = 16;
    options.epochs = 400;
    const auto summary = trainNetwork(p.blueprint, p.samples, options);
    ASSERT_TRUE(summary);
    // The robot is linear, so a network can follow it closely; velocity = command is off by some 10 %.
    EXPECT_LT(summary->network.heldOut.position, 1.5);
    EXPECT_LT(summary->network.heldOut.heading, 1.5);
    EXPECT_GT(summary->network.heldOut.windows, 10);
}

TEST(TrainNetwork, PapersNetworkLearnsALaggedRobotByEveryMethod) {
    const Planted& p = plantedPaper();
    for (const TrainingMethod method :
         {TrainingMethod::irpropPlus, TrainingMethod::irpropMinus, TrainingMethod::rpropPlus,
          TrainingMethod::rpropMinus, TrainingMethod::levenbergMarquardt}) {
        NetworkTrainerOptions options = quick(LearningLoss::oneStep);
        options.method = method;
        options.members = 1;
        options.epochs = method == TrainingMethod::levenbergMarquardt ? 40 : 500;
        const auto summary = trainNetwork(p.blueprint, p.samples, options);
        ASSERT_TRUE(summary);
        EXPECT_LT(summary->network.heldOut.position, 5) << summary->network.training.method;
        EXPECT_LT(summary->network.heldOut.heading, 5) << summary->network.training.method;
    }
}

TEST(TrainNetwork, SameSeedGivesTheSameFileWhateverTheThreads) {
    for (const LearningLoss loss : {LearningLoss::rollout, LearningLoss::oneStep}) {
        const auto& planted = loss == LearningLoss::rollout ? plantedHistory() : plantedPaper();
        std::string texts[3];
        int i = 0;
        for (const int threads : {1, 2, 8}) {
            const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, std::size_t(threads));
            tbb::task_arena arena(threads);
            arena.execute([&] {
                texts[i++] = networkText(trainNetwork(planted.blueprint, planted.samples, quick(loss))->network);
            });
        }
        EXPECT_EQ(texts[0], texts[1]);
        EXPECT_EQ(texts[0], texts[2]);
    }
}

TEST(TrainNetwork, AnotherSeedGivesAnotherNetwork) {
    NetworkTrainerOptions options = quick(LearningLoss::oneStep);
    const auto first = trainNetwork(plantedPaper().blueprint, plantedPaper().samples, options);
    options.seed = 2;
    const auto second = trainNetwork(plantedPaper().blueprint, plantedPaper().samples, options);
    EXPECT_NE(first->network.mlp.parameters, second->network.mlp.parameters);
}

TEST(TrainNetwork, KnowsItsMembers) {
    const Planted& p = plantedHistory();
    const auto learn = [&](int members) {
        NetworkTrainerOptions options = quick(LearningLoss::rollout);
        options.members = members;
        return trainNetwork(p.blueprint, p.samples, options)->network;
    };
    const MotionNetwork alone = learn(1), both = learn(2);
    EXPECT_TRUE(alone.members.empty());
    ASSERT_EQ(both.members.size(), 2u);
    // The first member was learned as if it were alone; the velocities at start and end are fitted to all.
    const Mlp first = memberOf(both.mlp, both.members, 0);
    EXPECT_EQ(first.shape.outputs, 3);
    const auto common = static_cast<std::ptrdiff_t>(8 * (both.inputs.size() + 1) + 3 * 8);
    EXPECT_TRUE(std::equal(first.parameters.begin(), first.parameters.begin() + common, alone.mlp.parameters.begin()));
    EXPECT_TRUE(std::equal(first.parameters.end() - 3, first.parameters.end(), alone.mlp.parameters.end() - 7));
    const auto read = parseNetwork(networkText(both), "n.net");
    ASSERT_TRUE(read) << read.error().message();
    EXPECT_TRUE(*read == both);
}

TEST(TrainNetwork, CancelledGivesTheBestNetworkSoFar) {
    const Planted& p = plantedHistory();
    int calls = 0;
    OpenLoopError best;
    const auto summary =
        trainNetwork(p.blueprint, p.samples, quick(LearningLoss::rollout), [&](const NetworkProgress& progress) {
            best = progress.heldOut;
            return ++calls < 2;
        });
    ASSERT_TRUE(summary);
    EXPECT_TRUE(summary->cancelled);
    EXPECT_EQ(calls, 2);
    EXPECT_EQ(summary->network.heldOut.position, best.position);
    EXPECT_TRUE(parseNetwork(networkText(summary->network), "n.net"));
}

TEST(TrainNetwork, RecoversFromAWrongStartVelocityWithTheLagOfItsFile) {
    const Planted& p = plantedHistory();
    NetworkTrainerOptions options = quick(LearningLoss::rollout);
    options.epochs = 200;
    const auto summary = trainNetwork(p.blueprint, p.samples, options);
    const LearnedModel model(std::make_shared<const LearnedMotion>(summary->network), "1");
    CommandHistory history;
    history.issue(0, {0.3, 0.2});
    for (const auto& [dv, dw] : {std::pair{0.05, 0.3}, {-0.05, -0.3}}) {
        MotionStep right, wrong;
        right.velocity = {0.27, 0.19};
        LearnedMotion::Memory rightMemory{right.velocity, 1}, wrongMemory = rightMemory;
        const auto bytes = [](LearnedMotion::Memory& memory) { return std::as_writable_bytes(std::span(&memory, 1)); };
        wrong.velocity = {0.27 + dv, 0.19 + dw};
        double ahead = 0, turned = 0;
        for (int k = 0; k < 10; ++k) {
            const Nanoseconds start = 2'000 * ms + k * 100 * ms;
            right = model.predictOne({&history, start, right.velocity, bytes(rightMemory)});
            wrong = model.predictOne({&history, start, wrong.velocity, bytes(wrongMemory)});
            ahead += wrong.increment.x - right.increment.x;
            turned += wrong.increment.heading - right.increment.heading;
        }
        // First order: the disturbance decays by exp(-t/lag) and has moved the robot by lag times itself.
        EXPECT_NEAR(wrong.velocity.v - right.velocity.v, dv * std::exp(-1 / times.lagV), 1e-6);
        EXPECT_NEAR(wrong.velocity.w - right.velocity.w, dw * std::exp(-1 / times.lagW), 1e-6);
        EXPECT_NEAR(ahead, dv * times.lagV * (1 - std::exp(-1 / times.lagV)), 1e-6);
        EXPECT_NEAR(turned, dw * times.lagW * (1 - std::exp(-1 / times.lagW)), 1e-6);
    }
}

TEST(TrainNetwork, TooShortLogsAreAnError) {
    const Planted& p = plantedHistory();
    MotionSamples few = p.samples;
    few.runs.resize(1);
    const auto summary = trainNetwork(p.blueprint, few, quick(LearningLoss::rollout));
    ASSERT_FALSE(summary);
    EXPECT_THAT(summary.error().message(), testing::HasSubstr("too short"));
    EXPECT_THAT(summary.error().message(), testing::EndsWith("or more of them, or fewer parts (--folds)"));
    few.folds = leastFolds;
    for (SampleRun& run : few.runs) run.fold %= leastFolds;
    EXPECT_THAT(trainNetwork(p.blueprint, few, quick(LearningLoss::rollout)).error().message(),
                testing::EndsWith("expected longer logs, or more of them"));
}

TEST(MotionSamples, TrackerOffsetIsFoundAndRemoved) {
    MotionSamples samples = plantedPaper().samples;
    const TrackerOffset planted{0.03, -0.02};
    for (MotionSample& s : samples.samples) s.increment.y += planted.sideways(s.increment);
    const auto offsets = removeTrackerOffsets(samples);
    ASSERT_EQ(offsets.size(), 1u);
    EXPECT_NEAR(offsets[0].ahead, planted.ahead, 2e-3);
    EXPECT_NEAR(offsets[0].rotated, planted.rotated, 2e-3);
    const MotionSamples& body = plantedPaper().samples;
    for (std::size_t i = 0; i < samples.samples.size(); ++i)
        EXPECT_NEAR(samples.samples[i].increment.y, body.samples[i].increment.y, 3e-4);
}

MotionNetwork limited(const RobotTraits& traits, std::vector<std::string> robots, const ResponseTimes& response) {
    ResponseTimes known = response;
    known.limits = {0.5, 4, 0.45, 0.17};
    return stateBlueprint(traits, std::move(robots), known);
}

/// However far a model reads back; the velocity model reads farther than a second.
TEST(MotionSamples, HistoryOfAPatternNeverReachesIntoAnotherFold) {
    const std::vector<Log> logs{drivenLog(KinematicModel(laggedRobot(), 20 * ms), 1, 200, 5)};
    for (const auto blueprint : {&historyBlueprint, &stateBlueprint, &velocityBlueprint, &paperBlueprint, &limited}) {
        const MotionNetwork network = blueprint(RobotTraits{"test", {}, 0, false}, {"1"}, times);
        SampleOptions options;
        options.block = 20;
        const auto samples = motionSamples(logs, network, options);
        ASSERT_TRUE(samples);
        const Nanoseconds memory = InputReader(network).lookBack();
        int folds = 0;
        for (const SampleRun& a : samples->runs) {
            folds |= 1 << a.fold;
            for (const SampleRun& b : samples->runs) {
                if (a.fold == b.fold) continue;
                const Nanoseconds begin = samples->samples[a.first].start - memory;
                const Nanoseconds end = samples->samples[b.first + b.count - 1].start + 100 * ms;
                const bool disjoint =
                    begin >= end || samples->samples[a.first + a.count - 1].start <= samples->samples[b.first].start;
                EXPECT_TRUE(disjoint) << toSeconds(memory);
            }
        }
        EXPECT_EQ(folds, 0b1111);
    }
}

TEST(MotionSamples, ABlockLosesASecondOrWhatThePatternsReadBack) {
    const std::vector<Log> logs{drivenLog(KinematicModel(laggedRobot(), 20 * ms), 1, 200, 5)};
    for (const auto& [blueprint, lost] : {std::pair{&stateBlueprint, 1.0 + 0.1},
                                          {&historyBlueprint, 1.2 + 0.1},
                                          {&velocityBlueprint, 1.4 + 0.1},
                                          {&limited, 0.3 + 2.4 + 0.1}}) {
        SampleOptions options;
        options.block = 20;
        options.phases = 1;
        const auto samples = motionSamples(logs, blueprint(RobotTraits{"test", {}, 0, false}, {"1"}, times), options);
        ASSERT_TRUE(samples);
        const Nanoseconds begin = samples->samples.front().start;  // of the first block
        for (const SampleRun& run : samples->runs) {
            const double since = toSeconds(samples->samples[run.first].start - begin);
            if (since == 0) continue;
            EXPECT_NEAR(std::fmod(since, 20), lost, 1e-9);
        }
        EXPECT_EQ(samples->runs.size(), 10u);
    }
}

TEST(MotionSamples, NoPatternReadsBackBeyondTheFirstCommand) {
    ResponseTimes late = times;
    late.deadTimeV = late.deadTimeW = 0.8;
    const RobotTraits traits{"test", {}, 0, false};
    for (const auto& [network, memory] :
         {std::pair{velocityBlueprint(traits, {"1"}, late), 2000 * ms}, {limited(traits, {"1"}, times), 2700 * ms}}) {
        ASSERT_EQ(InputReader(network).lookBack(), memory);
        for (const double seconds : {8.0, 30.0}) {
            const std::vector<Log> logs{drivenLog(KinematicModel(laggedRobot(), 20 * ms), 1, seconds, 5)};
            const auto samples = motionSamples(logs, network, {});
            ASSERT_TRUE(samples);
            EXPECT_EQ(samples->samples.front().start, memory) << "the first command is of the instant 0";
        }
    }
}

TEST(MotionSamples, LogWithoutGroundTruthIsAnError) {
    std::vector<Log> logs;
    logs.push_back(drivenLog(KinematicModel(laggedRobot(), 20 * ms), 1, 20, 5));
    logs[0].robots[0].trajectories[0].poses.clear();
    const auto samples = motionSamples(logs, plantedPaper().blueprint, {});
    ASSERT_FALSE(samples);
    EXPECT_THAT(samples.error().message(), testing::HasSubstr("planted: "));
}

}  // namespace
}  // namespace mrose

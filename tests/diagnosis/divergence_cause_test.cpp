#include "diagnosis/divergence_cause.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <memory>

#include <gtest/gtest.h>

#include "assessment/played_scenarios.h"
#include "assessment/test_models.h"
#include "assessment/tracker_history.h"
#include "diagnosis/command_jumps.h"
#include "diagnosis/compared_divergences.h"
#include "diagnosis/divergence_text.h"
#include "diagnosis/planted_logs.h"
#include "diagnosis/rollout_rerun.h"
#include "learning/parallel_for.h"
#include "motion/kinematic.h"
#include "support/places.h"
#include "support/units.h"

namespace mrose {
namespace {

/// What is said of one planted log; nullopt: it does not diverge.
std::optional<Diagnosis> diagnosed(const PlantedLog& planted) {
    const auto world = LogWorld::create(planted.parts, std::make_shared<const Log>(planted.log));
    if (!world) return std::nullopt;
    const auto comparison = compare(*world, {&planted.request, 1});
    if (!comparison) return std::nullopt;
    const ComparedRollout& rollout = comparison->rollouts.front();
    DiagnosisOptions options;
    options.bound = planted.bound;
    options.models = planted.models;
    const auto divergence = firstDivergence(rollout, options.step, options.bound);
    if (!divergence) return std::nullopt;
    auto diagnosis = diagnose(*world, planted.request, rollout, *divergence, options);
    return diagnosis ? std::optional(std::move(*diagnosis)) : std::nullopt;
}

constexpr int none = 7;  // after the causes
constexpr std::size_t wanted = 50, attempts = 100;

/// How often each cause was named for logs of one kind.
struct Named {
    std::array<std::size_t, none + 1> causes{};
    std::size_t diverged = 0, made = 0;
};

Named namedFor(Planted kind) {
    std::vector<std::optional<Diagnosis>> diagnoses(attempts);
    parallelFor(attempts, [&](std::size_t i) { diagnoses[i] = diagnosed(plantedLog(kind, i)); });
    Named named;
    for (const auto& diagnosis : diagnoses) {
        if (named.diverged == wanted) break;
        ++named.made;
        if (!diagnosis) continue;
        ++named.diverged;
        const int cause = diagnosis->likely ? static_cast<int>(diagnosis->trials[*diagnosis->likely].kind) : none;
        ++named.causes[static_cast<std::size_t>(cause)];
    }
    return named;
}

TEST(DivergenceCause, IsNamedWherePlantedAndNoOtherwise) {
    std::printf("%-18s%8s%8s", "synthetic, planted", "made", "diverged");
    for (int cause = 0; cause < none; ++cause) std::printf("%23s", name(static_cast<CauseKind>(cause)));
    std::printf("%15s\n", "none of these");
    for (int kind = 0; kind < plantedKinds; ++kind) {
        const auto planted = static_cast<Planted>(kind);
        const Named named = namedFor(planted);
        std::printf("%-18s%8zu%8zu", name(planted), named.made, named.diverged);
        for (int cause = 0; cause <= none; ++cause)
            std::printf("%*zu", cause == none ? 15 : 23, named.causes[static_cast<std::size_t>(cause)]);
        std::printf("\n");
        const auto right = static_cast<std::size_t>(causeOf(planted) ? static_cast<int>(*causeOf(planted)) : none);
        EXPECT_EQ(named.diverged, wanted) << name(planted);
        EXPECT_GE(10 * named.causes[right], 9 * named.diverged) << name(planted);
    }
}

/// A planted log, compared, with what it needs to be diagnosed.
struct PlantedRollout {
    std::unique_ptr<const PlantedLog> planted;
    LogWorld world;
    Comparison comparison;
    DiagnosisOptions options;

    explicit PlantedRollout(PlantedLog made)
        : planted(std::make_unique<const PlantedLog>(std::move(made))),
          world(*LogWorld::create(planted->parts, std::make_shared<const Log>(planted->log))),
          comparison(*compare(world, {&planted->request, 1})) {
        options.bound = planted->bound;
        options.models = planted->models;
    }
    const ComparedRollout& rollout() const { return comparison.rollouts.front(); }
    Divergence divergence() const { return *firstDivergence(rollout(), options.step, options.bound); }
    Expected<Diagnosis> diagnosis() const {
        return diagnose(world, planted->request, rollout(), divergence(), options);
    }
    RolloutRerun rerun(int steps) const { return {world, planted->request, rollout(), options.step, steps, 1}; }
};

/// The first planted log of a kind that diverges.
PlantedRollout firstOf(Planted kind) {
    for (std::uint64_t number = 0;; ++number) {
        PlantedRollout compared(plantedLog(kind, number));
        if (firstDivergence(compared.rollout(), compared.options.step, compared.options.bound)) return compared;
    }
}

TEST(RolloutRerun, IsTheRolloutItselfWhereNothingIsChanged) {
    const PlantedRollout compared = firstOf(Planted::noise);
    const ComparedRollout& rollout = compared.rollout();
    const RolloutRerun rerun = compared.rerun(40);
    const std::vector<Pose> same(rollout.simulated.begin(), rollout.simulated.begin() + 40);
    EXPECT_EQ(rerun.later(0), same);
    EXPECT_EQ(rerun.obeying({}), same);
    RolloutStart start{&rerun.trajectory(), rollout.real.start, rollout.real.measuredPose,
                       rollout.real.measuredVelocity};
    fillVelocities(rerun.model(), {&start, 1});
    EXPECT_EQ(rerun.startingAt(start.velocity->velocity), same);
    EXPECT_EQ(rerun.untouched(), same) << "there is nothing to touch";
    EXPECT_EQ(rerun.movedBy(compared.planted->parts.scene.models[0]), same);
    EXPECT_NE(rerun.later(rerun.tick()), same);
    EXPECT_NE(rerun.noisy(noiseOf(rerun.model()), 2), same);
}

TEST(RolloutRerun, LaterCommandsAreTheSameDriveLater) {
    // A robot at rest that is told to go: with commands 0.2 s later it is where it was 0.2 s before.
    Trajectory trajectory;
    for (Nanoseconds t = 0; t <= 10 * second; t += 20 * ms) trajectory.poses.push_back({t, {}});
    for (int i = 0; i < 100; ++i) trajectory.commands.push_back({i * 100 * ms, {i < 50 ? 0 : 0.4, i < 70 ? 0 : 1.0}});
    PlantedLog planted = plantedLog(Planted::push, 0);
    planted.log.robots[0].trajectories = {trajectory};
    planted.request = {0, 4 * second, 50};
    planted.parts.scene.models[0] = withNoise(planted.parts.scene.models[0], {});
    const PlantedRollout compared(std::move(planted));
    const auto same = compared.rerun(50).later(0), later = compared.rerun(50).later(200 * ms);
    for (std::size_t k = 2; k < 50; ++k) {
        EXPECT_NEAR(later[k].x, same[k - 2].x, 1e-9) << k;
        EXPECT_NEAR(later[k].heading, same[k - 2].heading, 1e-9) << k;
    }
}

/// What it follows where it begins is told from the changed commands, and where its tracked point lies from the other
/// model.
TEST(RolloutRerun, OfADriveThatRampsIsThePredictionWithTheSameChange) {
    auto network = loadNetwork(sourceFolder() / "nets" / "pioneer.net");
    ASSERT_TRUE(network) << network.error().message();
    network->limits = {0.3, 3, 0.5, 0.18, 0.5};
    const auto modelOf = [](const MotionNetwork& of) {
        return std::make_shared<const LearnedModel>(std::make_shared<const LearnedMotion>(of), "any");
    };
    const auto model = modelOf(*network);
    network->limits.accelerationV = 0.6;
    const auto other = modelOf(*network);
    Trajectory driven = obedientTrajectory(0, 30 * second, [](double t) {
        return Command{std::fmod(t, 1.7) < 0.8 ? 0.5 : -0.1, std::sin(7 * t)};
    });
    for (StampedPose& pose : driven.poses) pose.pose = pose.pose * Pose{0.05, 0, 0};
    const Log log = logOf({driven});
    const auto world = LogWorld::create(playersOf(log, model), std::make_shared<const Log>(log));
    ASSERT_TRUE(world) << world.error().message();
    const RolloutRequest request{0, 20 * second + 271'828'182, 40};
    const auto comparison = compare(*world, {&request, 1});
    ASSERT_TRUE(comparison) << comparison.error().message();
    const RolloutRerun rerun(*world, request, comparison->rollouts[0], RolloutOptions{}.step, 40, 1);
    const auto predicted = [&](const MotionModel& by, Nanoseconds later) {
        auto start = *measureStart(rerun.trajectory(), request.start, 40);
        fillTracked(by, {&start, 1});
        Trajectory changed = rerun.trajectory();
        for (StampedCommand& command : changed.commands) command.time += later;
        start.trajectory = &changed;
        return rollOut(by, {&start, 1})->front();
    };
    EXPECT_EQ(rerun.later(0), predicted(*model, 0));
    EXPECT_EQ(rerun.later(400 * ms), predicted(*model, 400 * ms));
    EXPECT_EQ(rerun.movedBy(other), predicted(*other, 0));
    EXPECT_NE(rerun.movedBy(other), rerun.later(0));
}

TEST(RolloutRerun, HoldingTheCommandBeforeIsTheSameDriveLater) {
    // A robot that drives straight on at 4 s and is told to turn at 6.5 s: turning 0.2 s later it is where it would
    // have turned had that command come 0.2 s later, and the same where it is told in two parts.
    Trajectory trajectory;
    for (Nanoseconds t = 0; t <= 10 * second; t += 20 * ms) trajectory.poses.push_back({t, {}});
    for (int i = 0; i < 100; ++i) trajectory.commands.push_back({i * 100 * ms, {0.4, i < 65 ? 0.0 : 1.0}});
    Trajectory late = trajectory;
    late.commands[65].command.w = late.commands[66].command.w = 0;
    const auto plantedWith = [](const Trajectory& log) {
        PlantedLog planted = plantedLog(Planted::push, 0);
        planted.log.robots[0].trajectories = {log};
        planted.request = {0, 4 * second, 50};
        planted.parts.scene.models[0] = withNoise(planted.parts.scene.models[0], {});
        return PlantedRollout(std::move(planted));
    };
    const PlantedRollout compared = plantedWith(trajectory), latest = plantedWith(late);
    const RolloutRerun rerun = compared.rerun(50);
    const Command straight{0.4, 0}, turning{0.4, 1};
    EXPECT_EQ(rerun.holding(straight, 6500 * ms, 6700 * ms), latest.rollout().simulated);
    EXPECT_EQ(latest.rerun(50).holding(turning, 6500 * ms, 6700 * ms), compared.rollout().simulated) << "sooner";
    EXPECT_EQ(rerun.holding(straight, 5 * second, 5800 * ms), compared.rollout().simulated)
        << "as it is commanded anyway";
    EXPECT_NE(latest.rollout().simulated, compared.rollout().simulated);
}

TEST(CommandJumps, AreCommandsThatChangeNearTheRollout) {
    Trajectory log;
    for (int i = 0; i < 200; ++i) {
        const double creeping = 0.001 * i;
        log.commands.push_back({i * 50 * ms, {i < 100 ? 0.2 : 0.5, (i < 40 ? 0 : i < 130 ? 1 : -1) + creeping}});
    }
    ComparedRollout rollout;
    rollout.real.start = 3 * second;
    const KinematicModel model({.v = {.deadTime = 0.2}, .w = {.deadTime = 0.2}}, 100 * ms);
    const DivergenceBound::At bound{0.1, 0.1};
    const auto timesOf = [&](Nanoseconds divergence) {
        std::vector<Nanoseconds> times;
        for (const CommandJump& jump : commandJumpsNear(log, model, rollout, divergence, bound))
            times.push_back(jump.command.time);
        return times;
    };
    EXPECT_EQ(timesOf(3 * second), (std::vector<Nanoseconds>{5 * second})) << "the first one is past, the last to come";
    EXPECT_EQ(timesOf(4 * second), (std::vector<Nanoseconds>{5 * second, 6500 * ms}));
    rollout.real.start = 2100 * ms;
    const auto jumps = commandJumpsNear(log, model, rollout, second, bound);
    ASSERT_EQ(jumps.size(), 1u) << "one that still acts";
    EXPECT_EQ(jumps[0].command.time, 2 * second);
    EXPECT_EQ(jumps[0].next, 5 * second);
    EXPECT_NEAR(jumps[0].command.command.w - jumps[0].before.w, 1.001, 1e-9);

    // Of many, the largest ones.
    log.commands.clear();
    for (int i = 0; i < 100; ++i) log.commands.push_back({i * 100 * ms, {0, i % 2 == 0 ? 0 : 0.5 + 0.01 * i}});
    rollout.real.start = 0;
    const auto largest = commandJumpsNear(log, model, rollout, 9 * second, bound);
    ASSERT_FALSE(largest.empty());
    EXPECT_LT(largest.size(), 20u);
    EXPECT_GT(largest.front().command.time, 8 * second);
    EXPECT_TRUE(std::is_sorted(largest.begin(), largest.end(), [](const CommandJump& a, const CommandJump& b) {
        return a.command.time < b.command.time;
    }));
}

TEST(RolloutRerun, CarriedOverAGapItKeepsTheErrorFromBefore) {
    const PlantedRollout compared = firstOf(Planted::largerWheels);
    const ComparedRollout& rollout = compared.rollout();
    const auto carried = compared.rerun(40).carried(10, 20);
    ASSERT_EQ(carried.size(), 40u);
    for (std::size_t k = 0; k < 10; ++k) EXPECT_EQ(carried[k], rollout.simulated[k]);
    for (std::size_t k = 10; k < 20; ++k) {
        const Pose real = relative(rollout.real.truth[10], rollout.real.truth[k + 1]),
                   simulated = relative(rollout.simulated[9], carried[k]);
        EXPECT_NEAR(simulated.x, real.x, 1e-9);
        EXPECT_NEAR(simulated.y, real.y, 1e-9);
        EXPECT_NEAR(simulated.heading, real.heading, 1e-9);
    }
    // Then it drives on by itself, at first as fast as the real one.
    const Pose real = relative(rollout.real.truth[20], rollout.real.truth[21]);
    EXPECT_NEAR(relative(carried[19], carried[20]).x, real.x, 0.01);
    EXPECT_NEAR(relative(carried[19], carried[20]).heading, real.heading, 0.03);
}

TEST(Diagnosis, ProgressAscendsAndCancels) {
    PlantedRollout compared = firstOf(Planted::blip);
    std::vector<double> shares;
    compared.options.progress = [&](double share) {
        shares.push_back(share);
        return true;
    };
    const auto whole = compared.diagnosis();
    ASSERT_TRUE(whole) << whole.error().message();
    EXPECT_FALSE(whole->cancelled);
    EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
    EXPECT_LE(shares.back(), 1);
    EXPECT_TRUE(std::is_sorted(whole->trials.begin(), whole->trials.end(),
                               [](const auto& a, const auto& b) { return a.explained > b.explained; }));
    for (const CauseTrial& trial : whole->trials)
        EXPECT_EQ(static_cast<Nanoseconds>(trial.simulated.size()) * compared.options.step, whole->until) << trial.what;

    int goingOn = 3;
    compared.options.progress = [&](double) { return --goingOn > 0; };
    const auto cancelled = compared.diagnosis();
    ASSERT_TRUE(cancelled);
    EXPECT_TRUE(cancelled->cancelled);
    EXPECT_FALSE(cancelled->likely);
    EXPECT_LT(cancelled->trials.size(), whole->trials.size());
}

TEST(Diagnosis, RefusesAModelWhosePeriodDoesNotFit) {
    PlantedRollout compared = firstOf(Planted::largerWheels);
    compared.options.models = {{"odd.net", {std::make_shared<const KinematicModel>(KinematicParameters{}, 30 * ms)}}};
    const auto diagnosis = compared.diagnosis();
    ASSERT_FALSE(diagnosis);
    EXPECT_EQ(diagnosis.error().message(),
              "odd.net: has a period of 0.03 s; expected a whole number of the scenario's ticks of 0.02 s");
}

TEST(Diagnosis, SaysWhatItFound) {
    const auto diagnosis = firstOf(Planted::contact).diagnosis();
    ASSERT_TRUE(diagnosis && diagnosis->likely);
    EXPECT_EQ(causeText(*diagnosis).find("without contact, which explains "), 0u) << causeText(*diagnosis);
    const auto pushed = firstOf(Planted::push).diagnosis();
    ASSERT_TRUE(pushed && !pushed->likely);
    EXPECT_EQ(causeText(*pushed).find("none of these; the best, "), 0u) << causeText(*pushed);
}

TEST(Diagnosis, JumpOfTheTruthIsSaidWithItsExtent) {
    const PlantedRollout compared = firstOf(Planted::truthJump);
    const std::vector<std::size_t>& jumps = compared.rollout().jumps;
    ASSERT_FALSE(jumps.empty());
    // Steps that know of it follow each other; beyond them it drives at most 1 m/s.
    EXPECT_LE(jumps.size(), 4u);
    EXPECT_EQ(jumps.back() - jumps.front() + 1, jumps.size());
    const std::vector<Pose>& truth = compared.rollout().real.truth;
    const auto far = [&](std::size_t from, std::size_t to) {
        return std::hypot(truth[to].x - truth[from].x, truth[to].y - truth[from].y);
    };
    EXPECT_GT(far(jumps.front() - 1, jumps.back()), 0.2);
    for (std::size_t k = 1; k < truth.size(); ++k)
        EXPECT_TRUE(far(k - 1, k) < 0.11 || (k >= jumps.front() && k <= jumps.back())) << k;
    const auto diagnosis = compared.diagnosis();
    ASSERT_TRUE(diagnosis && diagnosis->likely);
    EXPECT_EQ(causeText(*diagnosis).find("carried over the ground truth's jump at "), 0u) << causeText(*diagnosis);
    EXPECT_TRUE(firstOf(Planted::push).rollout().jumps.empty()) << "a robot may have been pushed so far";
}

TEST(Diagnosis, CommandThatChangesInStepsIsOneChange) {
    const auto changes = [](const PlantedLog& planted) {
        const auto diagnosis = diagnosed(planted);
        return !diagnosis ? 0
                          : std::count_if(diagnosis->trials.begin(), diagnosis->trials.end(),
                                          [](const auto& trial) { return trial.kind == CauseKind::command; });
    };
    int compared = 0;
    for (std::uint64_t number = 0; compared < 5; ++number) {
        PlantedLog planted = plantedLog(Planted::singleCommand, number);
        const auto once = changes(planted);
        if (once < 2 || once > 3) continue;
        // Each change begins half of it 20 ms sooner.
        auto& commands = planted.log.robots[0].trajectories[0].commands;
        for (std::size_t i = 1; i < commands.size(); ++i) {
            const Command before = commands[i - 1].command, after = commands[i].command;
            if (std::abs(after.w - before.w) < 0.5) continue;
            const StampedCommand half{commands[i].time - 20 * ms,
                                      {0.5 * (before.v + after.v), 0.5 * (before.w + after.w)}};
            commands.insert(commands.begin() + static_cast<std::ptrdiff_t>(i), half);
            ++i;
        }
        EXPECT_EQ(changes(planted), once) << number;
        ++compared;
    }
}

TEST(Diagnosis, GapOfTheTruthThatBeginsBeforeTheRolloutIsTheCause) {
    // Pushed aside without ground truth: from just before the start until 4.2 s after it.
    PlantedLog planted = plantedLog(Planted::push, 3);
    std::vector<StampedPose>& poses = planted.log.robots[0].trajectories[0].poses;
    const Nanoseconds start = 12'500 * ms;  // of the rollout, on the log's clock
    std::erase_if(
        poses, [&](const StampedPose& pose) { return pose.time > start - 30 * ms && pose.time < start + 4200 * ms; });
    const PlantedRollout compared(std::move(planted));
    ASSERT_FALSE(std::isfinite(compared.rollout().real.truth[0].x));
    const Divergence divergence = compared.divergence();
    EXPECT_TRUE(divergence.unknownBefore);
    EXPECT_EQ(divergence.within, 0);
    EXPECT_NE(divergenceText(divergence).find("; its ground truth is not known since 0.0 s"), std::string::npos);
    const auto diagnosis = compared.diagnosis();
    ASSERT_TRUE(diagnosis && diagnosis->likely);
    EXPECT_EQ(causeText(*diagnosis).find("carried over 4.2"), 0u) << causeText(*diagnosis);
    EXPECT_FALSE(firstOf(Planted::push).divergence().unknownBefore);
}

/// The shipped log of the reference robot, by its network: without noise in the robot's file, its held-out error says
/// what is likely.
TEST(Diagnosis, ErrorsWithinTheHeldOutOnesAreNoise) {
    const Log log = shippedLog();
    const auto world =
        LogWorld::create(playersOf(log, learnedModels(log, "pioneer.net")), std::make_shared<const Log>(log));
    ASSERT_TRUE(world) << world.error().message();
    const auto requests = rolloutsOf(*world, {0, std::nullopt, 10 * second});
    const auto comparison = compare(*world, *requests);
    ASSERT_TRUE(comparison);
    DivergenceOptions options{.bound = {.constant = {0.02, 0.02}}};
    const auto tight = divergencesOf(*world, *comparison, options);
    ASSERT_TRUE(tight) << tight.error().message();
    ASSERT_GT(tight->all.diverging, 5u) << "of a bound so tight";
    std::size_t diagnosed = 0;
    for (const RolloutDivergence& diverging : tight->rollouts) {
        if (!diverging.diagnosis) continue;
        ++diagnosed;
        const ComparedRollout& rollout = comparison->rollouts[diverging.rollout];
        const DivergenceBound likely = heldOutBound(networkOf(*world, 0)->heldOut, rollout, 100 * ms);
        bool within = true;
        for (std::size_t k = 0; k < static_cast<std::size_t>(diverging.diagnosis->until / (100 * ms)); ++k)
            within = within && std::hypot(rollout.errors.position[k] / likely.at(k).position,
                                          rollout.errors.heading[k] / likely.at(k).heading) <= 1;
        const auto& trials = diverging.diagnosis->trials;
        const auto noise = std::find_if(trials.begin(), trials.end(),
                                        [](const CauseTrial& trial) { return trial.kind == CauseKind::noise; });
        ASSERT_NE(noise, trials.end());
        EXPECT_TRUE(!within || noise->explained == 1);
    }
    EXPECT_EQ(diagnosed, tight->all.diverging);
    // By the held-out errors themselves fewer diverge.
    options.fromNetwork = true;
    EXPECT_LT(divergencesOf(*world, *comparison, options)->all.diverging, tight->all.diverging);
}

TEST(ComparedDivergences, AreThoseOfTheRollouts) {
    const Log log = shippedLog();
    const auto world = LogWorld::create(playersOf(log, wearyModel()), std::make_shared<const Log>(log));
    ASSERT_TRUE(world);
    const auto requests = rolloutsOf(*world, {0, std::nullopt, 8 * second});
    const auto comparison = compare(*world, *requests);
    ASSERT_TRUE(comparison);
    DivergenceOptions options;
    options.diagnosed = 2;
    const auto found = divergencesOf(*world, *comparison, options);
    ASSERT_TRUE(found) << found.error().message();
    std::vector<double> times;
    for (std::size_t i = 0; i < comparison->rollouts.size(); ++i) {
        const auto divergence = firstDivergence(comparison->rollouts[i], 100 * ms, options.bound);
        const RolloutDivergence* const here = found->of(i);
        ASSERT_EQ(here != nullptr, divergence.has_value());
        if (!divergence) continue;
        EXPECT_EQ(here->divergence.time, divergence->time);
        times.push_back(toSeconds(divergence->time));
    }
    ASSERT_GT(times.size(), 4u);
    EXPECT_EQ(found->all.diverging, times.size());
    EXPECT_EQ(found->all.rollouts, comparison->rollouts.size() - comparison->all.of(RolloutUse::absent));
    EXPECT_EQ(found->all.medianTime, quantile(times, 0.5));
    EXPECT_NE(found->of(worstFirst(*comparison).front())->diagnosis, std::nullopt) << "the worst rollout first";
    // Plain kinematics have no held-out error: the constants stay.
    EXPECT_EQ(boundSource(*world), BoundSource::constant);
    options.fromNetwork = true;
    const auto constant = divergencesOf(*world, *comparison, options);
    EXPECT_EQ(constant->source, BoundSource::constant);
    EXPECT_EQ(constant->all.diverging, found->all.diverging);
}

}  // namespace
}  // namespace mrose

#include "assessment/sensor_assessment.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "geometry/normal_distribution.h"
#include "support/toy_camera.h"
#include "world/noise.h"

namespace mrose {
namespace {

using testing::HasSubstr;

/// A log that was made by a camera, and models of it.
class SensorAssessments : public testing::Test {
protected:
    SensorEvaluation evaluate(const std::vector<NamedSensor>& models) const {
        auto cases = loggedCases(log_, "camera", {}, {});
        EXPECT_TRUE(cases) << cases.error().message();
        return evaluateSensors(log_, std::move(*cases), models).value();
    }
    std::string objection(const std::string& sensor, const std::vector<std::string>& robots) const {
        const auto cases = loggedCases(log_, sensor, robots, {});
        return cases ? "" : cases.error().message();
    }

    const ToyCamera camera_;
    Log log_ = seenLog(camera_, 600);
};

/// Three standard deviations of a share of so many.
double sampling(double share, std::size_t count) {
    return 3 * std::sqrt(share * (1 - share) / static_cast<double>(count));
}

TEST_F(SensorAssessments, TheModelThatMadeTheLogIsCalibrated) {
    const SensorEvaluation evaluation = evaluate({{"itself", &camera_}});
    const SensorAssessment& itself = evaluation.models[0];
    EXPECT_EQ(evaluation.log.looks.size(), evaluation.log.robots[0].looks);
    ASSERT_GT(itself.all.sound, 2000u);
    EXPECT_EQ(itself.all.sound, itself.all.readings);
    for (std::size_t d = 0; d < readingDimensions; ++d) {
        EXPECT_NEAR(itself.all.error[d].inside50, 0.5, sampling(0.5, itself.all.sound)) << d;
        EXPECT_NEAR(itself.all.error[d].inside90, 0.9, sampling(0.9, itself.all.sound)) << d;
        // even: chi squared with 19 degrees of freedom is below 44 but once in a thousand
        const double each = static_cast<double>(itself.all.sound) / SensorAssessment::belowParts;
        double squares = 0;
        for (const std::size_t count : itself.below[d])
            squares += (static_cast<double>(count) - each) * (static_cast<double>(count) - each) / each;
        EXPECT_LT(squares, 44) << d;
    }
    EXPECT_LT(itself.all.off, sampling(0.5, itself.all.cases / calibrationGroups));
}

TEST_F(SensorAssessments, NoOtherModelScoresBetter) {
    const ToyCamera wide(2), narrow(0.5);
    const SensorEvaluation evaluation = evaluate({{"itself", &camera_}, {"wide", &wide}, {"narrow", &narrow}});
    const SensorScores& itself = evaluation.models[0].all;
    for (std::size_t i : {std::size_t{1}, std::size_t{2}}) {
        const SensorScores& other = evaluation.models[i].all;
        EXPECT_EQ(other.detection, itself.detection);
        EXPECT_LT(other.logDensity, itself.logDensity);
        for (std::size_t d = 0; d < readingDimensions; ++d) {
            EXPECT_GT(other.error[d].crps, itself.error[d].crps);
            EXPECT_EQ(other.error[d].inside90 > itself.error[d].inside90, i == 1);
        }
    }
}

TEST_F(SensorAssessments, BandsAndMapAreThoseOfTheModelThatMadeTheLog) {
    const SensorEvaluation evaluation = evaluate({{"itself", &camera_}});
    const std::vector<ErrorBand>& bands = evaluation.bands[0][static_cast<std::size_t>(BandAxis::range)];
    ASSERT_GE(bands.size(), 4u);
    for (const ErrorBand& band : bands) {
        const double range = 0.5 * (band.from + band.to);
        EXPECT_NEAR(band.predicted[2], 0.03 * range, 0.03 * 0.26) << "the median is the bias";
        const double spread = band.predicted[3] - band.predicted[1];
        for (std::size_t s = 1; s < 4; ++s)
            EXPECT_NEAR(band.real[s], band.predicted[s], 4 * spread / std::sqrt(static_cast<double>(band.readings)))
                << range;
    }
    std::size_t cases = 0;
    for (const DetectionMap::Cell& cell : evaluation.map.cells) {
        cases += cell.cases;
        if (cell.cases >= 50) {
            EXPECT_NEAR(cell.real, cell.predicted, sampling(std::max(0.02, cell.predicted), cell.cases) * 1.4);
        }
    }
    EXPECT_EQ(cases, evaluation.log.cases.size());
}

TEST_F(SensorAssessments, ErrorsThatAreDrawnApartHaveNothingInCommon) {
    const SensorEvaluation evaluation = evaluate({{"itself", &camera_}});
    for (std::size_t d = 0; d < readingDimensions; ++d)
        for (const ErrorLink& link : {evaluation.links[d].next, evaluation.links[d].beside}) {
            ASSERT_GT(link.pairs, 500u);
            EXPECT_NEAR(link.real, 0, 4 / std::sqrt(static_cast<double>(link.pairs)));
            EXPECT_TRUE(std::isnan(link.model)) << "a toy says nothing of it";
        }
    const SensorScores& all = evaluation.models[0].all;
    for (std::size_t d = 0; d < readingDimensions; ++d)
        EXPECT_NEAR(evaluation.means[0].real[d], evaluation.means[0].predicted[d],
                    5 * all.error[d].rmse / std::sqrt(static_cast<double>(all.sound)));
}

TEST_F(SensorAssessments, WhatLastsInErrorsIsMeasured) {
    LoggedCases cases;
    cases.robots.resize(1);
    std::vector<CaseScore> scores;
    ReadingNoises noises{};
    noises[1] = {.look = 0.3, .slow = 0.2, .slowTime = 2, .subject = 0.3, .subjectTime = 1};
    const auto noise = [](std::int64_t i, std::uint32_t channel) { return normalNoise({5, i, 0, channel}); };
    const double pause = 0.5, slowKept = std::exp(-pause / 2), subjectKept = std::exp(-pause);
    double slow = noise(0, 0), subject[] = {noise(0, 1), noise(0, 2)};
    for (int l = 1; l <= 20000; ++l) {
        cases.looks.push_back({0, 0, fromSeconds(pause * l), cases.cases.size(), 2});
        slow = slowKept * slow + std::sqrt(1 - slowKept * slowKept) * noise(l, 0);
        const double common = std::sqrt(0.3) * noise(l, 3) + std::sqrt(0.2) * slow;
        for (std::uint32_t s = 0; s < 2; ++s) {
            subject[s] = subjectKept * subject[s] + std::sqrt(1 - subjectKept * subjectKept) * noise(l, 1 + s);
            const double number = common + std::sqrt(0.3) * subject[s] + std::sqrt(0.2) * noise(l, 4 + s);
            cases.cases.push_back({.subject = s, .reported = true, .sound = true});
            scores.push_back({.below = {normalProbability(number), 0.5}});
        }
    }
    const ErrorLinks links = errorLinks(cases, scores, 0, &noises);
    EXPECT_EQ(links.beside.pairs, 20000u);
    EXPECT_NEAR(links.next.model, 0.2 * slowKept + 0.3 * subjectKept, 1e-9);
    EXPECT_NEAR(links.next.real, links.next.model, 0.03);
    EXPECT_NEAR(links.beside.model, 0.5, 1e-9);
    EXPECT_NEAR(links.beside.real, 0.5, 0.03);
}

/// Of two robots one has errors that last.
TEST_F(SensorAssessments, WhatLastsInErrorsIsMeasuredOfEachRobotAlone) {
    LoggedCases cases;
    cases.robots.resize(2);
    std::vector<CaseScore> scores;
    const auto noise = [](std::int64_t i, std::uint32_t channel) { return normalNoise({5, i, 0, channel}); };
    for (std::uint32_t robot = 0; robot < 2; ++robot)
        for (int l = 0; l < 1000; ++l) {
            cases.looks.push_back({robot, 0, fromSeconds(0.5 * l), cases.cases.size(), 1});
            cases.cases.push_back({.subject = 0, .reported = true, .sound = true});
            scores.push_back({.below = {normalProbability(robot == 0 ? noise(l, 0) : noise(0, 1)), 0.5}});
        }
    EXPECT_NEAR(errorLinks(cases, scores, 0, nullptr, 0).next.real, 0, 0.1);
    EXPECT_NEAR(errorLinks(cases, scores, 0, nullptr, 1).next.real, 1, 1e-9);
    EXPECT_EQ(errorLinks(cases, scores, 0, nullptr, 0).next.pairs, 999u);
    EXPECT_EQ(errorLinks(cases, scores, 0, nullptr).next.pairs, 1998u);
}

TEST_F(SensorAssessments, AnIdealSensorIsAsGoodAsItsNoise) {
    SensorNetwork like;
    like.view = camera_.view();
    like.latency = camera_.latency();
    like.constant = {0.8, 0.001, {0.05, 0.02}};
    const IdealSensorModel noisy(like, IdealSensorModel::Noise::constant), exact(like, IdealSensorModel::Noise::none);
    log_ = seenLog(noisy, 600);
    const SensorEvaluation evaluation = evaluate({{"noisy", &noisy}, {"exact", &exact}});
    const SensorScores &first = evaluation.models[0].all, &second = evaluation.models[1].all;
    // of a normal distribution about itself: its standard deviation over the square root of pi
    EXPECT_NEAR(first.error[0].crps, 0.05 / std::sqrt(std::numbers::pi), 0.001);
    EXPECT_NEAR(first.error[1].rmse, 0.02, 0.001);
    EXPECT_NEAR(first.error[1].inside50, 0.5, sampling(0.5, first.sound));
    EXPECT_NEAR(second.error[0].crps, 0.05 * std::sqrt(2 / std::numbers::pi), 0.002) << "the mean absolute error";
    EXPECT_EQ(second.error[0].inside90, 0);
    EXPECT_TRUE(std::isnan(second.logDensity)) << "a point has no density";
    EXPECT_LT(second.detection, first.detection);
}

TEST_F(SensorAssessments, TheShownLookHasTheMostReadings) {
    const SensorEvaluation evaluation = evaluate({{"itself", &camera_}});
    const auto readings = [&](const LoggedLook& look) {
        std::size_t count = 0;
        for (std::size_t i = look.first; i < look.first + look.count; ++i) count += evaluation.log.cases[i].reported;
        return count;
    };
    const LoggedLook& shown = evaluation.log.looks[evaluation.shown.look];
    for (const LoggedLook& look : evaluation.log.looks) EXPECT_LE(readings(look), readings(shown));
    EXPECT_EQ(evaluation.shown.sinceStart, shown.time);
    EXPECT_EQ(evaluation.shown.robots.size(), 1u);
}

TEST_F(SensorAssessments, GrossErrorsAreCountedAndNotJudged) {
    const SensorScores before = evaluate({{"itself", &camera_}}).models[0].all;
    for (Look& look : log_.robots[0].trajectories[0].sensors[0].looks)
        if (!look.readings.empty() && look.time % 10'000'000'000 == 0) look.readings[0].range += 5;
    const SensorEvaluation evaluation = evaluate({{"itself", &camera_}});
    EXPECT_GT(evaluation.log.robots[0].gross, 5u);
    EXPECT_EQ(evaluation.models[0].all.readings, before.readings);
    EXPECT_EQ(evaluation.models[0].all.sound, before.sound - evaluation.log.robots[0].gross);
    EXPECT_NEAR(evaluation.models[0].all.error[0].crps, before.error[0].crps, 0.001);
}

TEST_F(SensorAssessments, WhatCannotBeJudgedIsSaidInOneLine) {
    EXPECT_THAT(objection("camera", {"9"}), HasSubstr("seen: has no robot \"9\""));
    EXPECT_THAT(objection("sonar", {}), HasSubstr("seen: has no sensor \"sonar\"; it has \"camera\""));
    EXPECT_THAT(objection("camera", {"2"}), HasSubstr("has no sensor \"camera\" of robot \"2\""));
    for (Look& look : log_.robots[0].trajectories[0].sensors[0].looks) look.readings.clear();
    EXPECT_THAT(objection("camera", {}), HasSubstr("reported no landmark"));
    for (LogSubject& subject : log_.subjects) subject.position.reset();
    EXPECT_THAT(objection("camera", {}), HasSubstr("has no landmark that \"camera\" of robot 1 had before it"));
    log_.robots[0].trajectories[0].sensors.clear();
    EXPECT_THAT(objection("camera", {}), HasSubstr("it has no readings of landmarks or robots"));
}

TEST_F(SensorAssessments, AllThatTheReaderFoundAndDidIsSummed) {
    Trajectory& first = log_.robots[0].trajectories[0];
    first.name = "1";
    first.sensors[0].defects = {1, 2, 3, 4, 5, 6, 7};
    log_.robots[0].trajectories.push_back(first);
    log_.robots[0].trajectories[1].name = "2";
    log_.robots[1].trajectories[0].sensors.clear();
    const auto cases = loggedCases(log_, "camera", {}, {});
    ASSERT_TRUE(cases) << cases.error().message();
    const SensorDefects& sum = cases->robots.at(0).defects;
    EXPECT_THAT((std::vector{sum.outOfOrder, sum.joinedStamps, sum.repeated, sum.unknownSubjects, sum.emptyLooks,
                             sum.headingWraps, sum.cutLines}),
                testing::ElementsAre(2, 4, 6, 8, 10, 12, 14));
}

}  // namespace
}  // namespace mrose

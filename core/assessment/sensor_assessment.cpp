#include "assessment/sensor_assessment.h"

#include <algorithm>
#include <cassert>
#include <numeric>

#include "learning/parallel_for.h"
#include "perception/logged_view.h"

namespace mrose {
namespace {

ReadingDistribution unreported() {
    ReadingDistribution distribution;
    distribution.threshold = -38;
    distribution.component[0].spread.fill(1);
    return distribution;
}

std::vector<CasePrediction> predictCases(const LoggedView& view, const LoggedCases& cases, const SensorModel& model) {
    std::vector<CasePrediction> predictions(cases.cases.size());
    parallelFor(cases.looks.size(), [&](std::size_t l) {
        const LoggedLook& look = cases.looks[l];
        const LoggedCases::Robot& robot = cases.robots[look.robot];
        const auto subjects = view.at(robot.inLog, look.trajectory, look.time - model.latency(), model.view());
        std::vector<SensedState> states;
        std::vector<std::size_t> of;
        for (std::size_t i = look.first; i < look.first + look.count; ++i) {
            const auto found = std::ranges::find(subjects, cases.cases[i].subject, &LoggedSubject::subject);
            if (found == subjects.end()) {
                // a robot that was not tracked when it was measured
                predictions[i] = {cases.cases[i].range, cases.cases[i].bearing, unreported()};
                continue;
            }
            states.push_back(found->state);
            of.push_back(i);
        }
        std::vector<ReadingDistribution> distributions(states.size());
        model.distributions(states, robot.name, distributions);
        for (std::size_t k = 0; k < of.size(); ++k)
            predictions[of[k]] = {states[k].range, states[k].bearing, distributions[k]};
    });
    return predictions;
}

SensorAssessment assess(const LoggedView& view, const LoggedCases& cases, const NamedSensor& model) {
    SensorAssessment assessment;
    assessment.name = model.name;
    assessment.predictions = predictCases(view, cases, *model.model);
    assessment.scores.resize(cases.cases.size());
    parallelFor(cases.cases.size(),
                [&](std::size_t i) { assessment.scores[i] = scoreOf(cases.cases[i], assessment.predictions[i]); });
    std::vector<std::size_t> all(cases.cases.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    assessment.all = summarise(cases.cases, assessment.scores, all);
    std::vector<std::vector<std::size_t>> ofRobot(cases.robots.size());
    for (const LoggedLook& look : cases.looks)
        for (std::size_t i = look.first; i < look.first + look.count; ++i) ofRobot[look.robot].push_back(i);
    for (const auto& chosen : ofRobot) assessment.byRobot.push_back(summarise(cases.cases, assessment.scores, chosen));
    for (std::size_t d = 0; d < readingDimensions; ++d)
        assessment.below[d] = belowHistogram(cases.cases, assessment.scores, d, SensorAssessment::belowParts);
    return assessment;
}

/// The first stamp of its commands and poses.
Nanoseconds startOf(const Trajectory& trajectory) {
    const Nanoseconds poses = trajectory.poses.front().time;
    return trajectory.commands.empty() ? poses : std::min(poses, trajectory.commands.front().time);
}

/// The first of those with the most readings.
ShownLook lookWithMost(const LoggedView& view, const LoggedCases& cases) {
    const auto readings = [&](const LoggedLook& look) {
        const auto begin = cases.cases.begin() + static_cast<std::ptrdiff_t>(look.first);
        return std::count_if(begin, begin + static_cast<std::ptrdiff_t>(look.count),
                             [](const LoggedCase& one) { return one.sound; });
    };
    const auto most = std::ranges::max_element(cases.looks, {}, readings);
    const std::size_t own = cases.robots[most->robot].inLog;
    const Nanoseconds start = startOf(view.log().robots[own].trajectories[most->trajectory]);
    ShownLook shown{static_cast<std::size_t>(most - cases.looks.begin()), most->time - start, {}};
    for (const LoggedSubject& subject : view.at(own, most->trajectory, most->time, View{}))
        if (subject.state.subject == SubjectKind::robot)
            shown.robots.push_back(subject.state.range * towards(subject.state.bearing));
    return shown;
}

}  // namespace

Expected<SensorEvaluation> evaluateSensors(const Log& log, LoggedCases cases, std::span<const NamedSensor> models,
                                           const Progress& progress) {
    assert(!models.empty());
    SensorEvaluation evaluation;
    evaluation.log = std::move(cases);
    evaluation.view = models.front().model->view();
    const LoggedView view(log);
    for (std::size_t i = 0; i < models.size(); ++i) {
        if (!mayGoOn(progress, static_cast<double>(i) / static_cast<double>(models.size())))
            return fail(log.source, "was not evaluated: cancelled");
        evaluation.models.push_back(assess(view, evaluation.log, models[i]));
    }
    const SensorAssessment& first = evaluation.models.front();
    for (std::size_t d = 0; d < readingDimensions; ++d)
        for (const BandAxis axis : {BandAxis::range, BandAxis::bearing})
            evaluation.bands[d][static_cast<std::size_t>(axis)] =
                errorBands(evaluation.log.cases, first.predictions, d, axis);
    evaluation.linksByRobot.resize(evaluation.log.robots.size());
    for (std::size_t d = 0; d < readingDimensions; ++d) {
        const ReadingNoises* const noises = models.front().model->noises();
        evaluation.links[d] = errorLinks(evaluation.log, first.scores, d, noises);
        for (std::size_t i = 0; i < evaluation.log.robots.size(); ++i)
            evaluation.linksByRobot[i][d] = errorLinks(evaluation.log, first.scores, d, noises, i);
    }
    for (std::size_t i = 0; i < evaluation.log.robots.size(); ++i)
        evaluation.means.push_back(meanErrors(evaluation.log, first.predictions, first.scores, i));
    evaluation.map = detectionMap(evaluation.log.cases, first.scores, evaluation.log.rule);
    evaluation.shown = lookWithMost(view, evaluation.log);
    return evaluation;
}

}  // namespace mrose

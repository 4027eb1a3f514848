#include "assessment/evaluate.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "io/format.h"
#include "world/seconds_text.h"

namespace mrose {
namespace {

bool isFinite(const Pose& pose) {
    return std::isfinite(pose.x) && std::isfinite(pose.y) && std::isfinite(pose.heading);
}

/// Parts of the windows: kind, name and the indices of each. Parts that are all or nothing of their kind stay out,
/// except for robots.
struct Part {
    std::string kind, name;
    std::vector<std::size_t> windows;
};

template <class Belongs>
void addPart(std::vector<Part>& parts, std::span<const Window> windows, std::string kind, std::string partName,
             Belongs belongs) {
    Part part{std::move(kind), std::move(partName), {}};
    for (std::size_t i = 0; i < windows.size(); ++i)
        if (belongs(windows[i])) part.windows.push_back(i);
    if (!part.windows.empty()) parts.push_back(std::move(part));
}

std::vector<Part> partsOf(const Log& log, std::span<const Window> windows) {
    std::vector<Part> parts;
    for (std::size_t r = 0; r < log.robots.size(); ++r)
        addPart(parts, windows, "robot", log.robots[r].robot, [r](const Window& w) { return w.robot == r; });
    for (int kind = 0; kind < manoeuvreCount; ++kind) {
        const auto manoeuvre = static_cast<Manoeuvre>(kind);
        addPart(parts, windows, "manoeuvre", std::string(name(manoeuvre)),
                [manoeuvre](const Window& w) { return w.manoeuvre == manoeuvre; });
    }
    std::vector<Part> states;
    addPart(states, windows, "state", "steady", [](const Window& w) { return w.steady; });
    addPart(states, windows, "state", "transient", [](const Window& w) { return !w.steady; });
    if (states.size() == 2) parts.insert(parts.end(), states.begin(), states.end());
    return parts;
}

std::vector<std::size_t> everyIndex(std::size_t count) {
    std::vector<std::size_t> indices(count);
    for (std::size_t i = 0; i < count; ++i) indices[i] = i;
    return indices;
}

void compare(const Evaluation& evaluation, std::span<const Part> parts, ModelEvaluation& model) {
    for (std::size_t i = 0; i < evaluation.windows.size(); ++i)
        model.errors.push_back(windowErrors(evaluation.windows[i].truth, model.predicted[i]));
    const auto summary = [&](std::span<const std::size_t> chosen) {
        return summarise(evaluation.windows, model.errors, chosen, evaluation.options.windows);
    };
    model.all = summary(everyIndex(evaluation.windows.size()));
    for (const Part& part : parts) model.groups.push_back({part.kind, part.name, summary(part.windows)});
    model.overTime = errorsOverTime(model.errors, evaluation.options.windows.step);
}

Expected<PercentErrors> errorsOnFloor(const NamedModel& named, const Log& log, const std::optional<Floor>& floor,
                                      Nanoseconds step) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    if (!floor || floor->pairs.empty()) return PercentErrors{nan, nan};
    std::vector<Window> stretches;
    std::vector<std::size_t> robots;
    for (const FloorPair& pair : floor->pairs)
        for (const Window* stretch : {&pair.first, &pair.second}) {
            stretches.push_back(*stretch);
            robots.push_back(stretch->robot);
        }
    const auto predicted = rollOut(named, log, rolloutStarts(log, stretches), robots, RolloutOptions{.step = step});
    if (!predicted) return tl::unexpected(predicted.error());
    double position = 0, path = 0, heading = 0, rotation = 0;
    for (std::size_t i = 0; i < stretches.size(); ++i) {
        const WindowErrors errors = windowErrors(stretches[i].truth, (*predicted)[i]);
        position += errors.positionMean;
        heading += errors.headingMean;
        path += stretches[i].path;
        rotation += stretches[i].rotation;
    }
    return PercentErrors{path > 0 ? 100 * position / path : nan, rotation > 0 ? 100 * heading / rotation : nan};
}

/// Asks whether it is to go on, of the steps of all models.
class Steps {
public:
    Steps(std::size_t count, const Progress& progress) : count_(count), progress_(progress) {}
    Expected<void> done() {
        ++done_;
        if (!progress_ || progress_(static_cast<double>(done_) / static_cast<double>(count_))) return {};
        return fail("", "the evaluation was ended before its end");
    }

private:
    std::size_t count_, done_ = 0;
    const Progress& progress_;
};

Expected<ModelEvaluation> evaluateModel(const NamedModel& named, const Log& log, const Evaluation& evaluation,
                                        std::span<const Part> parts, std::span<const RelativePieces> pieces,
                                        Steps& steps) {
    ModelEvaluation model;
    model.name = named.name;
    const RolloutOptions options{.step = evaluation.options.windows.step};
    std::vector<std::size_t> robots;
    for (const Window& window : evaluation.windows) robots.push_back(window.robot);
    auto predicted = rollOut(named, log, rolloutStarts(log, evaluation.windows), robots, options);
    if (!predicted) return tl::unexpected(predicted.error());
    model.predicted = std::move(*predicted);
    if (auto goesOn = steps.done(); !goesOn) return tl::unexpected(goesOn.error());
    compare(evaluation, parts, model);
    for (const RelativePieces& piece : pieces) {
        const auto ends = rollOut(named, log, piece.starts, piece.robots, options);
        if (!ends) return tl::unexpected(ends.error());
        model.relative.push_back(relativePoseError(piece, *ends));
        if (auto goesOn = steps.done(); !goesOn) return tl::unexpected(goesOn.error());
    }
    const auto onFloor = errorsOnFloor(named, log, evaluation.floor, options.step);
    const auto onTurning = errorsOnFloor(named, log, evaluation.turningFloor, options.step);
    if (!onFloor) return tl::unexpected(onFloor.error());
    if (!onTurning) return tl::unexpected(onTurning.error());
    model.onFloor = *onFloor;
    model.onTurningFloor = *onTurning;
    return model;
}

/// The first stamp of each drive, by its name.
std::map<std::string, Nanoseconds> driveStarts(const Log& log) {
    std::map<std::string, Nanoseconds> starts;
    const auto note = [&](const std::string& drive, Nanoseconds time) {
        const auto [known, isNew] = starts.try_emplace(drive, time);
        if (!isNew) known->second = std::min(known->second, time);
    };
    for (const RobotLog& robot : log.robots)
        for (const Trajectory& trajectory : robot.trajectories) {
            if (!trajectory.commands.empty()) note(trajectory.name, trajectory.commands.front().time);
            if (!trajectory.poses.empty()) note(trajectory.name, trajectory.poses.front().time);
        }
    return starts;
}

Evaluation describe(const Log& log, std::vector<Window> windows, const EvaluationOptions& options) {
    Evaluation evaluation;
    evaluation.source = log.source;
    evaluation.format = log.format;
    evaluation.dataset = log.dataset;
    evaluation.files = log.files;
    evaluation.options = options;
    for (const RobotLog& robot : log.robots) evaluation.robots.push_back({robot.robot, robot.defects, 0});
    const auto starts = driveStarts(log);
    for (const Window& window : windows) {
        ++evaluation.robots[window.robot].windows;
        evaluation.trajectories.push_back(log.robots[window.robot].trajectories[window.trajectory].name);
        evaluation.driveStarts.push_back(starts.at(evaluation.trajectories.back()));
    }
    evaluation.windows = std::move(windows);
    return evaluation;
}

}  // namespace

NamedModel NamedModel::same(std::string name, const MotionModel& model) {
    return {std::move(name), [&model](const std::string&) { return &model; }};
}

Expected<std::vector<std::vector<Pose>>> rollOut(const NamedModel& named, const Log& log,
                                                 std::span<const RolloutStart> starts,
                                                 std::span<const std::size_t> robots, const RolloutOptions& options) {
    std::map<std::size_t, std::vector<std::size_t>> byRobot;
    for (std::size_t i = 0; i < starts.size(); ++i) byRobot[robots[i]].push_back(i);
    std::vector<std::vector<Pose>> result(starts.size());
    for (const auto& [robot, indices] : byRobot) {
        const std::string& robotName = log.robots[robot].robot;
        const MotionModel* model = named.forRobot(robotName);
        if (model == nullptr) return fail(named.name, "knows no robot " + robotName);
        std::vector<RolloutStart> chosen;
        for (const std::size_t i : indices) chosen.push_back(starts[i]);
        auto poses = rollOut(*model, chosen, options);
        if (!poses) return fail(named.name, poses.error().cause);
        for (std::size_t k = 0; k < indices.size(); ++k) {
            if (!std::all_of((*poses)[k].begin(), (*poses)[k].end(), isFinite))
                return fail(named.name, "predicts no finite pose for robot " + robotName + " from " +
                                            secondsText(chosen[k].time) + " s on");
            result[indices[k]] = std::move((*poses)[k]);
        }
    }
    return result;
}

Evaluation evaluated(const Log& log, std::vector<Window> windows, std::string model,
                     std::vector<std::vector<Pose>> predicted, const EvaluationOptions& options) {
    Evaluation evaluation = describe(log, std::move(windows), options);
    ModelEvaluation& only = evaluation.models.emplace_back();
    only.name = std::move(model);
    only.predicted = std::move(predicted);
    compare(evaluation, partsOf(log, evaluation.windows), only);
    return evaluation;
}

Expected<Evaluation> evaluate(const Log& log, std::span<const NamedModel> models, const EvaluationOptions& options,
                              const Progress& progress) {
    auto windows = findWindows(log, options.robots, options.windows);
    if (!windows) return tl::unexpected(windows.error());
    Evaluation evaluation = describe(log, std::move(*windows), options);
    const std::vector<Part> parts = partsOf(log, evaluation.windows);
    std::vector<RelativePieces> pieces;
    for (const double horizon : options.relativeHorizons) {
        RelativePieces piece = relativePieces(log, evaluation.windows, horizon, options.windows.step);
        if (!piece.starts.empty()) pieces.push_back(std::move(piece));
    }
    Steps steps(models.size() * (pieces.size() + 1) + 1, progress);
    if (options.withFloor) {
        evaluation.floor = findFloor(log, options.robots, options.windows, options.floor);
        if (options.turningFloor.horizon < evaluation.floor->horizon)
            evaluation.turningFloor = findFloor(log, options.robots, options.windows, options.turningFloor);
    }
    if (auto ready = steps.done(); !ready) return tl::unexpected(ready.error());
    for (const NamedModel& named : models) {
        auto model = evaluateModel(named, log, evaluation, parts, pieces, steps);
        if (!model) return tl::unexpected(model.error());
        evaluation.models.push_back(std::move(*model));
    }
    return evaluation;
}

}  // namespace mrose

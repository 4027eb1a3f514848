#include "assessment/evaluate.h"

namespace mrose {
namespace {

/// Predicts by one model, with what the log shows of the tracked points before.
class LogPredictor {
public:
    LogPredictor(const NamedModel& named, const Log& log, Nanoseconds step) : named_(named), log_(log), step_(step) {}

    Expected<std::vector<std::vector<Pose>>> predict(std::vector<RolloutStart> starts,
                                                     std::span<const std::size_t> robots) {
        fillTracked(named_, log_, starts, robots, histories_);
        return rollOut(named_, log_, starts, robots, {.step = step_});
    }
    Expected<std::vector<std::vector<Pose>>> predict(std::span<const Window> windows) {
        return predict(rolloutStarts(log_, windows), robotsOf(windows));
    }

private:
    const NamedModel& named_;
    const Log& log_;
    Nanoseconds step_;
    TrackerHistories histories_;
};

Expected<PercentErrors> errorsOnFloor(LogPredictor& predictor, const std::optional<Floor>& floor) {
    if (!floor || floor->pairs.empty()) return ErrorSums{}.percentErrors();
    std::vector<Window> stretches;
    for (const FloorPair& pair : floor->pairs)
        for (const Window* stretch : {&pair.first, &pair.second}) stretches.push_back(*stretch);
    const auto predicted = predictor.predict(stretches);
    if (!predicted) return tl::unexpected(predicted.error());
    ErrorSums sums;
    for (std::size_t i = 0; i < stretches.size(); ++i) {
        const WindowErrors errors = windowErrors(stretches[i].truth, (*predicted)[i]);
        sums.add(errors.positionMean, errors.headingMean, stretches[i].path, stretches[i].rotation);
    }
    return sums.percentErrors();
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

Expected<Assessment> evaluateModel(const NamedModel& named, const Log& log, const LogWindows& against,
                                   std::span<const RelativePieces> pieces, Steps& steps) {
    LogPredictor predictor(named, log, against.options.step);
    auto predicted = predictor.predict(against.windows);
    if (!predicted) return tl::unexpected(predicted.error());
    if (auto goesOn = steps.done(); !goesOn) return tl::unexpected(goesOn.error());
    Assessment model = assess(against, named.name, std::move(*predicted));
    for (const RelativePieces& piece : pieces) {
        const auto ends = predictor.predict(piece.starts, piece.robots);
        if (!ends) return tl::unexpected(ends.error());
        model.relative.push_back(relativePoseError(piece, *ends));
        if (auto goesOn = steps.done(); !goesOn) return tl::unexpected(goesOn.error());
    }
    const auto onFloor = errorsOnFloor(predictor, against.floor);
    const auto onTurning = errorsOnFloor(predictor, against.turningFloor);
    if (!onFloor) return tl::unexpected(onFloor.error());
    if (!onTurning) return tl::unexpected(onTurning.error());
    model.onFloor = *onFloor;
    model.onTurningFloor = *onTurning;
    return model;
}

}  // namespace

Expected<Evaluation> evaluate(const Log& log, std::span<const NamedModel> models, const EvaluationOptions& options,
                              const Progress& progress) {
    auto windows = findWindows(log, options.robots, options.windows);
    if (!windows) return tl::unexpected(windows.error());
    Evaluation evaluation{logWindows(log, std::move(*windows), options.windows), {}};
    LogWindows& against = evaluation.log;
    std::vector<RelativePieces> pieces;
    for (const double horizon : options.relativeHorizons) {
        RelativePieces piece = relativePieces(log, against.windows, horizon, options.windows.step);
        if (!piece.starts.empty()) pieces.push_back(std::move(piece));
    }
    Steps steps(models.size() * (pieces.size() + 1) + 1, progress);
    if (options.withFloor) {
        against.floor = findFloor(log, options.robots, options.windows, options.floor);
        if (options.turningFloor.horizon < against.floor->horizon)
            against.turningFloor = findFloor(log, options.robots, options.windows, options.turningFloor);
    }
    if (auto ready = steps.done(); !ready) return tl::unexpected(ready.error());
    for (const NamedModel& named : models) {
        auto model = evaluateModel(named, log, against, pieces, steps);
        if (!model) return tl::unexpected(model.error());
        evaluation.models.push_back(std::move(*model));
    }
    return evaluation;
}

}  // namespace mrose

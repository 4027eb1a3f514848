#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "assessment/floor.h"
#include "assessment/metrics.h"
#include "assessment/windows.h"
#include "io/progress.h"

namespace mrose {

/// A model under its name in tables. `forRobot` gives the model of a robot, named as in the log; null: it knows no such
/// robot. What it points to must outlive the evaluation.
struct NamedModel {
    std::string name;
    std::function<const MotionModel*(const std::string& robot)> forRobot;

    /// One model for every robot.
    static NamedModel same(std::string name, const MotionModel& model);
};

struct EvaluationOptions {
    std::vector<std::string> robots{};  ///< as the log names them; empty: all
    WindowOptions windows{};
    std::vector<double> relativeHorizons{0.1, 1, 5, 10};  ///< s
    bool withFloor = true;
    FloorOptions floor{};
    /// Near-identical commands over a whole window go straight as a rule. What turns needs shorter stretches.
    FloorOptions turningFloor{
        .pathBound = 0.01, .rotationBound = 0.05, .horizon = 5'000'000'000LL, .leastTurnRate = 0.05};
};

/// A part of the windows.
struct GroupSummary {
    std::string kind;  ///< what the windows are grouped by: "robot", "manoeuvre", "state"
    std::string name;  ///< "1", "hard switch", "steady"
    Summary summary;
};

struct PercentErrors {
    double p = 0, hd = 0;  ///< %
};

struct ModelEvaluation {
    std::string name;
    std::vector<std::vector<Pose>> predicted;  ///< by window
    std::vector<WindowErrors> errors;          ///< by window
    Summary all;
    std::vector<GroupSummary> groups;  ///< the same ones in the same order for every model
    std::vector<ErrorsAt> overTime;
    std::vector<RelativePoseError> relative;  ///< by horizon
    PercentErrors onFloor, onTurningFloor;    ///< on the stretches of the floors' pairs; NaN without pairs
};

/// All that a report needs; it holds no reference to the log or the models.
struct Evaluation {
    std::string source, format;
    int dataset = 0;
    std::vector<LogFile> files;
    struct Robot {
        std::string name;
        LogDefects defects;
        std::size_t windows = 0;
    };
    std::vector<Robot> robots;              ///< indexed by Window::robot
    std::vector<std::string> trajectories;  ///< by window: Trajectory::name
    /// By window: the first stamp of its drive, that is of all trajectories of that name. Pages count from there.
    std::vector<Nanoseconds> driveStarts;
    EvaluationOptions options;
    std::vector<Window> windows;          ///< reports number them from 1
    std::vector<ModelEvaluation> models;  ///< in the order given
    std::optional<Floor> floor, turningFloor;
};

/// Rolls every model out over every window of the log and compares with the truth. The result is the same for any
/// number of threads. Error: no windows (see findWindows); a model that knows one of the robots not, whose period does
/// not divide the step, or that predicts something that is not finite; `progress`
/// ended it.
Expected<Evaluation> evaluate(const Log& log, std::span<const NamedModel> models, const EvaluationOptions& options = {},
                              const Progress& progress = {});

/// The same of one model whose poses are known already: predicted[i] of windows[i].
Evaluation evaluated(const Log& log, std::vector<Window> windows, std::string model,
                     std::vector<std::vector<Pose>> predicted, const EvaluationOptions& options = {});

/// Rollouts of one named model, each start with the model of its robot; `robots` are indices into log.robots. Error as
/// for evaluate.
Expected<std::vector<std::vector<Pose>>> rollOut(const NamedModel& model, const Log& log,
                                                 std::span<const RolloutStart> starts,
                                                 std::span<const std::size_t> robots,
                                                 const RolloutOptions& options = {});

}  // namespace mrose

#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "assessment/windows.h"
#include "learning/bootstrap.h"
#include "motion/percent_errors.h"

namespace mrose {

/// What is not known, or not defined.
constexpr double unknownNumber = std::numeric_limits<double>::quiet_NaN();

/// How far one rollout is from the truth, at each of its steps. Nothing is aligned: the start is given.
struct WindowErrors {
    std::vector<double> position;                                                   ///< m
    std::vector<double> heading;                                                    ///< rad, absolute, wrapped
    double positionMean = 0, positionFinal = 0, headingMean = 0, headingFinal = 0;  ///< over time, and at the end
    double along = 0, left = 0;     ///< m, signed, at the end: the prediction as seen from the real robot
    double headingFinalSigned = 0;  ///< rad, at the end
};

/// `predicted[k]` is compared with `truth[k + 1]`; `truth` may be longer.
WindowErrors windowErrors(std::span<const Pose> truth, std::span<const Pose> predicted);

/// The q-quantile, 0 <= q <= 1, with linear interpolation between order statistics (type 7, numpy's default); NaN of
/// nothing. Reorders `values`.
double quantile(std::span<double> values, double q);

struct Distribution {
    std::size_t count = 0;
    double mean = 0, rms = 0, p10 = 0, p25 = 0, median = 0, p75 = 0, p90 = 0;  ///< NaN when count is 0
};
Distribution distribution(std::vector<double> values);

/// P and Hd as the referee defines them, and what windows look like one by one.
struct Summary {
    std::size_t windows = 0;
    double path = 0, rotation = 0;  ///< m, rad: sums over the windows
    double p = 0, hd = 0;           ///< %: PercentErrors
    Interval p95, hd95;             ///< %: 95 % bootstrap intervals, windows drawn with replacement
    Distribution positionMeanOverPath, positionFinalOverPath;  ///< %, of windows with at least 0.3 m per 10 s
    Distribution positionFinalOverPathBySteps;                 ///< %, likewise, over the longer Window::pathBySteps
    Distribution positionMean, positionFinal;                  ///< m
    Distribution headingMean, headingFinal;                    ///< rad
    Distribution along, left, headingSigned;                   ///< m, m, rad: at the end, signed: the means are biases
};

/// `windows` and `errors` are parallel; `chosen` are indices into both. `step` is the windows'.
Summary summarise(std::span<const Window> windows, std::span<const WindowErrors> errors,
                  std::span<const std::size_t> chosen, const WindowOptions& options);

/// Errors of all windows that reach so far, `time` after their start.
struct ErrorsAt {
    double time = 0;                 ///< s
    Distribution position, heading;  ///< m, rad
};
std::vector<ErrorsAt> errorsOverTime(std::span<const WindowErrors> errors, Nanoseconds step);

/// RMS error of the predicted relative pose over a horizon. The windows are cut into pieces of that length, laid end to
/// end from the window's start; each piece is predicted from its own measured start, and the predicted pose of its end
/// in the frame of its start is compared with the real one.
struct RelativePoseError {
    double horizon = 0;  ///< s
    std::size_t pieces = 0;
    double position = 0, heading = 0;  ///< m, rad, RMS
};

struct RelativePieces {
    double horizon = 0;                ///< s
    std::vector<RolloutStart> starts;  ///< at the origin, in the frame of the piece's start; they point into the log
    std::vector<std::size_t> robots;   ///< Window::robot of each
    std::vector<Pose> real;            ///< the end in the frame of the start
};

/// `horizon` is rounded to whole steps; no pieces where it is longer than every window.
RelativePieces relativePieces(const Log& log, std::span<const Window> windows, double horizon, Nanoseconds step);

/// `predicted` are the rollouts of `pieces.starts`.
RelativePoseError relativePoseError(const RelativePieces& pieces, std::span<const std::vector<Pose>> predicted);

}  // namespace mrose

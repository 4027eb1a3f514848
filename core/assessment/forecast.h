#pragma once

#include <array>
#include <cmath>
#include <span>
#include <string>
#include <vector>

#include "assessment/assess.h"
#include "assessment/named_model.h"
#include "geometry/pose_region.h"
#include "io/progress.h"

namespace mrose {

/// How well sampled rollouts foresaw where robots are some time after a window's start. Errors are seen from the mean
/// pose of a window's samples: along its heading, across it (m), and of the heading (rad).
struct ForecastAt {
    static constexpr std::size_t errors = 3;
    using PerError = std::array<double, errors>;

    Nanoseconds time = 0;              ///< since the start
    double energy = 0;                 ///< m: mean energy score of the position
    PerError ranked{};                 ///< mean continuous ranked probability scores
    PerError half{}, nineTenths{};     ///< how wide the samples' central 50 and 90 % are, means
    std::vector<std::size_t> windows;  ///< those that reach so far: indices into LogWindows::windows
    std::vector<PerError> ranks;       ///< of these: share of the samples that lie below what happened

    /// Share of what happened, of all errors together or of one, in the central part of the samples that holds `share`
    /// of them; of a single sample it says nothing.
    double inside(double share) const;
    double inside(double share, std::size_t error) const;
    bool isInside(std::size_t rank, std::size_t error, double share) const {
        return std::abs(ranks[rank][error] - 0.5) <= share / 2;
    }
};

/// What sampled rollouts of all windows are worth. All scores are proper: who knows more, and says how much, has less.
struct Forecast {
    std::string name;
    std::size_t model = 0;       ///< of its mean: in Evaluation::models
    int samples = 0;             ///< of each window; 1: the mean alone, whose energy score is its mean error
    std::vector<ForecastAt> at;  ///< after 1/10, 1/5, 1/2 and all of the longest window
    double moves = 0;            ///< m: sum of the energy scores of the displacements from one of these instants to
                       ///< the next, in the frame of their starts: whole trajectories, not instants, are right
    std::vector<ErrorsAt> expected;  ///< how far samples lie from the mean alone, over time: errors as it foresees them

    std::vector<std::vector<PoseRegion>> regions;  ///< by window and step: where the samples are, about the mean alone

    double energy() const;   ///< m, sum over the instants
    double heading() const;  ///< rad, sum of the heading's ranked scores
    /// How far the shares inside 50 and 90 % are off at most, percentage points; NaN of a single sample.
    double miss() const;
};

/// A model whose noise is drawn, and the mean that it strays from.
struct SampledModel {
    NamedModel noisy, mean;
    std::size_t model = 0;  ///< Forecast::model
    int samples = 64;       ///< 1: of the mean alone
};

/// Judges `models` on the windows. A sample of a window is the robot's own trajectory in a run that begins there, of
/// the seed that sampleSeed() makes of 1. The result is the same for any number of threads. Error: as for evaluate().
Expected<std::vector<Forecast>> forecast(const Log& log, const LogWindows& against,
                                         std::span<const SampledModel> models, const Progress& progress = {});

}  // namespace mrose

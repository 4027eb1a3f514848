#pragma once

#include <Eigen/Core>

#include "identification/delayed_response.h"

namespace mrose {

struct ResponseFitOptions {
    bool lag = true;                             ///< found, or 0
    bool jitter = true;                          ///< single commands have dead times of their own, or all the same
    bool coefficients = true;                    ///< found, or 1 for the command and 0 for the rest
    double longestDeadTime = 1, longestLag = 1;  ///< s
};

struct ResponseFit {
    ResponseKernel kernel, standardError;  ///< errors from blocks of 10 s and from the jitter; 0 for what was held
    double jitter = 0, jitterError = 0;    ///< s, standard deviation of single commands' dead times
    Eigen::VectorXd coefficients;          ///< of the parts of the static map
    double explained = 0;                  ///< share of the displacements' variance, at the mean dead time
    double residual = 0;                   ///< RMS, m or rad per window, at the mean dead time
    std::int64_t used = 0, dropped = 0;    ///< windows; those beyond five times the RMS are dropped
};

/// Separable least squares of windows' displacements: linear in the static map, Levenberg-Marquardt with projection on
/// the bounds in the kernel, from the best of a coarse grid. With `jitter` each event has a dead time of its own, whose
/// prior's spread is found by expectation maximisation: a spread of dead times is then not mistaken for a lag. Needs at
/// least 20 windows.
ResponseFit fitResponse(DelayedResponse response, const ResponseFitOptions& options = {});

/// With fewer a fit says little about a robot.
constexpr Eigen::Index fewestWindows = 100;

}  // namespace mrose

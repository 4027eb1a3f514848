#include "identification/response_fit.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include <Eigen/Cholesky>

#include "geometry/point.h"

namespace mrose {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Dead time, lag.
using Theta = Eigen::Vector2d;
constexpr double smallestStep = 1e-3;  // s

ResponseKernel kernelOf(const Theta& theta) { return {theta[0], theta[1]}; }

struct Fitter {
    DelayedResponse& response;
    const ResponseFitOptions& options;
    VectorXd weights;  // 1, or 0 for a dropped window

    Theta bounded(const Theta& theta) const {
        const Theta highest{options.longestDeadTime, options.lag ? options.longestLag : 0};
        return theta.cwiseMax(0).cwiseMin(highest);
    }

    VectorXd coefficients(const MatrixXd& parts) const {
        if (!options.coefficients) return VectorXd::Unit(parts.cols(), 0);
        MatrixXd normal = parts.transpose() * weights.asDiagonal() * parts;
        // Parts that a log cannot tell apart share what they explain.
        normal.diagonal() *= 1 + 1e-9;
        normal.diagonal().array() += 1e-12 * normal.trace() + 1e-300;
        return normal.ldlt().solve(parts.transpose() * weights.cwiseProduct(response.measured()));
    }

    VectorXd residuals(const MatrixXd& parts, const VectorXd& c) const {
        return weights.cwiseProduct(response.measured() - parts * c);
    }

    double cost(const Theta& theta) const {
        const MatrixXd parts = response.displacements(kernelOf(theta));
        return residuals(parts, coefficients(parts)).squaredNorm();
    }

    Theta coarse() const;
    Theta refine(Theta theta, int iterations = 15) const;
    MatrixXd jacobian(const Theta& theta, const MatrixXd& parts, const VectorXd& c) const;
    void dropOutliers(const Theta& theta);
    ResponseFit summary(const Theta& theta) const;
};

Theta Fitter::coarse() const {
    Theta best = Theta::Zero();
    double lowest = std::numeric_limits<double>::infinity();
    for (int i = 0; i * 0.08 <= options.longestDeadTime; ++i) {
        const Theta theta = bounded({i * 0.08, 0.1});
        const double found = cost(theta);
        if (found < lowest) lowest = found, best = theta;
    }
    return best;
}

/// d(displacement)/d(theta, c); columns of what is held are zero.
MatrixXd Fitter::jacobian(const Theta& theta, const MatrixXd& parts, const VectorXd& c) const {
    MatrixXd result = MatrixXd::Zero(parts.rows(), 2 + parts.cols());
    for (int i = 0; i < (options.lag ? 2 : 1); ++i) {
        Theta moved = theta;
        moved[i] += smallestStep;
        result.col(i) = weights.cwiseProduct((response.displacements(kernelOf(moved)) - parts) * c) / smallestStep;
    }
    if (options.coefficients) result.rightCols(parts.cols()) = weights.asDiagonal() * parts;
    return result;
}

Theta Fitter::refine(Theta theta, int iterations) const {
    double damping = 1e-3;
    MatrixXd parts = response.displacements(kernelOf(theta));
    VectorXd c = coefficients(parts), r = residuals(parts, c);
    for (int iteration = 0; iteration < iterations; ++iteration) {
        MatrixXd j = jacobian(theta, parts, c);
        // What stands on its bound and would leave it is held there, so that the others step as if it were fixed.
        for (int i = 0; i < 2; ++i)
            if (theta[i] <= 0 && j.col(i).dot(r) < 0) j.col(i).setZero();
        const MatrixXd normal = j.transpose() * j;
        const VectorXd gradient = j.transpose() * r;
        bool better = false;
        Theta step = Theta::Zero();
        for (int attempt = 0; attempt < 6 && !better; ++attempt) {
            MatrixXd damped = normal;
            damped.diagonal() *= 1 + damping;
            damped.diagonal().array() += 1e-14 * normal.diagonal().maxCoeff();
            const Theta next = bounded(theta + damped.ldlt().solve(gradient).head<2>());
            step = next - theta;
            const MatrixXd nextParts = response.displacements(kernelOf(next));
            const VectorXd nextC = coefficients(nextParts), nextR = residuals(nextParts, nextC);
            better = nextR.squaredNorm() < r.squaredNorm();
            damping *= better ? 0.2 : 10;
            if (better) theta = next, parts = nextParts, c = nextC, r = nextR;
        }
        if (!better || step.cwiseAbs().maxCoeff() < 2e-5) break;
    }
    return theta;
}

void Fitter::dropOutliers(const Theta& theta) {
    const MatrixXd parts = response.displacements(kernelOf(theta));
    const VectorXd r = response.measured() - parts * coefficients(parts);
    const double rms = std::sqrt(weights.cwiseProduct(r).squaredNorm() / weights.sum());
    for (Index i = 0; i < r.size(); ++i) weights[i] = std::abs(r[i]) <= 5 * rms ? 1 : 0;
}

/// Sums of the gradient over blocks of windows, whose errors are taken to be independent of each other.
MatrixXd blockScores(const MatrixXd& j, const VectorXd& r, const std::vector<std::int32_t>& blocks) {
    MatrixXd scores = MatrixXd::Zero(blocks.back() + 1, j.cols());
    for (Index i = 0; i < r.size(); ++i) scores.row(blocks[static_cast<std::size_t>(i)]) += r[i] * j.row(i);
    return scores;
}

VectorXd standardErrors(const MatrixXd& j, const VectorXd& r, const std::vector<std::int32_t>& blocks) {
    MatrixXd normal = j.transpose() * j;
    normal.diagonal() = normal.diagonal().cwiseMax(1e-300) * (1 + 1e-9);
    const MatrixXd influence = normal.ldlt().solve(blockScores(j, r, blocks).transpose());
    const double count = blocks.back() + 1;
    return (influence.rowwise().squaredNorm() * (count / std::max(1.0, count - 1))).cwiseSqrt();
}

ResponseFit Fitter::summary(const Theta& theta) const {
    ResponseFit fit;
    fit.kernel = kernelOf(theta);
    const MatrixXd parts = response.displacements(fit.kernel);
    fit.coefficients = coefficients(parts);
    const VectorXd r = residuals(parts, fit.coefficients);
    const double used = weights.sum(), mean = weights.dot(response.measured()) / used;
    const double variance = weights.dot((response.measured().array() - mean).square().matrix());
    fit.used = std::llround(used);
    fit.dropped = response.windows() - fit.used;
    fit.residual = std::sqrt(r.squaredNorm() / used);
    fit.explained = variance > 0 ? 1 - r.squaredNorm() / variance : 0;
    MatrixXd j = jacobian(theta, parts, fit.coefficients);
    const VectorXd both = standardErrors(j, r, response.blocks());
    fit.standardError = {both[0], options.lag ? both[1] : 0};
    // Near a lag of 0, lag and dead time cannot be distinguished to first order; the bound does it.
    if (options.lag && fit.kernel.lag <= 0) {
        j.col(1).setZero();
        fit.standardError.deadTime = standardErrors(j, r, response.blocks())[0];
    }
    return fit;
}

/// What single events say about their own dead times, with the jitter as a prior: theta's mean is then that of the
/// events, and their spread is not mistaken for a lag.
struct Events {
    double variance = 9e-4;  // s2, of the events' dead times
    double effective = 1;    // how many of them decide the mean

    void update(Fitter& fitter, const Theta& theta);
};

void Events::update(Fitter& fitter, const Theta& theta) {
    DelayedResponse& response = fitter.response;
    const ResponseKernel kernel = kernelOf(theta);
    const MatrixXd parts = response.displacements(kernel);
    const VectorXd c = fitter.coefficients(parts);
    VectorXd r = fitter.residuals(parts, c), shifts = response.shifts();
    // Overlapping windows share their noise: each counts for a quarter.
    const double noise = 4 * r.squaredNorm() / fitter.weights.sum();
    const auto effects = response.shiftEffects(kernel, c);
    double spread = 0, weight = 0, weight2 = 0;
    for (int sweep = 0; sweep < 2; ++sweep) {
        spread = weight = weight2 = 0;
        for (std::size_t m = 0; m < effects.size(); ++m) {
            double gradient = 0, information = 0;
            for (const auto& [window, slope] : effects[m]) {
                gradient += slope * r[window];
                information += fitter.weights[window] * slope * slope;
            }
            if (information <= 0) continue;
            const auto index = static_cast<Index>(m);
            const double precision = information + noise / variance;
            const double step = (gradient - noise / variance * shifts[index]) / precision;
            const double bounded = std::clamp(shifts[index] + step, -0.25, 0.25) - shifts[index];
            shifts[index] += bounded;
            for (const auto& [window, slope] : effects[m]) r[window] -= fitter.weights[window] * slope * bounded;
            const double informed = information / precision;
            spread += informed * (shifts[index] * shifts[index] + noise / precision);
            weight += informed;
            weight2 += informed * informed;
        }
    }
    response.setShifts(shifts);
    if (weight <= 0) return;
    variance = std::max(1e-8, spread / weight);
    effective = weight * weight / weight2;
}

}  // namespace

ResponseFit fitResponse(DelayedResponse response, const ResponseFitOptions& options) {
    assert(response.windows() >= 20);
    Fitter fitter{response, options, VectorXd::Ones(response.windows())};
    Theta theta = fitter.refine(fitter.coarse());
    fitter.dropOutliers(theta);
    theta = fitter.refine(theta);
    if (!options.jitter) return fitter.summary(theta);
    Events events;
    for (int round = 0; round < 8; ++round) {
        events.update(fitter, theta);
        theta = fitter.refine(theta, 2);
    }
    ResponseFit fit = fitter.summary(theta);
    fit.jitter = std::sqrt(events.variance);
    fit.jitterError = fit.jitter / std::sqrt(2 * events.effective);
    fit.standardError.deadTime = length({fit.standardError.deadTime, fit.jitter / std::sqrt(events.effective)});
    response.setShifts(VectorXd::Zero(response.events()));
    const ResponseFit plain = fitter.summary(theta);
    fit.explained = plain.explained;
    fit.residual = plain.residual;
    return fit;
}

}  // namespace mrose

#include "identification/path_fit.h"

#include <algorithm>

namespace mrose {
namespace {

constexpr std::size_t fewestPoints = 4;   // to either side of a change
constexpr std::size_t mostChanges = 200;  // that are tried before the best is refined
constexpr double significant = 15;        // times the mean square error that three parameters must be worth, each

/// What the linear parameters of one coordinate are multiplied with: place, velocity, first, second acceleration.
std::array<double, 4> basis(double since, double change) {
    const double early = std::min(since, change), late = std::max(0.0, since - change);
    return {1, since, early * early / 2 + early * late, late * late / 2};
}

struct LinearFit {
    Eigen::MatrixXd solution;  ///< 3 or 4 by 2
    double squares = 0;        ///< of all residuals
};

LinearFit solved(std::span<const TrackedPoint> points, std::optional<double> change) {
    const auto n = static_cast<Eigen::Index>(points.size());
    const Eigen::Index width = change ? 4 : 3;
    Eigen::MatrixXd design(n, width), places(n, 2);
    for (Eigen::Index i = 0; i < n; ++i) {
        const TrackedPoint& point = points[static_cast<std::size_t>(i)];
        const std::array<double, 4> row = basis(point.time - points.front().time, change.value_or(1e9));
        for (Eigen::Index k = 0; k < width; ++k) design(i, k) = row[static_cast<std::size_t>(k)];
        places(i, 0) = point.place.x;
        places(i, 1) = point.place.y;
    }
    LinearFit fit{design.householderQr().solve(places), 0};
    fit.squares = (design * fit.solution - places).squaredNorm();
    return fit;
}

/// Parameters and their covariance.
PathFit described(std::span<const TrackedPoint> points, std::optional<double> change, double noise) {
    const LinearFit fit = solved(points, change);
    PathFit path;
    path.begin = points.front().time;
    path.changes = change.has_value();
    for (int k = 0; k < (change ? 4 : 3); ++k)
        for (int d = 0; d < 2; ++d) path.parameters[static_cast<std::size_t>(2 * k + d)] = fit.solution(k, d);
    path.parameters[PathFit::change] = change.value_or(1e9);
    const Eigen::Index free = change ? 9 : 6;
    const auto n = static_cast<Eigen::Index>(points.size());
    Eigen::MatrixXd jacobian = Eigen::MatrixXd::Zero(2 * n, free);
    for (Eigen::Index i = 0; i < n; ++i) {
        const double since = points[static_cast<std::size_t>(i)].time - path.begin;
        const std::array<double, 4> row = basis(since, path.parameters[PathFit::change]);
        for (Eigen::Index d = 0; d < 2; ++d) {
            for (Eigen::Index k = 0; k < (change ? 4 : 3); ++k)
                jacobian(2 * i + d, 2 * k + d) = row[static_cast<std::size_t>(k)];
            if (change)
                jacobian(2 * i + d, 8) = (fit.solution(2, d) - fit.solution(3, d)) * std::max(0.0, since - *change);
        }
    }
    const double freedom = std::max(1.0, static_cast<double>(2 * n - free));
    path.residual = std::sqrt(fit.squares / freedom);
    const double variance = std::max(noise * noise, fit.squares / freedom);
    const Eigen::MatrixXd inverse =
        (jacobian.transpose() * jacobian).ldlt().solve(Eigen::MatrixXd::Identity(free, free));
    path.covariance.topLeftCorner(free, free) = variance * inverse;
    return path;
}

}  // namespace

Point PathFit::placeAt(const Parameters& p, double time) const {
    const std::array<double, 4> row = basis(time - begin, p[change]);
    Point at;
    for (std::size_t k = 0; k < 4; ++k) at = at + row[k] * Point{p[2 * k], p[2 * k + 1]};
    return at;
}

Point PathFit::velocityAt(const Parameters& p, double time) const {
    const double since = time - begin;
    const double early = std::min(since, p[change]), late = std::max(0.0, since - p[change]);
    return {p[velocity] + p[first] * early + p[second] * late,
            p[velocity + 1] + p[first + 1] * early + p[second + 1] * late};
}

double PathFit::errorOf(const std::function<double(const Parameters&)>& value) const {
    Eigen::Matrix<double, count, 1> slope = Eigen::Matrix<double, count, 1>::Zero();
    for (std::size_t i = 0; i < count; ++i) {
        const double step = std::sqrt(covariance(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(i))) * 0.1;
        if (!(step > 0)) continue;
        Parameters more = parameters, less = parameters;
        more[i] += step;
        less[i] -= step;
        slope(static_cast<Eigen::Index>(i)) = (value(more) - value(less)) / (2 * step);
    }
    return std::sqrt(std::max(0.0, slope.dot(covariance * slope)));
}

std::optional<PathFit> fitEvenPath(std::span<const TrackedPoint> points, double noise) {
    if (points.size() < fewestPoints) return std::nullopt;
    return described(points, std::nullopt, noise);
}

std::optional<PathFit> fitChangingPath(std::span<const TrackedPoint> points, double noise) {
    if (points.size() < 2 * fewestPoints + 1) return std::nullopt;
    const double begin = points.front().time;
    const auto squares = [&](double change) { return solved(points, change).squares; };
    const std::size_t stride = 1 + points.size() / mostChanges;
    double best = 0, least = INFINITY, step = 0;
    for (std::size_t i = fewestPoints - 1; i + fewestPoints < points.size(); i += stride) {
        const double change = points[i].time - begin, found = squares(change);
        const std::size_t next = std::min(i + stride, points.size() - 1);
        if (found < least) best = change, least = found, step = points[next].time - points[i].time;
    }
    while (step > 1e-4) {
        for (const double change : {best - step / 2, best + step / 2})
            if (const double found = squares(change); found < least) best = change, least = found;
        step /= 2;
    }
    const double freedom = static_cast<double>(2 * points.size()) - 9;
    if (freedom < 1) return std::nullopt;
    const double variance = std::max(noise * noise, least / freedom);
    if (solved(points, std::nullopt).squares - least < 3 * significant * variance) return std::nullopt;
    return described(points, best, noise);
}

}  // namespace mrose

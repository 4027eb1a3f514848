#include "assessment/metrics.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "assessment/tracker_history.h"
#include "geometry/point.h"
#include "world/noise.h"

namespace mrose {
namespace {

constexpr int bootstrapDraws = 1000;

double mean(std::span<const double> values) {
    double sum = 0;
    for (const double value : values) sum += value;
    return values.empty() ? unknownNumber : sum / static_cast<double>(values.size());
}

double rms(std::span<const double> values) {
    double sum = 0;
    for (const double value : values) sum += value * value;
    return values.empty() ? unknownNumber : std::sqrt(sum / static_cast<double>(values.size()));
}

void add(ErrorSums& sums, const Window& window, const WindowErrors& errors) {
    sums.add(errors.positionMean, errors.headingMean, window.path, window.rotation);
}

/// The windows are drawn by number alone, so that models are resampled alike.
void bootstrap(std::span<const Window> windows, std::span<const WindowErrors> errors,
               std::span<const std::size_t> chosen, Summary& summary) {
    std::vector<double> p, hd;
    for (int draw = 0; draw < bootstrapDraws; ++draw) {
        ErrorSums sums;
        for (std::uint32_t i = 0; i < chosen.size(); ++i) {
            const double unit = uniformNoise({0, draw, i, 0});
            const std::size_t index = chosen[static_cast<std::size_t>(unit * static_cast<double>(chosen.size()))];
            add(sums, windows[index], errors[index]);
        }
        const PercentErrors drawn = sums.percentErrors();
        if (std::isfinite(drawn.p)) p.push_back(drawn.p);
        if (std::isfinite(drawn.hd)) hd.push_back(drawn.hd);
    }
    summary.p95 = {quantile(p, 0.025), quantile(p, 0.975)};
    summary.hd95 = {quantile(hd, 0.025), quantile(hd, 0.975)};
}

/// The distribution of what `value` says of each chosen window.
template <class Value>
Distribution overWindows(std::span<const std::size_t> chosen, Value value) {
    std::vector<double> values;
    values.reserve(chosen.size());
    for (const std::size_t i : chosen) values.push_back(value(i));
    return distribution(std::move(values));
}

}  // namespace

WindowErrors windowErrors(std::span<const Pose> truth, std::span<const Pose> predicted) {
    WindowErrors errors;
    if (predicted.empty()) return errors;
    for (std::size_t k = 0; k < predicted.size(); ++k) {
        const Pose& real = truth[k + 1];
        errors.position.push_back(distance(position(predicted[k]), position(real)));
        errors.heading.push_back(std::abs(wrapAngle(predicted[k].heading - real.heading)));
    }
    errors.positionMean = mean(errors.position);
    errors.headingMean = mean(errors.heading);
    errors.positionFinal = errors.position.back();
    errors.headingFinal = errors.heading.back();
    const Pose last = relative(truth[predicted.size()], predicted.back());
    errors.along = last.x;
    errors.left = last.y;
    errors.headingFinalSigned = wrapAngle(last.heading);
    return errors;
}

double quantile(std::span<double> values, double q) {
    if (values.empty()) return unknownNumber;
    const double position = q * static_cast<double>(values.size() - 1);
    const auto low = static_cast<std::size_t>(position);
    const auto at = values.begin() + static_cast<std::ptrdiff_t>(low);
    std::nth_element(values.begin(), at, values.end());
    if (low + 1 >= values.size()) return *at;
    const double next = *std::min_element(at + 1, values.end());
    return *at + (position - static_cast<double>(low)) * (next - *at);
}

Distribution distribution(std::vector<double> values) {
    Distribution d;
    d.count = values.size();
    d.mean = mean(values);
    d.rms = rms(values);
    d.p10 = quantile(values, 0.10);
    d.p25 = quantile(values, 0.25);
    d.median = quantile(values, 0.50);
    d.p75 = quantile(values, 0.75);
    d.p90 = quantile(values, 0.90);
    return d;
}

Summary summarise(std::span<const Window> windows, std::span<const WindowErrors> errors,
                  std::span<const std::size_t> chosen, const WindowOptions& options) {
    ErrorSums sums;
    std::vector<std::size_t> driving;
    for (const std::size_t i : chosen) {
        add(sums, windows[i], errors[i]);
        if (drives(windows[i], options)) driving.push_back(i);
    }
    Summary s;
    s.windows = chosen.size();
    s.path = sums.path;
    s.rotation = sums.rotation;
    s.p = sums.percentErrors().p;
    s.hd = sums.percentErrors().hd;
    bootstrap(windows, errors, chosen, s);
    s.positionMeanOverPath =
        overWindows(driving, [&](std::size_t i) { return percent(errors[i].positionMean, windows[i].path); });
    s.positionFinalOverPath =
        overWindows(driving, [&](std::size_t i) { return percent(errors[i].positionFinal, windows[i].path); });
    s.positionFinalOverPathBySteps =
        overWindows(driving, [&](std::size_t i) { return percent(errors[i].positionFinal, windows[i].pathBySteps); });
    s.positionMean = overWindows(chosen, [&](std::size_t i) { return errors[i].positionMean; });
    s.positionFinal = overWindows(chosen, [&](std::size_t i) { return errors[i].positionFinal; });
    s.headingMean = overWindows(chosen, [&](std::size_t i) { return errors[i].headingMean; });
    s.headingFinal = overWindows(chosen, [&](std::size_t i) { return errors[i].headingFinal; });
    s.along = overWindows(chosen, [&](std::size_t i) { return errors[i].along; });
    s.left = overWindows(chosen, [&](std::size_t i) { return errors[i].left; });
    s.headingSigned = overWindows(chosen, [&](std::size_t i) { return errors[i].headingFinalSigned; });
    return s;
}

std::vector<ErrorsAt> errorsOverTime(std::span<const WindowErrors> errors, Nanoseconds step) {
    std::size_t longest = 0;
    for (const WindowErrors& e : errors) longest = std::max(longest, e.position.size());
    std::vector<ErrorsAt> result;
    for (std::size_t k = 0; k < longest; ++k) {
        std::vector<double> position, heading;
        for (const WindowErrors& e : errors) {
            if (k >= e.position.size()) continue;
            position.push_back(e.position[k]);
            heading.push_back(e.heading[k]);
        }
        const double time = toSeconds(static_cast<Nanoseconds>(k + 1) * step);
        result.push_back({time, distribution(std::move(position)), distribution(std::move(heading))});
    }
    return result;
}

RelativePieces relativePieces(const Log& log, std::span<const Window> windows, double horizon, Nanoseconds step) {
    RelativePieces pieces;
    const int steps = std::max(1, static_cast<int>(std::lround(horizon / toSeconds(step))));
    pieces.horizon = steps * toSeconds(step);
    for (const Window& w : windows) {
        const Trajectory& trajectory = log.robots[w.robot].trajectories[w.trajectory];
        for (int first = 0; first + steps <= w.steps(); first += steps) {
            auto start = measureStart(trajectory, w.start + first * step, steps);
            if (!start) continue;
            start->pose = {};
            pieces.starts.push_back(*start);
            pieces.robots.push_back(w.robot);
            pieces.real.push_back(
                relative(w.truth[static_cast<std::size_t>(first)], w.truth[static_cast<std::size_t>(first + steps)]));
        }
    }
    return pieces;
}

RelativePoseError relativePoseError(const RelativePieces& pieces, std::span<const std::vector<Pose>> predicted) {
    std::vector<double> position, heading;
    for (std::size_t i = 0; i < predicted.size(); ++i) {
        const Pose &real = pieces.real[i], &end = predicted[i].back();
        position.push_back(length({end.x - real.x, end.y - real.y}));
        heading.push_back(wrapAngle(end.heading - real.heading));
    }
    return {pieces.horizon, predicted.size(), rms(position), rms(heading)};
}

}  // namespace mrose

#include "identification/delayed_response.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "geometry/elementary.h"

namespace mrose {
namespace {

constexpr double blockLength = 10;    // s
constexpr double eventLength = 0.1;   // s
constexpr double shortestLag = 1e-4;  // s

double sign(double x) { return x > 0 ? 1 : x < 0 ? -1 : 0; }

/// A zero of under 50 ms between equal commands: readers drop these unless asked not to.
bool isBlip(const std::vector<StampedCommand>& commands, std::size_t i) {
    return i + 1 < commands.size() && commands[i].command == Command{} &&
           commands[i - 1].command == commands[i + 1].command && commands[i + 1].time - commands[i].time < 50'000'000;
}

double stepResponse(double since, double lag) {
    if (since <= 0) return 0;
    return lag < shortestLag ? 1 : -exponentialMinusOne(-since / lag);
}

}  // namespace

DelayedResponse::Parts DelayedResponse::partsOf(const Command& command) const {
    const double own = channel_ == Channel::v ? command.v : command.w;
    const double other = channel_ == Channel::v ? command.w : command.v;
    if (map_ == StaticMap::command) return {own, 0, 0, 0};
    const double moving = own != 0 || other != 0 ? 1 : 0;
    if (map_ == StaticMap::affine) return {own, moving, 0, 0};
    return {own, moving, sign(own), own * std::abs(other)};
}

void DelayedResponse::appendCommands(Run& run, const Trajectory& trajectory) {
    const auto& commands = trajectory.commands;
    const Nanoseconds origin = commands.front().time;
    Eigen::Index event = shifts_.size() - 1;
    double eventBegan = -eventLength;
    for (std::size_t i = 0; i < commands.size(); ++i) {
        if (i > 0 && (commands[i].command == commands[i - 1].command || isBlip(commands, i))) continue;
        const double time = toSeconds(commands[i].time - origin);
        if (time - eventBegan >= eventLength) ++event, eventBegan = time;
        run.issueTimes.push_back(time);
        run.event.push_back(event);
        run.parts.push_back(partsOf(commands[i].command));
    }
    run.switchTimes = run.issueTimes;
    integrateParts(run);
    const Eigen::Index before = shifts_.size();
    shifts_.conservativeResize(event + 1);
    shifts_.tail(event + 1 - before).setZero();
}

void DelayedResponse::integrateParts(Run& run) {
    run.integral.assign(run.parts.size(), Parts::Zero());
    for (std::size_t k = 1; k < run.parts.size(); ++k)
        run.integral[k] = run.integral[k - 1] + (run.switchTimes[k] - run.switchTimes[k - 1]) * run.parts[k - 1];
}

void DelayedResponse::setShifts(const Eigen::VectorXd& shifts) {
    assert(shifts.size() == shifts_.size());
    shifts_ = shifts;
    for (Run& run : runs_) {
        for (std::size_t k = 0; k < run.issueTimes.size(); ++k) {
            const double shifted = run.issueTimes[k] + shifts_[run.event[k]];
            run.switchTimes[k] = k == 0 ? shifted : std::max(run.switchTimes[k - 1], shifted);
        }
        integrateParts(run);
    }
}

/// A step of the target that comes a little later takes its step response from the travelled distance.
std::vector<std::vector<DelayedResponse::ShiftEffect>> DelayedResponse::shiftEffects(
    const ResponseKernel& kernel, const Eigen::VectorXd& coefficients) const {
    std::vector<std::vector<ShiftEffect>> effects(static_cast<std::size_t>(shifts_.size()));
    const double reach = 6 * kernel.lag + 1e-9;
    const auto responded = [&](const Run& run, std::size_t point, double begin) {
        double sum = 0;
        for (std::size_t i = run.moved.begin[point]; i < run.moved.begin[point + 1]; ++i)
            sum += stepResponse(run.moved.times[i] - begin, kernel.lag);
        return sum / static_cast<double>(run.moved.begin[point + 1] - run.moved.begin[point]);
    };
    Eigen::Index firstRow = 0;
    for (const Run& run : runs_) {
        std::size_t first = 0;
        for (std::size_t k = 1; k < run.parts.size(); ++k) {
            const double jump = (run.parts[k] - run.parts[k - 1]).head(parts()).matrix().dot(coefficients);
            const double begin = run.switchTimes[k] + kernel.deadTime;
            const auto& windows = run.moved.windows;
            while (first < windows.size() && run.pointTime(windows[first].to) <= begin - eventLength) ++first;
            auto& own = effects[static_cast<std::size_t>(run.event[k])];
            for (std::size_t i = first; jump != 0 && i < windows.size(); ++i) {
                if (run.pointTime(windows[i].from) - begin > reach) break;
                const double slope =
                    -jump * (responded(run, windows[i].to, begin) - responded(run, windows[i].from, begin));
                if (slope != 0) own.push_back({firstRow + static_cast<Eigen::Index>(i), slope});
            }
        }
        firstRow += static_cast<Eigen::Index>(run.moved.windows.size());
    }
    return effects;
}

void DelayedResponse::add(const Trajectory& trajectory) {
    MotionWindows moved = motionWindows(trajectory);
    if (moved.windows.empty()) return;
    Run run;
    appendCommands(run, trajectory);
    const std::int32_t firstBlock = blocks_.empty() ? 0 : blocks_.back() + 1;
    const double begin = moved.times.front(), end = moved.times.back();
    run.moved = std::move(moved);
    for (const MotionWindows::Window& window : run.moved.windows) {
        measured_.push_back(channel_ == Channel::v ? window.along : window.rotation);
        const double since = run.pointTime(window.from) - begin;
        blocks_.push_back(firstBlock + static_cast<std::int32_t>(since / blockLength));
    }
    for (std::size_t k = 1; k < run.parts.size(); ++k)
        switches_ += run.parts[k][0] != run.parts[k - 1][0] && run.issueTimes[k] > begin && run.issueTimes[k] < end;
    runs_.push_back(std::move(run));
}

/// The velocity's integral, averaged over the poses of each point. A lag's output x has the integral U - lag x, where U
/// is that of its input.
std::vector<DelayedResponse::Parts> DelayedResponse::travelled(const Run& run, const ResponseKernel& kernel) {
    const double lag = kernel.lag < shortestLag ? 0 : kernel.lag;
    std::vector<Parts> lagged(run.parts);  // the lag's output at each switch; settled before the first
    for (std::size_t k = 1; k < lagged.size(); ++k) {
        const double left = lag == 0 ? 0 : exponential((run.switchTimes[k - 1] - run.switchTimes[k]) / lag);
        lagged[k] = run.parts[k - 1] + left * (lagged[k - 1] - run.parts[k - 1]);
    }
    const auto& begin = run.moved.begin;
    std::vector<Parts> result(begin.size() - 1, Parts::Zero());
    for (std::size_t point = 0, k = 0; point < result.size(); ++point) {
        for (std::size_t i = begin[point]; i < begin[point + 1]; ++i) {
            const double time = run.moved.times[i] - kernel.deadTime;
            while (k + 1 < run.switchTimes.size() && run.switchTimes[k + 1] <= time) ++k;
            const double since = time - run.switchTimes[k];
            result[point] += run.integral[k] + (since - lag) * run.parts[k];
            if (lag > 0 && since > 0 && since < 40 * lag)
                result[point] -= lag * exponential(-since / lag) * (lagged[k] - run.parts[k]);
        }
        result[point] /= static_cast<double>(begin[point + 1] - begin[point]);
    }
    return result;
}

Eigen::MatrixXd DelayedResponse::displacements(const ResponseKernel& kernel) const {
    Eigen::MatrixXd result(windows(), parts());
    Eigen::Index row = 0;
    for (const Run& run : runs_) {
        const std::vector<Parts> at = travelled(run, kernel);
        for (const MotionWindows::Window& window : run.moved.windows)
            result.row(row++) = (at[window.to] - at[window.from]).head(parts()).matrix().transpose();
    }
    return result;
}

}  // namespace mrose

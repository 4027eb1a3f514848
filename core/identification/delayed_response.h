#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "identification/motion_windows.h"

namespace mrose {

enum class Channel { v, w };

/// How a command turns into velocity in time: it waits for `deadTime` and is then approached with a first-order lag.
struct ResponseKernel {
    double deadTime = 0;  ///< s, the mean one where single commands differ
    double lag = 0;       ///< s
};

/// What steady velocity is taken to be made of, linearly.
enum class StaticMap {
    command,  ///< gain * command
    affine,   ///< gain * command + bias while any command moves the robot
    bent      ///< that + a term in the command's sign (dead bands) + command * |command of the other channel| (scrub)
};

/// One channel of several trajectories, ready for its response to be fitted: measured displacements of windows, and the
/// displacements that each part of the static map would give after any kernel, in closed form.
class DelayedResponse {
public:
    DelayedResponse(Channel channel, StaticMap map) : channel_(channel), map_(map) {}

    void add(const Trajectory& trajectory);

    Eigen::Index windows() const { return static_cast<Eigen::Index>(measured_.size()); }
    Eigen::Index parts() const { return map_ == StaticMap::command ? 1 : map_ == StaticMap::affine ? 2 : 4; }
    std::int64_t switches() const { return switches_; }  ///< changes of this channel's command that windows can show

    Eigen::Map<const Eigen::VectorXd> measured() const { return {measured_.data(), windows()}; }
    /// windows() x parts(): displacement in each window for a coefficient of 1.
    Eigen::MatrixXd displacements(const ResponseKernel& kernel) const;

    /// Commands that change within 0.1 s make one event, which may come later or earlier than the mean.
    Eigen::Index events() const { return static_cast<Eigen::Index>(shifts_.size()); }
    const Eigen::VectorXd& shifts() const { return shifts_; }  ///< s, 0 until set
    void setShifts(const Eigen::VectorXd& shifts);
    /// How displacements change with an event's shift.
    struct ShiftEffect {
        Eigen::Index window = 0;
        double slope = 0;  ///< m/s or rad/s
    };
    std::vector<std::vector<ShiftEffect>> shiftEffects(const ResponseKernel& kernel,
                                                       const Eigen::VectorXd& coefficients) const;

    /// Stretch of about 10 s that a window belongs to: the unit within which errors are not independent.
    const std::vector<std::int32_t>& blocks() const { return blocks_; }

private:
    using Parts = Eigen::Array4d;
    struct Run {
        std::vector<double> issueTimes;   ///< of either channel's changes, s after the first command
        std::vector<Eigen::Index> event;  ///< that each change belongs to
        std::vector<double> switchTimes;  ///< issueTimes with their events' shifts, in order
        std::vector<Parts> parts;         ///< in force from there on
        std::vector<Parts> integral;      ///< of them, up to there
        MotionWindows moved;
        double pointTime(std::size_t point) const { return moved.times[moved.begin[point]]; }
    };
    Parts partsOf(const Command& command) const;
    void appendCommands(Run& run, const Trajectory& trajectory);
    static void integrateParts(Run& run);
    static std::vector<Parts> travelled(const Run& run, const ResponseKernel& kernel);

    Channel channel_;
    StaticMap map_;
    std::vector<Run> runs_;
    std::vector<double> measured_;
    std::vector<std::int32_t> blocks_;
    Eigen::VectorXd shifts_;
    std::int64_t switches_ = 0;
};

}  // namespace mrose

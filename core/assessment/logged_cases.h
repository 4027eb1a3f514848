#pragma once

#include <numbers>
#include <span>
#include <string>
#include <vector>

#include "io/error.h"
#include "logs/robot_log.h"
#include "perception/sensed_state.h"

namespace mrose {

/// Which subjects at which looks a sensor is judged by. What is outside is never asked.
struct CaseRule {
    SubjectKind subjects = SubjectKind::landmark;
    double range = 9, bearing = 50 * std::numbers::pi / 180;  ///< m, rad to either side
    /// Readings farther off the truth are wrong ones: reported, but their errors are judged nowhere.
    double grossRange = 1, grossBearing = 0.15;  ///< m, rad
};

/// A subject near enough to be asked about at a look: was it reported, and as what?
struct LoggedCase {
    std::size_t subject = 0;        ///< in LoggedCases::subjects
    double range = 0, bearing = 0;  ///< m, rad: the truth at the look's stamp
    bool reported = false;
    double measuredRange = 0, measuredBearing = 0;  ///< of what was reported
    bool sound = false;                             ///< reported, and not a gross error
};

/// A look of a robot, with `count` cases from `first` on; none where nothing was near enough.
struct LoggedLook {
    std::size_t robot = 0;       ///< in LoggedCases::robots
    std::size_t trajectory = 0;  ///< of that robot in the log
    Nanoseconds time = 0;        ///< the stamp
    std::size_t first = 0, count = 0;
};

/// What one kind of sensor reported in a log, beside what was true: what models of it are held against.
struct LoggedCases {
    std::string source, format, sensor;
    int dataset = 0;
    bool synthetic = false;
    std::vector<LogFile> files;
    CaseRule rule;
    struct Robot {
        std::string name;
        std::size_t inLog = 0;  ///< in Log::robots
        std::size_t looks = 0, cases = 0, readings = 0, gross = 0;
        std::size_t withoutTruth = 0;  ///< looks at which it is not known where it was: left out
        SensorDefects defects;
    };
    std::vector<Robot> robots;
    std::vector<std::string> subjects;  ///< by LoggedCase::subject, as in Log::subjects
    std::vector<LoggedLook> looks;
    std::vector<LoggedCase> cases;

    const char* real() const { return realWord(synthetic); }
};

/// The cases of some robots of a log, or of all with such a sensor. Error: an unknown robot, one without such a sensor,
/// nothing that could have been reported, or nothing that was.
Expected<LoggedCases> loggedCases(const Log& log, const std::string& sensor, std::span<const std::string> robots,
                                  const CaseRule& rule);

}  // namespace mrose

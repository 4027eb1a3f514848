#pragma once

#include <optional>
#include <string>
#include <vector>

#include "identification/advised_drive.h"
#include "io/error.h"
#include "io/progress.h"

namespace mrose {

/// For which network, beside which of its robot's logs, and within what a drive is to be found that would teach it.
struct AdviseRequest {
    std::string network;
    std::vector<std::string> logs;
    std::vector<std::string> robots = {};  ///< of the logs, by name; empty: all
    std::string output = {};  ///< a velocity script: .csv, as logs are; .toml, a scenario's controller. Empty: none
    bool overwrite = false;   ///< of a file that is there already
    /// m/s, m/s, rad/s, none negative; otherwise those of the logs.
    std::optional<double> forward = {}, backward = {}, turn = {};
    double duration = 120, radius = 3;  ///< s; m
    std::uint64_t seed = 1;
};

/// Manoeuvres that were chosen for the same reason.
struct AdviceReason {
    std::string what;  ///< "turns faster than the logs' 0.50 rad/s"
    double seconds = 0;
    double unfamiliar = 0;  ///< share of the time
    double doubt = 0;       ///< disagreement of the members, in units of their mean over the logs
};

struct Advice {
    AdvisedDrive drive;
    CommandLimits limits, logs;         ///< those used, and what the logs have
    std::vector<AdviceReason> reasons;  ///< the longest first
    double rest = 0;                    ///< s, before and after the manoeuvres
    std::vector<std::string> notices;
    std::string script;  ///< what the output holds
};

/// Error: a file; what is no motion network; limits that allow no motion; a name that ends neither in .csv nor in
/// .toml; logs without patterns; it was cancelled.
Expected<Advice> advise(const AdviseRequest& request, const Progress& progress = {});

/// "forward up to 0.40 m/s, backward up to 0.20 m/s, turning up to 1.75 rad/s either way".
std::string limitsText(const CommandLimits& limits);
/// What the drive's duration consists of: "38.2 s: turns faster than ...; 82 % of it unfamiliar; members disagree 3.2
/// times as much as over the logs", and so on; the rest before and after.
std::vector<std::string> partTexts(const Advice& advice);
/// "3.1 x 2.7 m round the robot's reference point".
std::string spaceText(const AdvisedDrive& drive);

}  // namespace mrose

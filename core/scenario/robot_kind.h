#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/error.h"
#include "io/toml_table.h"
#include "logs/robot_log.h"
#include "motion/robot_traits.h"

namespace mrose {

/// A kind of robot, as the section [kind] of its robot file says it: which logs are of such robots, and what learning
/// from them must know. Nothing else decides it.
struct RobotKind {
    std::string file;                 ///< the robot file's name: "create.toml"
    RobotTraits traits;               ///< with the kind's name
    std::vector<std::string> logs;    ///< what says that such robots drove in a log: its format; "synthetic"
    std::string environment;          ///< where they drove in such a log; "": nothing is known of that place
    std::string robotName;            ///< what the robots of such a log are called: "create" makes "create 3"
    std::vector<std::string> robots;  ///< of such logs, which the kind's network distinguishes
    bool operator==(const RobotKind&) const = default;
};

/// The section of a robot file; `file` is its name.
RobotKind readRobotKind(TomlTable table, const std::string& file);

/// What a robot file says of its kind alone: networks and shapes that it names need not be there yet. nullopt where it
/// has no such section. Error: it is no robot file, or the section is wrong.
Expected<std::optional<RobotKind>> parseRobotKind(std::string_view text, const std::string& file,
                                                  const std::string& shown);

using RobotKinds = std::vector<RobotKind>;

/// The kinds of all robot files in a folder. Error: a file that cannot be read; two kinds of one name, or of the same
/// logs.
Expected<RobotKinds> readRobotKinds(const std::filesystem::path& folder);

/// The kind that drove in a log; null where the log does not say it.
const RobotKind* kindOfLog(const RobotKinds& kinds, const Log& log);
const RobotKind* kindNamed(const RobotKinds& kinds, std::string_view name);

}  // namespace mrose

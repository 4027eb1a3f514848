#include "comparison/log_scenario.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "evaluation/format.h"
#include "io/toml_edit.h"

namespace mrose {
namespace {

constexpr const char* placeName = "open place.toml";

/// What the robots of a log are, and where they drive.
struct Kind {
    std::string robotFile, robotName, environment;
    std::vector<std::string> known;  ///< robots that the kind's network tells apart
};

std::optional<Kind> kindOf(const Log& log) {
    if (log.format == "mrclam") return Kind{"create.toml", "create", "mrclam_arena.toml", {"1", "2", "3", "4", "5"}};
    if (log.format == "husky-windows") return Kind{"husky.toml", "husky", placeName, {"husky"}};
    if (log.synthetic) return Kind{"pioneer1.toml", "pioneer", placeName, {"reference"}};
    return {};
}

/// All that the robots drive in, with room round it, in whole metres.
std::string openPlace(const Log& log) {
    double left = 0, right = 0, bottom = 0, top = 0;
    bool any = false;
    for (const RobotLog& robot : log.robots)
        for (const Trajectory& trajectory : robot.trajectories)
            for (const StampedPose& stamped : trajectory.poses) {
                const Pose& at = stamped.pose;
                left = any ? std::min(left, at.x) : at.x;
                right = any ? std::max(right, at.x) : at.x;
                bottom = any ? std::min(bottom, at.y) : at.y;
                top = any ? std::max(top, at.y) : at.y;
                any = true;
            }
    const auto down = [](double value) { return fixed(std::clamp(std::floor(value) - 1, -9000.0, 9000.0), 1); };
    const auto up = [](double value) { return fixed(std::clamp(std::ceil(value) + 1, -9000.0, 9000.0), 1); };
    const std::string x0 = down(left), x1 = up(right), y0 = down(bottom), y1 = up(top);
    return "format = \"mrose environment\"\nversion = 1\nname = \"open place\"\n\n[floor]\narea_m = [[" + x0 + ", " +
           y0 + "], [" + x1 + ", " + y0 + "], [" + x1 + ", " + y1 + "], [" + x0 + ", " + y1 + "]]\n";
}

/// "create 3"; a robot that the log calls what it is needs no more.
std::string nameOf(const Kind& kind, const RobotLog& robot) {
    return kind.robotName == robot.robot ? robot.robot : kind.robotName + ' ' + robot.robot;
}

}  // namespace

bool tellsRobotKind(const Log& log) { return kindOf(log).has_value(); }

Expected<Descriptions> scenarioOfLog(const Log& log, const std::string& place, const std::string& robotFile) {
    std::optional<Kind> kind = kindOf(log);
    if (!robotFile.empty())
        kind = Kind{robotFile, "robot", kind ? kind->environment : placeName,
                    kind && kind->robotFile == robotFile ? kind->known : std::vector<std::string>{}};
    if (!kind)
        return fail(log.source,
                    "does not tell what kind of robot drove; expected a robot file (--robot), or a scenario whose "
                    "robots play it");
    if (log.robots.empty()) return fail(log.source, "has no robots");
    const std::string name = std::filesystem::path(log.source).filename().string();
    const std::string file = name + ".toml";
    std::string text = "format = \"mrose scenario\"\nversion = 1\nname = " + tomlString(name) +
                       "\nenvironment = " + tomlString(kind->environment) + "\nseed = 1\nduration_s = 60.0\n";
    for (const RobotLog& robot : log.robots) {
        const bool told = std::find(kind->known.begin(), kind->known.end(), robot.robot) != kind->known.end();
        text += "\n[[robot]]\nname = " + tomlString(nameOf(*kind, robot)) + "\ntype = " + tomlString(kind->robotFile) +
                '\n' + (told ? "motion_robot = " + tomlString(robot.robot) + '\n' : "") +
                "controller = { kind = \"log_player\", log = " + tomlString(place) +
                ", robot = " + tomlString(robot.robot) + " }\n";
    }
    Descriptions descriptions{file, {{file, std::move(text)}}};
    if (kind->environment == placeName) descriptions.texts.emplace(placeName, openPlace(log));
    return descriptions;
}

}  // namespace mrose

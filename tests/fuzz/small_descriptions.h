#pragma once

#include <map>
#include <string>
#include <utility>

#include "scenario/description_source.h"

namespace mrose {

// Small and sound descriptions, for what a fuzzed one names.

constexpr const char* shapeText = R"(format = "mrose shape"
version = 1
name = "disc"
part = [{ circle = { radius_m = 0.1 } }]
)";

constexpr const char* robotText = R"(format = "mrose robot"
version = 1
name = "robot"
shape = "x"
mass_kg = 5
motion = { network = "x" }
manipulator = [{ name = "kicker", position_m = [0.1, 0], speed_mps = 3, reach_m = 0.2, width_m = 0.3, recharge_s = 0.1 }]
)";

constexpr const char* environmentText = R"(format = "mrose environment"
version = 1
name = "field"
wall = [{ points_m = [[-40, -20], [40, -20], [40, 20], [-40, 20]], closed = true, thickness_m = 0.1, side = "right" }]
)";

/// Two robots with controllers that remember, and a ball.
constexpr const char* pairText = R"(format = "mrose scenario"
version = 1
name = "pair"
environment = "x.toml"
seed = 3
duration_s = 1.0
object = [{ name = "ball", kind = "ball", shape = "x.toml", mass_kg = 0.4, start = { x_m = 0.5, y_m = 0.0 } }]
[[robot]]
name = "chaser"
type = "x.toml"
start = { x_m = 0.0, y_m = 0.0, heading_deg = 0 }
controller = { kind = "chase_ball", target_m = [-4.0, 0.0] }
[[robot]]
name = "wanderer"
type = "x.toml"
start = { x_m = 2.0, y_m = 0.0, heading_deg = 180 }
controller = { kind = "wander" }
)";

constexpr const char* smallNetwork = R"(format = "mrose motion network"
version = 1
form = "state"
robot_type = "x"
synthetic = true
robots = ["1", "2", "3", "4", "5"]
period_s = 0.1
hidden = 1
turn_offset_radps = 0.0
inputs = [
  { quantity = "command_v", newest_s = 0.1, oldest_s = 0.2, mean = 0.0, scale = 1.0 },
  { quantity = "command_w", newest_s = 0.1, oldest_s = 0.2, mean = 0.0, scale = 1.0 },
]
outputs = [
  { name = "dx_m", mean = 0.0, scale = 0.1 },
  { name = "dy_m", mean = 0.0, scale = 0.1 },
  { name = "dphi_rad", mean = 0.0, scale = 0.1 },
  { name = "end_v_mps", mean = 0.0, scale = 1.0 },
  { name = "end_w_radps", mean = 0.0, scale = 1.0 },
]
identified = [{ robot = "5", tracker = { ahead_m = 0.0, rotated_rad = 0.0 }, v = { dead_time_s = 0.2, dead_time_error_s = 0.0, lag_s = 0.0, jitter_s = 0.0 }, w = { dead_time_s = 0.2, dead_time_error_s = 0.0, lag_s = 0.0, jitter_s = 0.0 }, delayed = { v = { dead_time_s = 0.0, lag_s = 0.0, gain = 1.0, bias = 0.0, limit = 0.0, acceleration = 0.0 }, w = { dead_time_s = 0.0, lag_s = 0.0, gain = 1.0, bias = 0.0, limit = 0.0, acceleration = 0.0 }, lateral_per_rotation_m = 0.0 }, dynamic = { v = { dead_time_s = 0.0, lag_s = 0.0, gain = 1.0, bias = 0.0, limit = 0.0, acceleration = 0.0 }, w = { dead_time_s = 0.0, lag_s = 0.0, gain = 1.0, bias = 0.0, limit = 0.0, acceleration = 0.0 }, lateral_per_rotation_m = 0.0 } }]
[training]
command = "x"
method = "x"
loss = "x"
seed = 1
patterns = 1
epochs = 1
logs = []
[held_out]
windows = 1
horizon_s = 1.0
position_percent = 1.0
heading_percent = 1.0
[layers]
hidden_weights = [[0.5, -0.5]]
hidden_biases = [0.0]
output_weights = [[1.0], [0.0], [0.5], [1.0], [0.5]]
output_biases = [0.0, 0.0, 0.0, 0.0, 0.0]
)";

/// The given texts, and something sound for whatever they name.
class SmallDescriptions final : public DescriptionSource {
public:
    explicit SmallDescriptions(std::map<std::string, std::string> given) : given_(std::move(given)) {}

    Expected<std::optional<std::string>> text(const std::string& name) override {
        if (const auto found = given_.find(name); found != given_.end()) return found->second;
        for (const auto& [folder, text] :
             {std::pair("mrose:shapes/", shapeText), std::pair("mrose:nets/", smallNetwork),
              std::pair("mrose:resources/robots/", robotText),
              std::pair("mrose:resources/environments/", environmentText)})
            if (name.starts_with(folder) && !besideARobot(name)) return text;
        return std::nullopt;
    }
    Expected<std::optional<ExcerptContent>> excerpt(const LogExcerpt& wanted) override {
        // Each robot has a place of its own.
        const double y = wanted.robot.empty() ? 0 : wanted.robot.front() % 10;
        return ExcerptContent{{{-nanosecondsPerSecond, {0.1, 0}}, {0, {0.2, 0.3}}}, Pose{1, y, 0.5}};
    }

private:
    /// What a robot file names is looked for beside it first; the robot above is alone in its folder.
    static bool besideARobot(const std::string& name) { return name == "mrose:resources/robots/x"; }

    std::map<std::string, std::string> given_;
};

}  // namespace mrose

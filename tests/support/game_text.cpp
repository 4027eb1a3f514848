#include "support/game_text.h"

namespace mrose {

std::string gameText() {
    return R"(format = "mrose scenario"
version = 1
name = "a game"
environment = "midsize_2001.toml"
seed = 5
duration_s = 3.0
random_factor = 0.1
variation = { robot_position_m = 0.3, robot_heading_deg = 40, object_position_m = 0.2, mass_share = 0.2 }

[[robot]]
name = "one's"
type = "pioneer1.toml"
start = { x_m = -0.6, y_m = 0.1, heading_deg = 0 }
controller = { kind = "chase_ball", target_m = [4.8, 0.0] }

[[robot]]
name = "two"
type = "nomad200.toml"
start = { x_m = 1.0, y_m = 1.0, heading_deg = 200 }
controller = { kind = "wander" }

[[object]]
name = "ball"
shape = "ball.toml"
mass_kg = 0.43
start = { x_m = 0.0, y_m = 0.0 }
)";
}

}  // namespace mrose

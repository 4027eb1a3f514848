#include "scenario/descriptions.h"

#include <gtest/gtest.h>

#include "motion/network_fixture.h"
#include "simulation/step.h"

namespace mrose {
namespace {

constexpr const char* disc = R"(format = "mrose shape"
version = 1
name = "disc"
[[part]]
name = "body"
colour = "#ff8000"
circle = { radius_m = 0.2 }
)";

constexpr const char* ball = R"(format = "mrose shape"
version = 1
name = "ball"
[[part]]
circle = { radius_m = 0.1 }
)";

constexpr const char* robot = R"(format = "mrose robot"
version = 1
name = "kinematic"
shape = "disc.toml"
mass_kg = 12.5
control_period_s = 0.1
surface = { friction = 0.7, restitution = 0.2 }
[kinematics]
v = { dead_time_s = 0.2, lag_s = 0.1, gain = 0.9, bias_mps = 0.01, limit_mps = 0.5, acceleration_mps2 = 0.4 }
w = { dead_time_s = 0.3, limit_degps = 90, acceleration_degps2 = 180, bias_degps = 1.8 }
lateral_per_rotation_m = 0.02
[motion_noise]
distance_per_distance = 0.01
rotation_per_rotation = 0.02
rotation_per_distance_degpm = 9
[[manipulator]]
name = "kicker"
position_m = [0.2, 0.05]
direction_deg = 30
speed_mps = 2.5
reach_m = 0.04
width_m = 0.18
recharge_s = 1.5
[[manipulator]]
name = "slow kicker"
position_m = [-0.2, 0]
speed_mps = 1
dead_time_s = 0.4
[perception]
velocity_noise_mps = 0.01
rotation_noise_degps = 18
[perception.self]
noise = { x_m = 0.05, y_m = 0.06, heading_deg = 1.8 }
bias = { x_m = 0.02, y_m = 0.03, heading_deg = 3.6 }
bias_time_s = 2
latency_s = 0.08
drop_out = 0.05
jump = 0.001
jump_distance_m = 0.4
[perception.objects]
bearing_noise_deg = 0.9
range_noise = 0.03
range_noise_per_m = 0.02
bearing_bias_deg = 1.8
field_of_view_deg = 90
range_m = 6
latency_s = 0.1
drop_out = 0.1
occlusion = true
[perception.robots]
present = false
)";

constexpr const char* learned = R"(format = "mrose robot"
version = 1
name = "learned"
shape = "disc.toml"
mass_kg = 5
[motion]
network = "n.net"
)";

constexpr const char* environment = R"(format = "mrose environment"
version = 1
name = "yard"
surface = { friction = 0.6, restitution = 0.3 }
[floor]
colour = "#102030"
sliding_friction = 0.25
traction = 0.7
rolling_deceleration_mps2 = 0.5
area_m = [[-5, -3], [5, -3], [5, 3], [-5, 3]]
[[wall]]
name = "fence"
points_m = [[-5, -3], [5, -3], [5, 3], [-5, 3]]
closed = true
thickness_m = 0.1
side = "right"
[[obstacle]]
name = "post"
colour = "#ff0000"
surface = { restitution = 0.9 }
circle = { centre_m = [3, 2], radius_m = 0.15 }
[[goal]]
name = "east"
area_m = [[4.5, -1], [5, -1], [5, 1], [4.5, 1]]
[[marking]]
points_m = [[0, -3], [0, 3]]
[[marking]]
circle = { radius_m = 1 }
width_m = 0.02
colour = "#00ff00"
)";

constexpr const char* scenario = R"(format = "mrose scenario"
version = 1
name = "small"
environment = "e.toml"
seed = 7
duration_s = 12.5
tick_s = 0.02
random_factor = 0.2
kick_off = false
[[robot]]
name = "one"
type = "r.toml"
start = { x_m = -1, y_m = 0.5, heading_deg = 90 }
phase_s = 0.04
controller = { kind = "velocity_script", commands = [{ t_s = 0, v_mps = 0.3 }, { t_s = 1.05, w_degps = 90 }] }
[[robot]]
name = "two"
type = "learned.toml"
motion_robot = "b"
start = { x_m = 1, y_m = 0.5 }
phase_share = 0.5
controller = { kind = "wander", speed_mps = 0.2, rotation_degps = 45, change_every_s = 1 }
[[person]]
name = "three"
type = "r.toml"
start = { x_m = 2, y_m = -1, heading_deg = -45 }
[[object]]
name = "crate"
kind = "box"
shape = "disc.toml"
mass_kg = 2
surface = { friction = 0.5, restitution = 0 }
start = { x_m = -2, y_m = -1, heading_deg = 10 }
[[object]]
name = "ball"
kind = "ball"
shape = "ball.toml"
mass_kg = 0.4
inertia = 0.4
start = { x_m = 0, y_m = 0 }
velocity = { x_mps = 1, y_mps = -0.5, rotation_degps = 180 }
)";

}  // namespace

std::map<std::string, std::string> smallWorld() {
    return {{"s.toml", scenario},
            {"e.toml", environment},
            {"r.toml", robot},
            {"learned.toml", learned},
            {"disc.toml", disc},
            {"ball.toml", ball},
            {"n.net", networkText(arbitraryNetwork(MotionNetwork::Form::state))}};
}

std::map<std::string, std::string> changedWorld(const std::string& file, const std::string& from,
                                                const std::string& to) {
    auto texts = smallWorld();
    const auto at = texts.at(file).find(from);
    EXPECT_NE(at, std::string::npos) << file << " does not hold " << from;
    if (at != std::string::npos) texts.at(file).replace(at, from.size(), to);
    return texts;
}

Expected<LoadedScenario> loadFrom(std::map<std::string, std::string> texts, const std::string& name) {
    KeptDescriptions source(std::move(texts));
    return loadScenario(name, source);
}

WorldState stateAfter(const ScenarioParts& parts, int ticks) {
    const Scenario scenario(parts);
    WorldState state = scenario.initialState();
    StepBuffers buffers;
    for (int i = 0; i < ticks; ++i) step(scenario, state, buffers);
    return state;
}

std::string refusal(const std::string& file, const std::string& from, const std::string& to) {
    const auto loaded = loadFrom(changedWorld(file, from, to));
    return loaded ? "" : loaded.error().message();
}

}  // namespace mrose

// Whatever the bytes are, taken as a shape, an environment, a robot or a scenario they give something sound, of which a
// scenario can be run and loaded again from its value, or an error of one line.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "drawing/scene_drawing.h"
#include "fuzz/require.h"
#include "io/toml_text.h"
#include "scenario/environment_file.h"
#include "scenario/robot_file.h"
#include "scenario/scenario_file.h"
#include "scenario/shape_file.h"
#include "simulation/step.h"

namespace mrose {
namespace {

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

/// The given text as the file "f", and something sound for whatever it names.
class FuzzedDescriptions final : public DescriptionSource {
public:
    explicit FuzzedDescriptions(std::string_view given) : given_(given) {}

    Expected<std::optional<std::string>> text(const std::string& name) override {
        if (name == "f") return std::string(given_);
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

    std::string_view given_;
};

void requireSound(const Shape& shape) {
    double area = 0, pieces = 0;
    for (const ShapePart& part : shape.parts) area += std::abs(signedArea(part.polygon));
    for (const ConvexPiece& piece : shape.pieces) {
        require(piece.count >= 1 && piece.count <= ConvexPiece::maxCorners);
        if (!piece.isCircle()) pieces += signedArea({piece.corners.data(), piece.count});
    }
    require(std::abs(area - pieces) <= 1e-3 * area);
    require(std::isfinite(shape.reach) && std::isfinite(shape.gyration) && shape.gyration > 0);
    drawShape(shape);
}

void runTicks(const LoadedScenario& loaded, int ticks) {
    const Scenario scenario(loaded.parts);
    WorldState state = scenario.initialState();
    StepBuffers buffers;
    for (int i = 0; i < ticks; ++i) step(scenario, state, buffers);
    for (const RobotState& r : state.robots) require(std::isfinite(r.pose.x + r.pose.y + r.pose.heading));
    for (const ObjectState& o : state.objects) require(std::isfinite(o.pose.x + o.pose.y + o.pose.heading));
}

void requireSound(const LoadedScenario& loaded) {
    const auto value = ScenarioValue::parse(loaded.value.bytes());
    require(value && *value == loaded.value && value->hash() == loaded.value.hash());
    const auto again = loadScenario(*value);
    require(again && again->value == loaded.value);
    const auto text = parseToml(tomlText(loaded.value.content()), "f");
    require(text.has_value());
    drawScene(loaded.parts.scene, loaded.parts.name);
    // Each state holds the poses of a second of all bodies, and a kinematic robot may have many commands a period.
    if (loaded.parts.scene.bodyCount() < 50) runTicks(loaded, 12);
}

}  // namespace
}  // namespace mrose

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace mrose;
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    if (const auto shape = parseShape(text, "f"))
        requireSound(*shape);
    else
        requireOneLine(shape.error());
    if (const auto environment = parseEnvironment(text, "f"))
        drawEnvironment(*environment);
    else
        requireOneLine(environment.error());
    FuzzedDescriptions source(text);
    DescriptionLibrary library(source);
    const auto file = library.file("f", {});
    if (!file) return requireOneLine(file.error()), 0;
    if (const auto robot = readRobot(*file, library))
        drawRobot(robot->type);
    else
        requireOneLine(robot.error());
    if (const auto scenario = loadScenario("f", source))
        requireSound(*scenario);
    else
        requireOneLine(scenario.error());
    return 0;
}

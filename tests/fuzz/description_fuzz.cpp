// Whatever the bytes are, taken as a shape, an environment, a robot or a scenario they give something sound, of which a
// scenario can be run and loaded again from its value, or an error of one line.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "drawing/scene_drawing.h"
#include "fuzz/require.h"
#include "fuzz/small_descriptions.h"
#include "io/toml_text.h"
#include "scenario/environment_file.h"
#include "scenario/robot_file.h"
#include "scenario/scenario_file.h"
#include "scenario/shape_file.h"
#include "simulation/running_into.h"

namespace mrose {
namespace {

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
    RobotType type = discRobot();
    type.shape = std::make_shared<const Shape>(shape);
    SmallWorld world;
    world.robot(type, {}, std::make_shared<const Told>(Command{0.5, 1}), ideal());
    require(finite(afterRunningInto(std::move(world), shape.pieces.front(), 12)));
}

void requireSound(const Environment& environment) {
    drawEnvironment(environment);
    if (environment.obstacles.empty()) return;
    const std::vector<ConvexPiece>& pieces = environment.obstacles.back().shape.pieces;
    require(!pieces.empty());
    require(finite(afterRunningInto(SmallWorld(environment), pieces.front(), 12)));
}

void runTicks(const LoadedScenario& loaded, int ticks) {
    const Scenario scenario(loaded.parts);
    WorldState state = scenario.initialState();
    StepBuffers buffers;
    for (int i = 0; i < ticks; ++i) step(scenario, state, buffers);
    require(finite(state));
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
        requireSound(*environment);
    else
        requireOneLine(environment.error());
    SmallDescriptions source({{"f", std::string(text)}});
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

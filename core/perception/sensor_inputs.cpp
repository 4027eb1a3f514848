#include "perception/sensor_inputs.h"

#include <algorithm>
#include <cmath>

#include "geometry/elementary.h"

namespace mrose {
namespace {

constexpr double touching = 0.005;  // rad: subjects so near each other look like one

constexpr SensorQuantity quantities[] = {
    {"range", "m", [](const SensedState& s) { return s.range; }},
    {"nearness", "1/m", [](const SensedState& s) { return 1 / std::max(s.range, 0.1); }},
    {"bearing", "rad", [](const SensedState& s) { return s.bearing; }},
    {"bearing_size", "rad", [](const SensedState& s) { return std::abs(s.bearing); }},
    {"bearing_depth", "m", [](const SensedState& s) { return s.range * (1 - cosine(s.bearing)); }},
    {"speed", "m/s", [](const SensedState& s) { return s.velocity.v; }},
    {"rotation", "rad/s", [](const SensedState& s) { return s.velocity.w; }},
    {"rotation_size", "rad/s", [](const SensedState& s) { return std::abs(s.velocity.w); }},
    {"is_robot", "1", [](const SensedState& s) { return s.subject == SubjectKind::robot ? 1.0 : 0.0; }},
    {"view_edge", "1", [](const SensedState& s) { return s.edge; }},
    {"near_edge", "1", [](const SensedState& s) { return s.nearEdge; }},
    {"clearance", "m", [](const SensedState& s) { return s.clearance; }},
    {"log_separation", "1", [](const SensedState& s) { return logarithm(touching + s.separation); }},
    {"log_nearer_separation", "1", [](const SensedState& s) { return logarithm(touching + s.nearerSeparation); }},
    {"others_in_view", "1", [](const SensedState& s) { return s.others; }},
    {"unknown_robots", "1", [](const SensedState& s) { return s.unknownRobots; }},
    {"x", "m", [](const SensedState& s) { return s.own.x; }},
    {"y", "m", [](const SensedState& s) { return s.own.y; }},
    {"heading_sine", "1", [](const SensedState& s) { return sine(s.own.heading); }},
    {"heading_cosine", "1", [](const SensedState& s) { return cosine(s.own.heading); }},
};

// How blurred the edges of a view are: rad, m.
constexpr double edgeWidth = 0.05, nearEdgeWidth = 0.05;

const SensorQuantity* quantityOf(std::string_view name) {
    const auto found = std::ranges::find(quantities, name, &SensorQuantity::name);
    return found == std::end(quantities) ? nullptr : found;
}

int robotOf(std::string_view input, std::span<const std::string> robots) {
    for (std::size_t i = 0; i < robots.size(); ++i)
        if (input == robotInput(robots[i])) return static_cast<int>(i);
    return -1;
}

}  // namespace

void findEdges(SensedState& state, const View& view) {
    state.edge = hyperbolicTangent((std::abs(state.bearing) - 0.5 * view.fieldOfView) / edgeWidth);
    state.nearEdge = hyperbolicTangent((view.nearest - state.range) / nearEdgeWidth);
}

std::span<const SensorQuantity> sensorQuantities() { return quantities; }

std::string robotInput(std::string_view robot) { return "robot " + std::string(robot); }

std::string SensorInputs::objection(std::span<const NetworkVariable> inputs, std::span<const std::string> robots) {
    for (const NetworkVariable& input : inputs) {
        const SensorQuantity* const quantity = quantityOf(input.name);
        if (quantity == nullptr && robotOf(input.name, robots) < 0)
            return "has an input \"" + input.name + "\" that no sensor has";
        const std::string_view unit = quantity != nullptr ? quantity->unit : robotInputUnit;
        if (input.unit != unit)
            return "has the input \"" + input.name + "\" in " + input.unit + "; expected " + std::string(unit);
    }
    return {};
}

SensorInputs::SensorInputs(std::span<const NetworkVariable> inputs, std::span<const std::string> robots) {
    for (std::size_t i = 0; i < inputs.size(); ++i)
        if (const SensorQuantity* const quantity = quantityOf(inputs[i].name))
            parts_.push_back({i, quantity->of, inputs[i].mean, 1 / inputs[i].scale});
    for (int robot = -1; robot < static_cast<int>(robots.size()); ++robot) {
        std::vector<double>& raw = raw_.emplace_back();
        std::vector<float>& row = rows_.emplace_back();
        for (const NetworkVariable& input : inputs) {
            raw.push_back(robot < 0 ? input.mean : robotOf(input.name, robots) == robot ? 1 : 0);
            row.push_back(static_cast<float>((raw.back() - input.mean) / input.scale));
        }
    }
}

void SensorInputs::readRaw(const SensedState& state, int robot, double* row) const {
    std::ranges::copy(raw_.of(robot), row);
    for (const Part& part : parts_) row[part.input] = part.of(state);
}

void SensorInputs::read(const SensedState& state, int robot, float* row) const {
    std::ranges::copy(rows_.of(robot), row);
    for (const Part& part : parts_)
        row[part.input] = static_cast<float>((part.of(state) - part.mean) * part.inverseScale);
}

}  // namespace mrose

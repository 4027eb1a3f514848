#include "perception/learned_sensor.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

namespace mrose {
namespace {

// Rows that are evaluated at once.
constexpr std::size_t chunk = 16;
using Rows = std::array<float, chunk * LearnedNetwork::maxInputs>;
using Outputs = std::array<float, chunk * LearnedNetwork::maxOutputs>;

}  // namespace

LearnedSensor::LearnedSensor(SensorNetwork network)
    : network_(std::move(network)),
      inputs_(network_.learned.inputs, network_.robots),
      reported_(withOutputs(network_.learned.regressor, 0, 1)),
      errors_(withOutputs(network_.learned.regressor, 1, network_.form.outputs() - 1)) {}

int LearnedSensor::robotIndex(const std::string& name) const {
    const auto found = std::find(network_.robots.begin(), network_.robots.end(), name);
    return found == network_.robots.end() ? -1 : static_cast<int>(found - network_.robots.begin());
}

bool LearnedSensor::inView(const SensedState& state) const {
    if (network_.measures == SensorNetwork::Measures::pose) return true;
    const bool known = state.subject == SubjectKind::landmark ? network_.landmarks : network_.robotSubjects;
    return known && network_.view.margin().holds(state.range, state.bearing);
}

void LearnedSensor::readInputs(std::span<const SensedState> states, int robot, float* rows) const {
    for (const SensedState& state : states) {
        inputs_.read(state, robot, rows);
        rows += inputs_.width();
    }
}

void LearnedSensor::describe(const float* outputs, std::size_t first, std::span<double> values) const {
    for (std::size_t i = 0; i < values.size(); ++i) {
        const NetworkVariable& output = network_.learned.outputs[first + i];
        values[i] = output.mean + output.scale * static_cast<double>(outputs[i]);
    }
}

void LearnedSensor::distributions(std::span<const SensedState> states, int robot,
                                  std::span<ReadingDistribution> to) const {
    assert(states.size() == to.size());
    const auto width = static_cast<std::size_t>(network_.form.outputs()), others = width - 1;
    Rows rows;
    Outputs reported, errors;
    std::array<double, LearnedNetwork::maxOutputs> values;
    for (std::size_t begin = 0; begin < states.size(); begin += chunk) {
        const std::size_t count = std::min(chunk, states.size() - begin);
        readInputs(states.subspan(begin, count), robot, rows.data());
        reported_.batch(rows.data(), reported.data(), count);
        errors_.batch(rows.data(), errors.data(), count);
        for (std::size_t i = 0; i < count; ++i) {
            describe(&reported[i], 0, std::span(values).first(1));
            describe(&errors[i * others], 1, std::span(values).subspan(1, others));
            to[begin + i] = ReadingDistribution::of(network_.form, std::span(values).first(width), network_.gross);
        }
    }
}

void LearnedSensor::report(std::span<const SensedState> states, int robot, std::span<const ReadingDraw> draws,
                           std::vector<Report>& to) const {
    assert(states.size() == draws.size());
    const std::size_t width = inputs_.width(), others = static_cast<std::size_t>(network_.form.outputs()) - 1;
    Rows rows;
    Outputs outputs;
    std::array<double, LearnedNetwork::maxOutputs> values;
    for (std::size_t begin = 0; begin < states.size(); begin += chunk) {
        const std::size_t count = std::min(chunk, states.size() - begin), known = to.size();
        readInputs(states.subspan(begin, count), robot, rows.data());
        reported_.batch(rows.data(), outputs.data(), count);
        for (std::size_t i = 0; i < count; ++i) {
            describe(&outputs[i], 0, std::span(values).first(1));
            if (!(draws[begin + i].reported < values[0])) continue;
            std::copy_n(&rows[i * width], width, &rows[(to.size() - known) * width]);
            to.push_back({begin + i, {}});
        }
        errors_.batch(rows.data(), outputs.data(), to.size() - known);
        for (std::size_t i = known; i < to.size(); ++i) {
            describe(&outputs[(i - known) * others], 1, std::span(values).subspan(1, others));
            const auto distribution =
                ReadingDistribution::of(network_.form, std::span(values).first(others + 1), network_.gross);
            to[i].error = distribution.error(draws[to[i].state]);
        }
    }
}

}  // namespace mrose

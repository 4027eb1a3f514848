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
using Row = std::array<float, LearnedNetwork::maxInputs>;
using Values = std::array<double, LearnedNetwork::maxOutputs>;

std::vector<int> neededInputs(const SensorNetwork& network, int first, int count) {
    std::vector<int> needed = inputsReadBy(withOutputs(network.learned.regressor, first, count));
    if (needed.empty()) needed.push_back(0);
    return needed;
}

std::vector<NetworkVariable> chosen(const std::vector<NetworkVariable>& variables, const std::vector<int>& which) {
    std::vector<NetworkVariable> some;
    for (const int i : which) some.push_back(variables[static_cast<std::size_t>(i)]);
    return some;
}

}  // namespace

LearnedSensor::Part::Part(const SensorNetwork& network, int first, int count, int memberCount)
    : inputs(chosen(network.learned.inputs, neededInputs(network, first, count * memberCount)), network.robots) {
    const std::vector<int> needed = neededInputs(network, first, count * memberCount);
    for (int m = 0; m < memberCount; ++m)
        members.emplace_back(withInputs(withOutputs(network.learned.regressor, first + m * count, count), needed));
}

LearnedSensor::LearnedSensor(SensorNetwork network)
    : network_(std::move(network)),
      reported_(network_, ReadingForm::reported, 1, 1),
      errors_(network_, ReadingForm::errors, network_.form.memberOutputs(), network_.form.members) {}

int LearnedSensor::robotIndex(const std::string& name) const {
    const auto found = std::find(network_.robots.begin(), network_.robots.end(), name);
    return found == network_.robots.end() ? -1 : static_cast<int>(found - network_.robots.begin());
}

bool LearnedSensor::inView(const SensedState& state) const {
    if (network_.measures == SensorNetwork::Measures::pose) return true;
    const bool known = state.subject == SubjectKind::landmark ? network_.landmarks : network_.robotSubjects;
    return known && network_.view.margin().holds(state.range, state.bearing);
}

void LearnedSensor::describe(const float* outputs, int first, std::span<double> values) const {
    const NetworkVariable* output = network_.learned.outputs.data() + first;
    for (double& value : values) {
        value = output->mean + output->scale * static_cast<double>(*outputs++);
        ++output;
    }
}

void LearnedSensor::distributions(std::span<const SensedState> states, int robot,
                                  std::span<ReadingDistribution> to) const {
    assert(states.size() == to.size());
    const int each = network_.form.memberOutputs();
    Row row;
    std::array<float, LearnedNetwork::maxOutputs> outputs;
    Values values;
    for (std::size_t i = 0; i < states.size(); ++i) {
        reported_.inputs.read(states[i], robot, row.data());
        reported_.members[0].one(row.data(), outputs.data());
        errors_.inputs.read(states[i], robot, row.data());
        int first = ReadingForm::errors;
        for (const RegressorInference& member : errors_.members) {
            member.one(row.data(), outputs.data() + first);
            first += each;
        }
        const auto all = std::span(values).first(network_.learned.outputs.size());
        describe(outputs.data(), 0, all);
        to[i] = ReadingDistribution::of(network_.form, all, network_.gross);
    }
}

void LearnedSensor::reported(std::span<const SensedState> states, int robot, std::span<const double> numbers,
                             std::vector<std::uint32_t>& which) const {
    assert(states.size() == numbers.size());
    Rows rows;
    std::array<float, chunk> outputs;
    for (std::size_t begin = 0; begin < states.size(); begin += chunk) {
        const std::size_t count = std::min(chunk, states.size() - begin);
        for (std::size_t i = 0; i < count; ++i)
            reported_.inputs.read(states[begin + i], robot, &rows[i * reported_.inputs.width()]);
        reported_.members[0].batch(rows.data(), outputs.data(), count);
        for (std::size_t i = 0; i < count; ++i) {
            double threshold = 0;
            describe(&outputs[i], ReadingForm::reported, {&threshold, 1});
            if (numbers[begin + i] < threshold) which.push_back(static_cast<std::uint32_t>(begin + i));
        }
    }
}

void LearnedSensor::errors(std::span<const SensedState> states, std::span<const std::uint32_t> which, int robot,
                           std::span<const ReadingDraw> draws, std::span<ReadingError> to) const {
    assert(which.size() == draws.size() && which.size() == to.size());
    const ReadingForm& form = network_.form;
    const int each = form.memberOutputs();
    Row row;
    std::array<float, LearnedNetwork::maxOutputs> outputs;
    Values values;
    for (std::size_t i = 0; i < which.size(); ++i) {
        const MemberDraw of = memberOf(draws[i], form, network_.gross);
        if (of.member < 0) {
            to[i] = grossError(form, network_.gross, draws[i]);
            continue;
        }
        errors_.inputs.read(states[which[i]], robot, row.data());
        errors_.members[static_cast<std::size_t>(of.member)].one(row.data(), outputs.data());
        describe(outputs.data(), ReadingForm::errors + of.member * each,
                 std::span(values).first(static_cast<std::size_t>(each)));
        to[i] = memberError(form, values.data(), draws[i], of.which);
    }
}

}  // namespace mrose

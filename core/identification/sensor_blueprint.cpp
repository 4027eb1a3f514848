#include "identification/sensor_blueprint.h"

#include <algorithm>
#include <cmath>

#include "geometry/normal_distribution.h"
#include "perception/sensor_inputs.h"

namespace mrose {
namespace {

std::vector<std::string_view> quantitiesFor(const SensorNetwork& network) {
    if (network.measures == SensorNetwork::Measures::pose)
        return {"x", "y", "heading_sine", "heading_cosine", "speed", "rotation", "rotation_size"};
    std::vector<std::string_view> quantities{"range",        "nearness",      "bearing",
                                             "bearing_size", "bearing_depth", "view_edge"};
    if (network.view.nearest > 0) quantities.push_back("near_edge");
    for (const std::string_view other : {"rotation", "rotation_size", "speed", "is_robot", "clearance",
                                         "log_separation", "log_nearer_separation", "others_in_view", "unknown_robots"})
        quantities.push_back(other);
    return quantities;
}

/// Mean and standard deviation of each input over all cases; of what does not change, 1.
void findScales(std::vector<NetworkVariable>& inputs, const SensorNetwork& network, const SensorSamples& samples) {
    const SensorInputs reader(inputs, network.robots);
    std::vector<double> row(inputs.size()), sum(inputs.size()), squares(inputs.size());
    const auto visit = [&](auto use) {
        for (const SampledLook& look : samples.looks)
            for (std::size_t i = 0; i < look.count; ++i) {
                reader.readRaw(samples.cases[look.first + i].state, look.robot, row.data());
                use();
            }
    };
    visit([&] {
        for (std::size_t i = 0; i < row.size(); ++i) sum[i] += row[i];
    });
    const double count = static_cast<double>(std::max<std::size_t>(samples.cases.size(), 1));
    for (std::size_t i = 0; i < inputs.size(); ++i) inputs[i].mean = sum[i] / count;
    visit([&] {
        for (std::size_t i = 0; i < row.size(); ++i)
            squares[i] += (row[i] - inputs[i].mean) * (row[i] - inputs[i].mean);
    });
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        const double deviation = std::sqrt(squares[i] / count);
        inputs[i].scale = deviation > 1e-9 ? deviation : 1;
    }
}

/// Axes of a table over inputs by their names, in their units.
class Axes {
public:
    explicit Axes(const std::vector<NetworkVariable>& inputs) : inputs_(inputs) {}

    LookupTable::Axis even(std::string_view name, double least, double most, double step) const {
        std::vector<double> knots;
        const int count = std::max(1, static_cast<int>(std::ceil((most - least) / step - 1e-9)));
        for (int i = 0; i <= count; ++i) knots.push_back(least + (most - least) * i / count);
        return at(name, knots);
    }
    LookupTable::Axis at(std::string_view name, const std::vector<double>& knots) const {
        const auto input = std::ranges::find(inputs_, name, &NetworkVariable::name);
        LookupTable::Axis axis{static_cast<int>(input - inputs_.begin()), {}};
        for (const double knot : knots) axis.knots.push_back(static_cast<float>((knot - input->mean) / input->scale));
        return axis;
    }

private:
    const std::vector<NetworkVariable>& inputs_;
};

}  // namespace

std::vector<NetworkVariable> sensorInputsFor(const SensorNetwork& network, const SensorSamples& samples) {
    std::vector<NetworkVariable> inputs;
    for (const std::string_view name : quantitiesFor(network)) {
        const auto quantity = std::ranges::find(sensorQuantities(), name, &SensorQuantity::name);
        inputs.push_back({std::string(quantity->name), std::string(quantity->unit)});
    }
    if (network.robots.size() > 1)
        for (const std::string& robot : network.robots)
            inputs.push_back({robotInput(robot), std::string(robotInputUnit)});
    findScales(inputs, network, samples);
    return inputs;
}

std::vector<NetworkVariable> sensorOutputsFor(const SensorNetwork& network, const SensorSamples& samples,
                                              const SoundErrors& sound) {
    constexpr double leastDeviation = 1e-4;
    const ReadingForm& form = network.form;
    std::vector<NetworkVariable> outputs = sensorOutputs(network.measures, form);
    const double cases = static_cast<double>(samples.cases.size());
    const double reported = static_cast<double>(std::ranges::count_if(samples.cases, &SensorCase::reported));
    outputs[ReadingForm::reported].mean = normalQuantile(std::clamp(reported, 0.5, cases - 0.5) / cases);
    const auto setAll = [&](int i, double mean, double scale) {
        for (int m = 0; m < form.members; ++m) {
            const int place = ReadingForm::errors + m * form.memberOutputs() + i;
            outputs[static_cast<std::size_t>(place)].mean = mean;
            outputs[static_cast<std::size_t>(place)].scale = scale;
        }
    };
    for (int d = 0; d < form.dimensions; ++d) {
        double sum = 0, squares = 0, count = 0;
        samples.visitReadings([&](const SensorCase& one) {
            if (!sound.holds(one.error)) return;
            const double error = one.error[static_cast<std::size_t>(d)];
            ++count;
            sum += error;
            squares += error * error;
        });
        const double mean = sum / count;
        const double deviation = std::max(std::sqrt(std::max(0.0, squares / count - mean * mean)), leastDeviation);
        for (int k = 0; k < form.components; ++k) {
            setAll(form.errorOf(k, d), mean, deviation);
            // components begin of different widths, so that each finds its part
            setAll(form.spreadOf(k, d), logarithm(deviation) + 0.7 * k - 0.3 * (form.components - 1), 1);
        }
    }
    for (int k = 1; k < form.components; ++k) setAll(form.shareOf(k), -1, 1);
    return outputs;
}

bool isReadForErrors(std::string_view input) {
    constexpr std::string_view others[] = {"nearness",       "view_edge",      "near_edge",
                                           "clearance",      "log_separation", "log_nearer_separation",
                                           "others_in_view", "unknown_robots"};
    return std::ranges::find(others, input) == std::end(others);
}

LookupTable sensorTableFor(const std::vector<NetworkVariable>& inputs, const SensorNetwork& network, SensorHalf half,
                           int outputs) {
    const Axes axes(inputs);
    LookupTable table{static_cast<int>(inputs.size()), outputs, {}};
    const auto add = [&](std::vector<LookupTable::Axis> of) {
        LookupTable::Grid grid{std::move(of), {}};
        grid.values.assign(grid.points() * static_cast<std::size_t>(outputs), 0.0f);
        table.grids.push_back(std::move(grid));
    };
    if (network.measures == SensorNetwork::Measures::pose) {
        const auto whole = [&](std::string_view name) {
            const auto input = std::ranges::find(inputs, name, &NetworkVariable::name);
            return axes.even(name, input->mean - 2 * input->scale, input->mean + 2 * input->scale, input->scale);
        };
        add({whole("x"), whole("y")});
        add({whole("heading_sine"), whole("heading_cosine")});
        add({whole("speed"), whole("rotation")});
        for (const std::string& robot : network.robots)
            if (network.robots.size() > 1) add({axes.at(robotInput(robot), {0, 1})});
        return table;
    }
    const double wide = 0.5 * network.view.fieldOfView + 0.05, far = network.view.range;
    constexpr double degree = 0.017453292519943295;
    add({axes.even("range", 0, far, 0.5), axes.even("bearing", -wide, wide, 5 * degree), axes.at("is_robot", {0, 1})});
    for (const std::string& robot : network.robots)
        if (network.robots.size() > 1)
            add({axes.at(robotInput(robot), {0, 1}), axes.even("range", 0, far, 1.5),
                 axes.even("bearing", -wide, wide, 10 * degree)});
    add({axes.even("rotation", -0.6, 0.6, 0.15)});
    if (half == SensorHalf::error) return table;
    add({axes.even("clearance", -SensedState::hidden, SensedState::clear, 0.05)});
    add({axes.at("log_separation", {-5, -4, -3.5, -3, -2.5, -2, -1.5, -0.5})});
    add({axes.at("log_nearer_separation", {-5, -4, -3.5, -3, -2.5, -2, -1.5, -0.5})});
    add({axes.even("others_in_view", 0, 10, 2), axes.at("unknown_robots", {0, 1})});
    return table;
}

}  // namespace mrose

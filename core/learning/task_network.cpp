#include "learning/task_network.h"

#include <algorithm>
#include <array>

#include "geometry/elementary.h"
#include "io/format.h"
#include "io/toml_table.h"
#include "learning/network_file.h"

namespace mrose {
namespace {

std::string sectionText(const TaskNetwork& network) {
    std::string text = "[task]\n";
    if (!network.seen.empty()) {
        text += "seen = [ # least and most of each input\n";
        for (const TaskNetwork::Range& range : network.seen)
            text += "  [" + numberText(range.least) + ", " + numberText(range.most) + "],\n";
        text += "]\n";
    }
    std::string logarithmic;
    for (std::size_t i = 0; i < network.logarithmic.size(); ++i)
        if (network.logarithmic[i]) logarithmic += (logarithmic.empty() ? "" : ", ") + std::to_string(i);
    if (!logarithmic.empty()) text += "logarithmic = [" + logarithmic + "] # outputs, from 0\n";
    if (network.heldOutError > 0) text += "held_out_error = " + numberText(network.heldOutError) + '\n';
    return text;
}

void readSection(TomlTable& section, const LearnedNetwork& learned, TaskNetwork& network) {
    if (section.has("seen")) {
        const std::vector<double> ends = section.matrix("seen", learned.inputs.size(), 2);
        for (std::size_t i = 0; i + 1 < ends.size(); i += 2) {
            if (ends[i] > ends[i + 1]) section.rejectElement("seen", i / 2, "expected the least before the most");
            network.seen.push_back({ends[i], ends[i + 1]});
        }
    }
    network.logarithmic.assign(learned.outputs.size(), false);
    if (section.has("logarithmic"))
        for (const double output : section.someNumbers("logarithmic", 1, learned.outputs.size())) {
            const auto most = static_cast<double>(learned.outputs.size());
            if (!(output >= 0) || output >= most || output != static_cast<double>(static_cast<std::size_t>(output)))
                section.reject("logarithmic", "expected numbers of outputs, from 0");
            else
                network.logarithmic[static_cast<std::size_t>(output)] = true;
        }
    network.heldOutError = section.numberOr("held_out_error", 0, {0, 1e9});
}

}  // namespace

std::string taskFileText(const TaskNetwork& network) { return networkFileText(network.learned, sectionText(network)); }

Expected<TaskNetwork> parseTask(const std::string& text, const std::string& name) {
    TomlTable root(text, name);
    TaskNetwork network;
    auto learned = readNetworkFile(root, TaskNetwork::kind, [&](TomlTable& section, const LearnedNetwork& of) {
        readSection(section, of, network);
    });
    if (!learned) return tl::unexpected(learned.error());
    network.learned = std::move(*learned);
    return network;
}

TaskInference::TaskInference(const TaskNetwork& network)
    : inputs_(network.learned.inputs),
      outputs_(network.learned.outputs),
      seen_(network.seen),
      logarithmic_(network.logarithmic),
      inference_(network.learned.regressor) {
    logarithmic_.resize(outputs_.size());
}

void TaskInference::evaluate(const double* from, double* to) const {
    std::array<float, LearnedNetwork::maxInputs> x;
    std::array<float, LearnedNetwork::maxOutputs> y;
    for (std::size_t i = 0; i < inputs_.size(); ++i)
        x[i] = static_cast<float>((from[i] - inputs_[i].mean) / inputs_[i].scale);
    inference_.one(x.data(), y.data());
    for (std::size_t i = 0; i < outputs_.size(); ++i) {
        to[i] = outputs_[i].mean + outputs_[i].scale * static_cast<double>(y[i]);
        if (logarithmic_[i]) to[i] = exponential(to[i]);
    }
}

double TaskInference::beyond(const double* from) const {
    double most = 0;
    for (std::size_t i = 0; i < seen_.size(); ++i) {
        const double wide = std::max(seen_[i].most - seen_[i].least, 1e-9);
        most = std::max({most, (seen_[i].least - from[i]) / wide, (from[i] - seen_[i].most) / wide});
    }
    return most;
}

}  // namespace mrose

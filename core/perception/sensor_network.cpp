#include "perception/sensor_network.h"

#include <numbers>

#include "io/file.h"
#include "io/format.h"
#include "io/toml_table.h"
#include "io/toml_text.h"
#include "learning/network_file.h"
#include "perception/sensor_inputs.h"

namespace mrose {
namespace {

using Measures = SensorNetwork::Measures;

constexpr std::string_view measuresNames[] = {"subjects", "pose"};
constexpr ReadingDimension ofSubjects[] = {{"range", "m"}, {"bearing", "rad"}};
constexpr ReadingDimension ofPose[] = {{"x", "m"}, {"y", "m"}, {"heading", "rad"}};

std::string line(std::string_view key, const std::string& value) { return std::string(key) + " = " + value + '\n'; }
std::string line(std::string_view key, double value) { return line(key, numberText(value)); }

std::string listText(const std::vector<std::string>& words) {
    std::string text;
    for (const std::string& word : words) text += (text.empty() ? "" : ", ") + tomlString(word);
    return '[' + text + ']';
}

/// "range_m".
std::string unitKey(const ReadingDimension& dimension) {
    return std::string(dimension.name) + '_' + std::string(dimension.unit);
}
std::string reachKey(const ReadingDimension& dimension) { return "reach_" + unitKey(dimension); }

std::string_view channelName(const SensorNetwork& network, std::size_t channel) {
    return channel == 0 ? "reported" : dimensionsOf(network.measures)[channel - 1].name;
}

std::vector<std::string> subjectsOf(const SensorNetwork& network) {
    std::vector<std::string> kinds;
    if (network.landmarks) kinds.emplace_back("landmarks");
    if (network.robotSubjects) kinds.emplace_back("robots");
    return kinds;
}

std::string sectionText(const SensorNetwork& n) {
    std::string text = "[sensor]\n" + line("name", tomlString(n.sensor)) +
                       line("measures", tomlString(measuresNames[static_cast<std::size_t>(n.measures)])) +
                       line("robot_type", tomlString(n.robotType)) + line("robots", listText(n.robots)) +
                       line("period_s", toSeconds(n.period)) + line("latency_s", toSeconds(n.latency)) +
                       line("latency_error_s", n.latencyError);
    if (n.measures == Measures::subjects)
        text += line("subjects", listText(subjectsOf(n))) + line("range_m", n.view.range) +
                line("nearest_m", n.view.nearest) + line("field_of_view_rad", n.view.fieldOfView);
    text += line("components", std::to_string(n.form.components)) + line("members", std::to_string(n.form.members));
    text += "gross_errors = { share = " + numberText(n.gross.share);
    for (int d = 0; d < n.form.dimensions; ++d) {
        const auto i = static_cast<std::size_t>(d);
        text += ", " + reachKey(dimensionsOf(n.measures)[i]) + " = " + numberText(n.gross.reach[i]);
    }
    text += " } # of the readings, anywhere within reach of the truth\n";
    text += "constant = { seen = " + numberText(n.constant.seen) + ", unseen = " + numberText(n.constant.unseen);
    for (int d = 0; d < n.form.dimensions; ++d) {
        const auto i = static_cast<std::size_t>(d);
        text += ", " + unitKey(dimensionsOf(n.measures)[i]) + " = " + numberText(n.constant.spread[i]);
    }
    text += " } # an ideal sensor's noise, to compare with\n";
    text += "held_out_score = { looks = " + std::to_string(n.heldOut.looks) +
            ", cases = " + std::to_string(n.heldOut.cases) + ", readings = " + std::to_string(n.heldOut.readings) +
            ", reported = " + numberText(n.heldOut.reported) + ", error = " + numberText(n.heldOut.error) +
            " } # mean logarithms of likelihoods\n";
    text += "\n[sensor.noise] # shares of the variance: common to a look, to all looks, to those of a subject\n";
    for (std::size_t i = 0; i <= static_cast<std::size_t>(n.form.dimensions); ++i)
        text += std::string(channelName(n, i)) + " = { look = " + numberText(n.noise[i].look) +
                ", slow = " + numberText(n.noise[i].slow) + ", slow_time_s = " + numberText(n.noise[i].slowTime) +
                ", subject = " + numberText(n.noise[i].subject) +
                ", subject_time_s = " + numberText(n.noise[i].subjectTime) + " }\n";
    return text;
}

void readSubjects(TomlTable& table, SensorNetwork& network) {
    network.landmarks = network.robotSubjects = false;
    for (const std::string& word : table.strings("subjects"))
        if (word == "landmarks")
            network.landmarks = true;
        else if (word == "robots")
            network.robotSubjects = true;
        else
            table.reject("subjects", "expected \"landmarks\" and \"robots\", found \"" + word + '"');
    network.view.range = table.number("range_m", {1e-3, 1e4});
    network.view.nearest = table.numberOr("nearest_m", 0, {0, network.view.range});
    network.view.fieldOfView = table.number("field_of_view_rad", {1e-3, 2 * std::numbers::pi});
}

void readNoise(TomlTable table, SensorNetwork& network) {
    for (std::size_t i = 0; i <= static_cast<std::size_t>(network.form.dimensions); ++i) {
        TomlTable part = table.table(channelName(network, i));
        ReadingNoise& noise = network.noise[i];
        constexpr NumberRange share{0, 1}, time{1e-3, 1e6};
        noise = {part.number("look", share), part.number("slow", share), part.number("slow_time_s", time),
                 part.number("subject", share), part.number("subject_time_s", time)};
        if (noise.look + noise.slow + noise.subject > 1 + 1e-9)
            part.reject("subject", "and look and slow are shares; expected at most 1 together");
        part.rejectUnknown();
    }
    table.rejectUnknown();
}

void readGross(TomlTable table, SensorNetwork& network) {
    network.gross.share = table.number("share", {0, 0.5});
    for (int d = 0; d < network.form.dimensions; ++d) {
        const auto i = static_cast<std::size_t>(d);
        network.gross.reach[i] = table.number(reachKey(dimensionsOf(network.measures)[i]), {1e-9, 1e6});
    }
    table.rejectUnknown();
}

void readConstant(TomlTable table, SensorNetwork& network) {
    network.constant.seen = table.number("seen", {0, 1});
    network.constant.unseen = table.number("unseen", {0, 1});
    for (int d = 0; d < network.form.dimensions; ++d) {
        const auto i = static_cast<std::size_t>(d);
        network.constant.spread[i] = table.number(unitKey(dimensionsOf(network.measures)[i]), {0, 1e6});
    }
    table.rejectUnknown();
}

void readHeldOut(TomlTable table, SensorNetwork::HeldOut& heldOut) {
    constexpr std::int64_t most = std::numeric_limits<std::int64_t>::max();
    heldOut = {table.integer("looks", 0, most), table.integer("cases", 0, most), table.integer("readings", 0, most),
               table.number("reported"), table.number("error")};
    table.rejectUnknown();
}

void checkVariables(TomlTable& table, const LearnedNetwork& learned, const SensorNetwork& network) {
    if (const std::string wrong = SensorInputs::objection(learned.inputs, network.robots); !wrong.empty())
        table.reject("robots", "and the quantities of sensors do not explain the network: it " + wrong);
    const std::vector<NetworkVariable> expected = sensorOutputs(network.measures, network.form);
    bool fits = expected.size() == learned.outputs.size();
    for (std::size_t i = 0; fits && i < expected.size(); ++i)
        fits = expected[i].name == learned.outputs[i].name && expected[i].unit == learned.outputs[i].unit;
    if (!fits)
        table.reject("components", "are described by other outputs than the network has: expected " +
                                       std::to_string(expected.size()) + " from \"" + expected.front().name +
                                       "\" to \"" + expected.back().name + '"');
}

void readSection(TomlTable& table, const LearnedNetwork& learned, SensorNetwork& network) {
    network.sensor = table.string("name");
    network.measures = static_cast<Measures>(table.choice("measures", measuresNames));
    network.robotType = table.string("robot_type");
    network.robots = table.strings("robots");
    network.period = fromSeconds(table.number("period_s", {0, 10}));
    network.latency = fromSeconds(table.number("latency_s", {0, 1}));
    network.latencyError = table.number("latency_error_s", {0, 1e6});
    if (network.measures == Measures::subjects) readSubjects(table, network);
    network.form.dimensions = static_cast<int>(dimensionsOf(network.measures).size());
    network.form.components =
        static_cast<int>(table.integer("components", 1, std::int64_t{ReadingForm::maxComponents}));
    network.form.members = static_cast<int>(table.integer("members", 1, std::int64_t{ReadingForm::maxMembers}));
    readGross(table.table("gross_errors"), network);
    readConstant(table.table("constant"), network);
    readHeldOut(table.table("held_out_score"), network.heldOut);
    readNoise(table.table("noise"), network);
    if (!table.failed()) checkVariables(table, learned, network);
}

}  // namespace

std::span<const ReadingDimension> dimensionsOf(Measures measures) {
    return measures == Measures::subjects ? std::span<const ReadingDimension>(ofSubjects)
                                          : std::span<const ReadingDimension>(ofPose);
}

std::vector<NetworkVariable> sensorOutputs(Measures measures, const ReadingForm& form) {
    std::vector<NetworkVariable> outputs(static_cast<std::size_t>(form.outputs()));
    outputs[ReadingForm::reported] = {"reported_quantile", "1"};
    auto output = outputs.begin() + ReadingForm::errors;
    for (int m = 0; m < form.members; ++m)
        for (int k = 0; k < form.components; ++k) {
            std::string of = form.members == 1 ? "" : " of member " + std::to_string(m + 1);
            if (k > 0) of.insert(0, '_' + std::to_string(k + 1));
            if (k > 0) *output++ = {"log_share" + of, "1"};
            for (const ReadingDimension& dimension : dimensionsOf(measures))
                *output++ = {std::string(dimension.name) + "_error" + of, std::string(dimension.unit)};
            for (const ReadingDimension& dimension : dimensionsOf(measures))
                *output++ = {"log_" + std::string(dimension.name) + "_spread" + of, "1"};
        }
    return outputs;
}

std::string sensorText(const SensorNetwork& network) { return networkFileText(network.learned, sectionText(network)); }

Expected<SensorNetwork> parseSensor(std::string_view text, const std::string& file) {
    TomlTable root(text, file);
    SensorNetwork network;
    const auto readPart = [&](TomlTable& section, const LearnedNetwork& general) {
        readSection(section, general, network);
    };
    auto learned = readNetworkFile(root, SensorNetwork::kind, readPart, sensorFamilyNames);
    if (!learned) return tl::unexpected(learned.error());
    network.learned = std::move(*learned);
    return network;
}

Expected<SensorNetwork> loadSensor(const std::filesystem::path& path) {
    return readFile(path).and_then([&](const std::string& text) { return parseSensor(text, path.string()); });
}

Expected<void> saveSensor(const SensorNetwork& network, const std::filesystem::path& path) {
    return writeFileAtomically(path, sensorText(network));
}

}  // namespace mrose

#include "experiment/results_row.h"

#include <algorithm>
#include <charconv>
#include <numbers>
#include <numeric>

#include "io/format.h"
#include "quantities/catalogue.h"
#include "simulation/driving_now.h"
#include "world/seconds_text.h"
#include "world/state_hash.h"

namespace mrose {
namespace {

constexpr std::size_t endCell = 2, firstNumber = 3, faultsCell = 7;

/// A cell that may hold commas and quotes, on one line.
std::string cell(const std::string& text) {
    std::string out = "\"";
    for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c < ' ' && c >= 0 ? ' ' : c);
    return out + '"';
}

/// The cells of a line before the first in quotes.
std::vector<std::string_view> plainCells(std::string_view line) {
    std::vector<std::string_view> cells;
    while (!line.empty() && line.front() != '"') {
        const std::size_t end = std::min(line.find(','), line.size());
        cells.push_back(line.substr(0, end));
        line.remove_prefix(std::min(end + 1, line.size()));
    }
    return cells;
}

struct VariedValue {
    std::string name;
    double value;
};

/// What [variation] varies of a scenario, as it is in this trial.
std::vector<VariedValue> variedValues(const ScenarioParts& parts) {
    constexpr double degrees = 180 / std::numbers::pi;
    const Variation& variation = parts.variation;
    std::vector<VariedValue> values;
    const auto add = [&](const std::string& name, const Pose& start, double position, double heading) {
        if (position > 0) values.insert(values.end(), {{"start x_m " + name, start.x}, {"start y_m " + name, start.y}});
        if (heading > 0) values.push_back({"start heading_deg " + name, degrees * start.heading});
    };
    for (const SceneRobot& robot : parts.scene.robots)
        add(robot.name, robot.start, variation.robotPosition, variation.robotHeading);
    for (const SceneObject& object : parts.scene.objects) add(object.name, object.start, variation.objectPosition, 0);
    const FloorSurface& floor = parts.scene.environment.floor;
    if (variation.frictionShare > 0)
        values.insert(values.end(), {{"sliding_friction", floor.slidingFriction},
                                     {"rolling_deceleration_mps2", floor.rollingDeceleration}});
    if (variation.massShare > 0)
        for (const SceneObject& object : parts.scene.objects)
            values.push_back({"mass_kg " + object.name, parts.scene.objectTypes[object.type].mass});
    return values;
}

/// Whose networks know what is unfamiliar.
std::vector<std::size_t> robotsWithFamiliar(const Scene& scene) {
    std::vector<std::size_t> robots;
    for (std::size_t i = 0; i < scene.robots.size(); ++i)
        if (familiarDriving(scene, i) != nullptr) robots.push_back(i);
    return robots;
}

const Quantity& goals() { return quantityNamed("goals", Quantity::Of::goal); }
/// As conditions call it.
std::string goalsName(const Goal& goal) { return goals().name + ('.' + goal.name); }

}  // namespace

std::vector<std::string> resultsCells(std::string_view line) {
    std::vector<std::string> cells(1);
    bool quoted = false;
    for (std::size_t i = 0; i < line.size(); ++i) {
        if (line[i] == '"' && quoted && i + 1 < line.size() && line[i + 1] == '"')
            cells.back() += line[++i];
        else if (line[i] == '"')
            quoted = !quoted;
        else if (line[i] == ',' && !quoted)
            cells.emplace_back();
        else
            cells.back() += line[i];
    }
    return cells;
}

std::string resultsHeader(const ScenarioParts& parts) {
    std::string line = "trial,seed,end,time_s,touches,kicks,hits,faults,driven_m,ball_still_s";
    for (const Goal& goal : parts.scene.environment.goals) line += ',' + cell(goalsName(goal));
    const auto familiar = robotsWithFamiliar(parts.scene);
    if (!familiar.empty()) line += std::string(",") + unfamiliarColumn;
    for (const std::size_t robot : familiar)
        line += ',' + cell(unfamiliarColumn + (' ' + parts.scene.robots[robot].name));
    for (const VariedValue& value : variedValues(parts)) line += ',' + cell(value.name);
    return line + ",world_hash,command,first_fault";
}

std::string resultsRow(const RunKey& key, const RunResult& result, const ScenarioParts& parts,
                       const std::string& command) {
    const RunStatistics& s = result.statistics;
    std::string line = std::to_string(key.trial) + ',' + std::to_string(key.seed) + ',' + name(result.end) + ',' +
                       plainSeconds(result.state.tick * parts.scene.tickLength);
    for (const std::int64_t count : {s.touches, s.kicks, s.hits, s.faults}) line += ',' + std::to_string(count);
    line += ',' + numberText(std::accumulate(s.driven.begin(), s.driven.end(), 0.0)) + ',' + plainSeconds(s.ballStill);
    for (std::uint32_t goal = 0; goal < s.goals.size(); ++goal)
        line += ',' + std::to_string(std::get<std::int64_t>(goals().value({{nullptr, &result.state}, goal})));
    const auto familiar = robotsWithFamiliar(parts.scene);
    if (!familiar.empty()) line += ',' + numberText(s.shareOf(s.anyUnfamiliar));
    for (const std::size_t robot : familiar) line += ',' + numberText(s.shareOf(*s.unfamiliar[robot]));
    for (const VariedValue& value : variedValues(parts)) line += ',' + numberText(value.value);
    return line + ',' + hexadecimal(hashOf(result.state).world) + ',' + cell(command) + ',' + cell(s.firstFault);
}

ResultsSummary::ResultsSummary(const Scene& scene) {
    for (const char* const name : {"time, s", "touches", "kicks", "hits", "faults", "driven, m", "ball still, s"})
        columns.push_back({name});
    for (const Goal& goal : scene.environment.goals) columns.push_back({goalsName(goal)});
    if (!robotsWithFamiliar(scene).empty()) columns.push_back({unfamiliarColumn});
}

void ResultsSummary::add(std::string_view row) {
    const std::vector<std::string_view> cells = plainCells(row);
    if (cells.size() < firstNumber + columns.size()) return;
    ++rows;
    ended += cells[endCell] == name(RunEnd::condition) ? 1 : 0;
    faulty += cells[faultsCell] != "0" ? 1 : 0;
    for (std::size_t i = 0; i < columns.size(); ++i) {
        const std::string_view number = cells[firstNumber + i];
        double value = 0;
        std::from_chars(number.data(), number.data() + number.size(), value);
        ColumnSummary& column = columns[i];
        column.least = rows == 1 ? value : std::min(column.least, value);
        column.most = rows == 1 ? value : std::max(column.most, value);
        column.mean += (value - column.mean) / static_cast<double>(rows);
    }
}

}  // namespace mrose

#include "compare_sensors.h"

#include <cmath>
#include <cstdio>

#include "common.h"
#include "io/format.h"
#include "report/stream_section.h"

namespace mrose::cli {
namespace {

std::string shareCell(const BlockShare& share) {
    return share.of == 0 ? "" : fixed(100 * share.share, 1) + " ± " + fixed(100 * share.error, 1);
}

std::vector<std::string> streamCells(const std::string& name, const StreamFigures& figures, bool simulated) {
    const auto of = [&](const auto& both) { return simulated ? both.simulated : both.real; };
    const ReadingErrors range = of(figures.range.of), bearing = of(figures.bearing.of);
    const auto error = [](const ReadingErrors& errors, double value, int decimals) {
        return errors.distribution.count == 0 ? "" : fixed(value, decimals);
    };
    return {name,
            std::to_string(of(figures.looks)),
            shareCell(of(figures.empty)),
            std::to_string(of(figures.reported).of),
            shareCell(of(figures.reported)),
            error(range, 100 * range.distribution.mean, 1),
            error(range, 100 * range.deviation, 1),
            error(bearing, 1000 * bearing.distribution.mean, 1),
            error(bearing, 1000 * bearing.deviation, 1)};
}

void add(TextTable& table, const Comparison& comparison, const std::string& name, const StreamFigures& figures) {
    table.add(streamCells(name + ", " + comparison.log.real(), figures, false));
    table.add(streamCells("  simulated", figures, true));
    table.add({"  p", "", probabilityText(figures.emptyTest), "", probabilityText(figures.reportedTest),
               probabilityText(figures.range.test), "", probabilityText(figures.bearing.test), ""});
}

/// In lines of at most so many characters.
std::string wrapped(const std::string& text, std::size_t width) {
    std::string lines;
    std::size_t column = 0;
    for (std::size_t from = 0; from < text.size();) {
        const std::size_t to = std::min(text.find(' ', from), text.size());
        if (column > 0 && column + 1 + to - from > width) lines += '\n', column = 0;
        if (column > 0) lines += ' ', ++column;
        lines += text.substr(from, to - from);
        column += to - from;
        from = to + 1;
    }
    return lines;
}

void print(const Comparison& comparison, const ComparedSensor& sensor) {
    std::printf("\nSensor \"%s\". %s\n", sensor.name.c_str(), streamsText(comparison, sensor).c_str());
    if (sensor.all.reported.real.of == 0 && sensor.all.reported.simulated.of == 0) return;
    TextTable table({"", "looks", "empty %", "in view", "reported %", "range cm", "sd", "bearing mrad", "sd"});
    std::size_t robots = 0;
    for (std::size_t i = 0; i < sensor.robots.size(); ++i) {
        if (!sensor.robots[i]) continue;
        add(table, comparison, comparison.robots[i].name, *sensor.robots[i]);
        ++robots;
    }
    if (robots > 1) add(table, comparison, "all", sensor.all);
    std::fputs(table.text().c_str(), stdout);
}

}  // namespace

void printSensors(const Comparison& comparison) {
    if (comparison.sensors.empty()) return;
    for (const ComparedSensor& sensor : comparison.sensors) print(comparison, sensor);
    std::puts(
        wrapped("range, bearing: mean error of what was reported, and its standard deviation (sd). " + testsText(), 112)
            .c_str());
}

}  // namespace mrose::cli

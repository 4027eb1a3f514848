#include "report/stream_section.h"

#include <cmath>

#include "io/format.h"
#include "report/legend.h"
#include "report/page.h"
#include "report/stream_figures.h"
#include "world/seconds_text.h"

namespace mrose {
namespace {

std::string shareText(const BlockShare& share) {
    if (share.of == 0) return {};
    return cat(fixed(100 * share.share, 1), std::isnan(share.error) ? "" : cat(" ± ", fixed(100 * share.error, 1)));
}

std::vector<std::string> errorCells(const ReadingErrors& errors, double unit, int decimals) {
    const Distribution& d = errors.distribution;
    if (d.count == 0) return {"", "", "", "", ""};
    return {fixed(unit * d.mean, decimals), knownText(unit * errors.deviation, decimals), fixed(unit * d.p10, decimals),
            fixed(unit * d.median, decimals), fixed(unit * d.p90, decimals)};
}

std::vector<std::string> streamRow(const std::string& name, const StreamFigures& figures, bool simulated) {
    const auto of = [&](const auto& both) { return simulated ? both.simulated : both.real; };
    std::vector<std::string> cells{name, std::to_string(of(figures.looks)), shareText(of(figures.empty)),
                                   std::to_string(of(figures.reported).of), shareText(of(figures.reported))};
    for (const auto& [errors, unit, decimals] :
         {std::tuple(&figures.range, 100.0, 1), std::tuple(&figures.bearing, 1000.0, 1)})
        for (std::string& cell : errorCells(of(errors->of), unit, decimals)) cells.push_back(std::move(cell));
    return cells;
}

std::vector<std::string> testRow(const StreamFigures& figures) {
    return {"p",
            "",
            probabilityText(figures.emptyTest),
            "",
            probabilityText(figures.reportedTest),
            probabilityText(figures.range.test),
            "",
            "",
            "",
            "",
            probabilityText(figures.bearing.test),
            "",
            "",
            "",
            ""};
}

std::string streamTable(const Comparison& comparison, const ComparedSensor& sensor) {
    HtmlTable table({{"", {""}},
                     {"looks", {"all", "empty %"}},
                     {"subjects", {"in view", "reported %"}},
                     {"range errors, cm", {"mean", "sd", "p10", "median", "p90"}},
                     {"bearing errors, mrad", {"mean", "sd", "p10", "median", "p90"}}},
                    "dense");
    const auto add = [&](const std::string& name, const StreamFigures& figures) {
        table.part(name);
        table.row(streamRow(comparison.log.real(), figures, false));
        table.row(streamRow("simulated", figures, true));
        table.row(testRow(figures));
    };
    std::size_t robots = 0;
    for (std::size_t i = 0; i < sensor.robots.size(); ++i) {
        if (!sensor.robots[i]) continue;
        add(escaped(comparison.robots[i].name), *sensor.robots[i]);
        ++robots;
    }
    if (robots > 1) add("all", sensor.all);
    return table.text();
}

std::string figures(const Comparison& comparison, const ComparedSensor& sensor) {
    const auto pair = [](std::string_view first, const std::string& firstFigure, std::string_view second,
                         const std::string& secondFigure) {
        return element("div", "pair", card(first, firstFigure) + card(second, secondFigure));
    };
    return cat(
        legend(lineEntry("real", comparison.log.real()) + lineEntry("s0", "simulated") +
               boxEntry("realband", cat("two standard errors, ", comparison.log.real())) +
               boxEntry("band", "two standard errors, simulated")),
        pair("Reports by range", reportsByRangeFigure(sensor), "Reports by bearing", reportsByBearingFigure(sensor)),
        pair("Errors of the range", rangeErrorFigure(sensor), "Errors of the bearing", bearingErrorFigure(sensor)));
}

}  // namespace

std::string probabilityText(const TwoSampleTest& test) {
    if (std::isnan(test.p)) return {};
    constexpr double least = 1.0 / (1 + blockSwaps);
    return test.p <= least ? "≤ " + fixed(least, 3) : fixed(test.p, 3);
}

std::string streamsText(const Comparison& comparison, const ComparedSensor& sensor) {
    const StreamFigures& all = sensor.all;
    const std::string& real = comparison.log.real();
    if (all.reported.real.of == 0 && all.reported.simulated.of == 0)
        return "Nothing was in view of it that the log and the simulated world both know.";
    std::string text = cat(
        "Of the subjects in view the ", real, " sensors reported ", fixed(100 * all.reported.real.share, 1),
        " %, the simulated ones ", fixed(100 * all.reported.simulated.share, 1), " %; of the looks ",
        fixed(100 * all.empty.real.share, 1), " % and ", fixed(100 * all.empty.simulated.share, 1), " % were empty.");
    if (all.blocks < leastBlocks)
        text += cat(" They last ", counted(all.blocks, "stretch", "stretches"), " of ", secondsText(readingBlock, 0),
                    " s: too short to test whether they differ.");
    return text;
}

std::string testsText() {
    return cat(
        "p: how likely two streams of one kind would differ by at least as much: in the shares by their "
        "difference, in the errors by the largest distance of their distribution functions (Kolmogorov and "
        "Smirnov). Readings depend on each other, so ",
        std::to_string(blockSwaps), " times whole stretches of ", secondsText(readingBlock, 0),
        " s exchange at random what is real and what is simulated in them. Standard errors (±) are by the same "
        "stretches.");
}

std::string streamSection(const Comparison& comparison) {
    std::string text;
    for (const ComparedSensor& sensor : comparison.sensors) {
        text += cat(heading(cat("What the sensor “", escaped(sensor.name), "” reported")),
                    paragraph(escaped(streamsText(comparison, sensor))));
        if (sensor.all.reported.real.of == 0 && sensor.all.reported.simulated.of == 0) continue;
        text += cat(figures(comparison, sensor), tableCard(streamTable(comparison, sensor)),
                    element("p", "soft", escaped(testsText())));
    }
    return text;
}

}  // namespace mrose

#include "report/evaluation_tables.h"

#include <algorithm>
#include <cmath>

#include "drawing/markup.h"
#include "io/format.h"
#include "report/evaluation_figures.h"
#include "report/page.h"
#include "world/seconds_text.h"

namespace mrose {
namespace {

std::string withInterval(double value, const Interval& interval, std::size_t windows) {
    if (windows < leastForInterval) return fixed(value, 2);
    return cat(fixed(value, 2), "<small>", fixed(interval.low, 2), "–", fixed(interval.high, 2), "</small>");
}

void addThree(std::vector<std::string>& cells, const Distribution& d, double unit, int decimals) {
    for (const double value : {d.median, d.mean}) cells.push_back(fixed(unit * value, decimals));
    cells.push_back(p90Text(d, unit, decimals));
}

std::string signedText(double value, int decimals) {
    const std::string text = fixed(std::abs(value), decimals);
    return cat(value > 0 ? "+" : value < 0 ? "−" : "", text);
}

/// The values with the smallest one in bold, where there are several.
std::vector<std::string> smallestBold(const std::vector<double>& values, int decimals) {
    std::vector<std::string> cells;
    const auto better = [](double a, double b) { return !std::isnan(a) && (std::isnan(b) || a < b); };
    const auto best = std::min_element(values.begin(), values.end(), better) - values.begin();
    for (std::size_t i = 0; i < values.size(); ++i) {
        const std::string text = fixed(values[i], decimals);
        const bool bold = values.size() > 1 && static_cast<std::ptrdiff_t>(i) == best && std::isfinite(values[i]);
        cells.push_back(bold ? cat("<b>", text, "</b>") : text);
    }
    return cells;
}

/// A pair of columns per model under the model's name.
struct PairedTable {
    PairedTable(const Evaluation& evaluation, std::vector<std::string> leading, const std::string& first,
                const std::string& second)
        : table([&] {
              std::vector<std::string> header = leading;
              for (std::size_t i = 0; i < evaluation.models.size(); ++i) {
                  header.push_back(first);
                  header.push_back(second);
              }
              return HtmlTable(header, "even");
          }()) {
        for (std::size_t i = 0; i < leading.size(); ++i) table.group("", 1);
        for (const Assessment& model : evaluation.models) table.group(escaped(model.name), 2);
    }

    void row(std::vector<std::string> cells, const std::vector<double>& first, const std::vector<double>& second,
             int decimals) {
        const auto left = smallestBold(first, decimals), right = smallestBold(second, decimals);
        for (std::size_t i = 0; i < left.size(); ++i) {
            cells.push_back(left[i]);
            cells.push_back(right[i]);
        }
        table.row(cells);
    }

    HtmlTable table;
};

}  // namespace

std::string modelTable(const Evaluation& evaluation) {
    HtmlTable table({"", "P %", "Hd %", "median", "mean", "p90", "median", "mean", "p90", "median", "mean", "p90",
                     "along cm", "left cm", "turn °"},
                    "dense");
    table.group("", 3);
    table.group("time-mean / path, %", 3);
    table.group("position at the end, cm", 3);
    table.group("heading at the end, °", 3);
    table.group("mean offset at the end", 3);
    for (std::size_t i = 0; i < evaluation.models.size(); ++i) {
        const Summary& s = evaluation.models[i].all;
        std::vector<std::string> cells{modelName(evaluation, i), withInterval(s.p, s.p95, s.windows),
                                       withInterval(s.hd, s.hd95, s.windows)};
        addThree(cells, s.positionMeanOverPath, 1, 2);
        addThree(cells, s.positionFinal, 100, 2);
        addThree(cells, s.headingFinal, degrees, 2);
        cells.push_back(signedText(100 * s.along.mean, 2));
        cells.push_back(signedText(100 * s.left.mean, 2));
        cells.push_back(signedText(degrees * s.headingSigned.mean, 2));
        table.row(cells);
    }
    return table.text();
}

std::string groupTable(const Evaluation& evaluation) {
    PairedTable paired(evaluation, {"", "windows", "path m", "rotation rad"}, "P %", "Hd %");
    const auto& groups = evaluation.models.front().groups;
    for (std::size_t g = 0; g < groups.size(); ++g) {
        if (g == 0 || groups[g].kind != groups[g - 1].kind) paired.table.part(cat("by ", escaped(groups[g].kind)));
        std::vector<double> p, hd;
        for (const Assessment& model : evaluation.models) {
            p.push_back(model.groups[g].summary.p);
            hd.push_back(model.groups[g].summary.hd);
        }
        const Summary& s = groups[g].summary;
        paired.row({cat(groups[g].kind == "robot" ? "robot " : "", escaped(groups[g].name)), std::to_string(s.windows),
                    fixed(s.path, 1), fixed(s.rotation, 1)},
                   p, hd, 2);
    }
    return paired.table.text();
}

std::string relativeTable(const Evaluation& evaluation) {
    PairedTable paired(evaluation, {"horizon", "pieces"}, "cm", "°");
    const auto& horizons = evaluation.models.front().relative;
    for (std::size_t h = 0; h < horizons.size(); ++h) {
        std::vector<double> position, heading;
        for (const Assessment& model : evaluation.models) {
            position.push_back(100 * model.relative[h].position);
            heading.push_back(degrees * model.relative[h].heading);
        }
        paired.row({cat(secondsText(fromSeconds(horizons[h].horizon), 0), " s"), std::to_string(horizons[h].pieces)},
                   position, heading, 2);
    }
    return paired.table.text();
}

std::string floorTable(const Evaluation& evaluation) {
    const bool both = evaluation.log.turningFloor.has_value();
    std::vector<std::string> header{"", "P %", "Hd %"};
    if (both) header.insert(header.end(), {"P %", "Hd %"});
    HtmlTable table(header);
    const auto title = [](const Floor& floor) {
        return cat(secondsText(floor.horizon, 0), " s, ", std::to_string(floor.pairs.size()), " pairs",
                   floor.options.leastTurnRate > 0 ? ", turning" : "");
    };
    table.group("", 1);
    table.group(title(*evaluation.log.floor), 2);
    if (both) table.group(title(*evaluation.log.turningFloor), 2);
    const auto row = [&](const std::string& label, const PercentErrors& first, const PercentErrors& second) {
        std::vector<std::string> cells{label, fixed(first.p, 2), fixed(first.hd, 2)};
        if (both) cells.insert(cells.end(), {fixed(second.p, 2), fixed(second.hd, 2)});
        table.row(cells);
    };
    const Floor& floor = *evaluation.log.floor;
    const Floor& turning = both ? *evaluation.log.turningFloor : floor;
    row("spread: two real runs of near-identical commands, apart", floor.spread, turning.spread);
    row("floor: the best possible prediction (spread / √2)", floor.best, turning.best);
    for (std::size_t i = 0; i < evaluation.models.size(); ++i)
        row(modelName(evaluation, i), evaluation.models[i].onFloor, evaluation.models[i].onTurningFloor);
    return table.text();
}

std::string defectTable(const LogWindows& log) {
    HtmlTable table({"", "windows", "out of order", "duplicate", "blips", "pose outliers", "unpaired", "heading wraps",
                     "number", "longest s", "number", "longest s"});
    table.group("", 2);
    table.group("stamps", 2);
    table.group("samples", 4);
    table.group("command gaps", 2);
    table.group("truth gaps", 2);
    for (const LogWindows::Robot& robot : log.robots) {
        if (robot.windows == 0) continue;
        const LogDefects& d = robot.defects;
        std::vector<std::string> cells{cat("robot ", escaped(robot.name)), std::to_string(robot.windows)};
        for (const auto count : {d.outOfOrder, d.duplicates, d.blips, d.poseOutliers, d.unpaired, d.headingWraps})
            cells.push_back(std::to_string(count));
        cells.push_back(std::to_string(d.commandGaps));
        cells.push_back(fixed(d.longestCommandGap, 2));
        cells.push_back(std::to_string(d.poseGaps));
        cells.push_back(fixed(d.longestPoseGap, 2));
        table.row(cells);
    }
    return table.text();
}

std::string windowTable(const Evaluation& evaluation, std::size_t window) {
    HtmlTable table({"", "mean<br/>cm", "mean<br/>% path", "end<br/>cm", "end<br/>°"}, "small");
    const double path = evaluation.log.windows[window].path;
    for (const Assessment& model : evaluation.models) {
        const WindowErrors& e = model.errors[window];
        table.row({escaped(model.name), fixed(100 * e.positionMean, 1),
                   path > 0 ? fixed(100 * e.positionMean / path, 1) : "–", fixed(100 * e.positionFinal, 1),
                   fixed(degrees * e.headingFinal, 1)});
    }
    return table.text();
}

std::string fileTable(const std::vector<LogFile>& files) {
    HtmlTable table({"file", "XXH3"}, "files");
    for (const LogFile& file : files)
        table.row({cat("<code>", escaped(file.path), "</code>"), cat("<code>", escaped(file.hash), "</code>")});
    return table.text();
}

}  // namespace mrose

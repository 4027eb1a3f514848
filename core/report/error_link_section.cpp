#include "report/error_link_section.h"

#include <cmath>

#include "io/format.h"
#include "report/page.h"
#include "report/sensor_figures.h"

namespace mrose {
namespace {

std::string linkCell(double value) { return std::isfinite(value) ? fixedWithMinus(value, 2) : ""; }

std::vector<std::string> linkCells(const std::string& name, const ErrorLinks& links) {
    std::vector<std::string> cells{name};
    for (const ErrorLink& link : {links.next, links.beside})
        for (std::string cell : {linkCell(link.real), linkCell(link.model), std::to_string(link.pairs)})
            cells.push_back(std::move(cell));
    return cells;
}

/// Of all robots, and of each of several.
std::string linkTable(const SensorEvaluation& evaluation) {
    const std::string real = evaluation.log.real();
    HtmlTable table({{"", {"errors of the"}},
                     {"same subject, next look", {real, "model", "pairs"}},
                     {"another subject, same look", {real, "model", "pairs"}}});
    for (std::size_t d = 0; d < readingDimensions; ++d) {
        const std::vector<LoggedCases::Robot>& robots = evaluation.log.robots;
        table.row(linkCells(shownDimension(d).name, evaluation.links[d]));
        for (std::size_t i = 0; robots.size() > 1 && i < robots.size(); ++i)
            table.row(linkCells(cat(shownDimension(d).name, ", robot ", escaped(robots[i].name)),
                                evaluation.linksByRobot[i][d]));
    }
    return table.text();
}

std::string biasTable(const SensorEvaluation& evaluation) {
    const std::string real = evaluation.log.real();
    std::vector<HtmlTable::Group> groups{{"", {"mean errors"}}};
    for (std::size_t d = 0; d < readingDimensions; ++d)
        groups.push_back({cat(shownDimension(d).name, ", ", shownDimension(d).unit), {real, "model"}});
    HtmlTable table(groups);
    for (std::size_t i = 0; i < evaluation.means.size(); ++i) {
        std::vector<std::string> cells{cat("robot ", escaped(evaluation.log.robots[i].name))};
        for (std::size_t d = 0; d < readingDimensions; ++d)
            for (const double mean : {evaluation.means[i].real[d], evaluation.means[i].predicted[d]})
                cells.push_back(std::isfinite(mean) ? fixedWithMinus(shownDimension(d).factor * mean, 1) : "");
        table.row(cells);
    }
    return table.text();
}

}  // namespace

std::string errorLinkSection(const SensorEvaluation& evaluation) {
    return cat(heading("From look to look, and from robot to robot"),
               paragraph("Left: how far two errors go together, as the correlation of what the prediction of each "
                         "leaves open; 0 is independent, 1 the same. Looks at most 1 s apart. Where there are several "
                         "robots: of all, then of each. Right: the mean errors of each robot, and those that the "
                         "model predicts for the same readings."),
               cardPair(card("Correlation of errors", linkTable(evaluation)),
                        card("Biases of robots", biasTable(evaluation))));
}

}  // namespace mrose

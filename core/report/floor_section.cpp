#include "report/floor_section.h"

#include "io/format.h"
#include "report/legend.h"
#include "report/page.h"
#include "world/seconds_text.h"

namespace mrose {
namespace {

std::string boundsText(const Floor& floor) {
    return cat(fixed(1000 * floor.options.pathBound, 0), " mm and ", fixed(1000 * floor.options.rotationBound, 0),
               " mrad");
}

std::string countsText(const Floor& floor) {
    const std::size_t pairs = floor.pairs.size();
    return cat("Of ", counted(floor.tried, "stretch", "stretches"), ", ", counted(floor.candidates, "pair"),
               floor.candidates == 1 ? " matches" : " match", "; <b>", std::to_string(pairs),
               "</b> of them, best match first, ", pairs == 1 ? "shares" : "share", " no instant and ",
               pairs == 1 ? "is" : "are", " counted. ");
}

/// What holds of the pairs, if there are any; `meaning` is what they are taken for.
std::string pairsText(const Floor& floor, std::string_view meaning) {
    double rotation = 0;
    for (const FloorPair& pair : floor.pairs) rotation += pair.rotation;
    const auto count = static_cast<double>(floor.pairs.size());
    const char* const few = " <b>With so few pairs this is a rough estimate.</b>";
    return cat("They turn by ", fixed(rotation / count, 2), " rad each on average.", meaning, count < 20 ? few : "");
}

std::string floorText(const Floor& floor) {
    const std::string text = cat(
        "Which part of the error could no model avoid? Pairs of stretches of ", secondsText(floor.horizon, 0),
        " s of the same robot were sought whose commands are nearly the same: the integrals of v and of w differ by "
        "less than ",
        boundsText(floor), " at every instant, from ", secondsText(floor.options.lead, 0),
        " s before the start to the end. ", countsText(floor));
    if (floor.pairs.empty()) return cat(text, "So there is no such estimate for this log.");
    return text + pairsText(floor,
                            " Two outcomes differ by the chance of both, which is called the spread here; a prediction "
                            "of their mean would be off by 1/√2 of that, the floor: about what a model that sees "
                            "commands alone can reach.");
}

std::string turningFloorText(const Floor& floor) {
    const std::string text =
        cat("Such pairs go straight as a rule, which says little of turning. So the same was done with stretches of ",
            secondsText(floor.horizon, 0), " s in which the robot turns by at least ",
            fixed(floor.options.leastTurnRate, 2), " rad/s on average, within ", boundsText(floor), ". ",
            countsText(floor));
    return floor.pairs.empty() ? text : text + pairsText(floor, "");
}

std::string floorTable(const Evaluation& evaluation) {
    const LogWindows& log = evaluation.log;
    const bool both = log.turningFloor.has_value();
    const auto group = [](const Floor& floor) {
        return HtmlTable::Group{cat(secondsText(floor.horizon, 0), " s, ", counted(floor.pairs.size(), "pair"),
                                    floor.options.leastTurnRate > 0 ? ", turning" : ""),
                                {"P %", "Hd %"}};
    };
    std::vector<HtmlTable::Group> groups{{"", {""}}, group(*log.floor)};
    if (both) groups.push_back(group(*log.turningFloor));
    HtmlTable table(groups);
    const auto row = [&](const std::string& label, const PercentErrors& first, const PercentErrors& second) {
        std::vector<std::string> cells{label, fixed(first.p, 2), fixed(first.hd, 2)};
        if (both) cells.insert(cells.end(), {fixed(second.p, 2), fixed(second.hd, 2)});
        table.row(cells);
    };
    const Floor &floor = *log.floor, &turning = both ? *log.turningFloor : floor;
    row(cat("spread: two ", log.real(), " runs of near-identical commands, apart"), floor.spread, turning.spread);
    row("floor: the best possible prediction (spread / √2)", floor.best, turning.best);
    for (std::size_t i = 0; i < evaluation.models.size(); ++i)
        row(seriesName(evaluation.models[i], i), evaluation.models[i].onFloor, evaluation.models[i].onTurningFloor);
    return table.text();
}

}  // namespace

std::string floorSection(const Evaluation& evaluation) {
    const std::optional<Floor>&floor = evaluation.log.floor, &turning = evaluation.log.turningFloor;
    if (!floor) return {};
    std::string text = cat("<h2 id=\"floor\">Spread and floor: how differently near-identical commands turn out</h2>\n",
                           paragraph(floorText(*floor)));
    if (turning) text += paragraph(turningFloorText(*turning));
    if (!floor->pairs.empty() || (turning && !turning->pairs.empty()))
        text += cat(
            paragraph("Both depend on how these stretches turn and how long they are: compare the rows of this table "
                      "with each other and not with those of the whole log."),
            tableCard(floorTable(evaluation)));
    return text;
}

}  // namespace mrose

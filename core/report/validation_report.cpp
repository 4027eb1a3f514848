#include "report/validation_report.h"

#include <cmath>

#include "io/format.h"
#include "report/page.h"
#include "report/validation_figures.h"
#include "report/validation_text.h"

namespace mrose {
namespace {

const std::string minusSign = "\u2212";

std::string valueText(const MeasureValidation& of, const Estimate& estimate) {
    return cat(measuredText(of.measure, estimate, minusSign), " <small>", intervalText(of.measure, estimate, minusSign),
               "</small>");
}

std::string gainCell(const MeasureValidation& of, const Estimate& estimate) {
    return cat(differenceText(of.measure, estimate, minusSign), " <small>",
               intervalText(of.measure, estimate, minusSign), "</small>");
}

std::string hoursText(double hours) {
    return hours >= 1 || hours <= -1 ? fixed(hours, 1) + " h" : fixed(60 * hours, 1) + " min";
}

std::string validationHead(const Validation& validation, const ValidationContext& context) {
    std::string text = element("h1", "",
                               cat(escaped(validation.name), "<span class=\"badge\">",
                                   validation.real ? "measured in reality" : "synthetic reality", "</span>"));
    text += element("p", "sub",
                    cat(escaped(validation.file), ", experiment <code>", escaped(validation.experiment.file), "</code>",
                        context.program.empty() ? "" : cat(", ", escaped(context.program))));
    if (!validation.real)
        text += element("p", "notice",
                        "The reality is simulated, too, by other classes of model than what was learned in. It shows "
                        "what of a gain holds outside of the simulator, and nothing of a real robot.");
    for (const std::string& note : validation.notes) text += element("p", "notice", escaped(note));
    return text;
}

std::string lead(const Validation& validation, const ValidationResult& result) {
    const MeasureValidation& of = result.measures.front();
    std::string text =
        cat("<b>", escaped(of.measure.name), "</b> of <b>", escaped(validation.after), "</b> against <b>",
            escaped(validation.before), "</b>, the same ", counted(of.trials.size(), "trial"),
            " in both: ", gainText(of.measure, of.gain[0]), " in ", escaped(validation.simulation), ", ",
            gainText(of.measure, of.gain[1]), " in ", escaped(validation.reality), ". ");
    if (std::isfinite(of.survives.value))
        text += cat("The gain ratio is <b>", escaped(survivesText(of, minusSign)), "</b>.");
    return element("p", "lead", text);
}

/// Of the tile, whose value is the ratio.
std::string ratioNote(const MeasureValidation& of) {
    if (!std::isfinite(of.survives.value)) return escaped(survivesText(of, minusSign));
    return cat("95\u00a0% interval ", fixedWithMinus(100 * of.survives.low, 0), " to ",
               fixedWithMinus(100 * of.survives.high, 0), "\u00a0%");
}

std::string validationTiles(const Validation& validation, const ValidationResult& result) {
    const MeasureValidation& of = result.measures.front();
    const auto gain = [&](std::size_t place, const std::string& where) {
        return tile(cat("gain in ", escaped(where)), differenceText(of.measure, of.gain[place], minusSign), "",
                    cat("95\u00a0% interval ", intervalText(of.measure, of.gain[place], minusSign)));
    };
    const AccountResult& account = result.account;
    const double given = validation.account.simulatedHours;
    const bool known = std::isfinite(of.survives.value);
    return tileRow(
        cat(gain(0, validation.simulation), gain(1, validation.reality),
            tile("gain ratio", known ? fixed(100 * of.survives.value, 0) : "–", known ? "%" : "", ratioNote(of)),
            tile("hours of real robots spared", fixed(account.sparedHours(), 1), "h",
                 cat(hoursText(account.simulatedHours), " simulated",
                     given > 0 ? cat(" (", hoursText(given), " by learning and tuning)") : "",
                     account.resetHours > 0 ? cat(" and ", hoursText(account.resetHours), " set up") : "",
                     account.logMinutes ? cat(", less ", hoursText(*account.logMinutes / 60), " of logs") : ""))));
}

std::string cellTable(const ValidationResult& result) {
    HtmlTable table(
        {{"", {""}},
         {"means", {result.cells[0].name, result.cells[1].name, result.cells[2].name, result.cells[3].name}},
         {"", {"trials", "left out"}}});
    for (const MeasureValidation& of : result.measures) {
        std::vector<std::string> cells{escaped(of.measure.name)};
        for (const Estimate& cell : of.cells) cells.push_back(valueText(of, cell));
        cells.push_back(std::to_string(of.trials.size()));
        cells.push_back(std::to_string(of.leftOut));
        table.row(cells);
    }
    const auto counts = [&](const char* what, auto count) {
        std::vector<std::string> cells{what};
        for (const CellRuns& runs : result.cells) cells.push_back(runs.measured ? "–" : std::to_string(count(runs)));
        cells.insert(cells.end(), {"", ""});
        table.row(cells);
    };
    counts("runs", [](const CellRuns& runs) { return runs.runs; });
    counts("not ended by `until`", [](const CellRuns& runs) { return runs.unfinished; });
    counts("left out: ended by a fault", [](const CellRuns& runs) { return runs.faulty; });
    return table.text();
}

std::string gainTable(const Validation& validation, const ValidationResult& result) {
    HtmlTable table(
        {{"", {""}},
         {"gain", {escaped(validation.simulation), escaped(validation.reality), "gain ratio"}},
         {cat("in ", escaped(validation.reality)), {escaped(validation.before), escaped(validation.after)}}});
    for (const MeasureValidation& of : result.measures)
        table.row({cat(escaped(of.measure.name), of.measure.lessIsBetter ? ", less is better" : ", more is better"),
                   gainCell(of, of.gain[0]), gainCell(of, of.gain[1]), escaped(survivesText(of, minusSign)),
                   escaped(gainWithIntervalText(of.measure, negated(of.worse[0]), minusSign)),
                   escaped(gainWithIntervalText(of.measure, negated(of.worse[1]), minusSign))});
    return table.text();
}

std::string figures(const Validation& validation, const ValidationResult& result) {
    std::string text = placeLegend(validation);
    for (const MeasureValidation& of : result.measures) {
        if (of.trials.empty()) continue;
        const std::string cells =
            card(cat(escaped(of.measure.name), ": means with 95\u00a0% intervals"), cellFigure(validation, of));
        const std::string second =
            of.measure.yesNo
                ? card("Gains, by trial", gainDistributionFigure(validation, of))
                : card("Gains, by trial: as large in both on the dashed line; orange ones lie beyond the edge",
                       pairedGainFigure(validation, of));
        text += cardPair(cells, second);
        if (!of.measure.yesNo)
            text += cardPair(card("How gains are distributed", gainDistributionFigure(validation, of)), "");
    }
    return text;
}

std::string disagreementSection(const Validation& validation, const ValidationResult& result,
                                const ResultsTable& results, const ValidationContext& context) {
    if (result.disagreements.empty()) return {};
    const MeasureValidation& of = result.measures.front();
    const std::size_t window = results.columnOf("window");
    HtmlTable table({{"", {"trial"}},
                     {"", {"seed", "controller", escaped(validation.simulation), escaped(validation.reality)}},
                     {"", {"opens it in the window"}}});
    for (const Disagreement& one : result.disagreements) {
        const auto command = [&](std::size_t row) {
            return cat("<code>", escaped(results.rows[row].at(window)), "</code>");
        };
        table.row({std::to_string(one.trial), std::to_string(one.seed),
                   escaped(one.after ? validation.after : validation.before),
                   measuredText(of.measure, one.simulated, minusSign), measuredText(of.measure, one.real, minusSign),
                   cat(command(one.simulatedRow), one.realRow ? cat("<br/>", command(*one.realRow)) : "")});
    }
    return cat(
        heading("Where the two disagree most"),
        paragraph(cat("By ", escaped(of.measure.name), ". As a list, from which each is opened by a click: <code>",
                      escaped(context.window), " ", escaped(context.folder), "/disagreements.csv</code>")),
        tableCard(table.text()));
}

std::string accountSection(const Validation& validation, const ValidationResult& result,
                           const ValidationContext& context) {
    const AccountResult& account = result.account;
    HtmlTable table({{"", {"", ""}}}, "words");
    table.row({"logs that the simulator was learned from",
               account.logMinutes ? cat(fixed(*account.logMinutes, 1), " min",
                                        account.fromNetworks ? ", by its motion networks: patterns times control period"
                                                             : ", as the file says")
                                  : "not known: `account.log_minutes`"});
    table.row(
        {"simulated", cat(hoursText(account.simulatedHours), ", ",
                          counted(static_cast<std::size_t>(account.simulatedRuns), "run"), " of this validation",
                          validation.account.simulatedHours > 0
                              ? cat(" and ", hoursText(validation.account.simulatedHours), " of learning and tuning")
                              : "")});
    table.row({"computing", cat(fixed(context.seconds / 60, 2), " min of this validation",
                                context.resumed > 0 ? cat(", of which ", std::to_string(context.resumed),
                                                          " runs were done before and are not counted")
                                                    : "",
                                account.computingMinutes > 0
                                    ? cat("; ", fixed(account.computingMinutes, 1), " min of learning and tuning")
                                    : "")});
    if (account.resetHours > 0)
        table.row({"setting robots up between trials",
                   cat(hoursText(account.resetHours), ", at ", fixed(validation.account.resetSeconds, 0), " s each")});
    table.row({"hours of real robots spared",
               cat("<b>", hoursText(account.sparedHours()), "</b>: what was simulated",
                   account.resetHours > 0 ? " and set up" : "",
                   account.logMinutes ? ", less what the logs took" : ", of which the logs took an unknown part")});
    return cat(heading("What it cost, and what it spared"), tableCard(table.text()));
}

std::string meanings(const Validation& validation) {
    std::string list;
    list +=
        definition("gain", cat("Of a trial: by how much ", escaped(validation.after), " is better than ",
                               escaped(validation.before),
                               ", from the same start with the same noise. The interval is Student’s, over trials; it "
                               "ends where a mean cannot be, as far as the measure says that."));
    list += definition("gain ratio",
                       "Mean gain in the reality over mean gain in the simulator: what of it survives, with "
                       "Fieller’s interval. It is not known where the gain in the simulator may be none.");
    list += definition("shares",
                       "Of yes and no: Wilson’s interval; where trials have several seeds their runs count as "
                       "fewer, as far as they are alike.");
    list += definition("left out", "Trials of which not all runs gave a number for the measure.");
    list += definition("worse, better",
                       "By how much the same controller does worse in the reality, or better: paired by trial, too.");
    return cat(heading("What the numbers mean"), element("dl", "", list));
}

}  // namespace

std::string validationReportHtml(const Validation& validation, const ValidationResult& result,
                                 const ResultsTable& results, const ValidationContext& context) {
    std::string made;
    if (!context.commandLine.empty())
        made = cat(heading("Where this comes from"),
                   paragraph(cat("<code>", escaped(context.commandLine), "</code>; trials ",
                                 std::to_string(validation.experiment.firstTrial), " to ",
                                 std::to_string(validation.experiment.firstTrial + validation.experiment.trials - 1),
                                 ", ", counted(validation.experiment.seeds, "seed"), " each.")));
    return reportPage(
        escaped(validation.name),
        cat(validationHead(validation, context), lead(validation, result), validationTiles(validation, result),
            heading("Gains"), tableCard(gainTable(validation, result)), figures(validation, result),
            heading("The four cells"), tableCard(cellTable(result)),
            disagreementSection(validation, result, results, context), accountSection(validation, result, context),
            meanings(validation), made));
}

Expected<void> writeValidationReport(const Validation& validation, const ValidationResult& result,
                                     const ResultsTable& results, const ValidationContext& context,
                                     const std::filesystem::path& folder) {
    return writeReportFiles(folder, {{"report.html", validationReportHtml(validation, result, results, context)},
                                     {"validation.csv", validationCsv(result, validation)},
                                     {"disagreements.csv", disagreementsCsv(result, results)}});
}

}  // namespace mrose

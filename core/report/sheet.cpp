#include "report/sheet.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "drawing/svg_plot.h"
#include "io/format.h"
#include "report/error_figures.h"
#include "report/legend.h"
#include "world/seconds_text.h"

namespace mrose {
namespace {

/// Beyond it a window counts as driven where the network was never learned.
constexpr double muchUnfamiliar = 0.1;
constexpr std::size_t fewWindows = 10;

/// Windows of one kind, as a row of the table.
struct Kind {
    std::string name;
    const Summary* summary = nullptr;
    std::vector<std::size_t> windows;
};

std::vector<Kind> kindsOf(const Evaluation& evaluation) {
    const Assessment& model = evaluation.models.front();
    Kind all{"all", &model.all, {}};
    std::map<std::string, Kind> manoeuvres;
    for (std::size_t i = 0; i < evaluation.log.windows.size(); ++i) {
        all.windows.push_back(i);
        manoeuvres[std::string(name(evaluation.log.windows[i].manoeuvre))].windows.push_back(i);
    }
    std::vector<Kind> kinds{std::move(all)};
    for (const GroupSummary& group : model.groups)
        if (group.kind == "manoeuvre")
            kinds.push_back({group.name, &group.summary, std::move(manoeuvres[group.name].windows)});
    return kinds;
}

const Forecast* forecastOf(const Evaluation& evaluation) {
    return foreseesErrors(evaluation) ? &evaluation.forecasts.front() : nullptr;
}

/// Of these windows, at their ends, in %; NaN of none.
double insideAtEnd(const Forecast& forecast, const std::vector<std::size_t>& windows, double share) {
    const ForecastAt& end = forecast.at.back();
    double inside = 0, all = 0;
    for (std::size_t rank = 0; rank < end.ranks.size(); ++rank) {
        if (!std::binary_search(windows.begin(), windows.end(), end.windows[rank])) continue;
        for (std::size_t e = 0; e < ForecastAt::errors; ++e) inside += end.isInside(rank, e, share);
        all += ForecastAt::errors;
    }
    return 100 * inside / all;
}

/// m: the median of what the 90 % of their runs keep to at the windows' ends.
double foreseenAtEnd(const Forecast& forecast, const std::vector<std::size_t>& windows) {
    std::vector<double> errors;
    for (const std::size_t i : windows)
        if (!forecast.regions[i].empty()) errors.push_back(forecast.regions[i].back().of(RegionShare::most).error);
    return quantile(errors, 0.5);
}

double meanUnfamiliar(const ReportContext& context, const std::vector<std::size_t>& windows) {
    double sum = 0;
    for (const std::size_t i : windows) sum += context.unfamiliar[i];
    return 100 * sum / static_cast<double>(windows.size());
}

/// Why the windows of a kind are not to be relied on; empty: they are.
std::string doubtOf(const Evaluation& evaluation, const ReportContext& context, const Kind& kind) {
    std::string text;
    const auto add = [&](const std::string& reason) { text += (text.empty() ? "" : "; ") + reason; };
    if (kind.windows.size() < fewWindows) return "too few windows to say";
    if (!context.unfamiliar.empty() && meanUnfamiliar(context, kind.windows) > 100 * muchUnfamiliar)
        add("driven as it was never learned");
    if (const Forecast* forecast = forecastOf(evaluation);
        forecast != nullptr && insideAtEnd(*forecast, kind.windows, 0.9) < 75)
        add("surer than it should be");
    if (kind.summary->p > 1.5 * evaluation.models.front().all.p) add("errors half as large again as elsewhere");
    return text;
}

std::string kindTable(const Evaluation& evaluation, const ReportContext& context) {
    const Forecast* const forecast = forecastOf(evaluation);
    HtmlTable table({{"", {"driving", "windows"}},
                     {"how true", {"P %", "Hd %", "end cm", "end °"}},
                     {"how certain", {"90 % within cm", "inside 50 %", "inside 90 %"}},
                     {"where not to trust it", {"unfamiliar %", ""}}},
                    "dense");
    for (const Kind& kind : kindsOf(evaluation)) {
        const Summary& s = *kind.summary;
        std::vector<std::string> cells{
            kind.name,      std::to_string(kind.windows.size()),    fixed(s.p, 2),
            fixed(s.hd, 2), fixed(100 * s.positionFinal.median, 1), fixed(degrees * s.headingFinal.median, 1)};
        if (forecast != nullptr) {
            cells.push_back(fixed(100 * foreseenAtEnd(*forecast, kind.windows), 1));
            for (const double share : {0.5, 0.9})
                cells.push_back(knownText(insideAtEnd(*forecast, kind.windows, share), 0));
        } else {
            cells.insert(cells.end(), 3, "–");
        }
        cells.push_back(context.unfamiliar.empty() ? "–" : fixed(meanUnfamiliar(context, kind.windows), 1));
        const std::string doubt = doubtOf(evaluation, context, kind);
        cells.push_back(doubt.empty() ? "" : cat("<span class=\"warn\">", escaped(doubt), "</span>"));
        table.row(cells);
    }
    return table.text();
}

/// Each window by how fast it was driven and turned.
std::string drivenFigure(const LogWindows& log, const ReportContext& context) {
    std::vector<Point> places;
    Point most{0.1, 0.1};
    for (const Window& window : log.windows) {
        const double time = window.steps() * toSeconds(log.options.step);
        places.push_back({window.path / time, degrees * window.rotation / time});
        most = {std::max(most.x, places.back().x), std::max(most.y, places.back().y)};
    }
    SvgPlot plot({}, {0, 1.06 * most.x}, {0, 1.06 * most.y}, "Windows by mean speed and mean turn rate");
    plot.axes("mean speed (m/s)", "mean turn rate (°/s)");
    for (const bool doubted : {false, true})
        for (std::size_t i = 0; i < places.size(); ++i)
            if (doubted == (!context.unfamiliar.empty() && context.unfamiliar[i] > muchUnfamiliar))
                plot.circle(places[i], doubted ? 4.5 : 3, doubted ? "leaves" : "sample");
    return plot.text();
}

std::string verdict(const Evaluation& evaluation, const ReportContext& context) {
    const Summary& all = evaluation.models.front().all;
    std::vector<std::size_t> every(evaluation.log.windows.size());
    for (std::size_t i = 0; i < every.size(); ++i) every[i] = i;
    const Nanoseconds length = evaluation.log.options.step * evaluation.log.windows.front().steps();
    std::string text =
        cat("After ", secondsText(length, 0), "\u00a0s the simulated robot is typically ",
            fixed(100 * all.positionFinal.median, 1), "\u00a0cm and ", fixed(degrees * all.headingFinal.median, 1),
            "° from the ", evaluation.log.real(), " one (P ", percentText(all.p), ", Hd ", percentText(all.hd), "). ");
    if (const Forecast* forecast = forecastOf(evaluation))
        text += cat("It says how far they may differ: its central 50 and 90\u00a0% then hold ",
                    fixed(insideAtEnd(*forecast, every, 0.5), 0), " and ", fixed(insideAtEnd(*forecast, every, 0.9), 0),
                    "\u00a0%. ");
    else
        text += "It does not know how far they may differ. ";
    if (context.unfamiliar.empty()) return text + "It does not know where it was learned.";
    const auto doubted = std::count_if(context.unfamiliar.begin(), context.unfamiliar.end(),
                                       [](double share) { return share > muchUnfamiliar; });
    const std::string share = cat(fixed(100 * muchUnfamiliar, 0), "\u00a0%");
    if (doubted == 0) return text + cat("No window has more than ", share, " that is driven as it was never learned.");
    return text + cat(counted(static_cast<std::size_t>(doubted), "window"), " of ", std::to_string(every.size()),
                      doubted == 1 ? " has" : " have", " more than ", share,
                      " that is driven as it was never learned.");
}

}  // namespace

std::string sheetHtml(const Evaluation& evaluation, const ReportContext& context) {
    std::vector<std::string> notices = context.notices;
    if (evaluation.log.synthetic)
        notices.insert(notices.begin(), "The log comes from a simulated robot: this says nothing of a real one.");
    const std::string title = cat(escaped(evaluation.models.front().name), " on ", escaped(evaluation.log.source),
                                  evaluation.log.synthetic ? " (synthetic)" : "");
    const std::string subtitle =
        cat(counted(evaluation.log.windows.size(), "window"), " · open loop from measured starts");
    return reportPage(
        title,
        element("div", "sheet",
                cat(pageHead(title, subtitle, {evaluation.log.source, evaluation.log.synthetic}, context, notices),
                    element("p", "lead", verdict(evaluation, context)), tableCard(kindTable(evaluation, context)),
                    element("div", "paths",
                            cat(card("Position error", errorOverTimeFigure(evaluation, ErrorChannel::position)),
                                card("Heading error", errorOverTimeFigure(evaluation, ErrorChannel::heading)),
                                card("What was driven", drivenFigure(evaluation.log, context)))),
                    errorOverTimeLegend(evaluation),
                    context.unfamiliar.empty()
                        ? ""
                        : legend(cat(dotEntry("sample", "a window"),
                                     dotEntry("leaves", cat("more than ", fixed(100 * muchUnfamiliar, 0),
                                                            " % of it driven as the network was never learned")))),
                    context.advice ? adviceCard(*context.advice) : "")));
}

}  // namespace mrose

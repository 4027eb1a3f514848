#include "report/comparison_report.h"

#include <algorithm>
#include <cmath>

#include "io/format.h"
#include "report/comparison_files.h"
#include "report/divergence_section.h"
#include "report/error_figures.h"
#include "report/path_figures.h"
#include "report/stream_section.h"
#include "world/seconds_text.h"

namespace mrose {
namespace {

constexpr const char* comparisonFiles[] = {"errors.csv", "rollouts.csv", "results.json", "report.html", "readings.csv"};
constexpr std::size_t listedRollouts = 12, shownRobots = 8;

std::string startText(const Comparison& comparison, const ComparedRollout& rollout) {
    const RolloutRequest& request = comparison.requests[rollout.request];
    const std::string& session = comparison.sessions[request.session];
    return secondsText(request.start) + " s" + (session.empty() ? "" : " of " + session);
}

std::string header(const Comparison& comparison, const ReportContext& context) {
    const auto [least, most] = std::ranges::minmax_element(comparison.requests, {}, &RolloutRequest::steps);
    const Nanoseconds step = comparison.log.options.step;
    return pageHead(
        cat(escaped(comparison.scenario), " beside the log"),
        cat(counted(comparison.requests.size(), "rollout"), " of ", lengthText(least->steps * step, most->steps * step),
            ", ", counted(comparison.robots.size(), "robot")),
        {comparison.log.source, comparison.log.synthetic}, context, context.notices);
}

/// cm, over the instants that are known.
std::string meanText(const ComparedRollout& rollout) {
    const double mean = knownMean(rollout);
    return mean < 0 ? "" : fixed(100 * mean, 1);
}

std::string endText(const Distribution& position, const Distribution& heading) {
    return cat("At the end of a typical rollout (median) it is ", fixed(100 * position.median, 1),
               "\u00a0cm off and points ", fixed(degrees * heading.median, 1), "° off.");
}

std::string lead(const Comparison& comparison) {
    const ComparedSummary& all = comparison.all;
    std::string text =
        cat("Each simulated robot starts where the ", comparison.log.real(), " one was and as fast, and gets the ",
            comparison.log.real(), " one's commands at the same instants. ");
    if (all.of(RolloutUse::counted) > 0)
        text += cat("Its position is then ", offText(all.counted),
                    endText(all.counted.positionFinal, all.counted.headingFinal));
    else if (all.positionFinal.count > 0)
        text += endText(all.positionFinal, all.headingFinal);
    return element("p", "lead", text);
}

std::vector<std::string> summaryRow(const std::string& name, const ComparedSummary& s) {
    const auto number = [&](RolloutUse use) { return std::to_string(s.of(use)); };
    return {name,
            std::to_string(s.rollouts()),
            number(RolloutUse::counted),
            number(RolloutUse::still),
            number(RolloutUse::gap),
            number(RolloutUse::absent),
            fixed(s.counted.p, 2),
            fixed(s.counted.hd, 2),
            fixed(100 * s.positionFinal.median, 1),
            p90Text(s.positionFinal, 100, 1),
            fixed(degrees * s.headingFinal.median, 1),
            p90Text(s.headingFinal, degrees, 1),
            std::to_string(s.touches),
            std::to_string(s.touched)};
}

std::string robotTable(const Comparison& comparison) {
    HtmlTable table({{"", {""}},
                     {"rollouts", {"all", "counted", "still", "gap", "absent"}},
                     {"of the counted", {"P %", "Hd %"}},
                     {"of all, cm at the end", {"median", "p90"}},
                     {"of all, ° at the end", {"median", "p90"}},
                     {"touches", {"begun", "rollouts"}}},
                    "dense");
    for (std::size_t i = 0; i < comparison.robots.size(); ++i)
        table.row(summaryRow(escaped(comparison.robots[i].name), comparison.summaries[i]));
    if (comparison.robots.size() > 1) table.row(summaryRow("all", comparison.all));
    return table.text();
}

/// Why a rollout does not count for P and Hd; nothing where it does.
std::string whyNot(RolloutUse use) {
    switch (use) {
        case RolloutUse::still:
            return "not in P and Hd: it hardly moves";
        case RolloutUse::gap:
            return "not in P and Hd: gap in the ground truth";
        case RolloutUse::absent:
            return "not in the world: no ground truth at the start";
        case RolloutUse::counted:
            break;
    }
    return {};
}

std::string worstTable(const Comparison& comparison, const std::vector<std::size_t>& worst) {
    HtmlTable table({{"", {"rank", "robot", "rollout", "from", "path m"}},
                     {"error over time", {"mean cm ▼", "% of path"}},
                     {"error at the end", {"cm", "°"}},
                     {"", {"touches", ""}}},
                    "dense");
    for (std::size_t i = 0; i < std::min(worst.size(), listedRollouts); ++i) {
        const ComparedRollout& rollout = comparison.rollouts[worst[i]];
        const WindowErrors& errors = rollout.errors;
        const bool whole = rollout.use == RolloutUse::counted;
        table.row({std::to_string(i + 1), escaped(comparison.robots[rollout.robot].name),
                   std::to_string(rollout.request + 1), escaped(startText(comparison, rollout)),
                   knownText(rollout.real.path, 2), cat("<b>", meanText(rollout), "</b>"),
                   whole ? fixed(100 * errors.positionMean / rollout.real.path, 1) : "",
                   knownText(100 * errors.positionFinal, 1), knownText(degrees * errors.headingFinal, 1),
                   std::to_string(rollout.touches), element("span", "soft", whyNot(rollout.use))});
    }
    return table.text();
}

/// All robots of one rollout: how far off, and who is not in the picture and why.
std::string rolloutTable(const Comparison& comparison, std::size_t request) {
    HtmlTable table({{"", {"", "path m", "mean cm", "end cm", "end °"}}}, "dense");
    std::string absent;
    for (const ComparedRollout& rollout : comparison.rollouts) {
        if (rollout.request != request) continue;
        const std::string name = escaped(comparison.robots[rollout.robot].name);
        const WindowErrors& errors = rollout.errors;
        if (rollout.simulated.empty())
            absent += element(
                "p", "soft", cat("<b>", name, "</b> is not in this rollout: the log has no ground truth of it there."));
        else
            table.row({name, knownText(rollout.real.path, 2), meanText(rollout),
                       knownText(100 * errors.positionFinal, 1), knownText(degrees * errors.headingFinal, 1)});
    }
    return element(
        "div", "",
        cat(element("h3", "", cat("Simulated position and heading, off the ", comparison.log.real(), " ones by")),
            table.text(), absent));
}

/// Rollouts whose pictures show most: all robots of a single one; the worst, the 90th percentile and the median of
/// many.
std::vector<std::size_t> shownRollouts(const Comparison& comparison, const std::vector<std::size_t>& worst) {
    if (worst.size() <= shownRobots) return worst;
    std::vector<std::size_t> shown;
    for (const double q : {0.0, 0.02, 0.1, 0.25, 0.5, 0.75}) {
        const std::size_t rollout = worst[static_cast<std::size_t>(q * static_cast<double>(worst.size()))];
        if (std::find(shown.begin(), shown.end(), rollout) == shown.end()) shown.push_back(rollout);
    }
    std::sort(shown.begin(), shown.end(), [&](std::size_t a, std::size_t b) {
        return knownMean(comparison.rollouts[a]) > knownMean(comparison.rollouts[b]);
    });
    return shown;
}

std::string robotCard(const Comparison& comparison, std::size_t index, const ComparedDivergences* divergences) {
    const ComparedRollout& rollout = comparison.rollouts[index];
    const WindowErrors& errors = rollout.errors;
    std::string what = cat("rollout\u00a0", std::to_string(rollout.request + 1), " · from\u00a0",
                           escaped(startText(comparison, rollout)));
    if (std::isfinite(rollout.real.path)) what += cat(" · path\u00a0", fixed(rollout.real.path, 2), "\u00a0m");
    what += cat("<br/>mean ", meanText(rollout), "\u00a0cm");
    if (std::isfinite(errors.positionFinal))
        what += cat(" · at the end ", fixed(100 * errors.positionFinal, 1), "\u00a0cm, ",
                    fixed(degrees * errors.headingFinal, 1), "°");
    if (rollout.use == RolloutUse::gap) what += " · gap in the ground truth";
    if (const auto* const left = divergences == nullptr ? nullptr : divergences->of(index))
        what += cat(" · leaves the ", comparison.log.real(), " trajectory after ", secondsText(left->divergence.time),
                    "\u00a0s");
    if (rollout.touched) what += cat(" · touched after ", secondsText(*rollout.touched), "\u00a0s");
    return card(escaped(comparison.robots[rollout.robot].name),
                cat(element("p", "soft", what), pathFigure(comparison, index, divergences)));
}

std::string pictures(const Comparison& comparison, const Environment& environment,
                     const ComparedDivergences* divergences) {
    const std::vector<std::size_t> worst = worstFirst(comparison);
    const std::vector<std::size_t> shown = shownRollouts(comparison, worst);
    std::string cards;
    for (const std::size_t i : shown) cards += robotCard(comparison, i, divergences);
    const std::size_t request = comparison.rollouts[worst.front()].request;
    std::string text =
        cat(heading("Where they drove"),
            paragraph(comparison.requests.size() == 1 ? "All robots from start to end."
                                                      : "All robots in the rollout with the largest mean error."),
            element("div", "card",
                    element("div", "scene",
                            cat(rolloutFigure(comparison, request, environment, divergences),
                                rolloutTable(comparison, request)))),
            heading(cat(capitalised(comparison.log.real()), " beside simulated paths")),
            paragraph(cat("Both axes have the same scale; the bar below each picture, which is also the grid’s "
                          "spacing, says which. ",
                          shown.size() == worst.size()
                              ? ""
                              : "From the worst rollout down to a good one, by the mean position error.")),
            pathLegend(comparison, divergences), element("div", "paths", cards));
    if (worst.size() > shown.size())
        text += cat(heading("The worst rollouts"),
                    paragraph(cat("The ", std::to_string(std::min(worst.size(), listedRollouts)), " of ",
                                  std::to_string(worst.size()),
                                  " drives with the largest mean position error, the largest first. "
                                  "<code>--start</code> and <code>--duration</code> show one alone; rollouts.csv has "
                                  "them all.")),
                    tableCard(worstTable(comparison, worst)));
    return text;
}

std::string definitions(const Comparison& comparison) {
    const WindowOptions& options = comparison.log.options;
    std::string list;
    list += definition(
        "rollout", cat("A drive in a world of its own. It begins with pose and velocity of the ", comparison.log.real(),
                       " robots, measured from "
                       "the ground truth up to the start, and with the commands before it; nothing is aligned later."));
    list +=
        definition("counted", cat("Ground truth throughout, and at least ", fixed(options.leastPath, 2), " m or ",
                                  fixed(options.leastRotation, 2),
                                  " rad in 10 s (in proportion to the length): a window as mrose evaluate has them. "
                                  "P and Hd are of these alone."));
    list += definition("still", "The robot hardly moves: its errors are too little to be divided by its path.");
    list += definition("gap", "The ground truth has a gap of 0.2 s or more; the errors at other instants are known.");
    list += definition("absent", "No ground truth at the start: the robot is not in the world in this rollout.");
    list += errorDefinitions(options, "rollouts");
    list += definition("touches",
                       "How often a robot began to touch another body or a wall in the simulation, and in how many "
                       "rollouts that took it off its way. From then on its motion is no longer its model’s alone.");
    return element("dl", "", list);
}

std::string provenance(const Comparison& comparison, const ReportContext& context) {
    HtmlTable facts({{"", {"", ""}}}, "words");
    facts.row({"scenario", escaped(comparison.scenario)});
    facts.row({"log", cat(escaped(comparison.log.source), " (", escaped(comparison.log.format), ")")});
    facts.row({"seed", std::to_string(comparison.seed)});
    addModelFacts(facts, context);
    facts.row({"made by", cat("<code>", escaped(context.commandLine), "</code>")});
    std::string text = cat(heading("Where this comes from"), tableCard(facts.text()));
    if (!comparison.counted.empty())
        text += cat(heading("What was wrong with the log"), tableCard(defectTable(comparison.log)));
    return text + foldedFiles(comparison.log.files);
}

}  // namespace

std::vector<std::string> remarksOn(const Comparison& comparison) {
    std::vector<std::string> remarks;
    for (std::size_t i = 0; i < comparison.robots.size(); ++i) {
        const ComparedSummary& s = comparison.summaries[i];
        std::string text;
        const auto add = [&](RolloutUse use, const std::string& what) {
            if (s.of(use) > 0) text += (text.empty() ? "" : ", ") + std::to_string(s.of(use)) + ' ' + what;
        };
        add(RolloutUse::gap, "with a gap in the ground truth");
        add(RolloutUse::absent, "without ground truth at the start");
        add(RolloutUse::still, "in which it hardly moves");
        if (!text.empty())
            remarks.push_back(comparison.robots[i].name + ": " +
                              std::to_string(s.rollouts() - s.of(RolloutUse::counted)) + " of " +
                              counted(s.rollouts(), "rollout") + " left out of P and Hd: " + text + '.');
    }
    if (comparison.all.of(RolloutUse::counted) == 0)
        remarks.push_back("No rollout counts for P and Hd; expected another --start, or --every for shorter ones.");
    if (comparison.all.touched > 0)
        remarks.push_back(
            "In " + counted(comparison.all.touched, "rollout") +
            " contact took a robot off its way: from there on it is the collision that is compared, too.");
    if (comparison.faults > 0)
        remarks.push_back(counted(static_cast<std::size_t>(comparison.faults), "fault") + ", the first of " +
                          comparison.firstFault + '.');
    return remarks;
}

std::string comparisonHtml(const Comparison& comparison, const Scene& scene, const ReportContext& context,
                           const ComparedDivergences* divergences) {
    std::string remarks;
    for (const std::string& remark : remarksOn(comparison)) remarks += element("li", "", escaped(remark));
    const std::string body =
        cat(header(comparison, context), lead(comparison),
            comparison.counted.empty()
                ? ""
                : cat(tiles(comparison.all.counted),
                      element("p", "soft", "All figures up to here are of the counted rollouts alone.")),
            heading("By robot"), tableCard(robotTable(comparison)),
            remarks.empty() ? "" : element("ul", "soft", remarks), heading("Error against time"),
            paragraph("One line for each robot: the median of its rollouts at that time, where ground truth is known."),
            robotLegend(comparison, divergences),
            figurePair(errorOverTimeFigure(comparison, ErrorChannel::position, divergences),
                       errorOverTimeFigure(comparison, ErrorChannel::heading, divergences)),
            divergences == nullptr ? "" : divergenceSection(comparison, *divergences),
            pictures(comparison, scene.environment, divergences), streamSection(comparison),
            heading("What the words mean"), definitions(comparison), provenance(comparison, context));
    return reportPage(cat(escaped(comparison.scenario), " beside ", escaped(comparison.log.source)), body);
}

Expected<void> checkComparisonFolder(const std::filesystem::path& folder, bool overwrite) {
    return checkReportFolder(folder, comparisonFiles, overwrite);
}

Expected<void> writeComparison(const Comparison& comparison, const Scene& scene, const ReportContext& context,
                               const std::filesystem::path& folder, const ComparedDivergences* divergences) {
    std::vector<NamedFile> files{{comparisonFiles[0], errorsCsv(comparison)},
                                 {comparisonFiles[1], rolloutsCsv(comparison, divergences)},
                                 {comparisonFiles[2], comparisonJson(comparison, context.notices, divergences)},
                                 {comparisonFiles[3], comparisonHtml(comparison, scene, context, divergences)}};
    if (!comparison.sensors.empty()) files.push_back({comparisonFiles[4], readingsCsv(comparison)});
    return writeReportFiles(folder, std::move(files));
}

}  // namespace mrose

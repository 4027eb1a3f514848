#include "report/divergence_section.h"

#include <cctype>

#include "diagnosis/divergence_text.h"
#include "io/format.h"
#include "report/page.h"
#include "world/seconds_text.h"

namespace mrose {
namespace {

/// As markup, with numbers and units on one line.
std::string unbroken(const std::string& text) {
    std::string kept;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const bool afterDigit = i > 0 && std::isdigit(static_cast<unsigned char>(text[i - 1])) != 0;
        const bool unit = i + 1 < text.size() && std::isdigit(static_cast<unsigned char>(text[i + 1])) == 0;
        kept += text[i] == ' ' && afterDigit && unit ? "\u00a0" : std::string(1, text[i]);
    }
    return escaped(kept);
}

std::string rolloutText(const Comparison& comparison, const ComparedRollout& rollout) {
    const RolloutRequest& request = comparison.requests[rollout.request];
    const std::string& session = comparison.sessions[request.session];
    return cat("rollout\u00a0", std::to_string(rollout.request + 1), " · from\u00a0", secondsText(request.start),
               "\u00a0s", session.empty() ? "" : cat(" of ", escaped(session)));
}

std::string summaryTable(const Comparison& comparison, const ComparedDivergences& divergences) {
    HtmlTable table({{"", {"", "rollouts", "leave it", "median s"}}}, "dense");
    const auto add = [&](const std::string& name, const ComparedDivergences::Summary& s) {
        table.row({name, std::to_string(s.rollouts), std::to_string(s.diverging),
                   s.diverging == 0 ? "" : fixed(s.medianTime, 1)});
    };
    for (std::size_t i = 0; i < comparison.robots.size(); ++i)
        add(escaped(comparison.robots[i].name), divergences.robots[i]);
    if (comparison.robots.size() > 1) add("all", divergences.all);
    return table.text();
}

std::string trialTable(const Diagnosis& diagnosis) {
    HtmlTable table({{"", {"changed alone", "explains"}}}, "small");
    const std::span<const CauseTrial> useful = usefulTrials(diagnosis);
    for (std::size_t i = 0; i < useful.size(); ++i) {
        const bool likely = diagnosis.likely == i;
        const auto shown = [&](const std::string& text) { return likely ? cat("<b>", text, "</b>") : text; };
        table.row({shown(unbroken(useful[i].what)), shown(unbroken(explainedText(useful[i])))});
    }
    const std::string useless = uselessText(diagnosis);
    return cat(useful.empty() ? "" : table.text(),
               useless.empty() ? "" : element("p", "soft", cat("Explains nothing: ", unbroken(useless), ".")));
}

std::string diagnosisCard(const Comparison& comparison, const RolloutDivergence& diverging) {
    const ComparedRollout& rollout = comparison.rollouts[diverging.rollout];
    std::string text;
    if (comparison.requests.size() > 1) text += element("p", "soft", rolloutText(comparison, rollout));
    text += element("p", "", cat("It ", unbroken(divergenceText(diverging.divergence, comparison.log.real())), "."));
    if (diverging.diagnosis && diverging.diagnosis->onset)
        text += element("p", "soft", cat(unbroken(onsetText(*diverging.diagnosis, comparison.log.real())), "."));
    if (diverging.diagnosis)
        text += cat(element("p", "", cat("Likely cause: ", unbroken(causeText(*diverging.diagnosis)), ".")),
                    trialTable(*diverging.diagnosis));
    return card(escaped(comparison.robots[rollout.robot].name), text);
}

}  // namespace

std::string divergenceSection(const Comparison& comparison, const ComparedDivergences& divergences) {
    std::string text = cat(heading(cat("Where they leave the ", comparison.log.real(), " trajectory")),
                           paragraph(escaped(boundText(divergences, comparison.log.real()))));
    if (divergences.rollouts.empty()) return text + paragraph("None of them does.");
    const bool many = comparison.requests.size() > 1;
    if (many) text += tableCard(summaryTable(comparison, divergences));
    if (const std::string counts = causeCounts(divergences); many && !counts.empty())
        text += paragraph(cat("Likely causes: ", unbroken(counts), "."));
    std::string cards;
    for (const std::size_t i : worstOf(comparison, divergences, shownDivergences))
        if (divergences.rollouts[i].diagnosis || !many) cards += diagnosisCard(comparison, divergences.rollouts[i]);
    if (cards.empty()) return text;
    text += paragraph(cat(many ? "The rollouts with the largest mean errors among them. " : "",
                          "Each was run again up to shortly after it left the ", comparison.log.real(),
                          " trajectory, with one thing changed at a "
                          "time; a change explains the part of the error (its root mean square, position and heading "
                          "in units of their bounds) that is gone with it."));
    return text + element("div", "paths", cards);
}

}  // namespace mrose

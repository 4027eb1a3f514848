#include "diagnosis/divergence_text.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "io/format.h"
#include "world/seconds_text.h"

namespace mrose {
namespace {

constexpr double leastUse = 0.005;  // what is shown as 1 %
constexpr std::size_t mostShown = 8;
constexpr double worthSaying = 0.25;  // bounds

std::string centimetres(double metres) { return fixed(100 * metres, 1) + " cm"; }
std::string inDegrees(double radians) { return fixed(degrees * radians, 1) + "°"; }

}  // namespace

std::string divergenceText(const Divergence& divergence, const std::string& real) {
    std::string text = "leaves the " + real + " trajectory after " + secondsText(divergence.time) +
                       " s: " + centimetres(divergence.position) + " and " + inDegrees(divergence.heading) +
                       " off, beyond ";
    if (divergence.byPosition) text += centimetres(divergence.bound.position);
    if (divergence.byPosition && divergence.byHeading) text += " and ";
    if (divergence.byHeading) text += inDegrees(divergence.bound.heading);
    if (divergence.unknownBefore)
        text += "; its ground truth is not known since " + secondsText(divergence.within) + " s";
    return text;
}

std::string onsetText(const Diagnosis& diagnosis, const std::string& real) {
    if (!diagnosis.onset) return {};
    const ErrorOnset& onset = *diagnosis.onset;
    std::vector<std::string> parts;
    const auto add = [&](double error, double bound, const std::string& text) {
        if (std::abs(error) >= worthSaying * bound) parts.push_back(text);
    };
    const auto more = [](double error) { return error > 0 ? " more" : " less"; };
    const auto side = [](double error) { return error > 0 ? " left" : " right"; };
    add(onset.ahead, onset.bound.position, "went " + centimetres(std::abs(onset.ahead)) + more(onset.ahead));
    add(onset.left, onset.bound.position,
        "moved " + centimetres(std::abs(onset.left)) + " more to the" + side(onset.left));
    add(onset.turn, onset.bound.heading,
        "turned " + inDegrees(std::abs(onset.turn)) + " more to the" + side(onset.turn));
    if (parts.empty()) return {};
    std::string text = fixed(100 * onset.explained, 0) + " % of the error at leaving arose from " +
                       secondsText(onset.from) + " to " + secondsText(onset.to) + " s, when the " + real + " robot ";
    for (std::size_t i = 0; i < parts.size(); ++i)
        text += (i == 0 ? "" : i + 1 == parts.size() ? " and " : ", ") + parts[i];
    return text + " than the simulated one";
}

std::string causeCounts(const ComparedDivergences& divergences) {
    std::map<CauseKind, std::size_t> likely;
    std::size_t none = 0;
    for (const RolloutDivergence& diverging : divergences.rollouts) {
        if (!diverging.diagnosis) continue;
        if (const auto& found = diverging.diagnosis->likely)
            ++likely[diverging.diagnosis->trials[*found].kind];
        else
            ++none;
    }
    std::vector<std::pair<std::string, std::size_t>> counts;
    for (const auto& [kind, count] : likely) counts.emplace_back(name(kind), count);
    std::stable_sort(counts.begin(), counts.end(), [](const auto& a, const auto& b) { return a.second > b.second; });
    if (none > 0) counts.emplace_back("none of these", none);
    std::string text;
    for (const auto& [what, count] : counts) text += (text.empty() ? "" : ", ") + what + " " + std::to_string(count);
    return text;
}

std::string explainedText(const CauseTrial& trial) { return fixed(100 * trial.explained, 0) + " %"; }

std::span<const CauseTrial> usefulTrials(const Diagnosis& diagnosis) {
    const auto end = std::find_if(diagnosis.trials.begin(), diagnosis.trials.end(),
                                  [](const CauseTrial& trial) { return trial.explained < leastUse; });
    const auto useful = static_cast<std::size_t>(end - diagnosis.trials.begin());
    return std::span(diagnosis.trials).first(std::min(useful, mostShown));
}

std::string uselessText(const Diagnosis& diagnosis) {
    std::string text;
    for (const CauseTrial& trial : diagnosis.trials)
        if (trial.explained < leastUse) text += (text.empty() ? "" : "; ") + trial.what;
    return text;
}

std::string causeText(const Diagnosis& diagnosis) {
    if (diagnosis.trials.empty()) return "none of these";
    const CauseTrial& trial = diagnosis.trials[diagnosis.likely.value_or(0)];
    const std::string explains = explainedText(trial) + " of the error";
    return diagnosis.likely ? trial.what + ", which explains " + explains
                            : "none of these; the best, " + trial.what + ", explains " + explains;
}

std::string boundText(const ComparedDivergences& divergences, const std::string& real) {
    const std::string leaves = "A robot leaves the " + real + " trajectory where it is off by more than ";
    const std::string held = " for " + secondsText(divergences.bound.held) + " s.";
    if (divergences.source == BoundSource::noise)
        return leaves + "99 of 100 runs of such a robot stray from their mean, by the noise of its network," + held +
               (divergences.ofAll ? "" : " Robots whose networks do not know it are judged by less.");
    if (divergences.source == BoundSource::heldOut)
        return leaves + "three times what its network's held-out errors make of the path and rotation so far," + held;
    return leaves + centimetres(divergences.bound.constant.position) + " or " +
           inDegrees(divergences.bound.constant.heading) + held;
}

}  // namespace mrose

#include "comparison/divergence_text.h"

#include <algorithm>

#include "evaluation/format.h"

namespace mrose {
namespace {

constexpr double leastUse = 0.005;  // what is shown as 1 %

std::string centimetres(double metres) { return fixed(100 * metres, 1) + " cm"; }
std::string inDegrees(double radians) { return fixed(degrees * radians, 1) + "°"; }

}  // namespace

std::string divergenceText(const Divergence& divergence) {
    std::string text = "leaves the real course after " + secondsText(divergence.time) +
                       " s: " + centimetres(divergence.position) + " and " + inDegrees(divergence.heading) +
                       " off, beyond ";
    if (divergence.byPosition) text += centimetres(divergence.bound.position);
    if (divergence.byPosition && divergence.byHeading) text += " and ";
    if (divergence.byHeading) text += inDegrees(divergence.bound.heading);
    return text;
}

std::string explainedText(const CauseTrial& trial) { return fixed(100 * trial.explained, 0) + " %"; }

std::span<const CauseTrial> usefulTrials(const Diagnosis& diagnosis) {
    const auto end = std::find_if(diagnosis.trials.begin(), diagnosis.trials.end(),
                                  [](const CauseTrial& trial) { return trial.explained < leastUse; });
    return {diagnosis.trials.begin(), end};
}

std::string uselessText(const Diagnosis& diagnosis) {
    std::string text;
    for (std::size_t i = usefulTrials(diagnosis).size(); i < diagnosis.trials.size(); ++i)
        text += (text.empty() ? "" : "; ") + diagnosis.trials[i].what;
    return text;
}

std::string causeText(const Diagnosis& diagnosis) {
    if (diagnosis.trials.empty()) return "none of these";
    const CauseTrial& trial = diagnosis.trials[diagnosis.likely.value_or(0)];
    const std::string explains = explainedText(trial) + " of the error";
    return diagnosis.likely ? trial.what + ", which explains " + explains
                            : "none of these; the best, " + trial.what + ", explains " + explains;
}

std::string boundText(const ComparedDivergences& divergences) {
    const std::string held = " for " + secondsText(divergences.bound.held) + " s.";
    if (divergences.fromHeldOut)
        return "A robot leaves the real course where it is off by more than three times what its network's held-out "
               "error is "
               "for the path and rotation so far," +
               held;
    return "A robot leaves the real course where it is off by more than " +
           centimetres(divergences.bound.constant.position) + " or " + inDegrees(divergences.bound.constant.heading) +
           held;
}

}  // namespace mrose

#include "compare_divergence.h"

#include <cmath>
#include <cstdio>

#include "diagnosis/divergence_text.h"
#include "io/format.h"
#include "world/seconds_text.h"

namespace mrose::cli {
namespace {

/// "create 1 in rollout 3, from 20.0 s": whose and which.
std::string whichOf(const Comparison& comparison, const RolloutDivergence& diverging) {
    const ComparedRollout& rollout = comparison.rollouts[diverging.rollout];
    const std::string& robot = comparison.robots[rollout.robot].name;
    if (comparison.requests.size() == 1) return robot;
    const RolloutRequest& request = comparison.requests[rollout.request];
    const std::string& session = comparison.sessions[request.session];
    return robot + ", rollout " + std::to_string(rollout.request + 1) + " (from " + secondsText(request.start) + " s" +
           (session.empty() ? "" : " of " + session) + ")";
}

void printCause(const Diagnosis& diagnosis, const std::string& real) {
    if (const std::string onset = onsetText(diagnosis, real); !onset.empty()) std::printf("  %s\n", onset.c_str());
    std::printf("  likely cause: %s\n", causeText(diagnosis).c_str());
    TextTable table({"    tried", "explains"});
    for (const CauseTrial& trial : usefulTrials(diagnosis)) table.add({"    " + trial.what, explainedText(trial)});
    if (!usefulTrials(diagnosis).empty()) std::fputs(table.text().c_str(), stdout);
    if (const std::string useless = uselessText(diagnosis); !useless.empty())
        std::printf("    explains nothing: %s\n", useless.c_str());
}

void printSummary(const Comparison& comparison, const ComparedDivergences& divergences) {
    TextTable table({"", "rollouts", "diverge", "median s"});
    const auto add = [&](const std::string& name, const ComparedDivergences::Summary& s) {
        table.add({name, std::to_string(s.rollouts), std::to_string(s.diverging), fixed(s.medianTime, 1)});
    };
    for (std::size_t i = 0; i < comparison.robots.size(); ++i) add(comparison.robots[i].name, divergences.robots[i]);
    if (comparison.robots.size() > 1) add("all", divergences.all);
    std::fputs(table.text().c_str(), stdout);
}

}  // namespace

void addDivergenceFlags(CLI::App& sub, DivergenceRequest& flags) {
    sub.add_option(
           "--bound-position", flags.position,
           "A robot farther off than this, in m, has left the real trajectory (0.1 beside --bound-heading); without "
           "both, one that is farther off than 99 of 100 runs of such a robot, by the noise of its network; where it "
           "knows none, by three times what its held-out errors make of the path and rotation so far, or by 0.1 m or "
           "10 degrees")
        ->check(numberRange(1e-4, 1e4));
    sub.add_option("--bound-heading", flags.heading,
                   "Likewise a heading farther off than this, in degrees (10 beside --bound-position)")
        ->check(numberRange(0.01, 180.0));
    sub.add_option("--held", flags.held, "For how long it must be farther off, in s")
        ->check(numberRange(0.0, 1e4))
        ->capture_default_str();
    CLI::Option* causes = sub.add_flag("--no-causes", flags.noCauses, "Do not look for the causes");
    sub.add_option("--model", flags.models,
                   "Network file that may explain it, beside those that ship for the robot and plain kinematics")
        ->excludes(causes);
}

void printDivergences(const Comparison& comparison, const ComparedDivergences& divergences) {
    const std::string real = comparison.log.real();
    std::printf("\n%s\n", boundText(divergences, real).c_str());
    if (divergences.rollouts.empty()) {
        const bool within = divergences.source == BoundSource::noise && divergences.ofAll;
        std::printf("No robot leaves the %s trajectory%s.\n", real.c_str(),
                    within ? ": all stay within what such robots differ from themselves" : "");
        return;
    }
    if (comparison.requests.size() > 1) {
        std::puts("");
        printSummary(comparison, divergences);
    }
    const bool many = comparison.requests.size() > 1;
    if (const std::string counts = causeCounts(divergences); many && !counts.empty())
        std::printf("\nLikely causes: %s. The rollouts with the largest mean errors:\n", counts.c_str());
    for (const std::size_t index : worstOf(comparison, divergences, shownDivergences)) {
        const RolloutDivergence& diverging = divergences.rollouts[index];
        if (!diverging.diagnosis && many) continue;
        std::printf("\n%s: %s\n", whichOf(comparison, diverging).c_str(),
                    divergenceText(diverging.divergence, real).c_str());
        if (diverging.diagnosis) printCause(*diverging.diagnosis, real);
    }
}

}  // namespace mrose::cli

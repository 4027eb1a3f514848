// Opens a log of real robots, goes to where the worst of its simulated robots leaves the real one, says why, steps back
// and tries another command there: a debugger of thirty lines, without a window.
#include <cstdio>

#include "debug/debugger.h"
#include "debug/log_rollouts.h"
#include "diagnosis/divergence_text.h"
#include "workflow/open_log.h"
#include "workflow/open_model.h"

using namespace mrose;

int main(int count, char** words) {
    const auto log = count == 2 ? openLogAsRun({words[1]}) : fail("", "expected a log");
    if (!log) return std::fprintf(stderr, "%s\n", log.error().message().c_str()), 1;
    LogRollouts rollouts;
    rollouts.replace(log->world, log->plan, log->requests);
    const auto compared = compareRollouts(*log->world, log->requests, rollouts.divergenceOptions(),
                                          [&](const auto& rows, double) { return rollouts.addRows(rows), true; });
    const RolloutRow* const row = rollouts.worstLeft();
    if (!compared || row == nullptr) return std::puts("no robot leaves the real trajectory"), 0;
    const RolloutRequest& request = log->requests[row->rollout];
    Debugger debugger(*openRollout(*log->world, request, false));
    const LeavingRobots leaving = leavingRobots(rollouts.world(), {row, 1});
    debugger.breakpoints().setDivergence({leavesReality(leaving), whoLeaves(leaving)});
    debugger.breakpoints().add({.text = "divergence"});
    debugger.goToBreak({});
    const auto why = whyItLeaves(*log->world, {request, *row, causeModels(*log->world, {})}, {});
    std::printf("%s\n%s\n", debugger.message().c_str(), why ? causeText(*why).c_str() : why.error().cause.c_str());
    debugger.stepBy(-50);
    const Scene& scene = debugger.run().setup().scene();
    const std::uint32_t body = bodyNamed(scene, rollouts.world().robots()[row->robot].name);
    debugger.branchOff(changeDecision(frameOf(debugger.run()), body, {.command = {0, 0}, .periods = 5}));
    debugger.goTo(debugger.run().tick() + 100, false);
    std::printf("%s\n", debugger.run().branches()[debugger.run().branch()].name.c_str());
}

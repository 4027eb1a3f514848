#include "debug/shown.h"

#include <algorithm>
#include <limits>

namespace mrose {
namespace {

std::vector<BranchInfo> branchInfos(const TimeTravel& run) {
    const BranchTree& branches = run.branches();
    std::vector<BranchInfo> infos;
    const auto count = [&](std::uint32_t branch, std::int64_t until) {
        BranchInfo::Events events;
        for (const TimelineMark& mark : branches.record(branch).marks()) {
            if (mark.tick > until) break;
            events.kicks += mark.kind == TimelineMark::Kind::kick ? 1 : 0;
            events.contacts += mark.kind == TimelineMark::Kind::contact ? 1 : 0;
        }
        return events;
    };
    for (std::uint32_t i = 0; i < branches.size(); ++i) {
        const Branch& branch = branches[i];
        BranchInfo info{branch.name,   branch.parent, branch.tick,      branch.timeline.first(), branch.timeline.last(),
                        run.hidden(i), run.undone(i), branches.parts(i)};
        info.lineage.back().last = std::numeric_limits<std::int64_t>::max();
        std::int64_t until = run.tick();
        for (std::uint32_t at = i;; at = branches[at].parent) {
            const BranchInfo::Events events = count(at, until);
            info.events.kicks += events.kicks;
            info.events.contacts += events.contacts;
            if (branches[at].parent == at) break;
            until = std::min(until, branches[at].tick);
        }
        infos.push_back(std::move(info));
    }
    return infos;
}

}  // namespace

int listedBranches(const std::vector<BranchInfo>& branches, std::size_t first) {
    int count = 0;
    for (std::size_t i = first; i < branches.size(); ++i) count += branches[i].hidden ? 0 : 1;
    return count;
}

std::string branchesText(int count) { return count == 1 ? "1 branch" : std::to_string(count) + " branches"; }

Shown shownOf(const TimeTravel& run, const FrameOptions& options) {
    Shown what;
    what.frame = std::make_shared<const FieldFrame>(frameOf(run, options));
    if (auto beside = besideFrame(run, options)) {
        what.beside = std::make_shared<const FieldFrame>(std::move(*beside));
        what.besideBranch = run.beside();
    }
    what.setup = run.branches().record(run.owner()).setupPointer();
    what.hash = hashOf(run.state());
    what.branch = run.branch();
    what.first = run.first();
    what.last = run.last();
    what.branches = branchInfos(run);
    what.faults = run.branches().faults(run.branch(), run.tick());
    what.canUndo = run.branch() != 0;
    what.undoName = run.origin(run.branch()).edit;
    if (const TimeTravel::Origin* const undone = run.lastUndone()) {
        what.canRedo = true;
        what.redoName = undone->edit;
    }
    return what;
}

}  // namespace mrose

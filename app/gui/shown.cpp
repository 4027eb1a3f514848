#include "shown.h"

#include <algorithm>

namespace mrose::gui {
namespace {

std::vector<BranchInfo> branchInfos(const TimeTravel& run) {
    std::vector<BranchInfo> infos;
    const auto count = [&](std::uint32_t branch, std::int64_t until) {
        BranchInfo::Events events;
        for (const TimelineMark& mark : run.record(branch).marks()) {
            if (mark.tick > until) break;
            events.kicks += mark.kind == TimelineMark::Kind::kick ? 1 : 0;
            events.contacts += mark.kind == TimelineMark::Kind::contact ? 1 : 0;
        }
        return events;
    };
    for (std::uint32_t i = 0; i < run.branches().size(); ++i) {
        const Branch& branch = run.branches()[i];
        BranchInfo info{QString::fromStdString(branch.name), branch.parent, branch.tick, branch.timeline.first(),
                        branch.timeline.last()};
        std::int64_t until = run.tick();
        for (std::uint32_t at = i;; at = run.branches()[at].parent) {
            const BranchInfo::Events events = count(at, until);
            info.events.kicks += events.kicks;
            info.events.contacts += events.contacts;
            if (run.branches()[at].parent == at) break;
            until = std::min(until, run.branches()[at].tick);
        }
        infos.push_back(std::move(info));
    }
    return infos;
}

std::vector<BranchRecord::FirstFault> faultsOf(const TimeTravel& run) {
    std::vector<BranchRecord::FirstFault> faults;
    std::int64_t until = run.tick();
    for (std::uint32_t at = run.branch();; at = run.branches()[at].parent) {
        for (const BranchRecord::FirstFault& fault : run.record(at).faults())
            if (fault.tick <= until) faults.push_back(fault);
        if (run.branches()[at].parent == at ||
            run.record(at).coursePointer() != run.record(run.branches()[at].parent).coursePointer())
            return faults;
        until = std::min(until, run.branches()[at].tick);
    }
}

}  // namespace

Shown shownOf(const TimeTravel& run, const TimeTravel::FrameOptions& options) {
    Shown what;
    what.frame = std::make_shared<const FieldFrame>(run.frame(options));
    if (auto beside = run.besideFrame(options)) {
        what.beside = std::make_shared<const FieldFrame>(std::move(*beside));
        what.besideBranch = run.beside();
    }
    what.course = run.record(run.owner()).coursePointer();
    what.hash = hashOf(run.state());
    what.branch = run.branch();
    what.first = run.first();
    what.last = run.last();
    what.branches = branchInfos(run);
    what.faults = faultsOf(run);
    what.canUndo = run.canUndo();
    what.canRedo = run.canRedo();
    return what;
}

}  // namespace mrose::gui

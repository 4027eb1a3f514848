#include "debug/branch_record.h"

#include <algorithm>

namespace mrose {
namespace {

/// Of which the words are kept.
constexpr std::size_t mostFaults = 100;

}  // namespace

BranchRecord::BranchRecord(BranchSetupPointer setup, const WorldState& start, std::vector<HandOrder> orders)
    : setup_(std::move(setup)),
      playback_(*setup_->scenario),
      track_(start),
      touches_(setup_->scene().tickLength),
      end_{start},
      orders_(std::move(orders)) {}

Overrides BranchRecord::overrides(const WorldState& state) {
    decisions_.clear();
    for (const HandOrder& order : orders_) {
        const RobotState& robot = state.robots[order.robot];
        if (state.tick < order.first || state.tick >= order.end || robot.nextControl != state.tick) continue;
        RobotDecision& ordered = decisions_.emplace_back(RobotDecision{order.robot, {}});
        ordered.decision.command = order.command;
        if (state.tick - order.first < setup_->scene().periodTicks(order.robot)) ordered.decision.kicks = order.kicks;
    }
    return {decisions_};
}

void BranchRecord::add(const WorldState& after, const StepTrace& trace) {
    end_ = {after};
    note(after, trace);
}

Expected<bool> BranchRecord::learn(const Timeline& timeline, std::int64_t ticks) {
    for (; ticks > 0 && last() < timeline.last(); --ticks) {
        if (end_.read == 0 && last() > timeline.first()) {
            auto reached = playback_.reach(timeline, last());
            if (!reached) return tl::unexpected(reached.error());
            end_ = std::move(*reached);
        }
        if (auto advanced = playback_.advance(timeline, end_, trace_); !advanced)
            return tl::unexpected(advanced.error());
        note(end_.state, trace_);
    }
    return last() < timeline.last();
}

void BranchRecord::note(const WorldState& after, const StepTrace& trace) {
    track_.add(after);
    const auto mark = [&](TimelineMark::Kind kind, std::uint32_t body, std::uint32_t other) {
        marks_.push_back({after.tick, kind, body, other});
    };
    for (const TouchCounter::Pair& pair : touches_.add(trace))
        mark(TimelineMark::Kind::contact, pair.first, pair.second);
    for (const PendingKick& kick : trace.orderedKicks)
        orderedKicks_.push_back({after.tick - 1, kick.robot, kick.manipulator, kick.due});
    for (const StepTrace::Kicked& kick : trace.kicks) {
        carriedOutKicks_.push_back({after.tick - 1, kick.robot, kick.manipulator, kick.due});
        mark(TimelineMark::Kind::kick, kick.robot,
             kick.hit ? static_cast<std::uint32_t>(after.robots.size()) + kick.object : noBody);
    }
    for (const std::uint32_t goal : trace.goals) mark(TimelineMark::Kind::goal, 0, goal);
    for (const StepTrace::Fault& fault : trace.faults) {
        mark(TimelineMark::Kind::fault, fault.robot, noBody);
        const bool known = std::any_of(faults_.begin(), faults_.end(), [&](const FirstFault& first) {
            return first.robot == fault.robot && first.what == fault.what;
        });
        if (!known && faults_.size() < mostFaults) faults_.push_back({after.tick, fault.robot, fault.what});
    }
    for (std::uint32_t robot = 0; robot < trace.robots.size(); ++robot) {
        const StepTrace::Robot& traced = trace.robots[robot];
        if (traced.decided && !traced.decision.breakReason.empty()) mark(TimelineMark::Kind::stop, robot, noBody);
    }
}

}  // namespace mrose

#include "recording/tick_decisions.h"

#include "messages/decision_bytes.h"
#include "messages/text_bytes.h"

namespace mrose {
namespace {

/// Each decision of a file takes two bytes and more than a hundred in memory.
constexpr std::uint64_t mostRobots = 1'000'000;

}  // namespace

void appendDecisions(const StepTrace& trace, std::string& bytes) {
    std::uint64_t count = 0;
    for (const StepTrace::Robot& robot : trace.robots) count += robot.decided;
    appendCount(bytes, count);
    std::size_t next = 0;
    for (std::size_t i = 0; i < trace.robots.size(); ++i) {
        const StepTrace::Robot& robot = trace.robots[i];
        if (!robot.decided) continue;
        appendCount(bytes, i - next);
        next = i + 1;
        appendOrders(robot.decision, !robot.observed, bytes);
    }
}

bool DecisionReader::next(DecisionsOf whose) {
    std::size_t kept = 0;
    std::uint64_t robot = 0;
    for (std::uint64_t left = readCount(bytes_); left > 0; --left, ++robot) {
        robot += readCount(bytes_);
        if (robot >= mostRobots) return false;
        if (decisions_.size() == kept) decisions_.emplace_back();
        decisions_[kept].robot = static_cast<std::uint32_t>(robot);
        bool outside = false;
        if (!readOrders(bytes_, decisions_[kept].decision, outside)) return false;
        if (outside || whose == DecisionsOf::all) ++kept;
    }
    decisions_.resize(kept);
    return !bytes_.failed();
}

}  // namespace mrose

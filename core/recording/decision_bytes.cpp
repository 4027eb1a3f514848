#include "recording/decision_bytes.h"

namespace mrose {
namespace {

enum Flag : std::uint8_t {
    hasCommand = 1,
    hasEarlier = 2,
    hasKicks = 4,
    hasFault = 8,
    fromOutside = 16,
    allFlags = 31
};

/// Each decision of a file takes two bytes and more than a hundred in memory.
constexpr std::uint64_t mostRobots = 1'000'000;

/// Seven bits a byte, the lowest first; the eighth says that more follow.
void appendCount(std::string& bytes, std::uint64_t value) {
    for (; value >= 128; value >>= 7) bytes += static_cast<char>(value | 128);
    bytes += static_cast<char>(value);
}

std::uint64_t readCount(ByteReader& reader) {
    std::uint64_t value = 0;
    for (int shift = 0; shift < 63; shift += 7) {
        const auto byte = reader.number<std::uint8_t>();
        value |= std::uint64_t{byte & 127u} << shift;
        if (byte < 128) break;
    }
    return value;
}

void appendCommand(std::string& bytes, const Command& command) {
    appendNumber(bytes, command.v);
    appendNumber(bytes, command.w);
}

Command readCommand(ByteReader& reader) {
    const double v = reader.number<double>();
    return {v, reader.number<double>()};
}

std::uint8_t flagsOf(const StepTrace::Robot& robot) {
    const Decision& d = robot.decision;
    return static_cast<std::uint8_t>((d.command ? hasCommand : 0) | (d.earlier.empty() ? 0 : hasEarlier) |
                                     (d.kicks.empty() ? 0 : hasKicks) | (d.fault.empty() ? 0 : hasFault) |
                                     (robot.observed ? 0 : fromOutside));
}

}  // namespace

void appendDecisions(const StepTrace& trace, std::string& bytes) {
    std::uint64_t count = 0;
    for (const StepTrace::Robot& robot : trace.robots) count += robot.decided;
    appendCount(bytes, count);
    std::size_t next = 0;
    for (std::size_t i = 0; i < trace.robots.size(); ++i) {
        const StepTrace::Robot& robot = trace.robots[i];
        if (!robot.decided) continue;
        const Decision& decision = robot.decision;
        const std::uint8_t flags = flagsOf(robot);
        appendCount(bytes, i - next);
        next = i + 1;
        appendNumber(bytes, flags);
        if (flags & hasCommand) appendCommand(bytes, *decision.command);
        if (flags & hasEarlier) appendCount(bytes, decision.earlier.size());
        for (const StampedCommand& earlier : decision.earlier) {
            appendNumber(bytes, earlier.time);
            appendCommand(bytes, earlier.command);
        }
        if (flags & hasKicks) appendCount(bytes, decision.kicks.size());
        for (const Kick& kick : decision.kicks) {
            appendCount(bytes, kick.manipulator);
            appendNumber(bytes, kick.power);
        }
        if (flags & hasFault) appendCount(bytes, decision.fault.size());
        bytes += decision.fault;
    }
}

bool DecisionReader::readDecision(RobotDecision& read, bool& outside) {
    const auto flags = bytes_.number<std::uint8_t>();
    outside = (flags & fromOutside) != 0;
    Decision& decision = read.decision;
    decision.clear();
    if (flags & hasCommand) decision.command = readCommand(bytes_);
    // A number of elements is believed as far as there are bytes for them.
    for (std::uint64_t left = flags & hasEarlier ? readCount(bytes_) : 0; left > 0 && !bytes_.failed(); --left) {
        const auto time = bytes_.number<Nanoseconds>();
        decision.earlier.push_back({time, readCommand(bytes_)});
    }
    for (std::uint64_t left = flags & hasKicks ? readCount(bytes_) : 0; left > 0 && !bytes_.failed(); --left) {
        const auto manipulator = static_cast<std::uint32_t>(readCount(bytes_));
        decision.kicks.push_back({manipulator, bytes_.number<double>()});
    }
    if (flags & hasFault) decision.fault = bytes_.take(readCount(bytes_));
    return !bytes_.failed() && flags <= allFlags;
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
        if (!readDecision(decisions_[kept], outside)) return false;
        if (outside || whose == DecisionsOf::all) ++kept;
    }
    decisions_.resize(kept);
    return !bytes_.failed();
}

}  // namespace mrose

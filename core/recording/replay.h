#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "io/error.h"
#include "recording/history.h"
#include "scenario/scenario.h"

namespace mrose {

struct ReplayOptions {
    /// False: robots are driven by the recorded decisions, and what the world's hash covers is compared. True: the
    /// controllers decide again, but where a decision came from outside, and what they and the sensors remember is
    /// compared as well.
    bool decide = false;
    /// Called now and then with how many ticks are done of how many; false ends the replay.
    std::function<bool(std::int64_t, std::int64_t)> progress;
};

struct ReplayDifference {
    std::uint32_t branch = 0;
    std::int64_t tick = 0;  ///< the first at which a state differs
    std::string what;       ///< sentences that name robots and fields
};

struct ReplayReport {
    std::int64_t ticks = 0;  ///< compared
    bool cancelled = false;
    std::optional<ReplayDifference> difference;  ///< the first; nullopt: the same to the last bit
};

/// Runs every branch again from its beginning and compares each tick; `scenarios` are those of the branches, one each.
/// Error: a branch is none of its scenario.
Expected<ReplayReport> replay(std::span<const Branch> branches,
                              std::span<const std::shared_ptr<const Scenario>> scenarios,
                              const ReplayOptions& options = {});
/// The same where all are of one scenario.
Expected<ReplayReport> replay(std::span<const Branch> branches, const Scenario& scenario,
                              const ReplayOptions& options = {});

}  // namespace mrose

#pragma once

#include <cstddef>
#include <map>
#include <span>
#include <string>

#include "debug/breakpoints.h"

namespace mrose {

/// How often breakpoints were met in each of the rollouts of a log, as far as those were played or looked through. A
/// rollout that is opened again adds nothing.
class RolloutHits {
public:
    void learn(std::size_t rollout, std::span<const BreakpointState> states);
    /// Of those before a rollout and after it.
    HitsInOtherRuns elsewhere(std::size_t rollout) const;
    /// What was met of this text is another question now.
    void forget(const std::string& text) { hits_.erase(text); }
    void clear() { hits_.clear(); }

private:
    std::map<std::string, std::map<std::size_t, std::int64_t>> hits_;  ///< by text and rollout
};

}  // namespace mrose

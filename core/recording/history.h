#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "recording/timeline.h"
#include "scenario/scenario_value.h"

namespace mrose {

/// The run itself, or what became of another branch from some tick on when something was changed by hand. It begins
/// with the changed state, which may be one of another scenario with other bodies.
struct Branch {
    std::uint32_t parent = 0;  ///< index of the branch that it departs from; of itself for the run
    std::int64_t tick = 0;     ///< of the state that it begins with; its parent may not have such a tick
    std::string name;
    Timeline timeline;
    ScenarioValuePointer value = nullptr;  ///< of its scenario; null: the run's
};

/// What a running simulation keeps in memory, so that any tick of any branch can be reached again (playback.h). Where
/// the memory does not suffice, the earliest ticks are forgotten.
class History {
public:
    struct Options {
        std::size_t mostBytes = std::size_t{256} << 20;  ///< exceeded only by what must be kept: the latest block each
        std::int64_t keyframeInterval = 0;               ///< see Timeline
    };
    explicit History(const WorldState& initial) : History(initial, Options{}) {}
    History(const WorldState& initial, const Options& options);
    /// Goes on with what was recorded (recording.h): the run itself first. The ends of the timelines are where add()
    /// goes on; playback.h reaches the states there.
    explicit History(std::vector<Branch> branches) : History(std::move(branches), Options{}) {}
    History(std::vector<Branch> branches, const Options& options);

    /// A new branch that begins with `state`, at its tick; its index. It runs in its parent's scenario unless another
    /// one is given.
    std::uint32_t beginBranch(std::uint32_t parent, const WorldState& state, std::string name,
                              ScenarioValuePointer value = nullptr);
    void rename(std::uint32_t branch, std::string name) { branches_[branch].name = std::move(name); }
    /// One tick more at the end of a branch.
    void add(const WorldState& after, const StepTrace& trace, std::uint32_t branch = 0);

    const std::vector<Branch>& branches() const { return branches_; }
    std::size_t size() const;  ///< bytes of memory, roughly

private:
    void forgetWhatIsTooMuch();

    Options options_;
    std::vector<Branch> branches_;
};

}  // namespace mrose

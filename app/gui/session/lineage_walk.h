#pragma once

#include <functional>
#include <optional>
#include <span>

#include "session/session.h"

namespace mrose::gui {

/// Goes along the lineage of a branch, in some thread. What is known of it is looked at for a few milliseconds at a
/// time, while the session does what its user wants.
class LineageWalk {
public:
    /// The `run`th that was opened, as Shown::run has it.
    LineageWalk(Session& session, std::uint64_t run, std::uint32_t branch)
        : session_(session), run_(run), branch_(branch) {}

    /// Makes the way there known: simulates on where the branch has not come so far, and looks through what came from
    /// a file. That is long work of the session, which does nothing else meanwhile. What is shown stays. False: ended
    /// by `goesOn`, or by the session's own cancel(). Error: another run was opened; what stepping says.
    Expected<bool> reach(std::int64_t tick, const QString& what, const GoesOn& goesOn);

    /// The ticks that are known of the lineage; nullopt: ended by `goesOn`. Error: as of reach().
    Expected<std::optional<TickRange>> known(const GoesOn& goesOn);

    using Visit = std::function<void(const TimeTravel& travel, const Cursor& at)>;
    /// Calls `visit` in the session's thread at each of these ticks, which are known and ascend. Otherwise as reach().
    Expected<bool> visit(std::span<const std::int64_t> ticks, const Visit& visit, const GoesOn& goesOn);

private:
    Expected<std::size_t> goAlong(TimeTravel& travel, std::span<const std::int64_t> ticks, const Visit& visit);

    Session& session_;
    std::uint64_t run_;
    std::uint32_t branch_;
    std::optional<Cursor> cursor_;
};

}  // namespace mrose::gui

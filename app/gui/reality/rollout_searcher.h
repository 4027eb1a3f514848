#pragma once

#include <QObject>
#include <QString>
#include <functional>
#include <optional>

#include "debug/log_rollouts.h"
#include "debug/rollout_hits.h"
#include "session/job_queue.h"

namespace mrose::gui {

/// Looks for breaks in the rollouts of a log that are not shown, and knows how often breakpoints were met in each.
class RolloutSearcher final : public QObject {
    Q_OBJECT

public:
    explicit RolloutSearcher(const LogRollouts& rollouts) : rollouts_(rollouts) {}

    /// The session is looking in the shown rollout; where there is none, the others are to be looked through.
    void wish(const BreakWish& wish);
    const std::optional<BreakWish>& wished() const { return wish_; }
    /// In the rollouts after the shown one, or before it; `take` gets the one that has it, nullopt: none has.
    void look(std::vector<Breakpoint> breakpoints, std::function<void(Expected<std::optional<std::size_t>>)> take);
    void stop();
    bool busy() { return searching_.busy(); }
    void settle() { searching_.settle(); }

    RolloutHits& hits() { return hits_; }
    /// Those of the rollouts before one and after it, where rollouts follow each other.
    HitsInOtherRuns hitsElsewhere(std::size_t rollout) const {
        return rollouts_.follow() ? hits_.elsewhere(rollout) : HitsInOtherRuns{};
    }

signals:
    void searching(const QString& what, double share);  ///< share 1: it has ended

private:
    const LogRollouts& rollouts_;
    std::optional<BreakWish> wish_;
    RolloutHits hits_;
    JobQueue searching_;
};

}  // namespace mrose::gui

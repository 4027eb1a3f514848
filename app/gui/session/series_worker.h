#pragma once

#include <QObject>
#include <atomic>
#include <memory>

#include "debug/series_walk.h"
#include "session/job_queue.h"
#include "session/session.h"

namespace mrose::gui {

/// Computes the past of values that are plotted, off the frame: it follows the run's timeline as that grows, steps
/// beside the session and never blocks it.
class SeriesWorker final : public QObject {
    Q_OBJECT

public:
    /// Must end before the session does.
    explicit SeriesWorker(Session& session) : session_(session) {}

    void want(std::vector<ValueKey> values);
    void follow(std::uint64_t run, std::shared_ptr<const Reality> reality, std::vector<BranchTicks> wanted);
    void cancel();
    void settle();  ///< blocks until all that is wanted is known; for scripts and tests

    const ValueSeries& series() const { return series_; }  ///< so far

signals:
    void grown();

private:
    void goOn();

    Session& session_;
    ValueSeries series_;
    std::shared_ptr<SeriesWalk> walk_ = std::make_shared<SeriesWalk>();  ///< one task's at a time
    /// What is under way; it ends where that becomes true.
    std::shared_ptr<std::atomic<bool>> enough_;
    bool front_ = false;  ///< it is of a front
    JobQueue computing_;
};

}  // namespace mrose::gui

#pragma once

#include <QObject>
#include <QString>
#include <vector>

#include "debug/log_rollouts.h"
#include "session/job_queue.h"

namespace mrose::gui {

/// Compares all rollouts of a log with what really happened, in the background; what comes of it is theirs.
class RolloutComparer final : public QObject {
    Q_OBJECT

public:
    RolloutComparer(LogRollouts& rollouts, JobQueue& computing) : rollouts_(rollouts), computing_(computing) {}

    void compareAll();  ///< anew
    void cancel();      ///< those that are not compared yet stay so
    void forget() { error_.clear(), share_ = 1; }
    double share() const { return share_; }          ///< that is compared; 1: all, or it was cancelled
    const QString& error() const { return error_; }  ///< why not all are

signals:
    void begun();
    void grown();                                      ///< some more are compared
    void ended(const Expected<ComparedSummary>& all);  ///< the figures over all of them

private:
    LogRollouts& rollouts_;
    JobQueue& computing_;
    double share_ = 1;
    QString error_;
};

}  // namespace mrose::gui

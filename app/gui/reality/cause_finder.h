#pragma once

#include <QObject>
#include <QString>
#include <optional>

#include "debug/log_rollouts.h"
#include "reality/laid_models.h"
#include "session/job_queue.h"

namespace mrose::gui {

/// Why the robot that is asked about leaves the real trajectory in the shown rollout.
class CauseFinder final : public QObject {
    Q_OBJECT

public:
    CauseFinder(const LogRollouts& rollouts, const LaidModels& models);

    /// Looks for it anew.
    void find();
    void forget();
    struct Finding {
        std::size_t rollout = 0, robot = 0;
        double share = 0;  ///< of the re-runs that are done
        std::optional<Diagnosis> diagnosis;
        QString error;
    };
    /// nullopt: it does not leave, or that is not known yet.
    const std::optional<Finding>& finding() const { return finding_; }
    /// Lays the re-run of a cause beside the shown rollout; nullopt: none.
    void show(std::optional<std::size_t> trial);
    std::optional<std::size_t> shown() const { return shown_; }
    /// That re-run.
    std::optional<Reality::ModelRollout> shownRerun() const;
    /// What is still under way comes to nothing.
    void giveUp();
    bool busy() { return diagnosing_.busy(); }
    void settle() { diagnosing_.settle(); }

signals:
    void changed();
    void laid();  ///< of what is laid over the shown rollout

private:
    void take(Expected<Diagnosis> found);

    const LogRollouts& rollouts_;
    const LaidModels& models_;
    std::optional<Finding> finding_;
    std::optional<std::size_t> shown_;
    JobQueue diagnosing_;
};

}  // namespace mrose::gui

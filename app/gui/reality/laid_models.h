#pragma once

#include <QObject>
#include <QString>
#include <optional>
#include <string>
#include <vector>

#include "debug/judged_model.h"
#include "debug/log_rollouts.h"
#include "frame/window_frame.h"
#include "session/job_queue.h"

namespace mrose::gui {

/// Motion models that are laid over a log beside the scenario's own: how true each of them is, and what it makes of the
/// shown rollout.
class LaidModels final : public QObject {
    Q_OBJECT

public:
    /// `computing` compares, too; one after the other.
    LaidModels(const WindowFrame& frame, const LogRollouts& rollouts, JobQueue& computing);

    const std::vector<JudgedModel>& all() const { return models_; }  ///< the scenario's own first
    void add(const std::string& named);
    void remove(std::size_t model);  ///< the scenario's own stays
    void show(std::size_t model, bool on);

    /// Another log: what was laid over the one before is opened in it.
    void enter(const std::vector<std::string>& more);
    void clear();
    /// Finds out how true each is in the rollouts.
    void judge();
    void setOwnFigures(const Expected<ComparedSummary>& compared);
    /// Drives the shown rollout by each of them.
    void drive();
    /// What those that are shown make of it, as far as it is known.
    std::vector<Reality::ModelRollout> drivenRollouts() const;
    void forgetDriven();
    /// What is still under way comes to nothing.
    void giveUp();
    bool busy() { return driving_.busy(); }
    void settle() { driving_.settle(); }

    /// What is done about them now.
    struct Work {
        QString what;
        double share = 0;
    };
    std::optional<Work> work() const;

signals:
    void changed();
    void laid();  ///< of what is laid over the shown rollout
    void failed(const Error& error);

private:
    struct Wanted {
        std::string named;
        bool shown = true;
    };
    void judge(std::size_t model);
    void take(const std::string& name, const JudgedModel::Figures& figures);
    void load(const Wanted& wanted);
    void take(const Wanted& wanted, Expected<JudgedModel> model);
    JudgedModel* named(const std::string& name);

    const WindowFrame& frame_;
    const LogRollouts& rollouts_;
    JobQueue& computing_;
    std::vector<JudgedModel> models_;
    std::vector<Wanted> loading_;  ///< that are not there yet
    std::vector<Reality::ModelRollout> driven_;
    JobQueue driving_;
};

}  // namespace mrose::gui

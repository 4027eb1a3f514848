#pragma once

#include <QObject>
#include <optional>

#include "files/laid_over_log.h"
#include "frame/window_frame.h"
#include "reality/rollout_comparer.h"
#include "reality/shown_rollout.h"
#include "workflow/open_log.h"

namespace mrose::gui {

class WindowFiles;

/// A real log laid over its simulation: where the simulated robots start, and what becomes of each rollout. Works in
/// the background; changed() is emitted.
class Overlay final : public QObject, public LaidOverLog {
    Q_OBJECT

public:
    Overlay(const WindowFrame& frame, FieldView& field, WindowFiles& files);

    /// Reads the log, shows its first rollout, and compares all of them. No plan: the one that suits it. What is wrong
    /// with it is said, and then all stays as it is; where the log does not say what kind of robot drove,
    /// robotKindUnknown().
    void open(const PlayedLogRequest& request, const std::optional<RolloutPlan>& asked = {});
    void openLog(const std::string& place) override { open({place, ""}); }
    /// The same, asks nothing, and waits until the first rollout is shown. Error: it is said, too.
    Expected<void> openNow(const PlayedLogRequest& request, const std::optional<RolloutPlan>& asked = {});
    bool isOpen() const override { return rollouts_.log() != nullptr; }
    void follow(const OpenedRun& run) override;
    void setFollows(bool on) { follows_ = on; }  ///< false: runs are opened as they are
    bool reload(const QString& why) override;
    void addModel(const std::string& named) override { models_.add(named); }
    void close() { leave(), emit closed(); }

    const LogRollouts& rollouts() const { return rollouts_; }
    LaidModels& models() { return models_; }
    const LaidModels& models() const { return models_; }
    CauseFinder& causes() { return causes_; }
    const CauseFinder& causes() const { return causes_; }
    RolloutSearcher& searcher() { return searcher_; }
    ShownRollout& shown() { return shown_; }
    const ShownRollout& shown() const { return shown_; }

    /// Compares anew. Error: no rollout fits in; then nothing has changed.
    Expected<void> setPlan(const RolloutPlan& plan);
    void setBound(const LogRollouts::Bound& bound);
    /// At the end of a rollout the next one begins, where rollouts follow each other.
    void setRestarts(bool on);
    void compareAll();  ///< once more, where that was cancelled
    const RolloutComparer& comparing() const { return comparing_; }
    /// What is done about rollouts and models now.
    std::optional<LaidModels::Work> work() const;

    bool opening() { return opener_.busy() || shown_.coming(); }  ///< a rollout, or a log
    /// Ends what is opened, compared and looked for; false: nothing is.
    bool cancel();
    bool busy();
    void settle();  ///< all is done and shown; for scripts and tests

signals:
    void changed();
    void closed();              ///< nothing real is known any more
    void divergencesChanged();  ///< where the shown rollout's robots leave the real ones, or the bound
    /// The user must say what kind of robot drove, as PlayedLogRequest::robotFile of the same request.
    void robotKindUnknown(const PlayedLogRequest& request, const std::optional<RolloutPlan>& asked);

private:
    /// A log that was asked for.
    struct Opening {
        PlayedLogRequest request;
        std::optional<RolloutPlan> asked;
        bool mayAsk = true;  ///< what drove
    };
    void post(const Opening& opening);
    void take(Expected<OpenedLog> opened, const Opening& opening, bool kindUnknown);
    void takeFollowed(PlayedLogPointer log, const BranchSetupPointer& followed);
    void begin(PlayedLogPointer log, const RolloutPlan& plan, std::vector<RolloutRequest> rollouts);
    void replace(PlayedLogPointer log, const RolloutPlan& plan, std::vector<RolloutRequest> rollouts);
    void leave();
    void setAside();
    void readAgain();
    void takeReopened(Expected<OpenedLog> again, const QString& why);
    void sayError(const Error& error);

    const WindowFrame& frame_;
    WindowFiles& files_;
    LogRollouts rollouts_;
    JobQueue computing_;
    RolloutComparer comparing_;
    LaidModels models_;
    CauseFinder causes_;
    RolloutSearcher searcher_;
    OpeningQueue opener_;
    ShownRollout shown_;
    bool follows_ = true;
    std::optional<Error> openError_;
    std::optional<QString> reload_, reading_;  ///< why all is to be read again, and why it is being
};

}  // namespace mrose::gui

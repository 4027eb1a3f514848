#pragma once

#include <QObject>
#include <optional>

#include "files/laid_over_log.h"
#include "frame/frame.h"
#include "reality/cause_finder.h"
#include "reality/laid_models.h"
#include "reality/log_opener.h"
#include "reality/rollout_searcher.h"
#include "reality/rollout_view.h"

namespace mrose::gui {

class WindowFiles;

/// A real log laid over its simulation: where the simulated robots start, what becomes of each rollout, and which of
/// them the window shows as its run. Works in the background; changed() is emitted.
class Overlay final : public QObject, public LaidOverLog {
    Q_OBJECT

public:
    Overlay(const Frame& frame, FieldView& field, WindowFiles& files);

    /// Reads the log, shows its first rollout, and compares all of them. No plan: the one that suits it. What is wrong
    /// with it is said, and then all stays as it is; where the log does not say what kind of robot drove,
    /// robotKindUnknown().
    void open(const PlayedLogRequest& request, const std::optional<RolloutPlan>& asked = {});
    void openLog(const std::string& place) override { open({place, ""}); }
    /// The same, asks nothing, and waits until the first rollout is shown. Error: it is said, too.
    Expected<void> openNow(const PlayedLogRequest& request, const std::optional<RolloutPlan>& asked = {});
    bool isOpen() const override { return rollouts_.log() != nullptr; }
    void follow(const OpenRun& run) override;
    void setFollows(bool on) { follows_ = on; }  ///< false: runs are opened as they are
    bool reload(const QString& why) override;
    void addModel(const std::string& named) override { models_.add(named); }
    void close();

    const LogRollouts& rollouts() const { return rollouts_; }
    LaidModels& models() { return models_; }
    const LaidModels& models() const { return models_; }
    CauseFinder& causes() { return causes_; }
    const CauseFinder& causes() const { return causes_; }
    RolloutSearcher& searcher() { return searcher_; }

    /// Compares anew. Error: no rollout fits in; then nothing has changed.
    Expected<void> setPlan(const RolloutPlan& plan);
    void setBound(const LogRollouts::Bound& bound);
    /// At the end of a rollout the next one begins, where rollouts follow each other.
    void setRestarts(bool on);
    void setRobot(std::optional<std::size_t> robot);  ///< that is asked about
    void compareAll();                                ///< once more, where that was cancelled
    double share() const { return share_; }           ///< that is compared; 1: all, or it was cancelled
    const QString& error() const { return error_; }   ///< of the comparison
    /// What is done about rollouts and models now.
    std::optional<LaidModels::Work> work() const;

    /// Of the shown rollout that branch which rows and comparison describe: its first one, after a reload the one that
    /// began then. nullopt: it is not there yet.
    std::optional<std::uint32_t> comparedBranch() const { return compared_; }
    bool showsCompared() const { return shownBranch_ == compared_; }
    /// To the instant at which a robot leaves the real trajectory, and it is selected; where the shown rollout is not
    /// left, to the next one that is. False: there is none, as far as they are compared.
    bool goToDivergence();
    /// Opens a rollout as the window's run. A robot that is picked is selected, and its rollout seen from near. False:
    /// there is none, or what is unsaved is to stay.
    bool show(std::size_t rollout, std::optional<std::size_t> robot = {}) { return show(rollout, robot, Then{}); }
    /// To the rollout before or after; false: there is none.
    bool showNext(int by) { return showNext(by, Then{}); }
    bool opening() { return opener_.busy() || coming_; }  ///< a rollout, or a log
    /// As Session::goToBreak(). Where rollouts follow each other, the others are looked through, too: those after the
    /// shown one, or before it.
    void goToBreak(const BreakWish& wish);
    /// Playing is asked for where the shown rollout is over: the next one begins, or it is said that there is none,
    /// once in a run. False: the run itself is to play.
    bool playsNext();

    /// Ends what is opened, compared and looked for; false: nothing is.
    bool cancel();
    bool busy();
    void settle();  ///< all is done and shown; for scripts and tests

signals:
    void changed();
    void divergencesChanged();  ///< where the shown rollout's robots leave the real ones, or the bound
    /// The user must say what kind of robot drove, as PlayedLogRequest::robotFile of the same request.
    void robotKindUnknown(const PlayedLogRequest& request, const std::optional<RolloutPlan>& asked);

private:
    /// What is to be done once a rollout is shown.
    struct Then {
        bool play = false;
        bool toDivergence = false;
        std::optional<BreakWish> look = {};
    };
    /// A run that was given to the session: what is to be done when it is shown.
    struct Coming {
        BranchSetupPointer run;
        std::optional<std::size_t> rollout;  ///< nullopt: a run that was opened as such
        std::optional<std::size_t> robot;
        std::shared_ptr<const Reality> reality;
        RolloutView::Kept view = {};
        Then then = {};
    };
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
    void setAside();
    void readAgain();
    void takeReopened(Expected<OpenedLog> again, const QString& why);
    void takeRows(const std::vector<RolloutRow>& rows, double share);
    void takeComparison(Expected<Comparison> comparison);
    void lookAtRollout();
    void layReality();
    void reportDivergences();
    bool show(std::size_t rollout, std::optional<std::size_t> robot, const Then& then);
    bool showNext(int by, const Then& then);
    void takeRollout(Expected<OpenRun> run, std::size_t rollout, std::optional<std::size_t> robot, const Then& then);
    void followShown();
    void finishComing();
    bool inRollouts() const;
    bool atRolloutEnd() const;
    void sayLogEnds();
    void lookInOthers();
    void showLeaving();
    void sayError(const Error& error);

    Frame frame_;
    WindowFiles& files_;
    LogRollouts rollouts_;
    JobQueue computing_;
    LaidModels models_;
    CauseFinder causes_;
    RolloutSearcher searcher_;
    RolloutView view_;
    LogOpener opener_;
    double share_ = 1;
    QString error_;
    std::shared_ptr<const Reality> reality_;     ///< of the shown rollout, without models
    std::uint64_t run_ = 0;                      ///< the session's count of the shown rollout
    std::optional<std::uint32_t> compared_ = 0;  ///< of its branches, the rollout of the comparison
    std::optional<std::uint32_t> shownBranch_;
    BranchSetupPointer reloaded_;    ///< that of which compared_ will be a branch
    std::uint64_t reportedEnd_ = 0;  ///< the run at whose end it was said that there is no further rollout
    bool follows_ = true;
    std::optional<Error> openError_;
    std::optional<Coming> coming_;
    std::optional<QString> reload_, reading_;  ///< why all is to be read again, and why it is being
};

}  // namespace mrose::gui

#pragma once

#include <QObject>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "debug/breakpoints.h"
#include "debug/rollout_hits.h"
#include "files/laid_over_log.h"
#include "frame/frame.h"
#include "session/job_queue.h"
#include "widgets/qt_text.h"
#include "widgets/view_transform.h"
#include "workflow/overlay_work.h"

namespace mrose {
class FieldView;
}

namespace mrose::gui {

class PlotPanel;
class WindowFiles;

/// Of the messages that speak of a model.
inline QString modelTopic(const std::string& name) { return "model " + qtText(name); }

/// A real log laid over its simulation: where the simulated robots start, what becomes of each rollout, and which of
/// them the window shows as its run. Works in the background; changed() is emitted.
class Overlay final : public QObject, public LaidOverLog {
    Q_OBJECT

public:
    Overlay(const Frame& frame, FieldView& field, WindowFiles& files);
    ~Overlay() override;

    /// Reads the log, shows its first rollout, and compares all of them. No plan: the one that suits it. What is wrong
    /// with it is said, and then all stays as it is; where the log does not say what kind of robot drove,
    /// robotKindUnknown().
    void open(const OverlayRequest& request, const std::optional<OverlayPlan>& asked = {});
    /// The same, asks nothing, and waits until the first rollout is shown. Error: it is said, too.
    Expected<void> openNow(const OverlayRequest& request, const std::optional<OverlayPlan>& asked = {});
    /// A run that plays a log and was opened as such: what really happened is laid beside it, and its log is compared.
    void follow(const OpenRun& run) override;
    void setFollows(bool on) { follows_ = on; }  ///< false: runs are opened as they are
    void close();
    /// Log and scenario once more from their files; the shown rollout goes on as a branch.
    bool reload(const QString& why) override;

    void openLog(const std::string& place) override { open({place, ""}); }
    bool isOpen() const override { return world_ != nullptr; }
    const OverlayWorldPointer& world() const { return world_; }  ///< null: no log is open
    const OverlayPlan& plan() const { return plan_; }
    /// Compares anew. Error: no rollout fits in; then nothing has changed.
    Expected<void> setPlan(const OverlayPlan& plan);
    /// From when on a robot has left the real trajectory.
    struct Bound {
        DivergenceBound::At at = DivergenceBound{}.constant;
        bool fromHeldOut = false;  ///< instead, from what the robot's network was held out from
        bool operator==(const Bound&) const = default;
    };
    const Bound& bound() const { return bound_; }
    void setBound(const Bound& bound);
    DivergenceOptions divergenceOptions() const;  ///< as of the flags of `mrose compare`

    /// Motion models, the scenario's own first; the others drive the shown rollout beside it.
    const std::vector<OverlayModel>& models() const { return models_; }
    void addModel(const std::string& named) override;
    void removeModel(std::size_t model);  ///< the scenario's own stays
    void showModel(std::size_t model, bool on);

    const std::vector<RolloutRequest>& requests() const { return requests_; }
    const std::vector<OverlayRow>& rows() const { return rows_; }  ///< of the rollouts that are done, by their indices
    std::uint64_t rowsVersion() const { return rowsVersion_; }     ///< another one: the rows have changed
    /// As `mrose compare` has it; null: it is not yet done.
    const Comparison* comparison() const { return comparison_.get(); }
    void compareAll();                               ///< once more, where that was cancelled
    double share() const { return share_; }          ///< that is compared; 1: all, or it was cancelled
    const QString& error() const { return error_; }  ///< of the comparison
    /// What is done about rollouts and models now.
    struct Work {
        QString what;
        double share = 0;
    };
    std::optional<Work> work() const;

    // A rollout is meant by its index in requests().

    /// The one that the window shows; nullopt: another run.
    std::optional<std::size_t> shownRollout() const { return shownRollout_; }
    /// Of the shown rollout that branch which rows and comparison describe: its first one, after a reload the one that
    /// began then. nullopt: it is not there yet.
    std::optional<std::uint32_t> comparedBranch() const { return compared_; }
    bool showsCompared() const { return shownBranch_ == compared_; }
    const OverlayRow* rowOf(std::size_t rollout, std::size_t robot) const;
    /// The robot that is asked about, in LogWorld::robots(): the selected one, otherwise that which is farthest off.
    /// nullopt: no rollout is shown, or nothing is known of it yet.
    std::optional<std::size_t> shownRobot() const;
    const OverlayRow* shownRow() const;
    void setRobot(std::optional<std::size_t> robot);

    /// Why that robot leaves the real trajectory.
    struct Finding {
        std::size_t rollout = 0, robot = 0;
        double share = 0;  ///< of the re-runs that are done
        std::optional<Diagnosis> diagnosis;
        QString error;
    };
    const std::optional<Finding>& finding() const { return finding_; }
    /// Lays the re-run of a cause beside the shown rollout; nullopt: none.
    void showCause(std::optional<std::size_t> trial);
    std::optional<std::size_t> shownCause() const { return cause_; }
    /// To the instant at which it leaves the real trajectory, and it is selected; where the shown rollout is not left,
    /// to the next one that is, after the last the first. False: there is none, as far as they are compared.
    bool goToDivergence();
    /// Opens a rollout as the window's run. A robot that is picked is selected, and its rollout seen from near. False:
    /// there is none, or what is unsaved is to stay.
    bool show(std::size_t rollout, std::optional<std::size_t> robot = {}) { return show(rollout, robot, Then{}); }
    bool opening() { return opener_.busy() || coming_; }  ///< a rollout, or a log
    /// To the rollout before or after; false: there is none.
    bool showNext(int by) { return showNext(by, Then{}); }
    /// As Session::goToBreak(). Where rollouts follow each other, the others are looked through, too: those after the
    /// shown one, or before it.
    void goToBreak(const BreakWish& wish);
    /// Playing is asked for where the shown rollout is over: the next one begins, or it is said that there is none,
    /// once in a run. False: the run itself is to play.
    bool playsNext();
    /// At the end of a rollout the next one begins, where rollouts follow each other.
    bool restarts() const { return restarts_; }
    void setRestarts(bool on);

    /// Ends what is opened, compared and looked for; false: nothing is.
    bool cancel();
    bool busy();
    void settle();  ///< all is done and shown; for scripts and tests

signals:
    void changed();
    void divergencesChanged();  ///< where the shown rollout's robots leave the real ones, or the bound
    void searching(const QString& what, double share);  ///< share 1: it has ended
    /// The user must say what kind of robot drove, as OverlayRequest::robotFile of the same request.
    void robotKindUnknown(const OverlayRequest& request, const std::optional<OverlayPlan>& asked);

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
        std::string selected;
        std::shared_ptr<const Reality> reality;
        bool near = false;
        std::optional<ViewTransform> view = {};  ///< the part of the place that was seen; nullopt: all of it
        Then then = {};
    };
    struct WantedModel {
        std::string named;
        bool shown = true;
    };

    /// One that was asked for, with what became of it.
    struct Opening {
        OverlayRequest request;
        std::optional<OverlayPlan> asked;
        bool mayAsk = true;  ///< what drove
        bool kindUnknown = false;
    };
    void post(const Opening& opening);
    void takeOpened(Expected<OpenedLog> opened, const Opening& opening);
    void takeFollowed(OverlayWorldPointer world, const BranchSetupPointer& followed);
    void begin(OverlayWorldPointer world, const OverlayPlan& plan, std::vector<RolloutRequest> rollouts);
    void reportOpening(const std::string& place);
    void setAside();
    void endOpening();
    void adopt(OverlayWorldPointer world, std::vector<RolloutRequest> requests);
    void readAgain();
    void takeReopened(Expected<OpenedLog> again, const QString& why);
    void takeRows(const std::vector<OverlayRow>& rows, double share);
    void takeComparison(Expected<Comparison> comparison);
    void setRows(std::vector<OverlayRow> rows);
    void compareModels();
    void compareModel(std::size_t model);
    void takeFigures(const std::string& name, const OverlayModel::Figures& figures);
    void loadModel(const WantedModel& wanted);
    void takeModel(const WantedModel& wanted, Expected<OverlayModel> model);
    OverlayModel* modelNamed(const std::string& name);
    void lookAtRollout();
    void forgetRollout();
    void findCause();
    void takeDiagnosis(Expected<Diagnosis> found);
    void layReality();
    void reportDivergences();
    bool show(std::size_t rollout, std::optional<std::size_t> robot, const Then& then);
    bool showNext(int by, const Then& then);
    void takeRollout(Expected<OpenRun> run, std::size_t rollout, std::optional<std::size_t> robot, const Then& then);
    void followShown();
    void finishComing();
    void showNear();
    bool isAside() const;
    void showAsBefore(const Coming& come);
    void selectAgain(const std::string& name);
    bool goToOtherDivergence();
    bool rolloutsFollow() const;
    bool inRollouts() const;
    void learnHits();
    void reportHits(std::size_t rollout);
    bool atRolloutEnd() const;
    bool isLastRollout() const;
    void sayLogEnds();
    void lookInRollouts();
    void stopSearching();
    void showLeaving();
    void select(std::size_t robot);
    std::span<const OverlayRow> rowsOf(std::size_t rollout) const;
    void sayError(const Error& error);

    Frame frame_;
    FieldView& field_;
    WindowFiles& files_;
    OverlayWorldPointer world_;
    OverlayPlan plan_;
    Bound bound_;
    std::vector<RolloutRequest> requests_;
    std::vector<OverlayRow> rows_;
    std::uint64_t rowsVersion_ = 0;
    std::shared_ptr<const Comparison> comparison_;
    double share_ = 1;
    QString error_;
    std::optional<std::size_t> shownRollout_;
    std::vector<OverlayModel> models_;
    std::vector<WantedModel> loading_;  ///< that are not there yet
    std::optional<std::size_t> robot_;
    std::string absent_;  ///< was selected before a rollout that does not have it; empty: none
    std::optional<Finding> finding_;
    std::optional<std::size_t> cause_;
    std::shared_ptr<const Reality> reality_;  ///< of the shown rollout, without models
    std::vector<Reality::ModelRollout> modelRollouts_;
    std::uint64_t openings_ = 0;                 ///< of logs, begun and ended
    std::uint64_t run_ = 0;                      ///< the session's count of the shown rollout
    std::optional<std::uint32_t> compared_ = 0;  ///< of its branches, the rollout of the comparison
    std::optional<std::uint32_t> shownBranch_;
    BranchSetupPointer reloaded_;    ///< that of which compared_ will be a branch
    std::optional<BreakWish> wish_;  ///< for which the session is looking
    RolloutHits hits_;
    std::uint64_t reportedEnd_ = 0;  ///< the run at whose end it was said that there is no further rollout
    bool restarts_ = true;
    bool follows_ = true;
    std::optional<Error> openError_;
    std::optional<Coming> coming_;
    std::optional<QString> reload_, reading_;  ///< why all is to be read again, and why it is being
    JobQueue opener_, computing_, driving_, diagnosing_, searching_;
};

}  // namespace mrose::gui

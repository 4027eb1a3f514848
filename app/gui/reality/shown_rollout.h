#pragma once

#include <QObject>
#include <memory>
#include <optional>

#include "files/opening_queue.h"
#include "frame/window_frame.h"
#include "reality/cause_finder.h"
#include "reality/laid_models.h"
#include "reality/rollout_searcher.h"
#include "reality/rollout_view.h"

namespace mrose::gui {

class WindowFiles;

/// Which rollout of a log the window shows as its run, and how one goes from one to the next.
class ShownRollout final : public QObject {
    Q_OBJECT

public:
    /// What it works on; all outlive it.
    struct Parts {
        LogRollouts& rollouts;
        LaidModels& models;
        CauseFinder& causes;
        RolloutSearcher& searcher;
        OpeningQueue& opener;
    };
    ShownRollout(const WindowFrame& frame, FieldView& field, WindowFiles& files, const Parts& parts);

    /// Opens a rollout as the window's run. A robot that is picked is selected, and its rollout seen from near. False:
    /// there is none, or what is unsaved is to stay.
    bool show(std::size_t rollout, std::optional<std::size_t> robot = {}) { return show(rollout, robot, Then{}); }
    /// To the rollout before or after; false: there is none.
    bool showNext(int by) { return showNext(by, Then{}); }
    /// One that has been opened.
    void take(Expected<OpenedRun> run, std::size_t rollout) { take(std::move(run), rollout, {}, Then{}); }
    /// A run that was opened as such plays the log: what really happened is laid beside it, once it is shown.
    void takeFollowed(BranchSetupPointer run, std::shared_ptr<const Reality> reality);
    /// The shown one goes on as a branch, in what was read again.
    void takeReopened(std::size_t rollout, const OpenedRun& run);
    void forget();
    /// One is on its way to be shown.
    bool coming() const { return coming_.has_value(); }
    void setAside() { coming_.reset(); }

    /// That branch of it which rows and comparison describe: its first one, after a reload the one that began then.
    /// nullopt: it is not there yet.
    std::optional<std::uint32_t> comparedBranch() const { return compared_; }
    /// The tick at which the shown rollout's own run ends; nullopt: no such run is shown. Beyond it the log's commands
    /// are not played.
    std::optional<std::int64_t> endTick() const;
    /// As Session::seek(), but not beyond that end, which is said.
    void seek(std::int64_t tick);
    bool showsCompared() const { return shownBranch_ == compared_; }
    void setRobot(std::optional<std::size_t> robot);  ///< that is asked about; nullopt: the same one
    /// What models make of it, and why it leaves the real one.
    void look();
    void reportDivergences();
    /// To the instant at which a robot leaves the real trajectory, and it is selected; where the shown rollout is not
    /// left, to the next one that is. False: there is none, as far as they are compared.
    bool goToDivergence();
    /// As Session::goToBreak(). Where rollouts follow each other, the others are looked through, too: those after the
    /// shown one, or before it.
    void goToBreak(const BreakWish& wish);
    /// Whether all rollouts are compared: where they leave the log is known only then.
    void setCompared(bool compared) { allCompared_ = compared; }
    /// Playing is asked for where the shown rollout is over: the next one begins, or it is said that there is none,
    /// once in a run. False: the run itself is to play.
    bool playsNext();

signals:
    void changed();
    void divergencesChanged();  ///< where its robots leave the real ones, or the bound
    void opens();               ///< another rollout is asked for
    void taken();               ///< the one that was asked for is shown, or cannot be
    void failed(const Error& error);
    void done();  ///< an error that was said is of the past

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
    bool show(std::size_t rollout, std::optional<std::size_t> robot, const Then& then);
    bool showNext(int by, const Then& then);
    void take(Expected<OpenedRun> run, std::size_t rollout, std::optional<std::size_t> robot, const Then& then);
    void layReality();
    void followShown();
    void finishComing();
    bool inRollouts() const;
    bool atRolloutEnd() const;
    void sayLogEnds();
    void lookInOthers();
    void showLeaving();

    const WindowFrame& frame_;
    WindowFiles& files_;
    LogRollouts& rollouts_;
    LaidModels& models_;
    CauseFinder& causes_;
    RolloutSearcher& searcher_;
    OpeningQueue& opener_;
    RolloutView view_;
    std::shared_ptr<const Reality> reality_;     ///< of the shown rollout, without models
    std::uint64_t run_ = 0;                      ///< the session's count of the shown rollout
    std::optional<std::uint32_t> compared_ = 0;  ///< of its branches, the rollout of the comparison
    std::optional<std::uint32_t> shownBranch_;
    BranchSetupPointer reloaded_;    ///< that of which compared_ will be a branch
    std::uint64_t reportedEnd_ = 0;  ///< the run at whose end it was said that there is no further rollout
    bool allCompared_ = false;
    std::optional<Coming> coming_;
};

}  // namespace mrose::gui

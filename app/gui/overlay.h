#pragma once

#include <QObject>
#include <optional>
#include <vector>

#include "job_queue.h"
#include "overlay_models.h"
#include "overlay_rows.h"
#include "overlay_world.h"

namespace mrose::gui {

class MainWindow;

/// A real log laid over its simulation: where the simulated robots start, what becomes of each course, and which of
/// them the window shows as its run. Works in the background; changed() tells.
class Overlay final : public QObject {
    Q_OBJECT

public:
    explicit Overlay(MainWindow& window);
    ~Overlay() override;

    /// Reads the log, shows its first course, and compares all of them. What is wrong with it is said.
    void open(const OverlayRequest& request, const OverlayPlan& plan = {});
    /// The same, and waits until the first course is shown. Error: it is said, too.
    Expected<void> openNow(const OverlayRequest& request, const OverlayPlan& plan = {});
    /// A run that plays a log and was opened as such: what really happened is laid beside it, and its log is compared.
    void follow(const OpenRun& run);
    void setFollows(bool on) { follows_ = on; }  ///< false: runs are opened as they are
    void close();
    /// Log and scenario once more from their files; the shown course goes on as a branch.
    void reload(const QString& why);

    const OverlayWorldPointer& world() const { return world_; }  ///< null: no log is open
    const OverlayPlan& plan() const { return plan_; }
    /// Compares anew. Error: no course fits in; then nothing has changed.
    Expected<void> setPlan(const OverlayPlan& plan);
    /// From when on a robot has left the real course.
    struct Bound {
        DivergenceBound::At at = DivergenceBound{}.constant;
        bool fromHeldOut = false;  ///< instead, from what the robot's network was held out from
        bool operator==(const Bound&) const = default;
    };
    const Bound& bound() const { return bound_; }
    void setBound(const Bound& bound);
    DivergenceOptions divergenceOptions() const;  ///< the same as `mrose compare` is told

    /// Motion models, the scenario's own first; the others drive the shown course beside it.
    const std::vector<OverlayModel>& models() const { return models_; }
    void addModel(const std::string& named);
    void removeModel(std::size_t model);
    void showModel(std::size_t model, bool on);

    const std::vector<CourseRequest>& requests() const { return requests_; }
    const std::vector<OverlayRow>& rows() const { return rows_; }  ///< of the courses that are done, by request
    /// As `mrose compare` has it; null: it is not yet done.
    const Comparison* comparison() const { return comparison_.get(); }
    double share() const { return share_; }          ///< that is compared; 1: all, or it was cancelled
    const QString& error() const { return error_; }  ///< of the comparison

    /// The one that the window shows; nothing: another run.
    std::optional<std::size_t> shownCourse() const { return shownCourse_; }
    const OverlayRow* rowOf(std::size_t request, std::size_t robot) const;
    /// The robot that is asked about, in LogWorld::robots(): the selected one, otherwise that which is farthest off.
    /// Nothing: no course is shown, or nothing is known of it yet.
    std::optional<std::size_t> shownRobot() const;
    const OverlayRow* shownRow() const;
    void setRobot(std::optional<std::size_t> robot);

    /// Why that robot leaves the real course.
    struct Finding {
        std::size_t request = 0, robot = 0;
        double share = 0;  ///< of the re-runs that are done
        std::optional<Diagnosis> diagnosis;
        QString error;
    };
    const std::optional<Finding>& finding() const { return finding_; }
    /// Lays the re-run of a cause beside the shown course; nothing: none.
    void showCause(std::optional<std::size_t> trial);
    std::optional<std::size_t> shownCause() const { return cause_; }
    /// To the instant at which it leaves the real course; false: it does not.
    bool goToDivergence();
    /// Opens a course as the window's run, and selects a robot in it.
    void show(std::size_t request, std::optional<std::size_t> robot = {}, bool play = false);
    /// To the course before or after; false: there is none.
    bool showNext(int by, bool play = false);
    /// At the end of a course the next one begins, where courses follow each other.
    bool restarts() const { return restarts_; }
    void setRestarts(bool on);

    /// Ends what is compared; false: nothing is.
    bool cancel();
    bool busy();
    void settle();  ///< all is done and shown; for scripts and tests

signals:
    void changed();

private:
    void take(Expected<OverlayWorldPointer> world);
    void compareAll();
    void compareModels();
    void compareModel(std::size_t model);
    void loadModel(const std::string& named);
    void lookAtCourse();
    void findCause();
    void layReality();
    void tellDivergences();
    void takeCourse(Expected<OpenRun> run, std::size_t request, std::optional<std::size_t> robot, bool play);
    bool goesOn() const;
    void watchPlaying();
    void sayError(const Error& error);

    MainWindow& window_;
    OverlayWorldPointer world_;
    OverlayPlan plan_;
    Bound bound_;
    std::vector<CourseRequest> requests_;
    std::vector<OverlayRow> rows_;
    std::shared_ptr<const Comparison> comparison_;
    double share_ = 1;
    QString error_;
    std::optional<std::size_t> shownCourse_;
    std::vector<OverlayModel> models_;
    std::vector<std::string> loading_;  ///< models that are wanted and not there yet
    std::optional<std::size_t> robot_;
    std::optional<Finding> finding_;
    std::optional<std::size_t> cause_;
    std::shared_ptr<const Reality> reality_;  ///< of the shown course, without models
    std::vector<Reality::ModelCourse> modelCourses_;
    std::uint64_t run_ = 0;  ///< the session's count of the shown course
    bool restarts_ = true;
    bool follows_ = true;
    bool showsFirst_ = true;  ///< of a log that is being opened
    std::optional<Error> opening_;
    JobQueue opener_, computing_, looking_;
};

}  // namespace mrose::gui

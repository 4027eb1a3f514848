#pragma once

#include <QObject>
#include <QStringList>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "files/description_watch.h"
#include "files/laid_over_log.h"
#include "files/opener.h"
#include "frame/frame.h"
#include "world/state_hash.h"

class QMimeData;

namespace mrose {
class FieldView;
}

namespace mrose::gui {

/// What the window does with files: opens runs and opens them again when a description changes, saves, and says what
/// is wrong with a file. Nothing here waits for a disk, but where it says so.
class WindowFiles final : public QObject {
    Q_OBJECT

public:
    WindowFiles(const Frame& frame, FieldView& field);
    void setLog(LaidOverLog& log) { log_ = &log; }  ///< before anything is opened

    /// What a file holds, of whatever kind, is opened; a network is offered to the selected robot.
    void open(const QString& path, OpenRequest how = {}, std::optional<double> at = {});
    void open(const OpenRequest& request, std::optional<double> at = {});
    /// The same, and waits: for scripts. `at` in seconds. Error: it is shown, too.
    Expected<void> openNow(const OpenRequest& request, std::optional<double> at = {});
    void drop(const QMimeData& what);
    /// Passes a network to swap_model, or says what is missing for it.
    void offerNetwork(const QString& path);
    /// A rollout of the log that is open: the window's run from now on. Its number, as Shown::run will have it.
    std::uint64_t takeRollout(const OpenRun& run);
    /// What is open, once more from its files: as a branch that goes up to the shown tick. Of a recording, what was
    /// written to it since.
    void reload(const QString& why);
    /// What came of that.
    void takeReloaded(Expected<OpenRun> run, const QString& why);
    /// What was read again has the contents that it had.
    void sayUnchanged();
    /// Ends what is being opened; false: nothing is.
    bool cancel() { return opener_.cancel(); }

    /// The run with its branches, in the background; once it is saved, `then`. Unattended, it waits. Error: such a file
    /// must not be written; unattended, all errors.
    Expected<void> saveRecording(const QString& path, const std::function<void()>& then = {});
    /// The shown state as a scenario that goes on from there; otherwise as saveRecording().
    Expected<void> saveScenario(const QString& path);
    /// Writes the run to a file while it goes on; an empty one: no more.
    void record(const QString& path, bool overwrite = true);
    /// For what is saved of what is open: a free name in the folder used last, as "soccer_2.mcap" for ".mcap".
    QString suggestedName(const QString& ending) const;
    /// Asks `over` for such a file, whose extension is that of `ending` unless another is typed. Empty: the user
    /// cancelled.
    QString askForName(QWidget& over, const QString& title, const QString& kinds, const QString& ending) const;
    const QString& recordedTo() const { return recordedTo_; }
    /// Why the last recording was not begun, or ended too early; empty: nothing went wrong.
    const QString& recordingError() const { return recordingError_; }

    /// What a user may answer to the question about what would be lost.
    enum class Answer { save, discard, cancel };
    void setQuestion(std::function<Answer(const QString& what)> ask) { ask_ = std::move(ask); }
    bool hasUnsaved() const;
    /// Whether what is unsaved may go. Saves first, where that is the answer, and then calls `then` itself.
    bool mayLeave(const std::function<void()>& then);

    /// How the run that is open was opened; nothing is open: nothing.
    const std::optional<OpenRequest>& opened() const { return opened_; }
    Opener& opener() { return opener_; }
    DescriptionWatch& watch() { return watch_; }

signals:
    void recordingTo(const QString& path);  ///< empty: nowhere

private:
    void openRunOf(const OpenRequest& request, std::function<void(Expected<OpenRun>)> take);
    Expected<void> take(Expected<OpenRun> run, std::optional<double> at);
    void offerModel(const QString& path);
    void listTrials(const QString& path);
    Expected<void> goTo(const OpenRun& run, double at);
    /// How far a branch of a recording goes, and where to.
    struct Extent {
        std::int64_t last = 0;
        StateHash state;
        bool operator==(const Extent&) const = default;
    };
    static std::vector<Extent> extentsOf(const OpenRun& run);
    void takeGrown(const OpenRun& run);
    void sayGone(const QString& names, std::size_t count);
    void offerBranches(const OpenRun& run, bool atItsPlace);
    Expected<void> checkNotRead(const QString& path) const;
    std::uint64_t show(const OpenRun& run, const std::string& breakpointsOf);
    bool saved(const QString& path, const Expected<bool>& done, std::uint64_t run, std::size_t branches);
    void savedScenario(const QString& path, const Expected<void>& done);
    void recordingChanged(const QString& path, const QString& error);
    void sayNotSaved(const Error& error, const QString& action);
    void sayError(const Error& error, const QString& topic);

    Frame frame_;
    FieldView& field_;
    LaidOverLog* log_ = nullptr;
    Opener opener_;
    DescriptionWatch watch_;
    static constexpr const char* goneTopic = "gone";
    std::optional<OpenRequest> opened_;
    std::map<std::string, std::string> files_;  ///< that it was read from, with their hashes
    std::vector<Extent> extents_;               ///< of a recording's branches, as it was read; empty: it is none
    std::function<Answer(const QString&)> ask_;
    std::uint64_t run_ = 0;  ///< that is open, as Shown::run
    std::size_t savedBranches_ = 1;
    QString network_;  ///< to be offered once a run is open
    QString recordedTo_, recordingError_;
    QString changedMeanwhile_;  ///< why it is to be read again, reported while it was being read
};

}  // namespace mrose::gui

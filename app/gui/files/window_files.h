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
#include "files/opening_queue.h"
#include "files/run_saver.h"
#include "frame/window_frame.h"
#include "world/state_hash.h"

class QMimeData;

namespace mrose {
class FieldView;
}

namespace mrose::gui {

/// What the window opens: runs, which are opened again when a description changes, logs, networks, results; and what is
/// wrong with a file is said. Nothing here waits for a disk, but where it says so.
class WindowFiles final : public QObject {
    Q_OBJECT

public:
    WindowFiles(const WindowFrame& frame, FieldView& field);
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
    std::uint64_t takeRollout(const OpenedRun& run);
    /// What is open, once more from its files: as a branch that goes up to the shown tick. Of a recording, what was
    /// written to it since.
    void reload(const QString& why);
    /// What came of that.
    void takeReloaded(Expected<OpenedRun> run, const QString& why);
    /// What was read again has the contents that it had.
    void sayUnchanged();
    /// Ends what is being opened; false: nothing is.
    bool cancel() { return opener_.cancel(); }

    RunSaver& saver() { return saver_; }
    /// How the run that is open was opened; nothing is open: nothing.
    const std::optional<OpenRequest>& opened() const { return opened_; }
    OpeningQueue& opener() { return opener_; }
    DescriptionWatch& watch() { return watch_; }

private:
    void openRunOf(const OpenRequest& request, std::function<void(Expected<OpenedRun>)> take);
    Expected<void> take(Expected<OpenedRun> run, std::optional<double> at);
    void offerModel(const QString& path);
    void listTrials(const QString& path);
    Expected<void> goTo(const OpenedRun& run, double at);
    /// How far a branch of a recording goes, and where to.
    struct Extent {
        std::int64_t last = 0;
        StateHash state;
        bool operator==(const Extent&) const = default;
    };
    static std::vector<Extent> extentsOf(const OpenedRun& run);
    void takeGrown(const OpenedRun& run);
    void sayGone(const QString& names, std::size_t count);
    void offerBranches(const OpenedRun& run, bool atItsPlace);
    std::uint64_t show(const OpenedRun& run, const std::string& breakpointsOf);
    void sayError(const Error& error, const QString& topic);

    const WindowFrame& frame_;
    FieldView& field_;
    LaidOverLog* log_ = nullptr;
    OpeningQueue opener_;
    DescriptionWatch watch_;
    RunSaver saver_;
    static constexpr const char* goneTopic = "gone";
    std::optional<OpenRequest> opened_;
    std::map<std::string, std::string> files_;  ///< that it was read from, with their hashes
    std::vector<Extent> extents_;               ///< of a recording's branches, as it was read; empty: it is none
    std::uint64_t run_ = 0;                     ///< that is open, as Shown::run
    QString network_;                           ///< to be offered once a run is open
    QString changedMeanwhile_;                  ///< why it is to be read again, reported while it was being read
};

}  // namespace mrose::gui

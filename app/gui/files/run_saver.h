#pragma once

#include <QObject>
#include <QString>
#include <cstdint>
#include <functional>
#include <optional>

#include "debug/opened_run.h"
#include "frame/window_frame.h"

namespace mrose::gui {

class DescriptionWatch;

/// What is kept of the window's run: recordings, states, and whether something would be lost. What went wrong is said.
class RunSaver final : public QObject {
    Q_OBJECT

public:
    /// What `watch` watches is never written over.
    RunSaver(const WindowFrame& frame, const DescriptionWatch& watch);
    /// Another run is open, so many branches of which are in a file.
    void setRun(std::uint64_t run, const OpenRequest& opened, std::size_t branches);
    /// One more branch is made from files alone.
    void addSaved() { ++savedBranches_; }

    /// The run with its branches, in the background; once it is saved, `then`. Unattended, it waits. Error: such a file
    /// must not be written; unattended, all errors.
    Expected<void> saveRecording(const QString& path, const std::function<void()>& then = {});
    /// The shown state as a scenario that goes on from there; otherwise as saveRecording().
    Expected<void> saveScenario(const QString& path);
    /// Writes the run to a file while it goes on; an empty one: no more.
    void record(const QString& path, bool overwrite = true);
    const QString& recordedTo() const { return recordedTo_; }
    /// Why the last recording was not begun, or ended too early; empty: nothing went wrong.
    const QString& recordingError() const { return recordingError_; }

    /// For what is saved of what is open: a free name in the folder used last, as "soccer_2.mcap" for ".mcap".
    QString suggestedName(const QString& ending) const;
    /// Asks `over` for such a file, whose extension is that of `ending` unless another is typed. Empty: the user
    /// cancelled.
    QString askForName(QWidget& over, const QString& title, const QString& kinds, const QString& ending) const;

    /// What a user may answer to the question about what would be lost.
    enum class Answer { save, discard, cancel };
    void setQuestion(std::function<Answer(const QString& what)> ask) { ask_ = std::move(ask); }
    bool hasUnsaved() const;
    /// Whether what is unsaved may go. Saves first, where that is the answer, and then calls `then` itself.
    bool mayLeave(const std::function<void()>& then);

signals:
    void recordingTo(const QString& path);  ///< empty: nowhere
    void openWanted(const QString& path);   ///< of what was saved

private:
    Expected<void> checkNotRead(const QString& path) const;
    bool saved(const QString& path, const Expected<bool>& done, std::uint64_t run, std::size_t branches);
    void savedScenario(const QString& path, const Expected<void>& done);
    void recordingChanged(const QString& path, const QString& error);
    void sayNotSaved(const Error& error, const QString& action);
    void sayError(const Error& error, const QString& topic);

    const WindowFrame& frame_;
    const DescriptionWatch& watch_;
    std::function<Answer(const QString&)> ask_;
    std::optional<OpenRequest> opened_;
    std::uint64_t run_ = 0;  ///< as Shown::run
    std::size_t savedBranches_ = 1;
    QString recordedTo_, recordingError_;
};

}  // namespace mrose::gui

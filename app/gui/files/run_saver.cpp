#include "files/run_saver.h"

#include <QFileDialog>
#include <QFileInfo>
#include <QMessageBox>
#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

#include "debug/run_recorder.h"
#include "files/description_watch.h"
#include "frame/actions.h"
#include "frame/window_memory.h"
#include "scenario/state_scenario.h"
#include "session/session.h"
#include "widgets/message_bar.h"
#include "widgets/qt_text.h"
#include "workflow/resources.h"

namespace mrose::gui {
namespace {

using Kind = MessageBar::Kind;

QString fileNameOf(const QString& path) { return QFileInfo(path).fileName(); }

RunSaver::Answer askUser(QWidget& window, const QString& what) {
    QMessageBox box(QMessageBox::Question, QObject::tr("Unsaved work"), what,
                    QMessageBox::Save | QMessageBox::Discard | QMessageBox::Cancel, &window);
    box.setInformativeText(QObject::tr("Save it as a recording?"));
    box.setDefaultButton(QMessageBox::Save);
    switch (box.exec()) {
        case QMessageBox::Save:
            return RunSaver::Answer::save;
        case QMessageBox::Discard:
            return RunSaver::Answer::discard;
        default:
            return RunSaver::Answer::cancel;
    }
}

bool saysOneOf(const QString& cause, std::initializer_list<int> errors) {
    return std::any_of(errors.begin(), errors.end(),
                       [&](int error) { return cause.contains(QString::fromLocal8Bit(std::strerror(error))); });
}

/// What to do where something could not be written, by what the system said of it.
QString adviceFor(const QString& cause) {
    if (saysOneOf(cause, {ENOSPC, EDQUOT, EFBIG})) return QObject::tr("Make room, or save it elsewhere");
    if (saysOneOf(cause, {EACCES, EPERM, EROFS})) return QObject::tr("Nothing may be written there: save it elsewhere");
    return QObject::tr("Save it elsewhere");
}

/// The same of a recording that ended.
QString adviceAfter(const QString& cause) {
    return saysOneOf(cause, {ENOSPC, EDQUOT, EFBIG}) ? QObject::tr("make room, then save all of it")
                                                     : QObject::tr("save all of it elsewhere");
}

}  // namespace

RunSaver::RunSaver(const WindowFrame& frame, const DescriptionWatch& watch) : frame_(frame), watch_(watch) {
    ask_ = [this](const QString& what) { return askUser(frame_.window, what); };
    connect(&frame.session, &Session::recordingChanged, this, &RunSaver::recordingChanged);
}

void RunSaver::setRun(std::uint64_t run, const OpenRequest& opened, std::size_t branches) {
    run_ = run;
    opened_ = opened;
    savedBranches_ = std::max<std::size_t>(1, branches);
}

/// What the run is made from must not be written over.
Expected<void> RunSaver::checkNotRead(const QString& path) const {
    if (!watch_.watches(path.toStdString())) return {};
    return fail(path.toStdString(), "is a file that the run is made from; expected another name");
}

Expected<void> RunSaver::saveRecording(const QString& path, const std::function<void()>& then) {
    if (auto other = checkNotRead(path); !other) return other;
    auto result = std::make_shared<Expected<bool>>(false);
    const std::string commandLine = "mrose-gui " + (opened_ ? opened_->file : "");
    const auto save = [this, path, then, result, commandLine, of = run_](TimeTravel& run, const Progress& progress) {
        *result = saveRun(path.toStdString(), run, commandLine, progress);
        const auto report = [this, path, then, result, of, branches = run.branches().size()] {
            if (saved(path, *result, of, branches) && then) then();
        };
        QMetaObject::invokeMethod(this, report, Qt::QueuedConnection);
    };
    frame_.session.doLongWork(tr("Saving %1").arg(fileNameOf(path)), save, true);
    if (!frame_.actions.unattended()) return {};
    frame_.session.settle();
    if (!*result) return tl::unexpected(result->error());
    return {};
}

QString RunSaver::suggestedName(const QString& ending) const {
    const std::string of = !opened_ ? "run" : opened_->log.empty() ? opened_->file : opened_->log;
    const QString folder = frame_.memory.saveFolder();
    const QString name = (folder.isEmpty() ? "" : folder + '/') + QFileInfo(qtText(of)).completeBaseName();
    QString free = name + ending;
    for (int number = 2; QFileInfo::exists(free); ++number) free = name + '_' + QString::number(number) + ending;
    return free;
}

QString RunSaver::askForName(QWidget& over, const QString& title, const QString& kinds, const QString& ending) const {
    QString path = QFileDialog::getSaveFileName(&over, title, suggestedName(ending), kinds);
    if (path.isEmpty()) return path;
    if (QFileInfo(path).suffix().isEmpty() && ending.contains('.')) path += ending.mid(ending.lastIndexOf('.'));
    frame_.memory.keepSaveFolder(path);
    return path;
}

void RunSaver::sayNotSaved(const Error& error, const QString& action) {
    frame_.messages.add({Kind::error,
                         tr("%1. Nothing is lost: the run is still here. %2")
                             .arg(qtText(error.message()), adviceFor(qtText(error.cause))),
                         "save",
                         {{tr("Save elsewhere\u2026"), tr("Save it to another file"),
                           [this, action] { frame_.actions[action].trigger(); }}}});
}

/// Reports what became of it; whether it is saved.
bool RunSaver::saved(const QString& path, const Expected<bool>& done, std::uint64_t run, std::size_t branches) {
    if (!done) return sayNotSaved(done.error(), "save_recording"), false;
    if (!*done) return frame_.messages.add({Kind::note, tr("Not saved: cancelled"), "save"}), false;
    if (run == run_) savedBranches_ = branches;
    frame_.memory.addRecent(QFileInfo(path).absoluteFilePath());
    frame_.messages.add({Kind::note, tr("Saved %1").arg(path), "save"});
    return true;
}

Expected<void> RunSaver::saveScenario(const QString& path) {
    if (auto other = checkNotRead(path); !other) return other;
    auto result = std::make_shared<Expected<void>>();
    const auto save = [this, path, result](TimeTravel& run, const Progress&) {
        const BranchSetup& setup = run.setup();
        DiskDescriptions disk = openDescriptions();
        *result = !setup.value
                      ? fail(path.toStdString(), "cannot be written: the run has no description")
                      : saveStateAsScenario(path.toStdString(), *setup.value, *setup.scenario, run.state(), disk);
        QMetaObject::invokeMethod(
            this, [this, path, result] { savedScenario(path, *result); }, Qt::QueuedConnection);
    };
    frame_.session.doLongWork(tr("Saving %1").arg(fileNameOf(path)), save, true);
    if (!frame_.actions.unattended()) return {};
    frame_.session.settle();
    return *result;
}

void RunSaver::savedScenario(const QString& path, const Expected<void>& done) {
    if (!done) return sayNotSaved(done.error(), "save_scenario");
    frame_.memory.addRecent(QFileInfo(path).absoluteFilePath());
    frame_.messages.add(
        {Kind::note,
         tr("Saved %1, with its state beside it").arg(path),
         "save",
         {{tr("Open"), tr("Open the scenario that was saved"), [this, path] { emit openWanted(path); }}}});
}

void RunSaver::record(const QString& path, bool overwrite) {
    if (path.isEmpty()) return frame_.session.stopRecording();
    if (const auto other = checkNotRead(path); !other) {
        recordingError_ = qtText(other.error().message());
        return sayError(other.error(), "record");
    }
    const QString commandLine = qtText("mrose-gui " + (opened_ ? opened_->file : "") + " --record ") + path;
    frame_.session.record(path, commandLine, overwrite);
}

void RunSaver::recordingChanged(const QString& path, const QString& error) {
    const QString before = std::exchange(recordedTo_, path);
    recordingError_ = error;
    // Unattended, whoever started it reports it.
    if (!error.isEmpty() && frame_.actions.unattended()) {
        if (!before.isEmpty()) recordingError_ += tr("; the run went on, and its recording ends there");
        return emit recordingTo(path);
    }
    if (!error.isEmpty())
        frame_.messages.add(
            {Kind::error,
             before.isEmpty()
                 ? tr("%1. Nothing is recorded; choose another file").arg(error)
                 : tr("%1. The recording ends here, and the run goes on: %2").arg(error, adviceAfter(error)),
             "record",
             {before.isEmpty()
                  ? MessageBar::Button{tr("Record elsewhere\u2026"), tr("Choose another file"),
                                       [this] { frame_.actions["record_to"].trigger(); }}
                  : MessageBar::Button{tr("Save elsewhere\u2026"), tr("Save the run up to here to another file"),
                                       [this] { frame_.actions["save_recording"].trigger(); }}}});
    else if (path.isEmpty() && !before.isEmpty()) {
        if (frame_.session.current()) savedBranches_ = frame_.session.current()->branches.size();
        frame_.messages.add({Kind::note, tr("Recorded in %1").arg(before), "record"});
    }
    emit recordingTo(path);
}

bool RunSaver::hasUnsaved() const {
    return frame_.session.current() && listedBranches(frame_.session.current()->branches, savedBranches_) > 0;
}

bool RunSaver::mayLeave(const std::function<void()>& then) {
    if (frame_.actions.unattended() || !hasUnsaved()) return true;
    const int count = listedBranches(frame_.session.current()->branches, savedBranches_);
    switch (ask_(tr(count == 1 ? "%1 of this run is not saved." : "%1 of this run are not saved.")
                     .arg(qtText(branchesText(count))))) {
        case Answer::discard:
            savedBranches_ = frame_.session.current()->branches.size();
            return true;
        case Answer::cancel:
            return false;
        case Answer::save:
            break;
    }
    const QString path = frame_.actions.ask("save_recording");
    if (path.isEmpty()) return false;
    if (const auto saving = saveRecording(path, then); !saving) sayError(saving.error(), "save");
    return false;
}

void RunSaver::sayError(const Error& error, const QString& topic) {
    frame_.messages.add({Kind::error, qtText(error.message()), topic});
}

}  // namespace mrose::gui

#include "files/window_files.h"

#include <QDesktopServices>
#include <QFileDialog>
#include <QFileInfo>
#include <QMessageBox>
#include <QMimeData>
#include <QTimer>
#include <QUrl>
#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

#include "debug/run_recorder.h"
#include "frame/actions.h"
#include "frame/window_memory.h"
#include "panels/trial_list.h"
#include "scenario/state_scenario.h"
#include "session/session.h"
#include "widgets/field_view.h"
#include "widgets/message_bar.h"
#include "widgets/qt_text.h"
#include "workflow/file_kind.h"
#include "workflow/resources.h"
#include "world/seconds_text.h"

namespace mrose::gui {
namespace {

using Kind = MessageBar::Kind;

/// Each file's error has its own line.
QString openingOf(const Error& error) { return "open " + qtText(error.file.empty() ? error.message() : error.file); }

QString nameOf(const QString& path) { return QFileInfo(path).fileName(); }

WindowFiles::Answer askUser(QWidget& window, const QString& what) {
    QMessageBox box(QMessageBox::Question, QObject::tr("Unsaved work"), what,
                    QMessageBox::Save | QMessageBox::Discard | QMessageBox::Cancel, &window);
    box.setInformativeText(QObject::tr("Save it as a recording?"));
    box.setDefaultButton(QMessageBox::Save);
    switch (box.exec()) {
        case QMessageBox::Save:
            return WindowFiles::Answer::save;
        case QMessageBox::Discard:
            return WindowFiles::Answer::discard;
        default:
            return WindowFiles::Answer::cancel;
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

WindowFiles::WindowFiles(const Frame& frame, FieldView& field)
    : QObject(&frame.window), frame_(frame), field_(field), opener_(frame, "opening") {
    ask_ = [this](const QString& what) { return askUser(frame_.window, what); };
    connect(&frame.session, &Session::recordingChanged, this, &WindowFiles::recordingChanged);
    // Later: what was opened is taken first.
    const auto readAgain = [this] {
        if (!changedMeanwhile_.isEmpty()) reload(std::exchange(changedMeanwhile_, {}));
    };
    connect(&opener_, &Opener::ended, this, readAgain, Qt::QueuedConnection);
    const auto namesOf = [](const std::vector<std::string>& files) {
        QStringList names;
        for (const std::string& file : files) names << nameOf(qtText(file));
        return names.join(", ");
    };
    connect(&watch_, &DescriptionWatch::changed, this,
            [this, namesOf](const std::vector<std::string>& files) { reload(tr("%1 changed").arg(namesOf(files))); });
    connect(&watch_, &DescriptionWatch::gone, this,
            [this, namesOf](const std::vector<std::string>& files) { sayGone(namesOf(files), files.size()); });
    connect(&watch_, &DescriptionWatch::back, this, [this] { frame_.messages.remove(goneTopic); });
    connect(&watch_, &DescriptionWatch::failed, this, [this](const Error& error) { sayError(error, goneTopic); });
}

void WindowFiles::open(const QString& path, OpenRequest how, std::optional<double> at) {
    how.file = path.toStdString();
    const QFileInfo place(path);
    if (!place.exists()) return open(how, at);  // it may ship
    const auto kind = fileKind(how.file);
    if (!kind) return sayError(kind.error(), openingOf(kind.error()));
    how.file = place.absoluteFilePath().toStdString();
    if (*kind == FileKind::results) return listTrials(place.absoluteFilePath());
    if (*kind == FileKind::log) return log_->openLog(placeOfLog(how.file));
    if (*kind != FileKind::network) return open(how, at);
    if (opened_) return offerNetwork(place.absoluteFilePath());
    // A robot to try it with.
    network_ = place.absoluteFilePath();
    open(OpenRequest{"soccer.toml"});
}

void WindowFiles::open(const OpenRequest& request, std::optional<double> at) {
    if (!mayLeave([this, request, at] { open(request, at); })) return;
    openRunOf(request, [this, at](Expected<OpenRun> run) { (void)take(std::move(run), at); });
}

void WindowFiles::openRunOf(const OpenRequest& request, std::function<void(Expected<OpenRun>)> take) {
    opener_.open(
        request.file, [request](const OpenProgress& progress) { return openRun(request, progress); }, std::move(take));
}

Expected<void> WindowFiles::openNow(const OpenRequest& request, std::optional<double> at) {
    Expected<void> done;
    openRunOf(request, [&, at](Expected<OpenRun> run) { done = take(std::move(run), at); });
    opener_.settle();
    return done;
}

Expected<void> WindowFiles::take(Expected<OpenRun> run, std::optional<double> at) {
    if (!run) {
        sayError(run.error(), openingOf(run.error()));
        frame_.memory.forgetRecent(qtText(run.error().file));
        return tl::unexpected(run.error());
    }
    frame_.messages.clear();
    show(*run, run->source.file);
    log_->follow(*run);
    for (const std::string& note : run->notes) frame_.messages.add({Kind::note, qtText(note)});
    offerBranches(*run, run->shown && !at);
    if (!network_.isEmpty()) offerNetwork(std::exchange(network_, {}));
    frame_.memory.addRecent(qtText(run->source.file));
    return at ? goTo(*run, *at) : Expected<void>{};
}

/// A recording has no more; a run can be simulated beyond the end that its scenario gives, where the user can end that.
Expected<void> WindowFiles::goTo(const OpenRun& run, double at) {
    const Scene& scene = run.setup->scene();
    const std::int64_t end = run.recorded() ? run.branches.front().branch.timeline.last()
                                            : scene.ticksOf(run.setup->scenario->parts().duration);
    std::int64_t tick = scene.ticksOf(fromSeconds(at));
    if (tick > end && !run.recorded() && frame_.actions.unattended())
        return fail(run.source.file, "lasts " + plainSeconds(scene.timeOf(end)) + " s, and not the " +
                                         plainSeconds(scene.timeOf(tick)) + " s that were asked for");
    if (tick > end)
        frame_.messages.add(
            {Kind::note, (run.recorded() ? tr("The recording ends at %1 s, before the %2 s that were asked for")
                                         : tr("The scenario lasts %1 s; it is simulated beyond its end, up to "
                                              "the %2 s that were asked for"))
                             .arg(toSeconds(scene.timeOf(end)), 0, 'f', 2)
                             .arg(at, 0, 'f', 2)});
    if (run.recorded()) tick = std::min(tick, end);
    frame_.session.seek(tick, false);
    return {};
}

std::uint64_t WindowFiles::takeRollout(const OpenRun& run) { return show(run, run.source.log); }

std::uint64_t WindowFiles::show(const OpenRun& run, const std::string& breakpointsOf) {
    opened_ = run.source;
    changedMeanwhile_.clear();
    files_ = run.files;
    extents_ = extentsOf(run);
    watch_.watch(run.files, run.recorded() ? std::vector{run.source.file} : std::vector<std::string>{});
    savedBranches_ = std::max<std::size_t>(1, run.branches.size());
    run_ = frame_.session.open(run);
    frame_.memory.restoreBreakpoints(qtText(breakpointsOf), run_);
    return run_;
}

/// A recording is shown where it was saved, or from the run's beginning: what else it holds is one click away.
void WindowFiles::offerBranches(const OpenRun& run, bool atItsPlace) {
    if (atItsPlace) frame_.session.show(run.shown->branch, run.shown->tick);
    if (run.branches.size() < 2) return;
    const bool runShown = !atItsPlace || run.shown->branch == 0;
    const auto nameOfBranch = [&](std::size_t branch) {
        const std::string& name = run.branches[branch].branch.name;
        return name.empty() ? tr("a branch") : tr("\u201c%1\u201d").arg(qtText(name));
    };
    const auto other = static_cast<std::uint32_t>(runShown ? run.branches.size() - 1 : 0);
    const std::int64_t tick = runShown ? run.branches[other].branch.timeline.first() : run.shown->tick;
    const QString file = nameOf(qtText(run.source.file)),
                  count = qtText(branchesText(static_cast<int>(run.branches.size() - 1)));
    frame_.messages.add(
        {Kind::note,
         runShown ? tr("%1 holds the run, which is shown, and %2 of it").arg(file, count)
                  : tr("%1 holds the run and %2 of it: %3 is shown, as when it was saved")
                        .arg(file, count, nameOfBranch(run.shown->branch)),
         "branches",
         {{tr("Show %1").arg(runShown ? nameOfBranch(other) : tr("the run")),
           runShown ? tr("The branch that was begun last, where it begins") : tr("What was before any change"),
           [this, other, tick] {
               frame_.session.show(other, tick);
               frame_.messages.remove("branches");
           }}}});
}

void WindowFiles::drop(const QMimeData& what) {
    QStringList files;
    for (const QUrl& url : what.urls())
        if (url.isLocalFile()) files << url.toLocalFile();
    if (files.isEmpty())
        return frame_.messages.add(
            {Kind::note, tr("Only files of this computer can be opened; save it first"), "open"});
    if (files.size() > 1)
        frame_.messages.add(
            {Kind::note, tr("%1 files were dropped; opening %2").arg(files.size()).arg(nameOf(files[0]))});
    // Later: who drops waits for the answer, and there may be a question to the user first.
    QTimer::singleShot(0, this, [this, file = files[0]] { open(file); });
}

void WindowFiles::offerNetwork(const QString& path) {
    if (log_->isOpen()) return offerModel(path);
    const auto selected = field_.selected();
    const bool robot =
        selected && frame_.session.current() && *selected < frame_.session.current()->frame->state.robots.size();
    if (robot) {
        frame_.messages.remove("network");
        if (const auto done = frame_.actions.perform("swap_model", path); !done) sayError(done.error(), "network");
        return;
    }
    frame_.messages.add(
        {Kind::note,
         tr("%1 is a network: select a robot first, then use it as this robot's motion model").arg(nameOf(path)),
         "network",
         {{tr("Use for the selected robot"), tr("Swap the motion model of the selected robot"),
           [this, path] { offerNetwork(path); }}}});
}

/// Beside a log a network has two uses.
void WindowFiles::offerModel(const QString& path) {
    frame_.messages.add({Kind::note,
                         tr("%1 is a network").arg(nameOf(path)),
                         "network",
                         {{tr("Lay over"), tr("Show beside the run what it makes of the same commands"),
                           [this, path] {
                               frame_.messages.remove("network");
                               log_->addModel(path.toStdString());
                           }},
                          {tr("Use for the selected robot"),
                           tr("Swap the motion model of the selected robot, as a branch"), [this, path] {
                               frame_.messages.remove("network");
                               if (const auto done = frame_.actions.perform("swap_model", path); !done)
                                   sayError(done.error(), "network");
                           }}}});
}

void WindowFiles::listTrials(const QString& path) {
    auto trials = readTrials(path.toStdString());
    if (!trials) return sayError(trials.error(), openingOf(trials.error()));
    field_.setEmptyText(tr("Choose one of the runs in the list"));
    auto* list = new TrialList(path, std::move(*trials), &frame_.window);
    connect(list, &TrialList::chosen, this, [this](const OpenRequest& request, double at) { open(request, at); });
    list->show();
}

/// What the run is made from must not be written over.
Expected<void> WindowFiles::checkNotRead(const QString& path) const {
    if (!watch_.watches(path.toStdString())) return {};
    return fail(path.toStdString(), "is a file that the run is made from; expected another name");
}

Expected<void> WindowFiles::saveRecording(const QString& path, const std::function<void()>& then) {
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
    frame_.session.doLongWork(tr("Saving %1").arg(nameOf(path)), save, true);
    if (!frame_.actions.unattended()) return {};
    frame_.session.settle();
    if (!*result) return tl::unexpected(result->error());
    return {};
}

QString WindowFiles::suggestedName(const QString& ending) const {
    const std::string of = !opened_ ? "run" : opened_->log.empty() ? opened_->file : opened_->log;
    const QString folder = frame_.memory.saveFolder();
    const QString name = (folder.isEmpty() ? "" : folder + '/') + QFileInfo(qtText(of)).completeBaseName();
    QString free = name + ending;
    for (int number = 2; QFileInfo::exists(free); ++number) free = name + '_' + QString::number(number) + ending;
    return free;
}

QString WindowFiles::askForName(QWidget& over, const QString& title, const QString& kinds,
                                const QString& ending) const {
    QString path = QFileDialog::getSaveFileName(&over, title, suggestedName(ending), kinds);
    if (path.isEmpty()) return path;
    if (QFileInfo(path).suffix().isEmpty() && ending.contains('.')) path += ending.mid(ending.lastIndexOf('.'));
    frame_.memory.keepSaveFolder(path);
    return path;
}

void WindowFiles::sayNotSaved(const Error& error, const QString& action) {
    frame_.messages.add({Kind::error,
                         tr("%1. Nothing is lost: the run is still here. %2")
                             .arg(qtText(error.message()), adviceFor(qtText(error.cause))),
                         "save",
                         {{tr("Save elsewhere\u2026"), tr("Save it to another file"),
                           [this, action] { frame_.actions[action].trigger(); }}}});
}

/// Reports what became of it; whether it is saved.
bool WindowFiles::saved(const QString& path, const Expected<bool>& done, std::uint64_t run, std::size_t branches) {
    if (!done) return sayNotSaved(done.error(), "save_recording"), false;
    if (!*done) return frame_.messages.add({Kind::note, tr("Not saved: cancelled"), "save"}), false;
    if (run == run_) savedBranches_ = branches;
    frame_.memory.addRecent(QFileInfo(path).absoluteFilePath());
    frame_.messages.add({Kind::note, tr("Saved %1").arg(path), "save"});
    return true;
}

Expected<void> WindowFiles::saveScenario(const QString& path) {
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
    frame_.session.doLongWork(tr("Saving %1").arg(nameOf(path)), save, true);
    if (!frame_.actions.unattended()) return {};
    frame_.session.settle();
    return *result;
}

void WindowFiles::savedScenario(const QString& path, const Expected<void>& done) {
    if (!done) return sayNotSaved(done.error(), "save_scenario");
    frame_.memory.addRecent(QFileInfo(path).absoluteFilePath());
    frame_.messages.add({Kind::note,
                         tr("Saved %1, with its state beside it").arg(path),
                         "save",
                         {{tr("Open"), tr("Open the scenario that was saved"), [this, path] { open(path); }}}});
}

void WindowFiles::record(const QString& path, bool overwrite) {
    if (path.isEmpty()) return frame_.session.stopRecording();
    if (const auto other = checkNotRead(path); !other) {
        recordingError_ = qtText(other.error().message());
        return sayError(other.error(), "record");
    }
    const QString commandLine = qtText("mrose-gui " + (opened_ ? opened_->file : "") + " --record ") + path;
    frame_.session.record(path, commandLine, overwrite);
}

void WindowFiles::recordingChanged(const QString& path, const QString& error) {
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

bool WindowFiles::hasUnsaved() const {
    return frame_.session.current() && listedBranches(frame_.session.current()->branches, savedBranches_) > 0;
}

bool WindowFiles::mayLeave(const std::function<void()>& then) {
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

void WindowFiles::sayError(const Error& error, const QString& topic) {
    frame_.messages.add({Kind::error, qtText(error.message()), topic});
}

}  // namespace mrose::gui

#include "window_files.h"

#include <QDesktopServices>
#include <QFileInfo>
#include <QMessageBox>
#include <QMimeData>
#include <QTimer>
#include <QUrl>
#include <utility>

#include "file_kind.h"
#include "main_window.h"
#include "overlay.h"
#include "run_recorder.h"
#include "scenario/state_scenario.h"
#include "trial_list.h"
#include "view_export.h"
#include "widgets/field_view.h"
#include "widgets/message_bar.h"
#include "window_memory.h"

namespace mrose::gui {
namespace {

using Kind = MessageBar::Kind;

QString text(const std::string& words) { return QString::fromStdString(words); }

QString nameOf(const QString& path) { return QFileInfo(path).fileName(); }

WindowFiles::Answer askUser(MainWindow& window, const QString& what) {
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

}  // namespace

WindowFiles::WindowFiles(MainWindow& window, MessageBar& messages)
    : QObject(&window), window_(window), messages_(messages) {
    ask_ = [this](const QString& what) { return askUser(window_, what); };
    connect(&window.session(), &Session::recordingChanged, this, &WindowFiles::recordingChanged);
    connect(&watch_, &DescriptionWatch::changed, this, [this](const std::vector<std::string>& files) {
        QStringList names;
        for (const std::string& file : files) names << nameOf(text(file));
        reload(tr("%1 changed").arg(names.join(", ")));
    });
}

void WindowFiles::open(const QString& path, OpenRequest how, std::optional<double> at) {
    how.file = path.toStdString();
    const QFileInfo place(path);
    if (!place.exists()) return open(how, at);  // it may ship
    const auto kind = fileKind(how.file);
    if (!kind) return sayError(kind.error(), "open");
    how.file = place.absoluteFilePath().toStdString();
    if (*kind == FileKind::results) return listTrials(place.absoluteFilePath());
    if (*kind == FileKind::log) return window_.overlay().open({how.file, ""});
    if (*kind != FileKind::network) return open(how, at);
    if (opened_) return offerNetwork(place.absoluteFilePath());
    // A robot to try it with.
    network_ = place.absoluteFilePath();
    open(OpenRequest{"soccer.toml"});
}

void WindowFiles::open(const OpenRequest& request, std::optional<double> at) {
    if (!mayLeave([this, request, at] { open(request, at); })) return;
    opener_.open(request, [this, at](Expected<OpenRun> run) { (void)take(std::move(run), at); });
}

Expected<void> WindowFiles::openNow(const OpenRequest& request, std::optional<double> at) {
    Expected<void> done;
    opener_.open(request, [&, at](Expected<OpenRun> run) { done = take(std::move(run), at); });
    opener_.settle();
    return done;
}

Expected<void> WindowFiles::take(Expected<OpenRun> run, std::optional<double> at) {
    if (!run) {
        sayError(run.error(), "open");
        window_.memory().forgetRecent(text(run.error().file));
        return tl::unexpected(run.error());
    }
    messages_.clear();
    takeCourse(*run);
    window_.memory().restoreBreakpoints();
    window_.overlay().follow(*run);
    for (const std::string& note : run->notes) messages_.add({Kind::note, text(note)});
    offerBranches(*run);
    if (!network_.isEmpty()) offerNetwork(std::exchange(network_, {}));
    window_.memory().addRecent(text(run->source.file));
    if (!at) return {};
    const Scene& scene = run->course->scene();
    std::int64_t tick = scene.ticksOf(fromSeconds(*at));
    if (run->recorded()) {
        const std::int64_t last = run->branches.front().branch.timeline.last();
        if (tick > last)
            messages_.add({Kind::note, tr("The recording ends at %1 s, before the %2 s that were asked for")
                                           .arg(toSeconds(scene.timeOf(last)), 0, 'f', 2)
                                           .arg(*at, 0, 'f', 2)});
        tick = std::min(tick, last);
    }
    window_.session().seek(tick, false);
    return {};
}

void WindowFiles::takeCourse(const OpenRun& run) {
    opened_ = run.source;
    watch_.watch(run.files);
    savedBranches_ = std::max<std::size_t>(1, run.branches.size());
    window_.show(run);
}

/// A recording begins with the run itself: what was tried in it last is one click away.
void WindowFiles::offerBranches(const OpenRun& run) {
    if (run.branches.size() < 2) return;
    const auto last = static_cast<std::uint32_t>(run.branches.size() - 1);
    const Branch& branch = run.branches.back().branch;
    const QString name = branch.name.empty() ? tr("the last one") : tr("\u201c%1\u201d").arg(text(branch.name));
    messages_.add({Kind::note,
                   tr("%1 holds the run, which is shown, and %n branch(es) of it", nullptr, static_cast<int>(last))
                       .arg(nameOf(text(run.source.file))),
                   "branches",
                   {{tr("Show %1").arg(name), tr("The branch that was begun last, where it begins"),
                     [this, last, tick = branch.timeline.first()] {
                         window_.session().show(last, tick);
                         messages_.remove("branches");
                     }}}});
}

void WindowFiles::drop(const QMimeData& what) {
    QStringList files;
    for (const QUrl& url : what.urls())
        if (url.isLocalFile()) files << url.toLocalFile();
    if (files.isEmpty())
        return messages_.add({Kind::note, tr("Only files of this computer can be opened; save it first"), "open"});
    if (files.size() > 1)
        messages_.add({Kind::note, tr("%1 files were dropped; opening %2").arg(files.size()).arg(nameOf(files[0]))});
    // Later: who drops waits for the answer, and there may be a question to the user first.
    QTimer::singleShot(0, this, [this, file = files[0]] { open(file); });
}

void WindowFiles::offerNetwork(const QString& path) {
    if (window_.overlay().world()) return offerModel(path);
    const auto selected = window_.field().selected();
    const bool robot = selected && window_.shown() && *selected < window_.shown()->frame->state.robots.size();
    if (robot) {
        messages_.remove("network");
        if (const auto done = window_.actions().perform("swap_model", path); !done) sayError(done.error(), "network");
        return;
    }
    messages_.add(
        {Kind::note,
         tr("%1 is a network: select a robot first, then use it as this robot's motion model").arg(nameOf(path)),
         "network",
         {{tr("Use for the selected robot"), tr("Swap the motion model of the selected robot"),
           [this, path] { offerNetwork(path); }}}});
}

/// Beside a log a network has two uses.
void WindowFiles::offerModel(const QString& path) {
    messages_.add({Kind::note,
                   tr("%1 is a network").arg(nameOf(path)),
                   "network",
                   {{tr("Lay over"), tr("Show beside the run what it makes of the same commands"),
                     [this, path] {
                         messages_.remove("network");
                         window_.overlay().addModel(path.toStdString());
                     }},
                    {tr("Use for the selected robot"), tr("Swap the motion model of the selected robot, as a branch"),
                     [this, path] {
                         messages_.remove("network");
                         if (const auto done = window_.actions().perform("swap_model", path); !done)
                             sayError(done.error(), "network");
                     }}}});
}

void WindowFiles::listTrials(const QString& path) {
    auto trials = readTrials(path.toStdString());
    if (!trials) return sayError(trials.error(), "open");
    window_.field().setEmptyText(tr("Choose one of the runs in the list"));
    auto* list = new TrialList(path, std::move(*trials), &window_);
    connect(list, &TrialList::chosen, this, [this](const OpenRequest& request, double at) { open(request, at); });
    list->show();
}

void WindowFiles::reload(const QString& why) {
    if (!opened_ || opener_.busy()) return;
    OpenRequest request = *opened_;
    const Shown* const shown = window_.shown();
    // A seed of the user's own stays; the scenario's may be what has changed.
    if (shown && shown->frame->state.seed != shown->frame->scenario->parts().seed)
        request.seed = shown->frame->state.seed;
    opener_.open(request, [this, why](Expected<OpenRun> run) { takeReloaded(std::move(run), why); });
}

void WindowFiles::takeReloaded(Expected<OpenRun> run, const QString& why) {
    const Shown* const shown = window_.shown();
    if (!run) {
        messages_.add({Kind::error,
                       tr("%1. What was read before goes on; once the file is mended it is read again")
                           .arg(text(run.error().message())),
                       "reload",
                       {{tr("Show file"), tr("Open it with the program for such files"),
                         [file = text(run.error().file)] {
                             QDesktopServices::openUrl(QUrl::fromLocalFile(QFileInfo(file).absoluteFilePath()));
                         }},
                        {tr("Reload"), tr("Read it again now"), [this, why] { reload(why); }}}});
        return;
    }
    messages_.remove("reload");
    watch_.watch(run->files);
    if (!shown) return;
    Edit edit;
    edit.name = why.toStdString();
    edit.tick = shown->first;
    edit.course = run->course;
    edit.start = std::move(run->start);
    const bool goesOn = shown->playing;
    ++savedBranches_;  // nobody's work
    window_.session().branchOff(edit, shown->tick());
    if (goesOn) window_.session().play();
    messages_.add({Kind::note,
                   tr("%1: the run was simulated again up to here; the course before is shown as a ghost").arg(why),
                   "reload",
                   {{tr("Undo"), tr("Back to the course before"), [this] {
                         window_.session().undo();
                         messages_.remove("reload");
                     }}}});
}

Expected<void> WindowFiles::savePicture(const QString& path) {
    FieldView& field = window_.field();
    return writePicture({field.size(), field.logicalDpiX(), window_.windowTitle(),
                         [&field](QPainter& painter) { field.paint(painter, field.size()); }},
                        path);
}

/// What the run is made from must not be written over.
Expected<void> WindowFiles::checkNotRead(const QString& path) const {
    if (!watch_.watches(path.toStdString())) return {};
    return fail(path.toStdString(), "is a file that the run is made from; expected another name");
}

Expected<void> WindowFiles::saveRecording(const QString& path) {
    if (auto other = checkNotRead(path); !other) return other;
    auto result = std::make_shared<Expected<bool>>(false);
    const std::string commandLine = "mrose-gui " + (opened_ ? opened_->file : "");
    window_.session().run(tr("Saving %1").arg(nameOf(path)), [this, path, result, commandLine](
                                                                 TimeTravel& run, const Session::Progress& progress) {
        *result = saveRun(path.toStdString(), run, commandLine, progress);
        const std::size_t branches = run.branches().size();
        QMetaObject::invokeMethod(
            this, [this, path, result, branches] { saved(path, *result, branches); }, Qt::QueuedConnection);
        return QString();
    });
    if (!window_.actions().unattended()) return {};
    window_.session().settle();
    if (!*result) return tl::unexpected(result->error());
    return {};
}

void WindowFiles::sayNotSaved(const Error& error, const QString& action) {
    messages_.add(
        {Kind::error,
         tr("%1. Nothing is lost: the run is still here. Make room, or save it elsewhere").arg(text(error.message())),
         "save",
         {{tr("Save elsewhere\u2026"), tr("Save it to another file"),
           [this, action] { window_.actions()[action].trigger(); }}}});
}

void WindowFiles::saved(const QString& path, const Expected<bool>& done, std::size_t branches) {
    const auto next = std::exchange(afterSaving_, {});
    if (!done) {
        sayNotSaved(done.error(), "save_recording");
        return;
    }
    if (!*done) return messages_.add({Kind::note, tr("Not saved: cancelled"), "save"});
    savedBranches_ = branches;
    window_.memory().addRecent(QFileInfo(path).absoluteFilePath());
    messages_.add({Kind::note, tr("Saved %1").arg(path), "save"});
    if (next) next();
}

Expected<void> WindowFiles::saveScenario(const QString& path) {
    if (auto other = checkNotRead(path); !other) return other;
    auto result = std::make_shared<Expected<void>>();
    window_.session().run(
        tr("Saving %1").arg(nameOf(path)), [this, path, result](TimeTravel& run, const Session::Progress&) {
            const Course& course = run.course();
            *result = saveStateAsScenario(path.toStdString(), course.descriptions, *course.scenario, run.state());
            QMetaObject::invokeMethod(
                this, [this, path, result] { savedScenario(path, *result); }, Qt::QueuedConnection);
            return QString();
        });
    if (!window_.actions().unattended()) return {};
    window_.session().settle();
    return *result;
}

void WindowFiles::savedScenario(const QString& path, const Expected<void>& done) {
    if (!done) return sayNotSaved(done.error(), "save_scenario");
    window_.memory().addRecent(QFileInfo(path).absoluteFilePath());
    messages_.add({Kind::note,
                   tr("Saved %1, with its state beside it").arg(path),
                   "save",
                   {{tr("Open"), tr("Open the scenario that was saved"), [this, path] { open(path); }}}});
}

void WindowFiles::record(const QString& path, bool overwrite) {
    if (path.isEmpty()) return window_.session().stopRecording();
    if (const auto other = checkNotRead(path); !other) {
        recordingError_ = text(other.error().message());
        return sayError(other.error(), "record");
    }
    const QString commandLine = text("mrose-gui " + (opened_ ? opened_->file : "") + " --record ") + path;
    window_.session().record(path, commandLine, overwrite);
}

void WindowFiles::recordingChanged(const QString& path, const QString& error) {
    const QString before = std::exchange(recordedTo_, path);
    recordingError_ = error;
    if (!error.isEmpty())
        messages_.add(
            {Kind::error,
             before.isEmpty()
                 ? tr("%1. Nothing is recorded; choose another file").arg(error)
                 : tr("%1. The recording ends here, and the run goes on: make room, then save all of it").arg(error),
             "record",
             {before.isEmpty()
                  ? MessageBar::Button{tr("Record elsewhere\u2026"), tr("Choose another file"),
                                       [this] { window_.actions()["record_to"].trigger(); }}
                  : MessageBar::Button{tr("Save elsewhere\u2026"), tr("Save the run up to here to another file"),
                                       [this] { window_.actions()["save_recording"].trigger(); }}}});
    else if (path.isEmpty() && !before.isEmpty()) {
        if (window_.shown()) savedBranches_ = window_.shown()->branches.size();
        messages_.add({Kind::note, tr("Recorded in %1").arg(before), "record"});
    }
    emit recordingTo(path);
}

bool WindowFiles::hasUnsaved() const { return window_.shown() && window_.shown()->branches.size() > savedBranches_; }

bool WindowFiles::mayLeave(const std::function<void()>& then) {
    if (window_.actions().unattended() || !hasUnsaved()) return true;
    const auto count = static_cast<int>(window_.shown()->branches.size() - savedBranches_);
    switch (ask_(tr("%n branch(es) of this run are not saved.", nullptr, count))) {
        case Answer::discard:
            savedBranches_ = window_.shown()->branches.size();
            return true;
        case Answer::cancel:
            return false;
        case Answer::save:
            break;
    }
    afterSaving_ = then;
    window_.actions()["save_recording"].trigger();
    return false;
}

void WindowFiles::sayError(const Error& error, const QString& topic) {
    messages_.add({Kind::error, text(error.message()), topic});
}

}  // namespace mrose::gui

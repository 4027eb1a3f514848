#include "files/window_files.h"

#include <QDesktopServices>
#include <QFileInfo>
#include <QMimeData>
#include <QTimer>
#include <QUrl>
#include <algorithm>
#include <utility>

#include "frame/actions.h"
#include "frame/window_memory.h"
#include "panels/trial_list.h"
#include "session/session.h"
#include "widgets/field_view.h"
#include "widgets/message_bar.h"
#include "widgets/qt_text.h"
#include "workflow/file_kind.h"
#include "workflow/open_run.h"
#include "workflow/resources.h"
#include "world/seconds_text.h"

namespace mrose::gui {
namespace {

using Kind = MessageBar::Kind;

/// Each file's error has its own line.
QString openingOf(const Error& error) { return "open " + qtText(error.file.empty() ? error.message() : error.file); }

QString nameOf(const QString& path) { return QFileInfo(path).fileName(); }

}  // namespace

WindowFiles::WindowFiles(const WindowFrame& frame, FieldView& field)
    : QObject(&frame.window), frame_(frame), field_(field), opener_(frame, "opening"), saver_(frame, watch_) {
    connect(&saver_, &RunSaver::openWanted, this, [this](const QString& path) { open(path); });
    // Later: what was opened is taken first.
    const auto readAgain = [this] {
        if (!changedMeanwhile_.isEmpty()) reload(std::exchange(changedMeanwhile_, {}));
    };
    connect(&opener_, &OpeningQueue::ended, this, readAgain, Qt::QueuedConnection);
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
    if (!saver_.mayLeave([this, request, at] { open(request, at); })) return;
    openRunOf(request, [this, at](Expected<OpenedRun> run) { (void)take(std::move(run), at); });
}

void WindowFiles::openRunOf(const OpenRequest& request, std::function<void(Expected<OpenedRun>)> take) {
    opener_.open(
        request.file, [request](const OpenProgress& progress) { return openRun(request, progress); }, std::move(take));
}

Expected<void> WindowFiles::openNow(const OpenRequest& request, std::optional<double> at) {
    Expected<void> done;
    openRunOf(request, [&, at](Expected<OpenedRun> run) { done = take(std::move(run), at); });
    opener_.settle();
    return done;
}

Expected<void> WindowFiles::take(Expected<OpenedRun> run, std::optional<double> at) {
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
Expected<void> WindowFiles::goTo(const OpenedRun& run, double at) {
    const Scene& scene = run.setup->scene();
    const std::int64_t end = run.recorded() ? run.branches.front().branch.timeline.last()
                                            : run.start.tick + scene.ticksOf(run.setup->scenario->parts().duration);
    std::int64_t tick = scene.ticksOf(fromSeconds(at));
    if (tick > end && !run.recorded() && frame_.actions.unattended())
        return fail(run.source.file, "ends at " + plainSeconds(scene.timeOf(end)) + " s, before the " +
                                         plainSeconds(scene.timeOf(tick)) + " s that were asked for");
    if (tick > end)
        frame_.messages.add(
            {Kind::note, (run.recorded() ? tr("The recording ends at %1 s, before the %2 s that were asked for")
                                         : tr("The scenario ends at %1 s; it is simulated beyond its end, up to "
                                              "the %2 s that were asked for"))
                             .arg(toSeconds(scene.timeOf(end)), 0, 'f', 2)
                             .arg(at, 0, 'f', 2)});
    if (run.recorded()) tick = std::min(tick, end);
    frame_.session.seek(tick, false);
    return {};
}

std::uint64_t WindowFiles::takeRollout(const OpenedRun& run) { return show(run, run.source.log); }

std::uint64_t WindowFiles::show(const OpenedRun& run, const std::string& breakpointsOf) {
    opened_ = run.source;
    changedMeanwhile_.clear();
    files_ = run.files;
    extents_ = extentsOf(run);
    watch_.watch(run.files, run.recorded() ? std::vector{run.source.file} : std::vector<std::string>{});
    run_ = frame_.session.open(run);
    saver_.setRun(run_, run.source, run.branches.size());
    frame_.memory.restoreBreakpoints(qtText(breakpointsOf), run_);
    return run_;
}

/// A recording is shown where it was saved, or from the run's beginning: what else it holds is one click away.
void WindowFiles::offerBranches(const OpenedRun& run, bool atItsPlace) {
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

void WindowFiles::reload(const QString& why) {
    if (!opened_) return;
    if (opener_.busy()) {
        changedMeanwhile_ = why;
        return;
    }
    if (log_->reload(why)) return;
    OpenRequest request = *opened_;
    const Shown* const shown = frame_.session.current().get();
    // A seed of the user's own stays; the scenario's may be what has changed.
    if (shown && shown->frame->state.seed != shown->frame->scenario->parts().seed)
        request.seed = shown->frame->state.seed;
    openRunOf(request, [this, why](Expected<OpenedRun> run) {
        if (run && run->recorded()) return takeGrown(*run);
        const Shown* const now = frame_.session.current().get();
        // A plug-in that crashed or was too slow gets another chance.
        if (run && now && run->files == files_ && *run->setup->value == *now->setup->value && now->faults.empty())
            return sayUnchanged();
        takeReloaded(std::move(run), why);
    });
}

void WindowFiles::sayUnchanged() {
    frame_.messages.remove("reload");
    changedMeanwhile_.clear();
    frame_.messages.add(
        {Kind::note, tr("Nothing has changed in what %1 is made from").arg(nameOf(qtText(opened_->file))), "reload"});
}

std::vector<WindowFiles::Extent> WindowFiles::extentsOf(const OpenedRun& run) {
    std::vector<Extent> extents;
    for (const OpenedRun::Recorded& recorded : run.branches) {
        const Timeline& timeline = recorded.branch.timeline;
        const bool any = timeline.last() > timeline.first();
        extents.push_back({timeline.last(), any ? timeline.hashAt(timeline.last()) : hashOf(recorded.start)});
    }
    return extents;
}

/// A recording that is being written: from the place that is shown one goes on.
void WindowFiles::takeGrown(const OpenedRun& run) {
    const QString name = nameOf(qtText(run.source.file));
    const bool same = extentsOf(run) == extents_;
    if (same)
        frame_.messages.add(
            {Kind::note, tr("Nothing has changed: %1 goes no further than it did").arg(name), "reload"});
    if (same || !saver_.mayLeave([this, run] { takeGrown(run); })) return;
    const Shown* const shown = frame_.session.current().get();
    const bool known = shown && shown->branch < extents_.size();
    const ShownPlace place = known ? ShownPlace{shown->branch, shown->tick()} : ShownPlace{};
    frame_.messages.clear();
    const auto selected = field_.selected();
    const std::optional<ViewTransform> view =
        field_.viewport().showsAll() ? std::nullopt : std::optional(field_.transform());
    show(run, run.source.file);
    if (view) field_.setView(*view);
    field_.setSelected(selected);
    log_->follow(run);
    for (const std::string& note : run.notes) frame_.messages.add({Kind::note, qtText(note)});
    if (known && place.branch < run.branches.size()) frame_.session.show(place.branch, place.tick);
    const Nanoseconds end = run.setup->scene().timeOf(run.branches.front().branch.timeline.last());
    frame_.messages.add(
        {Kind::note, tr("%1 was read on: it goes up to %2 s now").arg(name).arg(toSeconds(end), 0, 'f', 2), "reload"});
}

/// What is said of the files' earlier contents is no more.
void WindowFiles::sayGone(const QString& names, std::size_t count) {
    frame_.messages.remove("reload");
    const bool recorded = !extents_.empty();
    frame_.messages.add(
        {Kind::note,
         (recorded    ? tr("%1 was removed or emptied. All of it is still here, and can be saved")
          : count > 1 ? tr("%1 were removed. The run goes on with what was read from them")
                      : tr("%1 was removed. The run goes on with what was read from it"))
             .arg(names),
         goneTopic,
         {recorded ? MessageBar::Button{tr("Save recording\u2026"), tr("Save the run and all its branches"),
                                        [this] { frame_.actions["save_recording"].trigger(); }}
                   : MessageBar::Button{tr("Save state\u2026"), tr("Save a scenario that goes on from the shown tick"),
                                        [this] { frame_.actions["save_scenario"].trigger(); }}}});
}

void WindowFiles::takeReloaded(Expected<OpenedRun> run, const QString& why) {
    const Shown* const shown = frame_.session.current().get();
    if (!run) {
        if (!extents_.empty()) return sayError(run.error(), "reload");
        frame_.messages.add({Kind::error,
                             tr("%1. What was read before goes on; once the file is mended it is read again")
                                 .arg(qtText(run.error().message())),
                             "reload",
                             {{tr("Show file"), tr("Open it with the program for such files"),
                               [file = qtText(run.error().file)] {
                                   QDesktopServices::openUrl(QUrl::fromLocalFile(QFileInfo(file).absoluteFilePath()));
                               }},
                              {tr("Reload"), tr("Read it again now"), [this, why] { reload(why); }}}});
        return;
    }
    frame_.messages.remove("reload");
    changedMeanwhile_.clear();  // what was not read yet is found by looking again
    files_ = run->files;
    watch_.watch(run->files);
    if (!shown) return;
    Edit edit;
    edit.name = why.toStdString();
    edit.tick = shown->first;
    edit.setup = run->setup;
    edit.start = std::move(run->start);
    const bool goesOn = shown->playing;
    const auto unattendedWork = [this, of = run_] {
        if (run_ == of) saver_.addSaved();
    };
    frame_.session.branchOff(edit, shown->tick(), [this, unattendedWork] {
        QMetaObject::invokeMethod(this, unattendedWork, Qt::QueuedConnection);
    });
    if (goesOn) frame_.session.play();
    frame_.messages.add({Kind::note,
                         tr("%1: the run was simulated again up to here; the run before is shown as a ghost").arg(why),
                         "reload",
                         {{tr("Undo"), tr("Back to the run before"), [this] {
                               frame_.session.ask(&Debugger::undo);
                               frame_.messages.remove("reload");
                           }}}});
}

void WindowFiles::sayError(const Error& error, const QString& topic) {
    frame_.messages.add({Kind::error, qtText(error.message()), topic});
}

}  // namespace mrose::gui

#include <QDesktopServices>
#include <QFileInfo>
#include <QUrl>
#include <algorithm>
#include <utility>

#include "files/window_files.h"
#include "frame/actions.h"
#include "session/session.h"
#include "widgets/field_view.h"
#include "widgets/message_bar.h"
#include "widgets/qt_text.h"

namespace mrose::gui {
namespace {

QString fileName(const std::string& path) { return QFileInfo(qtText(path)).fileName(); }

}  // namespace

void WindowFiles::reload(const QString& why) {
    if (!opened_) return;
    if (opener_.busy()) {
        changedMeanwhile_ = why;
        return;
    }
    if (log_->reload(why)) return;
    OpenRequest request = *opened_;
    const Shown* const shown = frame_.session.current();
    // A seed of the user's own stays; the scenario's may be what has changed.
    if (shown && shown->frame->state.seed != shown->frame->scenario->parts().seed)
        request.seed = shown->frame->state.seed;
    openRunOf(request, [this, why](Expected<OpenRun> run) {
        if (run && run->recorded()) return takeGrown(*run);
        const Shown* const now = frame_.session.current();
        // A plug-in that crashed or was too slow gets another chance.
        if (run && now && run->files == files_ && *run->setup->value == *now->setup->value && now->faults.empty())
            return sayUnchanged();
        takeReloaded(std::move(run), why);
    });
}

void WindowFiles::sayUnchanged() {
    frame_.messages.remove("reload");
    changedMeanwhile_.clear();
    frame_.messages.add({MessageBar::Kind::note,
                         tr("Nothing has changed in what %1 is made from").arg(fileName(opened_->file)), "reload"});
}

std::vector<WindowFiles::Extent> WindowFiles::extentsOf(const OpenRun& run) {
    std::vector<Extent> extents;
    for (const OpenRun::Recorded& recorded : run.branches) {
        const Timeline& timeline = recorded.branch.timeline;
        const bool any = timeline.last() > timeline.first();
        extents.push_back({timeline.last(), any ? timeline.hashAt(timeline.last()) : hashOf(recorded.start)});
    }
    return extents;
}

/// A recording that is being written: from the place that is shown one goes on.
void WindowFiles::takeGrown(const OpenRun& run) {
    const QString name = fileName(run.source.file);
    const bool same = extentsOf(run) == extents_;
    if (same)
        frame_.messages.add(
            {MessageBar::Kind::note, tr("Nothing has changed: %1 goes no further than it did").arg(name), "reload"});
    if (same || !mayLeave([this, run] { takeGrown(run); })) return;
    const Shown* const shown = frame_.session.current();
    const bool known = shown && shown->branch < extents_.size();
    const ShownPlace place = known ? ShownPlace{shown->branch, shown->tick()} : ShownPlace{};
    frame_.messages.clear();
    const auto selected = field_.selected();
    const std::optional<ViewTransform> view = field_.showsAll() ? std::nullopt : std::optional(field_.transform());
    show(run, run.source.file);
    if (view) field_.setView(*view);
    field_.setSelected(selected);
    log_->follow(run);
    for (const std::string& note : run.notes) frame_.messages.add({MessageBar::Kind::note, qtText(note)});
    if (known && place.branch < run.branches.size()) frame_.session.show(place.branch, place.tick);
    const Nanoseconds end = run.setup->scene().timeOf(run.branches.front().branch.timeline.last());
    frame_.messages.add({MessageBar::Kind::note,
                         tr("%1 was read on: it goes up to %2 s now").arg(name).arg(toSeconds(end), 0, 'f', 2),
                         "reload"});
}

/// What is said of the files' earlier contents is no more.
void WindowFiles::sayGone(const QString& names, std::size_t count) {
    frame_.messages.remove("reload");
    const bool recorded = !extents_.empty();
    frame_.messages.add(
        {MessageBar::Kind::note,
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

void WindowFiles::takeReloaded(Expected<OpenRun> run, const QString& why) {
    const Shown* const shown = frame_.session.current();
    if (!run) {
        if (!extents_.empty()) return sayError(run.error(), "reload");
        frame_.messages.add({MessageBar::Kind::error,
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
        if (run_ == of) ++savedBranches_;
    };
    frame_.session.branchOff(edit, shown->tick(), [this, unattendedWork] {
        QMetaObject::invokeMethod(this, unattendedWork, Qt::QueuedConnection);
    });
    if (goesOn) frame_.session.play();
    frame_.messages.add({MessageBar::Kind::note,
                         tr("%1: the run was simulated again up to here; the run before is shown as a ghost").arg(why),
                         "reload",
                         {{tr("Undo"), tr("Back to the run before"), [this] {
                               frame_.session.ask(&Debugger::undo);
                               frame_.messages.remove("reload");
                           }}}});
}

}  // namespace mrose::gui

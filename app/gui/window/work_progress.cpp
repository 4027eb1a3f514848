#include "window/work_progress.h"

#include <QProgressDialog>
#include <utility>

#include "files/window_files.h"
#include "reality/overlay.h"
#include "session/background_work.h"
#include "widgets/message_bar.h"
#include "window/main_window.h"

namespace mrose::gui {
namespace {

/// What is done sooner needs no word.
constexpr int workPatience = 300;  // ms
constexpr const char *openingTopic = "opening", *workTopic = "work", *backgroundTopic = "background";
constexpr int wholeShare = 1000;

}  // namespace

WorkProgress::WorkProgress(MainWindow& window, MessageBar& messages)
    : QObject(&window), window_(window), messages_(messages) {
    RunOpener& opener = window.files().opener();
    connect(&opener, &RunOpener::progress, this, [this](const QString& what) {
        messages_.add({MessageBar::Kind::progress,
                       tr("Opening %1").arg(what),
                       openingTopic,
                       {{tr("Cancel"), tr("Do not open it (Esc)"), [this] { window_.files().cancel(); }}}});
    });
    connect(&opener, &RunOpener::ended, this, [this] { messages_.remove(openingTopic); });
    patience_.setSingleShot(true);
    patience_.setInterval(workPatience);
    connect(&patience_, &QTimer::timeout, this, &WorkProgress::show);
    connect(&window.session(), &Session::working, this, [this](const QString& what, double share) {
        onItsWay_ = false;
        work(what, share);
    });
    connect(&window.background(), &BackgroundWork::progress, this, &WorkProgress::reportBackground);
    connect(&window.overlay(), &Overlay::searching, this, [this](const QString& what, double share) {
        onItsWay_ = false;
        work(what, share);
    });
    connect(&window, &MainWindow::updated, this, [this] {
        const Shown& shown = *window_.shown();
        if (!shown.goal) {
            if (std::exchange(onItsWay_, false)) work({}, 1);
            return;
        }
        onItsWay_ = true;
        const double way = static_cast<double>(*shown.goal - shown.first);
        work(tr("Simulating up to %1 s").arg(toSeconds(shown.frame->scene().timeOf(*shown.goal)), 0, 'f', 2),
             static_cast<double>(shown.tick() - shown.first) / way);
    });
}

/// `share` 1: it has ended.
void WorkProgress::work(const QString& what, double share) {
    if (share >= 1) {
        patience_.stop();
        messages_.remove(workTopic);
        work_.clear();
        return;
    }
    if (work_.isEmpty()) patience_.start();
    work_ = what;
    share_ = share;
    if (messages_.has(workTopic)) show();
}

void WorkProgress::show() {
    messages_.add({MessageBar::Kind::progress,
                   work_,
                   workTopic,
                   {{tr("Cancel"), tr("End this here (Esc)"),
                     [this] {
                         if (!window_.session().cancel()) window_.overlay().cancel();
                     }}},
                   share_});
}

void WorkProgress::reportBackground(const QString& what, double share) {
    if (share >= 1) {
        messages_.remove(backgroundTopic);
        delete dialog_;
        return;
    }
    if (window_.actions().unattended()) return;
    if (!apart_)
        return messages_.add({MessageBar::Kind::progress,
                              what,
                              backgroundTopic,
                              {{tr("Cancel"), tr("End this here (Esc)"), [this] { window_.background().cancel(); }}},
                              share});
    if (!dialog_) {
        dialog_ = new QProgressDialog(what, tr("Cancel"), 0, wholeShare, &window_);
        dialog_->setMinimumWidth(420);
        connect(dialog_, &QProgressDialog::canceled, this, [this] { window_.background().cancel(); });
    }
    dialog_->setValue(static_cast<int>(share * wholeShare));
}

void WorkProgress::cancel() {
    if (window_.files().cancel()) return;
    if (window_.background().cancel()) return;
    if (window_.session().cancel()) return;
    if (window_.overlay().cancel()) return;
    messages_.dismiss();
}

}  // namespace mrose::gui

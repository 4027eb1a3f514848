#include "frame/work_progress.h"

#include <QProgressDialog>
#include <utility>

#include "frame/actions.h"
#include "session/background_work.h"
#include "widgets/message_bar.h"

namespace mrose::gui {
namespace {

/// What is done sooner needs no word.
constexpr int workPatience = 300;  // ms
constexpr const char *workTopic = "work", *backgroundTopic = "background";
constexpr int wholeShare = 1000;

}  // namespace

WorkProgress::WorkProgress(const WindowFrame& frame, BackgroundWork& background)
    : QObject(&frame.window), frame_(frame), background_(background) {
    patience_.setSingleShot(true);
    patience_.setInterval(workPatience);
    connect(&patience_, &QTimer::timeout, this, &WorkProgress::show);
    connect(&frame.session, &Session::working, this, &WorkProgress::report);
    connect(&background, &BackgroundWork::progress, this, &WorkProgress::reportBackground);
    connect(&frame.session, &Session::shown, this, [this] {
        const Shown& shown = *frame_.session.current();
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

void WorkProgress::report(const QString& what, double share) {
    onItsWay_ = false;
    work(what, share);
}

/// `share` 1: it has ended.
void WorkProgress::work(const QString& what, double share) {
    if (share >= 1) {
        patience_.stop();
        frame_.messages.remove(workTopic);
        work_.clear();
        return;
    }
    if (work_.isEmpty()) patience_.start();
    work_ = what;
    share_ = share;
    if (frame_.messages.has(workTopic)) show();
}

void WorkProgress::show() {
    frame_.messages.add({MessageBar::Kind::progress,
                         work_,
                         workTopic,
                         {{tr("Cancel"), tr("End this here (Esc)"),
                           [this] {
                               if (!frame_.session.cancel()) endSearch_();
                           }}},
                         share_});
}

void WorkProgress::reportBackground(const QString& what, double share) {
    if (share >= 1) {
        frame_.messages.remove(backgroundTopic);
        delete dialog_;
        return;
    }
    if (frame_.actions.unattended()) return;
    if (!apart_)
        return frame_.messages.add({MessageBar::Kind::progress,
                                    what,
                                    backgroundTopic,
                                    {{tr("Cancel"), tr("End this here (Esc)"), [this] { background_.cancel(); }}},
                                    share});
    if (!dialog_) {
        dialog_ = new QProgressDialog(what, tr("Cancel"), 0, wholeShare, &frame_.window);
        dialog_->setMinimumWidth(420);
        connect(dialog_, &QProgressDialog::canceled, this, [this] { background_.cancel(); });
    }
    dialog_->setValue(static_cast<int>(share * wholeShare));
}

void WorkProgress::cancel() {
    if (endOpening_()) return;
    if (background_.cancel()) return;
    if (frame_.session.cancel()) return;
    if (endSearch_()) return;
    frame_.messages.dismiss();
}

}  // namespace mrose::gui

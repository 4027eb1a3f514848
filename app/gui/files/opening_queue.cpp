#include "files/opening_queue.h"

#include <QFileInfo>

#include "frame/actions.h"
#include "widgets/message_bar.h"
#include "widgets/qt_text.h"

namespace mrose::gui {
namespace {

/// What is done sooner needs no word.
constexpr int openingPatience = 300;  // ms

}  // namespace

OpeningQueue::OpeningQueue(const WindowFrame& frame, const QString& topic) : frame_(frame), topic_(topic) {
    patience_.setInterval(openingPatience);
    connect(&patience_, &QTimer::timeout, this, &OpeningQueue::report);
}

void OpeningQueue::begin(const std::string& place) {
    queue_.drop();
    reading_ = place;
    patience_.start();
}

void OpeningQueue::end() {
    patience_.stop();
    frame_.messages.remove(topic_);
    emit ended();
}

bool OpeningQueue::cancel() {
    if (!busy()) return false;
    queue_.drop();
    end();
    return true;
}

OpenProgress OpeningQueue::progress(const GoesOn& goesOn) {
    return {goesOn, [this](const std::string& file) { queue_.report([this, file] { reading_ = file; }); }};
}

void OpeningQueue::report() {
    if (frame_.actions.unattended()) return;
    frame_.messages.add({MessageBar::Kind::progress,
                         tr("Opening %1").arg(QFileInfo(qtText(reading_)).fileName()),
                         topic_,
                         {{tr("Cancel"), tr("Do not open it (Esc)"), [this] {
                               cancel();
                               emit cancelled();
                           }}}});
}

}  // namespace mrose::gui

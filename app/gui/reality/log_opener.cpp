#include "reality/log_opener.h"

#include <QFileInfo>
#include <QTimer>

#include "frame/actions.h"
#include "widgets/message_bar.h"
#include "widgets/qt_text.h"

namespace mrose::gui {
namespace {

constexpr const char* openingTopic = "opening log";

/// What opens sooner needs no word.
constexpr int openPatience = 300;  // ms

}  // namespace

LogOpener::LogOpener(const Frame& frame) : frame_(frame) {}

void LogOpener::reportOpening(const std::string& place) {
    if (frame_.actions.unattended()) return;
    QTimer::singleShot(openPatience, this, [this, place, number = openings_] {
        if (number != openings_ || !busy()) return;
        frame_.messages.add({MessageBar::Kind::progress,
                             tr("Opening %1").arg(QFileInfo(qtText(place)).fileName()),
                             openingTopic,
                             {{tr("Cancel"), tr("Do not open it (Esc)"), [this] {
                                   drop();
                                   emit cancelled();
                               }}}});
    });
}

void LogOpener::drop() {
    ++openings_;
    queue_.drop();
    frame_.messages.remove(openingTopic);
}

}  // namespace mrose::gui

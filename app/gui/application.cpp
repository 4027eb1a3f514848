#include "application.h"

#include <QFont>

#include "application_style.h"

#ifdef MROSE_ADDRESS_SANITIZER
#include <sanitizer/lsan_interface.h>

namespace {
bool onDesktop = false;
}

/// The libraries of a real display keep what is theirs, and are gone when leaks are looked for, so that no suppression
/// knows them. Without a display the same window runs alone.
extern "C" int __lsan_is_turned_off() { return onDesktop ? 1 : 0; }
#endif

namespace mrose::gui {

std::unique_ptr<QApplication> makeApplication(int& count, char** words) {
#ifdef MROSE_ADDRESS_SANITIZER
    const __lsan::ScopedDisabler ignored;  // Qt's offscreen platform never frees its screen.
#endif
    auto app = std::make_unique<QApplication>(count, words);
#ifdef MROSE_ADDRESS_SANITIZER
    onDesktop = QApplication::platformName() != "offscreen";
#endif
    QApplication::setStyle(new ApplicationStyle);
    if (QApplication::platformName() == "offscreen") {
        // Pictures are looked at on any screen: letters as large as on a desktop, without coloured rims.
        QFont font = QApplication::font();
        font.setPointSizeF(9.5);
        font.setStyleStrategy(QFont::NoSubpixelAntialias);
        QApplication::setFont(font);
    }
    return app;
}

}  // namespace mrose::gui

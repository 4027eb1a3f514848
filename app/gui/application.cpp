#include "application.h"

#include <QFont>

#include "application_style.h"

#ifdef MROSE_ADDRESS_SANITIZER
#include <sanitizer/lsan_interface.h>

/// What the desktop's own libraries never free.
extern "C" const char* __lsan_default_suppressions() { return "leak:libdbus-1\n"; }
extern "C" const char* __lsan_default_options() { return "print_suppressions=0"; }
#endif

namespace mrose::gui {

std::unique_ptr<QApplication> makeApplication(int& count, char** words) {
#ifdef MROSE_ADDRESS_SANITIZER
    const __lsan::ScopedDisabler ignored;  // Qt's offscreen platform never frees its screen.
#endif
    auto app = std::make_unique<QApplication>(count, words);
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

#pragma once

#include <QImage>
#include <QString>
#include <functional>
#include <string>
#include <vector>

#include "gui/window_fixture.h"
#include "support/temporary_folder.h"
#include "widgets/qt_text.h"

namespace mrose::gui {

/// A window whose user exports into a folder.
class ExportTest : public WindowTest {
protected:
    QString path(const std::string& name) const { return qtText((folder.path() / name).string()); }
    bool isThere(const std::string& name) const { return std::filesystem::exists(folder.path() / name); }
    /// All that is in the folder.
    std::vector<std::string> files() const;
    std::string read(const std::string& name) const;
    void seek(std::int64_t tick);
    /// Until the background has done its work, and the window has told.
    void finish();
    /// What the window says, errors and notes.
    std::vector<std::string> said() const;
    /// As a script does it; empty: it went well.
    std::string perform(const char* action, const QString& argument);
    /// The same unattended: no user could wait.
    template <class Run>
    std::string alone(Run run) {
        window.actions().setUnattended(true);
        const auto done = run();
        window.actions().setUnattended(false);
        return done ? "" : done.error().message();
    }
    /// The field of a window that goes through some ticks, at the last of them.
    static QImage pictureOf(QWidget& part);

    TemporaryFolder folder;
};

}  // namespace mrose::gui

#pragma once

#include <QString>
#include <functional>

#include "session/background_work.h"

namespace mrose::gui {

class MainWindow;

/// What an export is, for those who wait for it.
struct ExportText {
    QString what;        ///< "Exporting run.mp4"
    QString path;        ///< what is opened when it is there
    bool apart = false;  ///< its progress is told outside of the window, which is in the picture
};

/// Does the job in the background and tells what came of it, with a way to open it. `after` is called in any case.
/// Where nobody attends, waits. Error: something else is under way; where nobody attends, what went wrong.
Expected<void> exportInBackground(MainWindow& window, const ExportText& text, BackgroundWork::Job job,
                                  const std::function<void()>& after = {});

/// Tells that a file is there, with a way to open it.
void tellExported(MainWindow& window, const QString& path);

}  // namespace mrose::gui

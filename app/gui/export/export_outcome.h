#pragma once

#include <QString>
#include <functional>

#include "export/exports.h"
#include "session/background_work.h"

namespace mrose::gui {

/// What an export is, for those who wait for it.
struct ExportText {
    QString what;        ///< "Exporting run.mp4"
    QString path;        ///< what is opened when it is there
    bool apart = false;  ///< its progress is reported outside of the window, which is in the picture
};

/// Does the job in the background and reports the outcome, with a way to open the file. `after` is called in any case.
/// Unattended, it waits. Error: something else is under way; unattended, what went wrong.
Expected<void> exportInBackground(const Exports& exports, const ExportText& text, BackgroundWork::Job job,
                                  const std::function<void()>& after = {});

/// Reports that a file is there, with a way to open it.
void reportExported(const Exports& exports, const QString& path);

}  // namespace mrose::gui

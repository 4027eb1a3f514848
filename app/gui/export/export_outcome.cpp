#include "export/export_outcome.h"

#include <QDesktopServices>
#include <QDir>
#include <QFileInfo>
#include <QUrl>

#include "frame/actions.h"
#include "frame/work_progress.h"
#include "widgets/message_bar.h"
#include "widgets/qt_text.h"

namespace mrose::gui {
namespace {

constexpr const char* exportTopic = "export";

void openOutside(const QString& path) {
    QDesktopServices::openUrl(QUrl::fromLocalFile(QFileInfo(path).absoluteFilePath()));
}

}  // namespace

void reportExported(const Exports& exports, const QString& path) {
    std::vector<MessageBar::Button> buttons;
    buttons.push_back(
        {QObject::tr("Open"), QObject::tr("Open it with the program for such files"), [path] { openOutside(path); }});
    if (!QFileInfo(path).isDir())
        buttons.push_back({QObject::tr("Show folder"), QObject::tr("Open the folder that it is in"),
                           [path] { openOutside(QFileInfo(path).absolutePath()); }});
    exports.frame.messages.add(
        {MessageBar::Kind::note, QObject::tr("Exported %1").arg(path), exportTopic, std::move(buttons)});
}

Expected<void> exportInBackground(const Exports& exports, const ExportText& text, BackgroundWork::Job job,
                                  const std::function<void()>& after) {
    auto result = std::make_shared<BackgroundWork::Outcome>(false);
    const bool alone = exports.frame.actions.unattended();
    if (!exports.background.busy()) exports.progress.setApart(text.apart);
    const auto done = [&exports, path = text.path, after, result, alone](const BackgroundWork::Outcome& outcome) {
        *result = outcome;
        if (after) after();
        if (alone) return;
        if (!outcome)
            exports.frame.messages.add({MessageBar::Kind::error, qtText(outcome.error().message()), exportTopic});
        else if (*outcome)
            reportExported(exports, path);
        else
            exports.frame.messages.add({MessageBar::Kind::note, QObject::tr("Not exported: cancelled"), exportTopic});
    };
    exports.frame.messages.remove(exportTopic);
    if (auto begun = exports.background.start(text.what, std::move(job), done); !begun) return begun;
    if (!alone) return {};
    exports.background.settle();
    if (!*result) return tl::unexpected(result->error());
    if (!**result) return fail("", "was cancelled");
    return {};
}

}  // namespace mrose::gui

#include "gui/export_fixture.h"

#include <QApplication>
#include <algorithm>

#include "export/view_export.h"
#include "io/file.h"
#include "session/background_work.h"
#include "widgets/message_bar.h"
#include "widgets/qt_text.h"

namespace mrose::gui {

std::vector<std::string> ExportTest::files() const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
        names.push_back(entry.path().filename().string());
    std::sort(names.begin(), names.end());
    return names;
}

std::string ExportTest::read(const std::string& name) const { return readFile(folder.path() / name).value_or(""); }

void ExportTest::seek(std::int64_t tick) {
    window.session().seek(tick);
    settle();
}

void ExportTest::finish() {
    window.background().settle();
    settle();
}

std::vector<std::string> ExportTest::said() const {
    std::vector<std::string> lines;
    for (const MessageBar::Message& message : window.messages().messages()) lines.push_back(message.text.toStdString());
    return lines;
}

std::string ExportTest::perform(const char* action, const QString& argument) {
    return alone([&] { return window.actions().perform(action, argument); });
}

QImage ExportTest::pictureOf(QWidget& part) {
    const TemporaryFolder place;
    const QString file = qtText((place.path() / "a.png").string());
    EXPECT_TRUE(writeWidget(part, file));
    return QImage(file).convertToFormat(QImage::Format_RGB32);
}

}  // namespace mrose::gui

#pragma once

#include <QMimeData>
#include <QTest>
#include <functional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "scenario/scenario.h"
#include "support/temporary_folder.h"
#include "widgets/message_bar.h"
#include "widgets/qt_text.h"
#include "window/main_window.h"

namespace mrose::gui {

/// A window of a user with a folder of files, who answers questions about unsaved work by `answer`.
class FileTest : public testing::Test {
protected:
    FileTest();

    std::string path(const std::string& name) const { return (folder.path() / name).string(); }
    QString qPath(const std::string& name) const { return qtText(path(name)); }
    std::string write(const std::string& name, const std::string& text) const {
        return folder.write(name, text).string();
    }
    /// Two robots and a ball; the ball lies at `ballX` and robots are as mine.toml says.
    static std::string game(double ballX = 0);
    static std::string robot(double mass = 7.5);
    /// Writes game.toml and mine.toml; the path of the first.
    std::string writeGame() const;

    /// A run that the window has nothing to do with.
    static std::shared_ptr<const Scenario> scenarioOf(const std::string& file);
    static StateHash hashAt(const Scenario& scenario, std::int64_t tick);

    void settle();
    /// Until that holds; false: it did not for a long time.
    static bool waitFor(const std::function<bool()>& holds) { return QTest::qWaitFor(holds, 60'000); }
    void open(const std::string& file, std::optional<double> at = {});
    void seek(std::int64_t tick);
    void drop(const QList<QUrl>& urls);
    void dropFile(const std::string& file) { drop({QUrl::fromLocalFile(qtText(file))}); }
    void throwBall();
    QAction& action(const char* name) { return window.actions()[name]; }
    /// What the window says, of one kind.
    std::vector<std::string> said(MessageBar::Kind kind) const;
    std::vector<std::string> errors() const { return said(MessageBar::Kind::error); }
    std::vector<std::string> notes() const { return said(MessageBar::Kind::note); }
    /// A button of a message.
    bool press(const QString& text);
    const WorldState& state() const { return window.shown()->frame->state; }

    TemporaryFolder folder;
    MainWindow window;
};

}  // namespace mrose::gui

#include "gui/file_fixture.h"

#include <QApplication>
#include <QDropEvent>
#include <QPushButton>

#include "files/window_files.h"
#include "io/file.h"
#include "io/format.h"
#include "scenario/scenario_file.h"
#include "simulation/step.h"
#include "support/game_text.h"
#include "support/places.h"
#include "world/state_hash.h"

namespace mrose::gui {

FileTest::FileTest() {
    window.files().saver().setQuestion([](const QString& what) {
        ADD_FAILURE() << "asked: " << what.toStdString();
        return RunSaver::Answer::cancel;
    });
    window.QWidget::show();
}

std::string FileTest::game(double ballX) {
    std::string text = gameText();
    const auto replace = [&](const std::string& from, const std::string& to) {
        const std::size_t at = text.find(from);
        EXPECT_NE(at, text.npos) << from;
        if (at != text.npos) text.replace(at, from.size(), to);
    };
    replace("one's", "one");
    replace("random_factor = 0.1\n", "");
    replace("pioneer1.toml", "mine.toml");
    replace("mass_share = 0.2", "mass_share = 0.2, friction_share = 0.2");
    replace("{ x_m = 0.0, y_m = 0.0 }", "{ x_m = " + numberText(ballX) + ", y_m = 0.0 }");
    return text;
}

std::string FileTest::robot(double mass) {
    std::string text = readFile(sourceFolder() / "resources/robots/pioneer1.toml").value_or("");
    const std::size_t at = text.find("mass_kg = 7.5");
    EXPECT_NE(at, text.npos);
    return text.replace(at, 13, "mass_kg = " + numberText(mass));
}

std::string FileTest::writeGame() const {
    write("mine.toml", robot());
    return write("game.toml", game());
}

std::shared_ptr<const Scenario> FileTest::scenarioOf(const std::string& file) {
    DiskDescriptions source({sourceFolder(), {}, ""});
    auto loaded = loadScenario(file, source);
    EXPECT_TRUE(loaded) << loaded.error().message();
    return loaded ? std::make_shared<const Scenario>(std::move(loaded->parts)) : nullptr;
}

StateHash FileTest::hashAt(const Scenario& scenario, std::int64_t tick) {
    WorldState state = scenario.initialState();
    StepBuffers buffers;
    while (state.tick < tick) step(scenario, state, buffers);
    return hashOf(state);
}

void FileTest::settle() {
    QApplication::processEvents();
    window.files().opener().settle();
    window.session().settle();
    QApplication::processEvents();
    window.session().settle();
    QApplication::processEvents();
}

void FileTest::open(const std::string& file, std::optional<double> at) {
    const auto opened = window.files().openNow({file}, at);
    ASSERT_TRUE(opened) << opened.error().message();
    settle();
}

void FileTest::seek(std::int64_t tick) {
    window.session().seek(tick);
    settle();
}

void FileTest::drop(const QList<QUrl>& urls) {
    QMimeData data;
    data.setUrls(urls);
    QDragEnterEvent enter({100, 100}, Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
    QApplication::sendEvent(&window, &enter);
    if (!enter.isAccepted()) return;
    QDropEvent dropped(QPointF(100, 100), Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
    QApplication::sendEvent(&window, &dropped);
}

void FileTest::throwBall() {
    Edit edit{"thrown"};
    edit.change = [](const Scenario&, WorldState& state) { state.objects[0].velocity_W = {-1, 2, 0}; };
    window.session().branchOff(edit);
    settle();
}

std::vector<std::string> FileTest::said(MessageBar::Kind kind) const {
    std::vector<std::string> texts;
    for (const MessageBar::Message& message : window.messages().messages())
        // Programs that were not built at once are told apart.
        if (message.kind == kind && !message.text.startsWith("it was recorded by"))
            texts.push_back(message.text.toStdString());
    return texts;
}

bool FileTest::press(const QString& text) {
    for (QPushButton* button : window.messages().findChildren<QPushButton*>())
        if (button->text() == text && button->isVisible()) {
            QTest::mouseClick(button, Qt::LeftButton);
            return true;
        }
    return false;
}

}  // namespace mrose::gui

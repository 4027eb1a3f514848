// A stretch of time as numbered pictures.
#include <QApplication>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QPushButton>

#include <gmock/gmock.h>

#include "export/film_dialog.h"
#include "export/sequence_export.h"
#include "gui/export_fixture.h"
#include "scripting/window_script.h"
#include "session/background_work.h"
#include "support/full_disk.h"
#include "widgets/message_bar.h"

namespace mrose::gui {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr Nanoseconds tick = 20'000'000;

SequenceSettings stretch(double from, double to, double framesPerSecond = 25, double speed = 1) {
    SequenceSettings settings;
    settings.from = from;
    settings.to = to;
    settings.framesPerSecond = framesPerSecond;
    settings.speed = speed;
    return settings;
}

std::string wrong(const SequenceSettings& settings) {
    const auto ticks = sequenceTicks(settings, tick);
    return ticks ? "" : ticks.error().message();
}

TEST(SequenceTicks, AreTheNearestOnesOfBothEndsAndBetween) {
    EXPECT_THAT(*sequenceTicks(stretch(1, 1.2), tick), ElementsAre(50, 52, 54, 56, 58, 60));
    EXPECT_THAT(*sequenceTicks(stretch(0, 0.1, 30), tick), ElementsAre(0, 2, 3, 5));
    EXPECT_THAT(*sequenceTicks(stretch(0, 0.04, 25, 0.25), tick), ElementsAre(0, 1, 1, 2, 2));
    EXPECT_THAT(*sequenceTicks(stretch(0, 60, 10, 200), tick), ElementsAre(0, 1000, 2000, 3000));
    EXPECT_THAT(*sequenceTicks(stretch(3, 3), tick), ElementsAre(150));
    EXPECT_EQ(sequenceTicks(stretch(0, 3600), tick)->size(), 90'001u);
}

TEST(SequenceTicks, WhatMakesNoSenseIsSaid) {
    EXPECT_THAT(wrong(stretch(2, 1)), HasSubstr("begins before it ends"));
    EXPECT_THAT(wrong(stretch(-1, 1)), HasSubstr("from 0 s on"));
    EXPECT_THAT(wrong(stretch(std::nan(""), 1)), HasSubstr("from 0 s on"));
    EXPECT_THAT(wrong(stretch(0, 1, 0)), HasSubstr("frames per second"));
    EXPECT_THAT(wrong(stretch(0, 1, 25, 0)), HasSubstr("speed"));
    EXPECT_THAT(wrong(stretch(0, 1e6)), HasSubstr("200000 frames"));
    SequenceSettings settings = stretch(0, 1);
    settings.size = {9000, 100};
    EXPECT_THAT(wrong(settings), HasSubstr("8192 pixels"));
}

class SequenceTest : public ExportTest {
protected:
    QImage frame(const std::string& of, const char* number) const {
        return QImage(path(of + "/frame_" + number + ".png")).convertToFormat(QImage::Format_RGB32);
    }
    static void follow(MainWindow& window) {
        window.field().viewport().zoom(1.7);
        window.field().setSelected(1);
        window.actions()["follow"].trigger();
        window.actions()["layer_grid"].trigger();
    }
};

/// Another window goes through the same ticks.
TEST_F(SequenceTest, FramesAreWhatTheWindowShowsAtTheirTicks) {
    follow(window);
    seek(33);
    const QImage before = pictureOf(window.field());
    const StateHash hash = window.shown()->hash;
    ASSERT_TRUE(exportFrames(window.exports(), path("game"), stretch(1, 4, 5)));
    finish();
    EXPECT_EQ(window.shown()->tick(), 33);
    EXPECT_EQ(window.shown()->hash, hash);
    EXPECT_EQ(window.shown()->last, 200);
    EXPECT_EQ(files(), std::vector<std::string>{"game"});
    MainWindow other;
    // What the mouse can do is in no film, and so no name gives way to it.
    QObject::connect(&other.session(), &Session::shown, &other.field(), [&other] { other.field().setEditable(false); });
    ASSERT_TRUE(other.open("soccer.toml"));
    other.QWidget::show();
    gui::settle(other.scripted());
    follow(other);
    QImage last;
    for (int k = 0; k <= 15; ++k) {
        other.session().seek(50 + 10 * k);
        gui::settle(other.scripted());
        const QImage shown = pictureOf(other.field());
        const QImage made = frame("game", QString("%1").arg(k, 4, 10, QChar('0')).toLatin1());
        ASSERT_EQ(made.size(), shown.size());
        EXPECT_TRUE(made == shown) << k;
        EXPECT_FALSE(made == last) << k;
        last = made;
    }
    EXPECT_TRUE(frame("game", "0016").isNull());
    window.messages().clear();
    settle();
    EXPECT_TRUE(pictureOf(window.field()) == before);
}

TEST_F(SequenceTest, WholeWindowGoesThroughTheStretchAndComesBack) {
    seek(20);
    SequenceSettings settings = stretch(0.2, 0.6, 10);
    settings.wholeWindow = true;
    ASSERT_TRUE(exportFrames(window.exports(), path("all"), settings));
    finish();
    EXPECT_EQ(window.shown()->tick(), 20);
    for (const auto& [number, at] : {std::pair{"0001", 15}, std::pair{"0004", 30}}) {
        seek(at);
        window.messages().clear();
        QApplication::processEvents();
        EXPECT_TRUE(frame("all", number) == pictureOf(window)) << number;
    }
    EXPECT_TRUE(frame("all", "0005").isNull());
}

TEST_F(SequenceTest, WindowStandsInTheMiddleOfFramesOfAnotherShape) {
    SequenceSettings settings = stretch(0, 0);
    settings.wholeWindow = true;
    ASSERT_EQ(alone([&] { return exportFrames(window.exports(), path("own"), settings); }), "");
    const QImage own = frame("own", "0000");
    for (const QSize& more : {QSize(200, 0), QSize(0, 120)}) {
        settings.size = window.size() + more;
        const std::string name = more.width() > 0 ? "broad" : "high";
        ASSERT_EQ(alone([&] { return exportFrames(window.exports(), path(name), settings); }), "");
        const QImage made = frame(name.c_str(), "0000");
        ASSERT_EQ(made.size(), settings.size);
        EXPECT_TRUE(made.copy({{more.width() / 2, more.height() / 2}, window.size()}) == own) << name;
    }
}

TEST_F(SequenceTest, BranchesFramesBeginInTheirParent) {
    seek(40);
    drag(pixelOf(0), pixelOf(0) + QPointF(40, 25));
    ASSERT_EQ(window.shown()->branches.size(), 2u);
    // The inspector has something to show now, and takes its room from the field once no second click is to come.
    const QSize before = window.field().size();
    ASSERT_TRUE(QTest::qWaitFor([&] { return window.field().size() != before; }));
    seek(60);
    ASSERT_EQ(alone([&] { return exportFrames(window.exports(), path("branch"), stretch(0.7, 0.9, 10)); }), "");
    for (const auto& [number, at] : {std::pair{"0000", 35}, std::pair{"0002", 45}}) {
        seek(at);
        // Names may stand elsewhere: it depends on the picture before.
        const QImage shown = pictureOf(window.field()), made = frame("branch", number);
        int differing = 0;
        for (int y = 0; y < shown.height(); ++y)
            for (int x = 0; x < shown.width(); ++x) differing += shown.pixel(x, y) != made.pixel(x, y) ? 1 : 0;
        EXPECT_LT(differing, shown.width() * shown.height() / 100) << number;
    }
}

TEST_F(SequenceTest, OtherSizesShowTheSameLargerAndSharper) {
    SequenceSettings settings = stretch(0, 0);
    settings.size = window.field().size() * 2;
    ASSERT_EQ(alone([&] { return exportFrames(window.exports(), path("large"), settings); }), "");
    const QImage large = frame("large", "0000");
    ASSERT_EQ(large.size(), settings.size);
    const QImage shown = pictureOf(window.field());
    const QImage half = large.scaled(shown.size(), Qt::IgnoreAspectRatio, Qt::SmoothTransformation);
    double apart = 0;
    for (int y = 0; y < shown.height(); ++y)
        for (int x = 0; x < shown.width(); ++x) apart += std::abs(qGray(shown.pixel(x, y)) - qGray(half.pixel(x, y)));
    EXPECT_LT(apart / (shown.width() * shown.height()), 2);
}

/// The whole field stays the whole field, as large as it goes.
TEST_F(SequenceTest, BroaderPicturesOfTheWholeFieldAreFilledByIt) {
    window.field().viewport().fit();
    SequenceSettings settings = stretch(0, 0);
    const auto green = [&](const char* name) {
        EXPECT_EQ(alone([&] { return exportFrames(window.exports(), path(name), settings); }), "");
        const QImage made = frame(name, "0000");
        int first = made.width(), last = 0;
        for (int x = 0; x < made.width(); ++x) {
            const QColor at = made.pixelColor(x, made.height() / 2 + 60);
            if (at.green() < at.red() + 20) continue;
            first = std::min(first, x);
            last = std::max(last, x);
        }
        return static_cast<double>(last - first) / made.width();
    };
    const double shown = green("shown");
    settings.size = {window.field().height() * 8 / 5, window.field().height()};
    EXPECT_GT(green("broad"), 0.95 * shown);
}

TEST_F(SequenceTest, CancellingLeavesNothing) {
    ASSERT_TRUE(exportFrames(window.exports(), path("game"), stretch(0, 100)));
    EXPECT_TRUE(window.background().busy());
    EXPECT_THAT(alone([&] { return exportFrames(window.exports(), path("other"), stretch(0, 1)); }),
                HasSubstr("is under way"));
    window.actions()["cancel"].trigger();
    finish();
    EXPECT_EQ(files(), std::vector<std::string>{});
    EXPECT_THAT(said(), ElementsAre("Not exported: cancelled"));
    EXPECT_EQ(window.shown()->tick(), 0);
    EXPECT_EQ(alone([&] { return exportFrames(window.exports(), path("deep/down"), stretch(0, 0)); }), "")
        << "it can begin anew";
    EXPECT_TRUE(isThere("deep/down/frame_0000.png"));
}

TEST_F(SequenceTest, WindowMayCloseInTheMiddle) {
    auto other = std::make_unique<MainWindow>();
    ASSERT_TRUE(other->open("soccer.toml"));
    other->QWidget::show();
    gui::settle(other->scripted());
    SequenceSettings settings = stretch(0, 100);
    for (const bool whole : {false, true}) {
        settings.wholeWindow = whole;
        if (!other) {
            other = std::make_unique<MainWindow>();
            ASSERT_TRUE(other->open("soccer.toml"));
            gui::settle(other->scripted());
        }
        ASSERT_TRUE(exportFrames(other->exports(), path("game"), settings));
        QApplication::processEvents();
        other.reset();
        EXPECT_EQ(files(), std::vector<std::string>{});
    }
}

TEST_F(SequenceTest, WhatIsWrongWithTheFolderIsOneLine) {
    folder.write("full/a.txt", "mine");
    folder.write("file", "mine");
    EXPECT_THAT(perform("export_sequence", path("full")), HasSubstr("full: is a folder with something in it"));
    EXPECT_THAT(perform("export_sequence", path("file")), HasSubstr("file: is there already and no folder"));
    EXPECT_THAT(perform("export_sequence", path("file/under")), HasSubstr("Not a directory"));
    {
        const FullDisk disk(2000);
        EXPECT_THAT(alone([&] { return exportFrames(window.exports(), path("new"), stretch(0, 1)); }),
                    HasSubstr("new/frame_0000.png: cannot be written: "));
    }
    EXPECT_EQ(files(), (std::vector<std::string>{"file", "full"}));
    EXPECT_EQ(read("full/a.txt") + read("file"), "minemine");
    std::filesystem::create_directory(folder.path() / "empty");
    EXPECT_EQ(alone([&] { return exportFrames(window.exports(), path("empty"), stretch(0, 0.1)); }), "");
    EXPECT_TRUE(isThere("empty/frame_0002.png"));
}

TEST_F(SequenceTest, ScriptsSayAllOfIt) {
    const auto run = [&](const std::string& text) {
        const auto outcome = runScript(window.scripted(), text, "s.lua", {[](const auto&) {}, [](const auto&) {}});
        return outcome ? "" : outcome.error().message();
    };
    const std::string place = path("a").toStdString();
    EXPECT_EQ(run("export_sequence('" + place + "', 0.5, 1, 2, 10, '320x200')\nexpect(tick == 0)"), "");
    EXPECT_EQ(frame("a", "0002").size(), QSize(320, 200));
    EXPECT_TRUE(frame("a", "0003").isNull());
    EXPECT_THAT(run("export_sequence('" + place + "')"), HasSubstr("s.lua:1: export_sequence(): "));
    EXPECT_THAT(run("export_sequence()"), HasSubstr("expected a folder as argument 1"));
    EXPECT_THAT(run("export_sequence('b', 'x')"), HasSubstr("expected a number as argument 2"));
    EXPECT_THAT(run("export_sequence('b', 0, 1, 1, 25, '3x')"), HasSubstr("is no size"));
    EXPECT_THAT(run("export_sequence('b', 0, 1, 1, 25, nil, 'moon')"), HasSubstr("\"field\" or \"window\""));
}

TEST_F(SequenceTest, DialogueSaysWhatComesOfIt) {
    seek(100);
    window.actions()["export_sequence"].trigger();
    auto* dialog = window.findChild<FilmDialog*>();
    ASSERT_NE(dialog, nullptr);
    const auto says = [&](const char* text) {
        for (const QLabel* label : dialog->findChildren<QLabel*>())
            if (label->text().contains(text)) return true;
        return false;
    };
    EXPECT_TRUE(says("51 frame"));
    EXPECT_EQ(*dialog->settings().to, 2);
    const auto numbers = dialog->findChildren<QDoubleSpinBox*>();
    ASSERT_EQ(numbers.size(), 4);
    numbers[0]->setValue(3);
    EXPECT_TRUE(says("begins before it ends"));
    numbers[0]->setValue(1.6);
    EXPECT_TRUE(dialog->exportTo(path("out")));
    finish();
    EXPECT_TRUE(isThere("out/frame_0010.png"));
    EXPECT_FALSE(isThere("out/frame_0011.png"));
    EXPECT_THAT(said(), ElementsAre(HasSubstr("Exported ")));
}

}  // namespace
}  // namespace mrose::gui

// Films by ffmpeg.
#include <QDialogButtonBox>
#include <QLabel>
#include <QProcess>
#include <QPushButton>
#include <QStandardPaths>
#include <algorithm>

#include <gmock/gmock.h>
#include <sys/stat.h>

#include "export/film_dialog.h"
#include "export/sequence_export.h"
#include "gui/export_fixture.h"
#include "session/background_work.h"
#include "support/places.h"
#include "support/run_program.h"

namespace mrose::gui {
namespace {

using testing::HasSubstr;

class FilmTest : public ExportTest {
protected:
    void TearDown() override { qputenv("PATH", searched); }

    /// The only programs that are found from now on: a shell script instead of ffmpeg, or none.
    void pretend(const std::string& script) {
        const auto place = folder.write("bin/ffmpeg", "#!/bin/sh\n" + script + '\n');
        ::chmod(place.c_str(), 0755);
        qputenv("PATH", QByteArray::fromStdString(place.parent_path().string()) + ":/usr/bin:/bin");
    }
    static bool installed() {
        return !QStandardPaths::findExecutable("ffprobe").isEmpty() &&
               !QStandardPaths::findExecutable("ffmpeg").isEmpty();
    }
    static QString outputOf(const QString& program, const QStringList& words) {
        QProcess process;
        process.start(program, words);
        process.waitForFinished();
        return QString::fromUtf8(process.readAllStandardOutput()).trimmed();
    }
    std::string film(const std::string& name, double to = 1, const QSize& size = {}) {
        SequenceSettings settings;
        settings.from = 0.5;
        settings.to = to;
        settings.size = size;
        return alone([&] { return exportFilm(window.exports(), path(name), settings); });
    }

    QByteArray searched = qgetenv("PATH");
};

TEST_F(FilmTest, HasTheFramesThatWereAskedFor) {
    if (!installed()) GTEST_SKIP() << "no ffmpeg: sudo apt install ffmpeg";
    folder.write("game.mp4", "an earlier one");
    ASSERT_EQ(film("game.mp4", 1, {641, 403}), "");
    const QString seen =
        outputOf("ffprobe", {"-v", "error", "-count_frames", "-select_streams", "v", "-show_entries",
                             "stream=codec_name,width,height,pix_fmt,color_space,r_frame_rate,nb_read_frames", "-of",
                             "csv=p=0", path("game.mp4")});
    EXPECT_EQ(seen.toStdString(), "h264,640,402,yuv420p,bt709,25/1,13");
    settle();
    // Its last frame, beside the picture of the same tick.
    outputOf("ffmpeg",
             {"-v", "error", "-i", path("game.mp4"), "-vf", "select=eq(n\\,12)", "-vframes", "1", path("last.png")});
    SequenceSettings settings;
    settings.from = settings.to = 0.98;
    settings.size = {641, 403};
    ASSERT_EQ(alone([&] { return exportFrames(window.exports(), path("one"), settings); }), "");
    const QImage frame(path("last.png")), picture(path("one/frame_0000.png"));
    ASSERT_EQ(frame.size(), QSize(640, 402));
    double apart = 0;
    for (int y = 0; y < frame.height(); ++y)
        for (int x = 0; x < frame.width(); ++x) {
            const QColor a(frame.pixel(x, y)), b(picture.pixel(x, y));
            apart += std::abs(a.red() - b.red()) + std::abs(a.green() - b.green()) + std::abs(a.blue() - b.blue());
        }
    EXPECT_LT(apart / (frame.width() * frame.height()), 9);
    EXPECT_EQ(files(), (std::vector<std::string>{"game.mp4", "last.png", "one"}));
}

TEST_F(FilmTest, WithoutFfmpegItSaysWhatToInstall) {
    std::filesystem::create_directory(folder.path() / "bin");
    qputenv("PATH", path("bin").toLocal8Bit());
    EXPECT_THAT(film("game.mp4"), HasSubstr("game.mp4: needs the program ffmpeg, which is not installed: sudo apt"));
    EXPECT_FALSE(isThere("game.mp4"));
}

TEST_F(FilmTest, OtherPlacesAndExtensionsAreRefused) {
    pretend("cat >/dev/null");
    EXPECT_THAT(film("game.avi"), HasSubstr("expected .mp4"));
    EXPECT_THAT(film("no/where.mp4"), HasSubstr("where.mp4: cannot be written: No such file"));
    std::filesystem::create_directory(folder.path() / "a.mp4");
    EXPECT_THAT(film("a.mp4"), HasSubstr("is a folder"));
}

/// It takes some frames and then fails: its last line is told, and what was there stays.
TEST_F(FilmTest, WhatFfmpegSaysLastIsTold) {
    folder.write("game.mp4", "an earlier one");
    pretend("head -c 100000 >/dev/null; echo 'first words' >&2; echo 'No space left on device' >&2; exit 1");
    const std::string message = film("game.mp4", 20);
    EXPECT_THAT(message, HasSubstr("game.mp4: ffmpeg: No space left on device"));
    EXPECT_EQ(message.find('\n'), std::string::npos);
    pretend("cat >/dev/null; echo 'Unknown encoder' >&2; exit 1");
    EXPECT_THAT(film("game.mp4"), HasSubstr("game.mp4: ffmpeg: Unknown encoder"));
    pretend("head -c 100000 >/dev/null; kill -9 $$");
    EXPECT_THAT(film("game.mp4", 20), HasSubstr("game.mp4: ffmpeg was ended before its end"));
    pretend("cat >/dev/null");
    EXPECT_THAT(film("game.mp4"), HasSubstr("game.mp4: ffmpeg wrote nothing"));
    EXPECT_EQ(read("game.mp4"), "an earlier one");
    EXPECT_EQ(files(), (std::vector<std::string>{"bin", "game.mp4"}));
}

/// One that takes no frames blocks nothing.
TEST_F(FilmTest, CancellingLeavesNothing) {
    pretend("exec sleep 1000");
    SequenceSettings settings;
    settings.to = 30;
    ASSERT_TRUE(exportFilm(window.exports(), path("game.mp4"), settings));
    ASSERT_TRUE(QTest::qWaitFor([&] { return files().size() == 2; }, 60'000));
    window.actions()["cancel"].trigger();
    finish();
    EXPECT_THAT(said(), testing::ElementsAre("Not exported: cancelled"));
    EXPECT_EQ(files(), std::vector<std::string>{"bin"});
}

TEST_F(FilmTest, ProgramThatIsToEndLeavesNoPart) {
    pretend("exec sleep 1000");
    const auto program = std::filesystem::path(mroseProgram()).parent_path() / "mrose-gui";
    RunningProgram running({program.string(), "--offscreen", "--run", "soccer.toml", "--ticks", "100", "--film",
                            path("game.mp4").toStdString()});
    ASSERT_TRUE(QTest::qWaitFor([&] { return files().size() == 2; }, 60'000));
    running.send(SIGTERM);
    EXPECT_EQ(running.finish().status, 128 + SIGTERM);
    EXPECT_EQ(files(), std::vector<std::string>{"bin"});
}

TEST_F(FilmTest, CommandLineMakesOneOfWhatWasRun) {
    const auto run = [&](const std::string& file) {
        const auto program = std::filesystem::path(mroseProgram()).parent_path() / "mrose-gui";
        return RunningProgram(
                   {program.string(), "--offscreen", "--run", "soccer.toml", "--ticks", "20", "--film", file})
            .finish();
    };
    const ProgramResult other = run(path("a.gif").toStdString());
    EXPECT_EQ(other.status, 1);
    EXPECT_THAT(other.err, HasSubstr("a.gif: is no film that can be written; expected .mp4\n"));
    if (!installed()) GTEST_SKIP() << "no ffmpeg: sudo apt install ffmpeg";
    const ProgramResult made = run(path("game.mp4").toStdString());
    EXPECT_EQ(made.status, 0);
    EXPECT_EQ(made.out + made.err, "");
    EXPECT_EQ(outputOf("ffprobe", {"-v", "error", "-count_frames", "-show_entries", "stream=nb_read_frames", "-of",
                                   "csv=p=0", path("game.mp4")}),
              "11");
}

TEST_F(FilmTest, WithoutFfmpegTheDialogueSaysSoBeforeAnyNameIsAskedFor) {
    qputenv("PATH", "/nowhere");
    FilmDialog* const dialog = showFilmDialog(window.exports(), true);
    const auto says = [&](const char* words) {
        const auto labels = dialog->findChildren<QLabel*>();
        return std::any_of(labels.begin(), labels.end(), [&](QLabel* label) { return label->text().contains(words); });
    };
    const auto* button = dialog->findChild<QDialogButtonBox*>()->buttons().last();
    const auto exports = [&] {
        for (const QAbstractButton* one : dialog->findChild<QDialogButtonBox*>()->buttons())
            if (one->text().contains("xport")) button = one;
        return button->isEnabled();
    };
    EXPECT_TRUE(says("sudo apt install ffmpeg"));
    EXPECT_FALSE(exports());
    dialog->setFilm(false);
    EXPECT_FALSE(says("ffmpeg"));
    EXPECT_TRUE(exports());
}

}  // namespace
}  // namespace mrose::gui

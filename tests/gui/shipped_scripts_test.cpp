// Scripts that ship: the tour holds what it expects, and the README's pictures can be made.
#include <QImage>
#include <filesystem>

#include <gtest/gtest.h>

#include "support/places.h"
#include "support/run_program.h"
#include "support/temporary_folder.h"

namespace mrose {
namespace {

std::string windowProgram() { return (std::filesystem::path(mroseProgram()).parent_path() / "mrose-gui").string(); }

ProgramResult runShell(const std::vector<std::string>& environment, const std::vector<std::string>& words) {
    std::vector<std::string> all{"/usr/bin/env"};
    all.insert(all.end(), environment.begin(), environment.end());
    all.insert(all.end(), words.begin(), words.end());
    return RunningProgram(all).finish();
}

void expectTourHolds(const std::string& name, const char* says) {
    const ProgramResult result = RunningProgram({windowProgram(), "--offscreen", "--script",
                                                 (sourceFolder() / "resources/scripts" / name).string()})
                                     .finish();
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_EQ(result.err, "");
    EXPECT_NE(result.out.find(says), std::string::npos) << result.out;
}

TEST(ShippedScripts, TourThroughTheSoccerGameHolds) { expectTourHolds("soccer_tour.lua", " decided at "); }

TEST(ShippedScripts, TourThroughTheCorridorHolds) { expectTourHolds("corridor_tour.lua", "it arrived at "); }

TEST(ShippedScripts, PicturesOfTheReadmeCanBeMade) {
    const TemporaryFolder folder;
    const ProgramResult result =
        runShell({"MROSE_GUI=" + windowProgram()},
                 {"/bin/sh", (sourceFolder() / "resources/pictures/make_window.sh").string(), folder.path().string()});
    ASSERT_EQ(result.status, 0) << result.err;
    for (const char* name : {"window.png", "window_dark.png"}) {
        const std::filesystem::path made = folder.path() / name, shipped = sourceFolder() / "resources/pictures" / name;
        const QImage picture(made.c_str());
        EXPECT_EQ(picture.size(), QSize(1280, 800)) << name;
        EXPECT_EQ(QImage(shipped.c_str()).size(), picture.size()) << name;
        EXPECT_LT(std::filesystem::file_size(shipped), 150'000u) << name;
        // Neither empty nor all of one tone.
        const QImage small = picture.scaled(32, 20, Qt::IgnoreAspectRatio, Qt::SmoothTransformation);
        int least = 255, most = 0;
        for (int y = 0; y < small.height(); ++y)
            for (int x = 0; x < small.width(); ++x) {
                least = std::min(least, small.pixelColor(x, y).lightness());
                most = std::max(most, small.pixelColor(x, y).lightness());
            }
        EXPECT_GT(most - least, 60) << name;
    }
}

TEST(ShippedScripts, EachViewOfTheWindowIsPictured) {
    const TemporaryFolder folder;
    const ProgramResult result =
        runShell({"MROSE_GUI=" + windowProgram(), "MROSE_DATA=", "SIZES=1024x620@2", "THEMES=dark"},
                 {"/bin/sh", (sourceFolder() / "tests/pictures/make_views.sh").string(), folder.path().string()});
    ASSERT_EQ(result.status, 0) << result.err;
    for (const char* name : {"start", "plots", "side_by_side", "log", "models"}) {
        const std::string file = (folder.path() / "1024x620@2_dark" / name).string() + ".png";
        EXPECT_EQ(QImage(file.c_str()).size(), 2 * QSize(1024, 620)) << name;
    }
}

/// As ./demo does where there is no display.
TEST(ShippedScripts, RecordedGameIsPictured) {
    const TemporaryFolder folder;
    const std::string game = (folder.path() / "game.mcap").string();
    ASSERT_EQ(runMrose({"run", "soccer.toml", "--duration", "25", "--record", game, "--quiet"}).status, 0);
    const ProgramResult result = runShell({"-C", folder.path().string()},
                                          {windowProgram(), "--offscreen", "--script",
                                           (sourceFolder() / "resources/scripts/recorded_game.lua").string(), game});
    ASSERT_EQ(result.status, 0) << result.err;
    for (const char* name : {"game.png", "robot.png", "branch.png", "side_by_side.png"})
        EXPECT_EQ(QImage((folder.path() / name).c_str()).size(), QSize(1280, 800)) << name;
}

/// As resources/paper/repeat does.
TEST(ShippedScripts, FiguresOfTheStrokeAtTheWallCanBeMade) {
    const TemporaryFolder folder;
    const ProgramResult result = runShell({"-C", folder.path().string()},
                                          {windowProgram(), "--offscreen", "ball_off_the_wall.toml", "--trial", "8",
                                           "--script", (sourceFolder() / "resources/paper/figure3.lua").string()});
    ASSERT_EQ(result.status, 0) << result.err;
    for (const char* name : {"figure3a.png", "figure3b.png", "figure3c.png", "figure3d.png"})
        EXPECT_GT(QImage((folder.path() / name).c_str()).width(), 300) << name;
}

TEST(ShippedScripts, RealLogIsPictured) {
    const TemporaryFolder folder;
    const ProgramResult result =
        runShell({"-C", folder.path().string()}, {windowProgram(), "--offscreen", "--script",
                                                  (sourceFolder() / "resources/scripts/real_log.lua").string(), "--log",
                                                  (sourceFolder() / "resources/logs/pioneer").string()});
    ASSERT_EQ(result.status, 0) << result.err;
    EXPECT_NE(result.out.find("is off by "), std::string::npos) << result.out;
    EXPECT_NE(result.err.find("from a simulated robot"), std::string::npos) << result.err;
    EXPECT_EQ(QImage((folder.path() / "reality.png").c_str()).size(), QSize(1280, 800));
}

}  // namespace
}  // namespace mrose

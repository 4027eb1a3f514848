// The window on a real display with a window manager, driven by keys from outside. Skipped where the tools for that are
// not installed.
#include <QImage>
#include <QStandardPaths>
#include <filesystem>

#include <gtest/gtest.h>

#include "support/places.h"
#include "support/run_program.h"
#include "support/temporary_folder.h"

namespace mrose {
namespace {

TEST(Desktop, KeysStepTheRunAndEndTheProgram) {
    for (const char* tool : {"xvfb-run", "xauth", "openbox", "xdotool", "import"})
        if (QStandardPaths::findExecutable(tool).isEmpty()) GTEST_SKIP() << tool << " is not installed";
    const TemporaryFolder folder;
    const std::string program = (std::filesystem::path(mroseProgram()).parent_path() / "mrose-gui").string();
    const ProgramResult result =
        RunningProgram({QStandardPaths::findExecutable("xvfb-run").toStdString(), "-a", "-s", "-screen 0 1400x900x24",
                        "/usr/bin/env", "-u", "QT_QPA_PLATFORM", "/bin/sh",
                        (sourceFolder() / "tests/gui/drive_desktop.sh").string(), program, "soccer.toml",
                        folder.path().string(), "Right", "Right", "Right", "Right", "Right", "Left", "Left"})
            .finish();
    ASSERT_EQ(result.status, 0) << result.err;
    // Five ticks on and two back, of 20 ms each.
    const ProgramResult plain = runMrose({"run", "soccer.toml", "--duration", "0.06", "--quiet"});
    EXPECT_EQ(result.out, plain.out.substr(plain.out.find("state ")));
    EXPECT_EQ(result.err, "");
    const QImage before((folder.path() / "before.png").c_str()), after((folder.path() / "after.png").c_str());
    EXPECT_EQ(before.size(), QSize(1400, 900));
    EXPECT_EQ(after.size(), QSize(1400, 900));
    EXPECT_NE(before, after);
}

}  // namespace
}  // namespace mrose

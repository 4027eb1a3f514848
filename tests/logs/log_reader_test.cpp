#include "logs/log_reader.h"

#include <gtest/gtest.h>

#include "support/temporary_folder.h"

namespace mrose {
namespace {

constexpr const char* odometry = "1 0.1 0 \n2 0.1 0 \n";
constexpr const char* csv = "t,v_cmd,w_cmd\n1,2,3\n2,3,4\n";
constexpr const char* husky =
    "window,calib_step,t_s,cmd_left_radps,cmd_right_radps,wheel_left_radps,wheel_right_radps,icp_x_m,icp_y_m,"
    "icp_yaw_rad,imu_yaw_rad,steady\n0,0,0,1,1,1,1,0,0,0,0,1\n0,0,0.05,1,1,1,1,0,0,0,0,1\n";

TEST(LogReader, TellsTheFormatFromTheContent) {
    const TemporaryFolder folder;
    folder.write("mrclam3/Robot1_Odometry.dat", odometry);
    folder.write("several/a.csv", csv);
    const auto formatOf = [&](const std::filesystem::path& source) {
        const auto log = readLog(source);
        return log ? log->format : log.error().message();
    };
    EXPECT_EQ(formatOf(folder.path() / "mrclam3"), "mrclam");
    EXPECT_EQ(formatOf(folder.path() / "several"), "csv");
    EXPECT_EQ(formatOf(folder.write("log.txt", csv)), "csv");
    EXPECT_EQ(formatOf(folder.write("windows", husky)), "husky-windows");
    EXPECT_EQ(readLog(folder.path() / "mrclam3")->source, (folder.path() / "mrclam3").string());
}

TEST(LogReader, WhatIsNoLogIsOneLine) {
    const TemporaryFolder folder;
    const auto messageOf = [](const std::filesystem::path& source) { return readLog(source).error().message(); };
    const std::string path = folder.path().string();
    EXPECT_EQ(messageOf(folder.path() / "missing"), path + "/missing: does not exist");
    EXPECT_EQ(messageOf(folder.path()),
              path + ": is a folder without a log; expected Robot<N>_Odometry.dat or *.csv files in it");
    EXPECT_EQ(messageOf(folder.write("empty", "")), path + "/empty: is empty or cannot be read; expected a log");
    EXPECT_EQ(messageOf(folder.write("text", "hello\n")),
              path + "/text: is no log; expected a CSV file whose first line names a column t");
    EXPECT_EQ(messageOf(folder.write("Robot1_Odometry.dat", odometry)),
              path + "/Robot1_Odometry.dat: is no log; expected a CSV file whose first line names a column t");
}

TEST(LogReader, FolderOfLogsNamesThem) {
    const TemporaryFolder folder;
    const auto messageOf = [](const std::filesystem::path& source) { return readLog(source).error().message(); };
    const std::string path = folder.path().string();
    folder.write("windows/husky.csv", husky);
    folder.write("windows/notes.csv", "who,what\nme,this\n");
    EXPECT_EQ(messageOf(folder.path() / "windows"),
              path + "/windows: is not a log itself; it holds husky.csv: open that");
    folder.write("b/Robot1_Odometry.dat", odometry);
    folder.write("a/it.csv", csv);
    folder.write("other/readme", "text");
    EXPECT_EQ(messageOf(folder.path()), path + ": is not a log itself; it holds a and b: open one of them");
    for (const char* name : {"c", "d", "e", "f", "g"}) folder.write(std::string(name) + "/it.csv", csv);
    EXPECT_EQ(messageOf(folder.path()),
              path + ": is not a log itself; it holds a, b, c, d, e and 2 more: open one of them");
}

TEST(LogReader, ErrorsOfTheReaderComeThrough) {
    const TemporaryFolder folder;
    const auto file = folder.write("log.csv", "t,v_cmd,w_cmd\n1,2,3\n2,x,4\n");
    EXPECT_EQ(readLog(file).error().message(),
              file.string() + ":3:3: v_cmd: expected a number within +-1e9, found 'x'");
}

}  // namespace
}  // namespace mrose

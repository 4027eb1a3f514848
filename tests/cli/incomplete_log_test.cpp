// A log of which something is missing: the rest is worked with, and it is said what is not there.
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "logs/csv_reader.h"
#include "logs/csv_writer.h"
#include "support/mrclam_folder.h"
#include "support/places.h"
#include "support/workshop.h"

namespace mrose {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr const char* missing = "Robot2_Groundtruth.dat has no rows: nothing says where robot 2 was.";

class IncompleteLog : public Workshop {
protected:
    IncompleteLog() { folder_.write(2, "Groundtruth", ""); }
    std::string place() const { return folder_.path(); }
    /// What the program prints where it is to succeed.
    static std::string printed(const std::vector<std::string>& words) {
        const ProgramResult ran = runMrose(words);
        EXPECT_EQ(ran.status, 0) << ran.err;
        EXPECT_EQ(ran.err, "");
        return ran.out;
    }

    const MrclamFolder folder_{3};
};

TEST_F(IncompleteLog, InspectSaysWhatIsMissingAndTellsOfTheOthers) {
    const std::string text = printed({"inspect", place()});
    EXPECT_THAT(text, HasSubstr(std::string("Note: ") + missing));
    EXPECT_THAT(text, HasSubstr("3 robots"));
    EXPECT_THAT(text, HasSubstr("1501 in 60.0 s"));
    EXPECT_THAT(text, HasSubstr("none: the log has no ground truth of it"));
    const auto json = nlohmann::json::parse(printed({"inspect", place(), "--json"}));
    EXPECT_EQ(json["incomplete"], nlohmann::json{missing});
    EXPECT_EQ(json["robots"].size(), 3u);
    EXPECT_EQ(json["robots"][0]["defects"]["cut_lines"], 0);
}

TEST_F(IncompleteLog, InspectCountsACutLine) {
    folder_.write(2, "Groundtruth", "0 1 2 3\n0.1 1 2 3\n0.2 1");
    const std::string text = printed({"inspect", place()});
    EXPECT_THAT(text, HasSubstr("Note: The last line of Robot2_Groundtruth.dat is cut off: it is left out."));
    EXPECT_THAT(text, HasSubstr("found     1 last line cut off, left out"));
    EXPECT_THAT(text, Not(HasSubstr("none: the log")));
}

TEST_F(IncompleteLog, CompareSimulatesTheOthersAndSaysSo) {
    const std::vector<std::string> words{"compare", "--log", place(), "--duration", "5", "--no-causes"};
    const std::string text = printed(words);
    EXPECT_THAT(text, HasSubstr(std::string("Note: ") + missing));
    EXPECT_THAT(text, HasSubstr("Note: Robot \"2\" is not compared: the log has no ground truth of it."));
    EXPECT_THAT(text, HasSubstr("create 1"));
    EXPECT_THAT(text, HasSubstr("create 3"));
    EXPECT_THAT(text, Not(HasSubstr("create 2")));
    // Who asks for it learns why it cannot be had.
    std::vector<std::string> asked = words;
    asked.insert(asked.end(), {"--robots", "1,2"});
    expectOneLine(runMrose(asked), {place() + ": has no ground truth of robot \"2\""});
    // The others are where they are without it.
    asked.back() = "1,3";
    EXPECT_THAT(printed(asked), HasSubstr(missing));
}

TEST_F(IncompleteLog, EvaluateSaysWhatIsMissing) {
    const std::string network = (sourceFolder() / "nets/create.net").string();
    EXPECT_THAT(printed({"evaluate", network, "--log", place(), "--no-floor"}),
                HasSubstr(std::string("Note: ") + missing));
}

TEST_F(IncompleteLog, TrainLearnsFromTheOthers) {
    Log log = parseCsv(plantedCsv(), "planted.csv").value();
    const std::string whole = write("whole.csv", toCsv(log));
    RobotLog unseen = log.robots.front();
    unseen.robot = "unseen";
    for (Trajectory& trajectory : unseen.trajectories) trajectory.poses.clear();
    log.robots.push_back(unseen);
    const std::string half = write("half.csv", toCsv(log));
    const auto learned = [&](const std::string& from, const std::string& name) {
        const ProgramResult ran = runMrose(trainWords(from, path(name)));
        EXPECT_EQ(ran.status, 0) << ran.err;
        return ran.out;
    };
    EXPECT_THAT(learned(whole, "whole.net"), Not(HasSubstr("ground truth")));
    EXPECT_THAT(learned(half, "half.net"),
                HasSubstr("Note: Nothing is learned from robot \"unseen\": the log has no ground truth of it."));
    const auto layersOf = [&](const std::string& name) { return read(name).substr(read(name).find("[layers]")); };
    EXPECT_EQ(layersOf("half.net"), layersOf("whole.net"));
    expectOneLine(runMrose({"train", half, "-o", path("b.net"), "--robots", "planted,unseen"}), {half + ": "});
}

TEST_F(IncompleteLog, TrainSaysWhichCommandsNeverChange) {
    std::string log = "t,v_cmd,w_cmd,x,y,heading\n";
    for (int i = 0; i < 3000; ++i) log += std::to_string(0.02 * i) + ",0.1,0.2," + std::to_string(0.002 * i) + ",0,0\n";
    write("same.csv", log);
    const ProgramResult ran =
        runMrose({"train", path("same.csv"), "-o", path("same.net"), "--model", "paper", "--epochs", "3"});
    for (const char* note :
         {"Note: All commands have v = 0.1 m/s: how the robot answers to others cannot be learned from them.",
          "Note: All commands have w = 0.2 rad/s"})
        EXPECT_THAT(ran.out, HasSubstr(note));
}

TEST_F(IncompleteLog, PredictSaysWhichWindowsGoOnAfterTheLastCommand) {
    const auto predicted = [&](const std::string& start) {
        write("windows.csv", "dataset,robot,t_start\n0,1," + start + "\n");
        std::string log = "t,v_cmd,w_cmd,x,y,heading,robot\n";
        for (int i = 0; i < 1500; ++i)
            log += std::to_string(0.02 * i) + ",0.1,0," + std::to_string(0.002 * i) + ",0,0,1\n";
        write("log.csv", log);
        return printed({"predict", "create.net", "--log", path("log.csv"), "--windows", path("windows.csv"), "-o",
                        path("predicted.csv"), "--overwrite"});
    };
    EXPECT_THAT(predicted("25"), HasSubstr("1 window goes on for more than 1 s after the log's last command"));
    const std::string within = predicted("15");
    EXPECT_THAT(within, HasSubstr("1 window of 10 s predicted"));
    EXPECT_THAT(within, Not(HasSubstr("last command")));
}

}  // namespace
}  // namespace mrose

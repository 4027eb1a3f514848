// Whatever is wrong is one line that says where and why, and nothing that was there before is touched.
#include <algorithm>

#include "cli/workshop.h"

namespace mrose {
namespace {

using BadInput = Workshop;

const std::string header = "t,v_cmd,w_cmd,x,y,heading\n";

/// Rows every 50 ms of a robot that stands still.
std::string restingRows(int count, double start = 100) {
    std::string text;
    for (int i = 0; i < count; ++i) text += std::to_string(start + 0.05 * i) + ",0,0,1,2,0.5\n";
    return text;
}

TEST_F(BadInput, LogsThatCannotBeReadAreNamedByEverySubcommand) {
    const std::string net = network(), windowsFile = windows(), missing = path("missing.csv");
    std::filesystem::create_directory(path("empty"));
    const auto before = listing();
    for (const auto& [source, cause] :
         {std::pair{missing, "does not exist"}, std::pair{path("empty"), "is a folder"}, std::pair{net, "is no log"}}) {
        expectOneLine(runMrose({"inspect", source}), {source + ": ", cause});
        expectOneLine(runMrose(trainWords(source, path("b.net"))), {source + ": ", cause});
        expectOneLine(runMrose({"evaluate", net, "--log", source, "--report", path("report")}), {source + ": ", cause});
        expectOneLine(runMrose({"predict", net, "--log", source, "--windows", windowsFile, "-o", path("p.csv")}),
                      {source + ": ", cause});
    }
    EXPECT_EQ(listing(), before);
}

TEST_F(BadInput, BrokenRowsAreNamedByLineColumnAndKey) {
    struct Case {
        std::string name, content;
        std::vector<std::string> parts;
    };
    const std::string rows = restingRows(40);
    for (const Case& c :
         {Case{"columns.csv", header + rows + "102.0,0,0,1,2\n" + restingRows(9, 103), {"columns.csv:42:", "5", "6"}},
          Case{"nan.csv", header + rows + "102.0,0,nan,1,2,0\n", {"nan.csv:42:9: ", "w_cmd"}},
          Case{"inf.csv", header + rows + "102.0,inf,0,1,2,0\n", {"inf.csv:42:7: ", "v_cmd"}},
          Case{"text.csv", header + rows + "102.0,0,0,1,left,0\n", {"text.csv:42:13: ", "y"}},
          Case{"twice.csv", "t,x,x\n" + rows, {"twice.csv:1:", "x"}},
          Case{"backwards.csv", header + restingRows(400, 500) + restingRows(400, 100), {"backwards.csv:402", "t"}}}) {
        const std::string file = write(c.name, c.content);
        expectOneLine(runMrose({"inspect", file}), c.parts);
        expectOneLine(runMrose(trainWords(file, path("b.net"))), c.parts);
    }
    EXPECT_FALSE(std::filesystem::exists(path("b.net")));
}

TEST_F(BadInput, LogWithoutGroundTruthIsRefused) {
    std::string rows = "t,v_cmd,w_cmd\n";
    for (int i = 0; i < 1000; ++i) rows += std::to_string(0.05 * i) + ",0.2,0.1\n";
    const std::string commands = write("commands.csv", rows), net = network();
    expectOneLine(runMrose(trainWords(commands, path("b.net"))), {commands + ": ", "ground truth"});
    expectOneLine(runMrose({"evaluate", net, "--log", commands, "--report", path("report")}),
                  {commands + ": ", "ground truth"});
    EXPECT_EQ(runMrose({"inspect", commands}).status, 0) << "what it holds can still be said";
    EXPECT_FALSE(std::filesystem::exists(path("b.net")));
    EXPECT_FALSE(std::filesystem::exists(path("report")));
}

TEST_F(BadInput, CommandsAndGroundTruthOfDifferentTimesAreRefused) {
    std::string rows = "t,v_cmd,w_cmd,x,y,heading\n";
    for (int i = 0; i < 600; ++i) rows += std::to_string(0.05 * i) + ",0.2,0.1,,,\n";
    for (int i = 0; i < 600; ++i) rows += std::to_string(5000 + 0.05 * i) + ",,," + std::to_string(0.01 * i) + ",0,0\n";
    const std::string apart = write("apart.csv", rows), net = network();
    expectOneLine(runMrose({"evaluate", net, "--log", apart}), {apart + ": ", "expected both of the same time"});
}

TEST_F(BadInput, LogTooShortForAWindowIsRefused) {
    const std::string brief = write("brief.csv", firstLines(plantedCsv(), 60)), net = network();
    expectOneLine(runMrose(trainWords(brief, path("b.net"))), {brief + ": "});
    expectOneLine(runMrose({"evaluate", net, "--log", brief}), {brief + ": "});
    // Long enough for windows, but one trajectory cannot be learned from and held out at once.
    const std::string single = write("single.csv", firstLines(plantedCsv(), 1500));
    expectOneLine(runMrose(trainWords(single, path("b.net"))), {single + ": ", "too short"});
    EXPECT_FALSE(std::filesystem::exists(path("b.net")));
}

TEST_F(BadInput, LogGivenTwiceIsNotLearnedFromAndHeldOutAtOnce) {
    const std::string copy = write("copy.csv", plantedCsv());
    auto words = trainWords(path("b.net"));
    words.push_back(copy);
    expectOneLine(runMrose(words), {copy + ": ", "twice", log()});
    EXPECT_FALSE(std::filesystem::exists(path("b.net")));
}

TEST_F(BadInput, LogsOfDifferentKindsOfRobotMakeNoNetwork) {
    write("real/Robot1_Odometry.dat", "# command\n0.0 0.1 0.0\n0.1 0.1 0.0\n");
    write("real/Robot1_Groundtruth.dat", "# truth\n0.0 0 0 0\n0.1 0.01 0 0\n");
    const std::string synthetic = write("synthetic.csv", "# synthetic\n" + plantedCsv());
    auto words = trainWords(synthetic, path("b.net"));
    words.push_back(path("real"));
    expectOneLine(runMrose(words), {path("real") + ": ", "another kind of robot", synthetic});
    EXPECT_FALSE(std::filesystem::exists(path("b.net")));
}

TEST_F(BadInput, UnknownRobotIsNamed) {
    const std::string net = network();
    for (const std::vector<std::string>& words :
         {std::vector<std::string>{"inspect", log()},
          trainWords(path("b.net")),
          {"evaluate", net, "--log", log()},
          {"predict", net, "--log", log(), "--windows", windows(), "-o", path("p.csv")}}) {
        std::vector<std::string> all = words;
        all.insert(all.end(), {"--robots", "planted,r2d2"});
        expectOneLine(runMrose(all), {log() + ": ", "r2d2"});
    }
}

TEST_F(BadInput, ForeignAndHalfNetworksAreRefused) {
    const std::string good = network(), text = read("a.net");
    struct Case {
        std::string name, content;
        std::vector<std::string> parts;
    };
    for (const Case& c :
         {Case{"empty.net", "", {"format", "is missing"}}, Case{"half.net", text.substr(0, text.size() / 2), {":"}},
          Case{"binary.net", std::string("\0\xff\x01 not a network", 17), {}},
          Case{"foreign.net", "FANN_FLO_2.1\nnum_layers=3\n", {"foreign.net:1:", "TOML"}},
          Case{"later.net", replaced(text, "version = 1", "version = 2"), {"later.net:3:11: version: "}},
          Case{"unit.net", replaced(text, "hidden = 6", "hidden = 7"), {"hidden_weights"}},
          Case{"huge.net", replaced(text, "hidden = 6", "hidden = 999999999999"), {"hidden: "}},
          Case{"weight.net",
               replaced(text, "output_biases = [", "output_biases = [1e39, "),
               {"output_biases: has 8 numbers; expected 7"}},
          Case{"key.net", "\"new\\nline\" = 1\n" + text, {"key.net:1:15: new?line: "}},
          Case{"extra.net", "colour = \"red\"\n" + text, {"extra.net:1:", "colour"}}}) {
        std::vector<std::string> parts = c.parts;
        parts.push_back(c.name);
        const std::string file = write(c.name, c.content);
        expectOneLine(runMrose({"evaluate", file, "--log", log(), "--report", path("report")}), parts);
        expectOneLine(runMrose({"predict", file, "--log", log(), "--windows", windows(), "-o", path("p.csv")}), parts);
    }
    expectOneLine(runMrose({"evaluate", path("no.net"), "--log", log()}), {"no.net: ", "No such file"});
    expectOneLine(runMrose({"evaluate", path(""), "--log", log()}), {"Is a directory"});
    expectOneLine(runMrose({"evaluate", good, "--against", path("no.net"), "--log", log()}), {"no.net: "});
    EXPECT_FALSE(std::filesystem::exists(path("p.csv")) || std::filesystem::exists(path("report")));
}

TEST_F(BadInput, NetworkForAnotherPeriodIsRefused) {
    network();
    const std::string other = write("b.net", replaced(read("a.net"), "period_s = 0.1\n", "period_s = 0.07\n"));
    expectOneLine(runMrose({"evaluate", other, "--log", log(), "--report", path("report")}), {"b.net: ", "0.07"});
    write("p.csv", "earlier");
    expectOneLine(
        runMrose({"predict", other, "--log", log(), "--windows", windows(), "-o", path("p.csv"), "--overwrite"}),
        {"b.net: ", "0.07"});
    EXPECT_EQ(read("p.csv"), "earlier");
    EXPECT_FALSE(std::filesystem::exists(path("report")));
}

TEST_F(BadInput, HorizonBetweenTwoStepsIsRefused) {
    const std::string net = network();
    expectOneLine(runMrose({"evaluate", net, "--log", log(), "--horizon", "0.55"}), {"horizon: 0.55 s", "0.1 s"});
    expectOneLine(
        runMrose({"predict", net, "--log", log(), "--windows", windows(), "-o", path("p.csv"), "--horizon", "0.55"}),
        {"horizon: 0.55 s", "0.1 s"});
    EXPECT_FALSE(std::filesystem::exists(path("p.csv")));
}

TEST_F(BadInput, WindowsFileErrorsNameLineAndColumn) {
    const std::string net = network(), out = path("p.csv");
    write("p.csv", "earlier");
    struct Case {
        std::string name, content;
        std::vector<std::string> parts;
    };
    for (const Case& c :
         {Case{"column.csv", "dataset,robot\n0,planted\n", {"column.csv:1", "t_start"}},
          Case{"text.csv", "dataset,robot,t_start\n0,planted,soon\n", {"text.csv:2:11: ", "t_start"}},
          Case{"nan.csv", "dataset,robot,t_start\n0,planted,nan\n", {"nan.csv:2:11: ", "t_start"}},
          Case{"robot.csv", "dataset,robot,t_start\n0,r2d2,1700000003\n", {"robot.csv:2: robot: ", "r2d2"}},
          Case{"set.csv", "dataset,robot,t_start\n3,planted,1700000003\n", {"set.csv:2: dataset: ", "3"}},
          Case{"late.csv",
               "dataset,robot,t_start,trajectory\n0,planted,1800000000,run0\n",
               {"late.csv:2: t_start: ", "no ground truth"}},
          Case{"which.csv", "dataset,robot,t_start\n0,planted,1700000003\n", {"which.csv:2: ", "several trajectories"}},
          Case{"empty.csv", "", {"empty.csv"}}}) {
        const std::string file = write(c.name, c.content);
        expectOneLine(runMrose({"predict", net, "--log", log(), "--windows", file, "-o", out, "--overwrite"}), c.parts);
    }
    expectOneLine(runMrose({"predict", net, "--log", log(), "--windows", path("no.csv"), "-o", out, "--overwrite"}),
                  {"no.csv: "});
    EXPECT_EQ(read("p.csv"), "earlier");
    EXPECT_FALSE(std::filesystem::exists(path("p.csv.part")));
}

}  // namespace
}  // namespace mrose

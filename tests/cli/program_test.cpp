// The program as its users run it: what goes well.
#include <algorithm>
#include <sstream>

#include <nlohmann/json.hpp>

#include "motion/motion_network.h"
#include "support/places.h"
#include "support/workshop.h"

namespace mrose {
namespace {

using Program = Workshop;
using Json = nlohmann::json;

std::vector<std::string> linesOf(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
}

TEST_F(Program, TellsItsVersion) {
    const ProgramResult result = runMrose({"--version"});
    EXPECT_EQ(result.status, 0);
    EXPECT_TRUE(result.out.starts_with("mrose 0.")) << result.out;
    EXPECT_EQ(result.err, "");
}

TEST_F(Program, HelpOfEverySubcommandHasExamplesAndTheCommonFlags) {
    const ProgramResult all = runMrose({"--help"});
    EXPECT_EQ(all.status, 0);
    for (const std::string name : {"inspect", "train", "evaluate", "predict", "advise", "generate", "compare"}) {
        EXPECT_NE(all.out.find("\n  " + name), std::string::npos) << name;
        const ProgramResult help = runMrose({name, "--help"});
        EXPECT_EQ(help.status, 0);
        EXPECT_NE(help.out.find("Examples:\n  mrose " + name + ' '), std::string::npos) << help.out;
        for (const char* flag : {"--quiet", "--json"})
            EXPECT_NE(help.out.find(flag), std::string::npos) << name << flag;
    }
}

/// Flags that would do nothing are not there.
TEST_F(Program, FlagsAreOfferedWhereTheyAct) {
    const std::pair<const char*, std::vector<std::string>> cases[] = {
        {"--seed", {"train", "predict", "advise", "generate", "run", "batch", "compare"}},
        {"--threads", {"inspect", "train", "batch", "compare"}},
        {"--overwrite", {"train", "evaluate", "predict", "advise", "generate", "shapes", "run", "compare"}}};
    for (const auto& [flag, commands] : cases)
        for (const char* name : {"inspect", "train", "evaluate", "predict", "advise", "generate", "shapes", "run",
                                 "replay", "batch", "compare"}) {
            const bool offered = std::find(commands.begin(), commands.end(), name) != commands.end();
            EXPECT_EQ(runMrose({name, "--help"}).out.find(std::string("  ") + flag + ' ') != std::string::npos, offered)
                << name << ' ' << flag;
        }
    expectOneLine(runMrose({"replay", "a.mcap", "--seed", "3"}), {"--seed"}, 2);
    expectOneLine(runMrose({"shapes", "ball.toml", "--threads", "3"}), {"--threads"}, 2);
}

TEST_F(Program, OutputsThatAreThereAreReplacedOnlyWhenAsked) {
    const std::string net = network(), windowsFile = windows(), logFile = log();
    const std::vector<std::pair<std::vector<std::string>, std::string>> cases = {
        {trainWords(path("b.net")), "b.net"},
        {{"predict", net, "--log", logFile, "--windows", windowsFile, "-o", path("p.csv")}, "p.csv"},
        {{"evaluate", net, "--log", logFile, "--report", path("report")}, "report/windows.csv"},
        {{"generate", "--pattern", "ellipse", "-o", path("logs")}, "logs/ellipse.csv"},
        {{"shapes", "ball.toml", "-o", path("ball.svg")}, "ball.svg"},
        {{"shapes", "ball.toml", "-o", path("pictures")}, "pictures/ball.shape.svg"},
        {{"run", "soccer.toml", "--duration", "0.1", "--record", path("a.mcap")}, "a.mcap"}};
    for (auto [words, file] : cases) {
        write(file, "earlier");
        words.push_back("--quiet");
        expectOneLine(runMrose(words), {path(file) + ": is there already; --overwrite replaces it"});
        EXPECT_EQ(read(file), "earlier");
        words.push_back("--overwrite");
        EXPECT_EQ(runMrose(words).status, 0) << file;
        EXPECT_NE(read(file), "earlier") << file;
    }
}

TEST_F(Program, WrongUsageIsOneLineAndStatusTwo) {
    expectOneLine(runMrose({}), {"--help"}, 2);
    expectOneLine(runMrose({"teach"}), {"teach"}, 2);
    expectOneLine(runMrose({"train", log()}), {"--output", "required"}, 2);
    expectOneLine(runMrose({"inspect", log(), "--threads", "many"}), {"--threads", "many"}, 2);
    expectOneLine(runMrose({"inspect", log(), "--colour"}), {"--colour"}, 2);
    expectOneLine(runMrose({"train", log(), "-o", path("x"), "--seed", "-1"}), {"--seed", "-1"}, 2);
    expectOneLine(runMrose({"train", log(), "-o", path("x"), "--method", "lm"}), {"--method lm", "one-step"}, 2);
    EXPECT_EQ(listing(), std::vector<std::string>{"log.csv"});
}

TEST_F(Program, SeedOfAPredictionNeedsSamples) {
    const std::vector<std::string> words{"predict", "a",  "--log",   "b",      "--windows",
                                         "c",       "-o", path("x"), "--seed", "2"};
    expectOneLine(runMrose(words), {"--seed requires --samples"}, 2);
}

TEST_F(Program, NoNumberIsNoValueOfAnyFlag) {
    auto training = trainWords(path("x.net")), evaluation = std::vector<std::string>{"evaluate", "a", "--log", "b"},
         prediction = std::vector<std::string>{"predict", "a", "--log", "b", "--windows", "c", "-o", path("x")},
         generation = std::vector<std::string>{"generate", "--pattern", "random", "-o", path("x")};
    for (const auto& [words, flags] :
         {std::pair{training,
                    std::vector<std::string>{"--hold-out", "--dead-time-v", "--dead-time-w", "--lag-v", "--lag-w"}},
          std::pair{evaluation, std::vector<std::string>{"--horizon"}},
          std::pair{prediction, std::vector<std::string>{"--horizon"}},
          std::pair{generation, std::vector<std::string>{"--duration"}}})
        for (const std::string& flag : flags)
            for (const char* value : {"nan", "-nan", "inf"}) {
                auto all = words;
                all.insert(all.end(), {flag + '=' + value});
                expectOneLine(runMrose(all), {flag, value}, 2);
            }
    EXPECT_EQ(listing(), std::vector<std::string>{"log.csv"});
}

TEST_F(Program, InspectPrintsWhatItFinds) {
    const ProgramResult text = runMrose({"inspect", log()});
    EXPECT_EQ(text.status, 0);
    EXPECT_NE(text.out.find("robot planted, 4 trajectories"), std::string::npos) << text.out;
    const ProgramResult result = runMrose({"inspect", log(), "--json"});
    ASSERT_EQ(result.status, 0);
    EXPECT_EQ(result.err, "");
    const Json json = Json::parse(result.out, nullptr, false);
    ASSERT_FALSE(json.is_discarded());
    EXPECT_EQ(json["source"], log());
    EXPECT_EQ(json["format"], "csv");
    ASSERT_EQ(json["robots"].size(), 1u);
    const Json& robot = json["robots"][0];
    EXPECT_EQ(robot["robot"], "planted");
    EXPECT_EQ(robot["trajectories"], 4);
    EXPECT_EQ(robot["delays"]["w"]["identified"], true);
}

TEST_F(Program, TrainedNetworkIsEvaluatedAndReported) {
    const std::string net = network(), report = path("reports/first");
    const ProgramResult result = runMrose({"evaluate", net, "--log", log(), "--report", report, "--json"});
    ASSERT_EQ(result.status, 0) << result.err;
    const Json json = Json::parse(result.out, nullptr, false);
    ASSERT_FALSE(json.is_discarded());
    EXPECT_EQ(Json::parse(read("reports/first/results.json"), nullptr, false), json);
    const std::string html = read("reports/first/report.html");
    EXPECT_TRUE(html.starts_with("<!DOCTYPE html>") && html.ends_with("</html>\n"));
    EXPECT_NE(html.find("<svg"), std::string::npos);
    EXPECT_GT(linesOf(read("reports/first/results.csv")).size(), 5u);
    const std::vector<std::string> names = listing();
    EXPECT_EQ(std::count_if(names.begin(), names.end(), [](const auto& name) { return name.starts_with("reports"); }),
              6)
        << "the folders reports and reports/first with four files";
    const ProgramResult text = runMrose({"evaluate", net, "--log", log()});
    EXPECT_NE(text.out.find("velocity = command"), std::string::npos) << text.out;
}

TEST_F(Program, NetworkJudgedByItsOwnLogSaysSo) {
    const std::string sentence = "learned from this log";
    const std::string other = write("other.csv", plantedCsv() + "# other bytes\n");
    const ProgramResult own = runMrose({"evaluate", network(), "--log", log(), "--report", path("own")});
    EXPECT_NE(own.out.find("Note: The network was " + sentence), std::string::npos) << own.out;
    EXPECT_NE(read("own/report.html").find(sentence), std::string::npos);
    const ProgramResult foreign = runMrose({"evaluate", network(), "--log", other, "--report", path("foreign")});
    EXPECT_EQ(foreign.status, 0);
    EXPECT_EQ(foreign.out.find("Note:"), std::string::npos) << foreign.out;
    EXPECT_EQ(read("foreign/report.html").find(sentence), std::string::npos);
}

TEST_F(Program, RobotsThatTheNetworkDoesNotKnowAreNamed) {
    std::string text = plantedCsv();
    for (std::size_t at = 0; (at = text.find("planted,", at)) != std::string::npos;) text.replace(at, 8, "newcomer,");
    const std::string other = write("other.csv", text);
    const ProgramResult shown = runMrose({"evaluate", network(), "--log", other, "--json", "--no-floor"});
    ASSERT_EQ(shown.status, 0) << shown.err;
    const Json notices = Json::parse(shown.out, nullptr, false)["notices"];
    ASSERT_EQ(notices.size(), 1u);
    EXPECT_NE(notices[0].get<std::string>().find("newcomer"), std::string::npos) << notices;
    write("create.net", replaced(read("a.net"), "robot_type = \"robot\"", "robot_type = \"husky\""));
    write("synthetic.csv", "# synthetic\n" + plantedCsv());
    const ProgramResult kind = runMrose({"evaluate", path("create.net"), "--log", path("synthetic.csv"), "--no-floor"});
    EXPECT_NE(kind.out.find("another kind of robot (husky)"), std::string::npos) << kind.out;
}

TEST_F(Program, ChosenWindowsAreShown) {
    const std::string net = network();
    ASSERT_EQ(runMrose({"evaluate", net, "--log", log(), "--report", path("r"), "--show", "2,4"}).status, 0);
    const std::string html = read("r/report.html");
    for (const char* number : {"window\u00a02 ", "window\u00a04 "})
        EXPECT_NE(html.find(number), std::string::npos) << number;
    EXPECT_NE(html.find("hosen"), std::string::npos);
    expectOneLine(runMrose({"evaluate", net, "--log", log(), "--report", path("s"), "--show", "1,999"}),
                  {"--show: ", "999"});
    EXPECT_FALSE(std::filesystem::exists(path("s")));
    expectOneLine(runMrose({"evaluate", net, "--log", log(), "--show", "1"}), {"--show", "--report"}, 2);
}

TEST_F(Program, WindowsOfAReportCanBePredicted) {
    const std::string net = network();
    const ProgramResult evaluated = runMrose({"evaluate", net, "--log", log(), "--report", path("r"), "--json"});
    const std::size_t count = Json::parse(evaluated.out, nullptr, false)["windows"].size();
    const ProgramResult predicted =
        runMrose({"predict", net, "--log", log(), "--windows", path("r/windows.csv"), "-o", path("p.csv")});
    ASSERT_EQ(predicted.status, 0) << predicted.err;
    EXPECT_GT(count, 0u);
    EXPECT_EQ(linesOf(read("p.csv")).size(), 1 + 100 * count);
}

TEST_F(Program, LogsAreFoundByNameInTheFolderOfData) {
    const std::string net = network(), windowsFile = windows();
    std::filesystem::create_directory(path("mrclam"));
    write("mrclam/named.csv", plantedCsv());
    const auto saysTheSame = [&](const std::vector<std::string>& words) {
        const auto of = [&](const std::string& log) {
            auto with = words;
            std::replace(with.begin(), with.end(), std::string("LOG"), log);
            return with;
        };
        expectOneLine(runMrose(of("named.csv")), {"named.csv: does not exist"});
        const ProgramResult placed = runMrose(of(path("mrclam/named.csv"))),
                            named = runWithData(path(""), of("named.csv"));
        EXPECT_EQ(named.status, 0) << named.err;
        EXPECT_EQ(replaced(named.out, "named.csv", ""), replaced(placed.out, "named.csv", "")) << words[0];
    };
    saysTheSame({"inspect", "LOG"});
    saysTheSame({"evaluate", net, "--log", "LOG", "--no-floor"});
    const std::string out = path("p.csv");
    const std::vector<std::string> predict{"predict", net, "--log", "named.csv", "--windows", windowsFile, "-o", out};
    expectOneLine(runMrose(predict), {"named.csv: does not exist"});
    EXPECT_EQ(runWithData(path(""), predict).status, 0);
    EXPECT_EQ(linesOf(read("p.csv")).size(), 1u + 4 * 100);
    const auto train = trainWords("named.csv", path("b.net"));
    expectOneLine(runMrose(train), {"named.csv: does not exist"});
    EXPECT_EQ(runWithData(path(""), train).status, 0);
    EXPECT_NE(read("b.net"), "");
    // What is read is not overwritten, wherever it was found.
    auto onto = predict;
    onto.back() = path("mrclam/named.csv");
    onto.emplace_back("--overwrite");
    expectOneLine(runWithData(path(""), onto), {"is read by this command"});
}

TEST_F(Program, NetworksThatShipAreFoundByTheirNames) {
    const std::string pioneer = (sourceFolder() / "resources/logs/pioneer").string();
    const auto evaluated = [&](const std::string& network) {
        return runMrose({"evaluate", network, "--log", pioneer, "--no-floor", "--json"});
    };
    const auto saidOf = [&](const std::string& network) {
        const ProgramResult result = evaluated(network);
        EXPECT_EQ(result.status, 0) << result.err;
        auto json = nlohmann::json::parse(result.out);
        json.erase("command_line");
        return json;
    };
    EXPECT_EQ(saidOf("pioneer.net"), saidOf((sourceFolder() / "nets/pioneer.net").string()));
    expectOneLine(evaluated("pioneers.net"), {"pioneers.net", "cannot be read"}, 1);
}

TEST_F(Program, RobotNamedTwiceIsOneRobot) {
    const std::vector<std::string> words{"evaluate", network(), "--log", log(), "--no-floor", "--robots"};
    auto once = words, twice = words;
    once.push_back("planted");
    twice.push_back("planted,planted");
    EXPECT_EQ(runMrose(once).out, runMrose(twice).out);
}

TEST_F(Program, InspectReportsWhatItDropped) {
    const std::string lone = write("lone.csv", plantedCsv() + "planted,run3,1700000900,,,5,,\n");
    const ProgramResult text = runMrose({"inspect", lone});
    EXPECT_NE(text.out.find("found     1 value without a partner, dropped"), std::string::npos) << text.out;
    const Json json = Json::parse(runMrose({"inspect", lone, "--json"}).out, nullptr, false);
    EXPECT_EQ(json["robots"][0]["defects"]["unpaired"], 1);
}

TEST_F(Program, InspectSaysWhatSensorsReported) {
    const std::string without = write("without.csv", "t,v_cmd,w_cmd\n0,1,0\n1,1,0\n2,1,0\n");
    EXPECT_NE(runMrose({"inspect", without}).out.find("\nThe log holds no measurements: "), std::string::npos);
    EXPECT_EQ(Json::parse(runMrose({"inspect", without, "--json"}).out)["robots"][0]["sensors"], Json::array());
    const std::string with = write("with.csv",
                                   "t,v_cmd,w_cmd,sensor,subject,range,bearing\n"
                                   "0,1,0,,,,\n0.1,,,camera,6,1,0\n0.4,,,camera,,,\n0.7,,,camera,6,1,0\n"
                                   "0.701,,,camera,7,1,0\n2,1,0,,,,\n");
    const std::string text = runMrose({"inspect", with}).out;
    EXPECT_EQ(text.find("no measurements"), std::string::npos);
    EXPECT_NE(
        text.find("\n  camera    3 looks, 1 of them empty; 3 readings of 2 subjects (100 % landmarks), 1.5 a look\n"),
        std::string::npos)
        << text;
    EXPECT_NE(text.find("every 0.300 ± 0.000 s; lateness not identified: no ground truth\n"), std::string::npos)
        << text;
    EXPECT_NE(text.find("found     1 stamp shortly after another, taken for one look\n"), std::string::npos) << text;
    const Json camera = Json::parse(runMrose({"inspect", with, "--json"}).out)["robots"][0]["sensors"][0];
    EXPECT_EQ(camera["sensor"], "camera");
    EXPECT_EQ(camera["looks"], 3);
    EXPECT_EQ(camera["lateness"]["reason"], "no ground truth");
    EXPECT_EQ(camera["defects"]["joined_stamps"], 1);
    EXPECT_EQ(camera["changes"], Json::array());
    EXPECT_TRUE(camera["truth"].is_null());
}

TEST_F(Program, PredictWritesARowForEachWindowAndStep) {
    const std::string out = path("predicted.csv");
    const ProgramResult result =
        runMrose({"predict", network(), "--log", log(), "--windows", windows(), "-o", out, "--horizon", "2"});
    ASSERT_EQ(result.status, 0) << result.err;
    const std::vector<std::string> lines = linesOf(read("predicted.csv"));
    ASSERT_EQ(lines.size(), 1u + 4 * 20);
    EXPECT_TRUE(lines[0].starts_with("dataset,robot,t_start,t,x,y,heading")) << lines[0];
    for (std::size_t i = 1; i < lines.size(); ++i) {
        double t = 0, x = 0, y = 0, heading = 0;
        ASSERT_EQ(std::sscanf(lines[i].c_str(), "0,planted,1700000003.5,%lf,%lf,%lf,%lf", &t, &x, &y, &heading), 4)
            << lines[i];
        EXPECT_NEAR(t, 0.1 * static_cast<double>((i - 1) % 20 + 1), 1e-9);
        EXPECT_LT(std::abs(x) + std::abs(y), 20);
    }
}

TEST_F(Program, PredictionReadsNothingLaterThanItMay) {
    // After the window's end the log says something else; the predictions stay the same to the byte.
    const std::string common = firstLines(plantedCsv(), 900);
    ASSERT_TRUE(common.starts_with("robot,trajectory,t,v_cmd,w_cmd,x,y,heading\n")) << firstLines(common, 1);
    const std::string window = write("one.csv", "dataset,robot,t_start\n0,planted,1700000003.5\n");
    const std::string row = "planted,run0,1700000008.9,";
    const std::string first = write("first.csv", common + row + "0.5,1,9,9,1\n");
    const std::string second = write("second.csv", common + row + "-0.5,-1,-9,-9,-1\n");
    for (const auto& [log, out] : {std::pair{first, "p1.csv"}, std::pair{second, "p2.csv"}})
        ASSERT_EQ(runMrose({"predict", network(), "--log", log, "--windows", window, "-o", path(out), "--horizon", "3"})
                      .status,
                  0);
    EXPECT_EQ(read("p1.csv"), read("p2.csv"));
    EXPECT_EQ(linesOf(read("p1.csv")).size(), 31u);
}

TEST_F(Program, NetworkFileDependsOnSeedAndNotOnThreads) {
    // The command line is part of the file: runs differ only by what the environment says.
    const auto train = [&](const std::string& seed, const std::string& threads) {
        std::vector<std::string> words = trainWords(path("b.net"));
        words.insert(words.end(), {"--overwrite", "--seed", seed, "--threads", threads});
        EXPECT_EQ(runMrose(words).status, 0);
        return replaced(read("b.net"), "--threads " + threads, "--threads N");
    };
    const std::string one = train("1", "1");
    EXPECT_EQ(one, train("1", "1"));
    EXPECT_EQ(one, train("1", "2"));
    EXPECT_NE(one.substr(one.find("[layers]")),
              [](const std::string& text) { return text.substr(text.find("[layers]")); }(train("2", "2")));
}

TEST_F(Program, ProgressGoesToStandardErrorUnlessQuiet) {
    const ProgramResult loud = runMrose(trainWords(path("b.net")));
    EXPECT_NE(loud.err.find("epoch 10: loss "), std::string::npos) << loud.err;
    EXPECT_NE(loud.err.find("left"), std::string::npos) << loud.err;
    EXPECT_NE(loud.err.find("network 1 of "), std::string::npos) << loud.err;
    EXPECT_NE(loud.err.find(" for the noise), epoch "), std::string::npos) << loud.err;
    EXPECT_EQ(loud.out.find("epoch 10"), std::string::npos);
    std::vector<std::string> longer = trainWords(path("b.net"));
    for (const auto& [flag, value] :
         {std::pair{"--members", "4"}, std::pair{"--folds", "4"}, std::pair{"--epochs", "200"}})
        *(std::find(longer.begin(), longer.end(), flag) + 1) = value;
    longer.push_back("--overwrite");
    EXPECT_LE(linesOf(runMrose(longer).err).size(), 12u) << "no terminal: a line for each tenth, and one of the noise";
    std::vector<std::string> words = trainWords(path("b.net"));
    words.insert(words.end(), {"--quiet", "--overwrite"});
    const ProgramResult quiet = runMrose(words);
    EXPECT_EQ(quiet.status, 0);
    EXPECT_EQ(quiet.err, "");
}

TEST_F(Program, FewEpochsAreEnough) {
    EXPECT_EQ(runMrose({"train", log(), "-o", path("b.net"), "--epochs", "3", "--members", "1", "--folds", "2"}).status,
              0);
}

TEST_F(Program, TrainPrintsJson) {
    std::vector<std::string> words = trainWords(path("b.net"));
    words.insert(words.end(), {"--json", "--quiet", "--dead-time-v", "0.123"});
    const ProgramResult result = runMrose(words);
    ASSERT_EQ(result.status, 0) << result.err;
    const Json json = Json::parse(result.out, nullptr, false);
    ASSERT_FALSE(json.is_discarded()) << result.out;
    EXPECT_EQ(json["network"], path("b.net"));
    EXPECT_EQ(json["interrupted"], false);
    const auto net = loadNetwork(path("b.net"));
    ASSERT_TRUE(net);
    EXPECT_EQ(json["patterns"], net->training.patterns);
    ASSERT_EQ(net->training.logs.size(), 1u);
    EXPECT_EQ(net->training.logs[0].path, log());
    EXPECT_EQ(net->training.command.substr(0, 12), "mrose train ");
}

TEST_F(Program, OutputBehindASymbolicLinkKeepsTheLink) {
    write("kept/real.net", "old");
    std::filesystem::create_symlink("kept/real.net", path("link.net"));
    std::vector<std::string> words = trainWords(path("link.net"));
    words.push_back("--overwrite");
    ASSERT_EQ(runMrose(words).status, 0);
    EXPECT_TRUE(std::filesystem::is_symlink(path("link.net")));
    EXPECT_TRUE(loadNetwork(path("kept/real.net")));
}

}  // namespace
}  // namespace mrose

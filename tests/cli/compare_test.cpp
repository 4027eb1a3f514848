// `mrose compare` as its users run it.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <sstream>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "io/file.h"
#include "io/format.h"
#include "support/camera_folder.h"
#include "support/places.h"
#include "support/referee.h"
#include "support/test_data.h"
#include "support/workshop.h"

namespace mrose {
namespace {

using Json = nlohmann::json;
using Words = std::vector<std::string>;

/// A scenario of one robot that plays the log that ships, by the network that ships, without noise.
class CompareProgram : public Workshop {
protected:
    std::string scenario(const std::string& controller = R"({ kind = "log_player", log = "x", robot = "reference" })",
                         const std::string& start = "") const {
        write("r.toml",
              "format = \"mrose robot\"\nversion = 1\nname = \"r\"\nshape = \"pioneer1.toml\"\nmass_kg = 7\n"
              "[motion]\nnetwork = \"pioneer.net\"\nrobot = \"reference\"\n");
        write("e.toml",
              "format = \"mrose environment\"\nversion = 1\nname = \"plane\"\n[floor]\n"
              "area_m = [[-50, -50], [50, -50], [50, 50], [-50, 50]]\n");
        return write("s.toml",
                     "format = \"mrose scenario\"\nversion = 1\nname = \"replay\"\nenvironment = \"e.toml\"\n"
                     "duration_s = 20\n[[robot]]\nname = \"twin\"\ntype = \"r.toml\"\n" +
                         start + "controller = " + controller + "\n");
    }
    static std::string shippedLog() { return (sourceFolder() / "resources/logs/pioneer").string(); }
    static std::string shippedNetwork() { return (sourceFolder() / "nets/pioneer.net").string(); }

    /// compare with `more`; its result as JSON.
    Json result(Words words) {
        words.insert(words.end(), {"--json", "--quiet"});
        const ProgramResult ran = runMrose(words);
        EXPECT_EQ(ran.status, 0) << ran.err;
        EXPECT_EQ(ran.err, "");
        return Json::parse(ran.out, nullptr, false);
    }
};

/// Rows of a CSV file by their column names.
std::vector<std::map<std::string, std::string>> rowsOf(const std::string& csv) {
    const auto cellsOf = [](const std::string& line) {
        Words cells(1);
        bool quoted = false;
        for (const char c : line) {
            if (c == '"')
                quoted = !quoted;
            else if (c == ',' && !quoted)
                cells.emplace_back();
            else
                cells.back() += c;
        }
        return cells;
    };
    std::istringstream stream(csv);
    std::string line;
    std::getline(stream, line);
    const Words columns = cellsOf(line);
    std::vector<std::map<std::string, std::string>> rows;
    while (std::getline(stream, line)) {
        const Words cells = cellsOf(line);
        EXPECT_EQ(cells.size(), columns.size()) << line;
        for (std::size_t i = 0; i < std::min(cells.size(), columns.size()); ++i)
            (i == 0 ? rows.emplace_back() : rows.back())[columns[i]] = cells[i];
    }
    return rows;
}

TEST_F(CompareProgram, AgreesWithEvaluateAndPredictForTheSameWindows) {
    ASSERT_EQ(
        runMrose({"evaluate", shippedNetwork(), "--log", shippedLog(), "--no-floor", "--report", path("ev")}).status,
        0);
    const std::string windows = path("ev/windows.csv");
    ASSERT_EQ(runMrose({"predict", shippedNetwork(), "--log", shippedLog(), "--windows", windows, "-o", path("p.csv")})
                  .status,
              0);
    const Json ours =
        result({"compare", scenario(), "--log", shippedLog(), "--windows", windows, "--report", path("report")});
    const Json theirs = Json::parse(read("ev/results.json"), nullptr, false)["models"][0]["all"];
    const Json& summary = ours["all"]["summary"];
    EXPECT_GT(theirs["windows"], 20);
    for (const char* figure : {"windows", "path_m", "rotation_rad", "P_percent", "Hd_percent", "P_interval95_percent",
                               "position_final_m", "heading_final_rad", "final_left_m"})
        EXPECT_EQ(summary[figure], theirs[figure]) << figure;
    EXPECT_EQ(ours["touches"], 0);

    const auto simulated = rowsOf(read("report/errors.csv")), predicted = rowsOf(read("p.csv"));
    ASSERT_EQ(simulated.size(), predicted.size());
    for (std::size_t i = 0; i < simulated.size(); ++i)
        for (const auto& [column, value] : predicted[i]) EXPECT_EQ(simulated[i].at(column), value) << i << column;
    for (const char* file : {"report/report.html", "report/rollouts.csv", "report/results.json"})
        EXPECT_NE(read(file), "") << file;
}

TEST_F(CompareProgram, SaysWhoseNetworkKnowsNoNoise) {
    const auto notices = [&](const std::string& text) {
        return result({"compare", text, "--log", shippedLog(), "--duration", "2", "--no-causes"})["notices"].dump();
    };
    const std::string file = scenario(), said = "The network knows its mean alone";
    EXPECT_EQ(notices(file).find(said), std::string::npos);
    write("r.toml", replaced(read("r.toml"), "network = \"pioneer.net\"\nrobot = \"reference\"",
                             "network = \"create_paper.net\""));
    const std::string found = notices(file);
    EXPECT_NE(found.find(said), std::string::npos) << found;
    EXPECT_EQ(found.find(said), found.rfind(said)) << "once";
}

TEST_F(CompareProgram, LogOfShortPiecesIsCutAsEvaluateCutsIt) {
    std::string text =
        "window,calib_step,t_s,cmd_left_radps,cmd_right_radps,wheel_left_radps,wheel_right_radps,icp_x_m,icp_y_m,"
        "icp_yaw_rad,imu_yaw_rad,steady\n";
    for (int window = 0; window < 5; ++window)
        for (int row = 0; row < 40; ++row) {
            const std::string wheels = numberText(3 + 0.1 * window), number = std::to_string(window);
            text += number + ',' + number + ',' + numberText(0.05 * row) + ',' + wheels + ',' + wheels + ',' + wheels +
                    ',' + wheels + ',' + numberText(0.02 * row) + ",0,0,0,1\n";
        }
    const std::string log = write("husky.csv", text), network = (sourceFolder() / "nets/husky.net").string();
    ASSERT_EQ(runMrose({"evaluate", network, "--log", log, "--no-floor", "--report", path("ev")}).status, 0);
    const Json theirs = Json::parse(read("ev/results.json"), nullptr, false)["models"][0]["all"];
    const Json ours = result({"compare", "--log", log, "--no-causes"});
    EXPECT_EQ(theirs["windows"], 5);
    for (const char* figure : {"windows", "P_percent", "Hd_percent"})
        EXPECT_EQ(ours["all"]["summary"][figure], theirs[figure]) << figure;
    EXPECT_NE(ours["notices"].dump().find("windows of 1.9 s, as `mrose evaluate` cuts them"), std::string::npos);
    const Json asked = result({"compare", "--log", log, "--no-causes", "--windows", "all", "--duration", "1.9"});
    EXPECT_EQ(asked["all"], ours["all"]);
    const Json told = result({"compare", "--log", log, "--no-causes", "--every", "0.5"});
    EXPECT_EQ(told["all"]["rollouts"], 15) << "three of 0.5 s in each 1.95 s";
    EXPECT_EQ(told["notices"].dump().find("as `mrose evaluate` cuts them"), std::string::npos);
}

TEST_F(CompareProgram, AllWindowsAreThoseOfEvaluate) {
    const std::string log = shippedLog() + "/random.csv";
    const ProgramResult evaluated =
        runMrose({"evaluate", shippedNetwork(), "--log", log, "--horizon", "5", "--no-floor", "--json"});
    const Json theirs = Json::parse(evaluated.out, nullptr, false)["models"][0]["all"];
    const Json ours = result(
        {"compare", scenario(), "--log", log, "--windows", "all", "--duration", "5", "--no-causes"})["all"]["summary"];
    EXPECT_GT(theirs["windows"], 1);
    for (const char* figure : {"windows", "P_percent", "Hd_percent"}) EXPECT_EQ(ours[figure], theirs[figure]) << figure;
}

TEST_F(CompareProgram, TheRefereeFindsTheSameErrorsInRealLogs) {
    const auto data = realData();
    const auto command = referee();
    if (!data || !command) GTEST_SKIP() << "no real logs or no referee: set MROSE_DATA and MROSE_REFEREE";
    const std::string mrclam = (*data / "mrclam").string();
    const auto windows = outputOf(*command + " windows '" + mrclam + "' --dataset 7 --robots 1,2");
    ASSERT_TRUE(windows);
    const Json ours = result({"compare", "mrclam_replay.toml", "--log", mrclam + "/MRCLAM_Dataset7", "--robots", "1,2",
                              "--windows", write("w.csv", *windows), "--report", path("report")});
    const auto verdict =
        outputOf(*command + " score '" + mrclam + "' --dataset 7 --robots 1,2 '" + path("report/errors.csv") + "'");
    ASSERT_TRUE(verdict);
    const Json& summary = ours["all"]["summary"];
    // Its figures are rounded to 0.01.
    EXPECT_EQ(numberAfter(*verdict, "windows "), summary["windows"].get<double>()) << *verdict;
    EXPECT_NEAR(numberAfter(*verdict, "P "), summary["P_percent"].get<double>(), 0.01);
    EXPECT_NEAR(numberAfter(*verdict, "Hd "), summary["Hd_percent"].get<double>(), 0.01);
}

TEST_F(CompareProgram, OneRolloutAsTheScenarioRunsOrManyThatRestart) {
    const Json one = result({"compare", scenario(), "--log", shippedLog()});
    EXPECT_EQ(one["all"]["rollouts"], 1);
    EXPECT_EQ(one["notices"].size(), 1u) << "synthetic: " << one["notices"];
    const ProgramResult shortened =
        runMrose({"compare", scenario(), "--log", shippedLog(), "--start", "10", "--duration", "1000"});
    EXPECT_NE(shortened.out.find("Note: The ground truth ends "), std::string::npos) << shortened.out;
    const Json many = result({"compare", scenario(), "--log", shippedLog(), "--start", "3", "--duration", "40",
                              "--every", "8", "--report", path("report")});
    const auto rollouts = rowsOf(read("report/rollouts.csv"));
    EXPECT_EQ(many["all"]["rollouts"], rollouts.size());
    std::map<std::string, Words> starts;
    for (const auto& row : rollouts) {
        starts[row.at("trajectory")].push_back(row.at("start_s"));
        EXPECT_EQ(row.at("duration_s"), "8.0");
        EXPECT_EQ(row.at("simulated"), "twin");
    }
    EXPECT_EQ(starts.at("random2"), (Words{"3.0", "11.0", "19.0", "27.0", "35.0"}));

    // Errors are told by the poses beside them.
    const auto rows = rowsOf(read("report/errors.csv"));
    EXPECT_EQ(rows.size(), 80 * rollouts.size());
    for (const auto& row : rows) {
        const auto number = [&](const char* column) { return std::stod(row.at(column)); };
        EXPECT_NEAR(std::hypot(number("x") - number("real_x"), number("y") - number("real_y")),
                    number("position_error_m"), 1e-6);
    }
}

TEST_F(CompareProgram, SaysWhatItComparesAndNeverForPeopleAndProgramsAtOnce) {
    const ProgramResult ran = runMrose({"compare", scenario(), "--log", shippedLog(), "--every", "10", "--quiet"});
    EXPECT_EQ(ran.status, 0);
    EXPECT_EQ(ran.err, "");
    for (const char* part : {"replay beside ", "twin", "windows", "P %", "Hd %", "final cm", "final deg", "touches",
                             "Note: The log comes from a simulated robot"})
        EXPECT_NE(ran.out.find(part), std::string::npos) << part << '\n' << ran.out;
}

TEST_F(CompareProgram, SaysWhereTheRobotLeavesTheRealTrajectoryAndWhy) {
    const Words tight{"--bound-position", "0.02", "--bound-heading", "3"};
    const auto with = [&](Words words, const Words& more) {
        words.insert(words.end(), more.begin(), more.end());
        return words;
    };
    const Words one{"compare", scenario(), "--log", shippedLog(), "--start", "10", "--duration", "20", "--quiet"};
    const ProgramResult ran = runMrose(with(one, tight));
    EXPECT_EQ(ran.status, 0) << ran.err;
    for (const char* part :
         {"A robot leaves the logged trajectory where it is off by more than 2.0 cm or 3.0° for 0.3 s.",
          "twin: leaves the logged trajectory after ", "  likely cause: ", "tried", "explains", "dead time ",
          "velocity at the start ", "no more than such robots differ from themselves",
          "motion model velocity = command + lag, gains, biases"})
        EXPECT_NE(ran.out.find(part), std::string::npos) << part << '\n' << ran.out;
    const Json said = result(with(one, tight))["divergence"];
    ASSERT_EQ(said["rollouts"].size(), 1u) << said;
    const Json& rollout = said["rollouts"][0];
    EXPECT_TRUE(rollout["position_m"] > 0.02 || rollout["heading_rad"] > 3 / 57.3) << rollout;
    EXPECT_GT(rollout["tried"].size(), 5u);
    EXPECT_EQ(result(one)["divergence"]["all"]["rollouts"], 1);

    const Json without = result(with(with(one, tight), {"--no-causes"}))["divergence"]["rollouts"][0];
    EXPECT_FALSE(without.contains("tried"));
    EXPECT_EQ(without["time_s"], rollout["time_s"]);
    // Another network, by name; held for longer it is later or never.
    const Json more = result(with(with(one, tight), {"--model", (sourceFolder() / "nets/create.net").string()}));
    EXPECT_EQ(more["divergence"]["rollouts"][0]["tried"].size(), rollout["tried"].size() + 1);
    const Json many = result(with({"compare", scenario(), "--log", shippedLog(), "--every", "5"}, tight))["divergence"];
    EXPECT_GT(many["all"]["diverging"], 5);
    EXPECT_EQ(std::count_if(many["rollouts"].begin(), many["rollouts"].end(),
                            [](const Json& c) { return c.contains("tried"); }),
              many["all"]["diverging"]);
    EXPECT_EQ(many["bound"]["from"], "constant");
    const Json known = result({"compare", scenario(), "--log", shippedLog(), "--every", "10"})["divergence"];
    EXPECT_EQ(known["bound"]["from"], "noise");
    EXPECT_FALSE(known["bound"].contains("position_m"));
    EXPECT_LT(known["all"]["diverging"], many["all"]["diverging"]);
}

TEST_F(CompareProgram, MakesAScenarioForALogWithoutOne) {
    scenario();
    const Words log{"--log", shippedLog(), "--every", "10"};
    const auto with = [&](Words words) {
        words.insert(words.end(), log.begin(), log.end());
        return words;
    };
    const Json made = result(with({"compare", "--robot", path("r.toml")})),
               given = result(with({"compare", path("s.toml")}));
    EXPECT_GT(made["all"]["rollouts"], 10);
    EXPECT_EQ(made["all"], given["all"]) << "the same robot in another place";
    EXPECT_EQ(made["divergence"]["all"], given["divergence"]["all"]);
    write("mine.csv", "t,v_cmd,w_cmd,x,y,heading\n0,0,0,0,0,0\n1,0,0,0,0,0\n2,0,0,0,0,0\n");
    expectOneLine(runMrose({"compare", "--quiet", "--log", path("mine.csv")}),
                  {path("mine.csv"), "what kind of robot drove", "--robot"});
    expectOneLine(runMrose(with({"compare", path("s.toml"), "--robot", path("r.toml")})), {"--robot", "SCENARIO"}, 2);
}

TEST_F(CompareProgram, SaysWhoseReadingsDoNotFitTheTruth) {
    const CameraFolder folder;
    const Words words{"compare", "--log", folder.path(), "--duration", "50", "--no-causes"};
    const ProgramResult fits = runMrose(words);
    ASSERT_EQ(fits.status, 0) << fits.err;
    EXPECT_THAT(fits.out, testing::Not(testing::HasSubstr("off the truth")));
    std::istringstream rows(*readFile(folder.path() + "/Robot1_Measurement.dat"));
    std::string time, barcode, range, mirrored;
    std::getline(rows, mirrored);
    mirrored += '\n';
    for (double bearing = 0; rows >> time >> barcode >> range >> bearing;)
        mirrored += time + ' ' + barcode + ' ' + range + ' ' + std::to_string(-bearing) + '\n';
    folder.write(1, "Measurement", mirrored);
    const ProgramResult off = runMrose(words);
    ASSERT_EQ(off.status, 0) << off.err;
    EXPECT_THAT(off.out,
                testing::ContainsRegex("Note: Robot 1: [0-9]+ of [0-9]+ readings of \"camera\" are more than 1 "
                                       "m or 0.15 rad off the truth; are their stamps of another clock"));
}

TEST_F(CompareProgram, DivergenceFlagsThatDoNotFit) {
    const Words words{"compare", scenario(), "--log", shippedLog()};
    const auto with = [&](const Words& more) {
        Words all = words;
        all.insert(all.end(), more.begin(), more.end());
        return runMrose(all);
    };
    expectOneLine(with({"--bound-position", "0"}), {"--bound-position", "0"}, 2);
    expectOneLine(with({"--bound-heading", "-3"}), {"--bound-heading", "-3"}, 2);
    expectOneLine(with({"--no-causes", "--model", "x.net"}), {"--model", "--no-causes"}, 2);
    expectOneLine(with({"--model", path("none.net"), "--quiet"}), {path("none.net")});
    write("odd.toml", "[robot]\n");
    expectOneLine(with({"--model", path("odd.toml"), "--quiet"}), {path("odd.toml")});
}

TEST_F(CompareProgram, LogsAreFoundWhereScenariosFindThem) {
    const std::string file = scenario();
    std::filesystem::create_directory(path("mrclam"));
    std::filesystem::create_directory_symlink(shippedLog(), path("mrclam/named"));
    const Words words{"compare", file, "--log", "named", "--quiet", "--no-causes", "--every", "10"};
    expectOneLine(runMrose(words), {"named: "});
    const ProgramResult found = runWithData(path(""), words);
    EXPECT_EQ(found.status, 0) << found.err;
    EXPECT_NE(found.out.find("replay beside " + path("mrclam/named")), std::string::npos) << found.out;
}

TEST_F(CompareProgram, TheSameWhateverTheNumberOfThreads) {
    const auto report = [&](const std::string& threads) {
        EXPECT_EQ(runMrose({"compare", scenario(), "--log", shippedLog(), "--every", "2", "--threads", threads,
                            "--report", path("r" + threads)})
                      .status,
                  0);
        return read("r" + threads + "/errors.csv") + read("r" + threads + "/rollouts.csv") +
               read("r" + threads + "/results.json");
    };
    EXPECT_EQ(report("1"), report("8"));
}

TEST_F(CompareProgram, SeedIsThatOfTheWorld) {
    const std::string file = scenario();
    write("r.toml", read("r.toml") + "[motion_noise]\ndistance_per_distance = 0.1\n");
    const auto mean = [&](const std::string& seed) {
        return result({"compare", file, "--log", shippedLog(), "--seed", seed})["all"]["summary"]["P_percent"];
    };
    EXPECT_EQ(mean("5"), mean("5"));
    EXPECT_NE(mean("5"), mean("6"));
}

TEST_F(CompareProgram, ErrorsAreOneLineThatSaysWhatToDo) {
    const std::string file = scenario(), log = shippedLog();
    expectOneLine(runMrose({"compare", file, "--log", log, "--start", "5000"}),
                  {log + ": the ground truth ends ", "expected an earlier --start than 5000.0 s"});
    expectOneLine(runMrose({"compare", file, "--log", log, "--every", "500"}), {log + ": ", "a shorter --every"});
    expectOneLine(runMrose({"compare", file, "--log", log, "--every", "0.25"}), {"--every: 0.25 s", "0.1 s"});
    expectOneLine(runMrose({"compare", file, "--log", path("none")}), {path("none") + ": "});
    expectOneLine(runMrose({"compare", file, "--log", write("text.txt", "once upon a time\n")}), {"text.txt"});
    expectOneLine(runMrose({"compare", path("none.toml"), "--log", log}), {path("none.toml") + ": does not exist"});
    expectOneLine(runMrose({"compare", file, "--log", log, "--robots", "2"}), {log + ": has no robot \"2\""});
    expectOneLine(runMrose({"compare", "mrclam_replay.toml", "--log", log}),
                  {log + ": has no robot \"1\", which \"create 1\" plays", "expected a log of the scenario's robots"});

    expectOneLine(runMrose({"compare", "--log", log, "--robot", "nosuch.toml"}),
                  {"--robot nosuch.toml: does not exist", "resources/robots/nosuch.toml", "expected a robot file"});
    const std::string blind = write("blind.csv", "robot,t,v_cmd,w_cmd\nreference,1,0.1,0\nreference,9,0.2,0\n");
    expectOneLine(runMrose({"compare", file, "--log", blind}),
                  {blind + ": has no ground truth of robot \"reference\"", "expected its poses"});
    const std::string silent = write("silent.csv", "robot,t,x,y,heading\nreference,1,0,0,0\nreference,9,1,0,0\n");
    expectOneLine(runMrose({"compare", file, "--log", silent}), {silent + ": has no commands of robot \"reference\""});
    std::string rows = "robot,t,v_cmd,w_cmd,x,y,heading\n";
    for (int i = 0; i < 300; ++i)
        if (i < 100 || i > 150) rows += "reference," + std::to_string(10 + 0.1 * i) + ",0.1,0,1,1,0\n";
    const std::string gap = write("gap.csv", rows);
    expectOneLine(runMrose({"compare", file, "--log", gap, "--start", "12", "--duration", "2"}),
                  {gap + ": has no ground truth of any compared robot where a rollout starts", "another start"});
    const ProgramResult across = runMrose({"compare", file, "--log", gap, "--start", "5", "--duration", "15"});
    EXPECT_EQ(across.status, 0) << across.err;
    EXPECT_NE(across.out.find("Note: twin: 1 of 1 rollout left out of P and Hd: 1 with a gap in the ground truth."),
              std::string::npos)
        << across.out;

    const std::string wanderer = scenario("{ kind = \"wander\" }", "start = { x_m = 0, y_m = 0 }\n");
    expectOneLine(runMrose({"compare", wanderer, "--log", log}), {wanderer + ": plays no log", "log_player"});
    EXPECT_FALSE(std::filesystem::exists(path("report")));
}

TEST_F(CompareProgram, WindowsFilesAndReportFoldersThatDoNotFit) {
    const std::string file = scenario(), log = shippedLog();
    const std::string other = write("w.csv", "dataset,robot,t_start\n3,reference,10\n");
    expectOneLine(runMrose({"compare", file, "--log", log, "--windows", other}), {"w.csv:2: dataset: is 3"});
    expectOneLine(runMrose({"compare", file, "--log", log, "--windows", other, "--every", "10"}),
                  {"--every", "--windows"}, 2);
    expectOneLine(runMrose({"compare", file, "--log", log, "--windows", other, "--duration", "1.05"}),
                  {"--duration: 1.05 s", "0.1 s"});
    write("taken", "a file");
    expectOneLine(runMrose({"compare", file, "--log", log, "--report", path("taken")}), {path("taken"), "no folder"});
    EXPECT_EQ(read("taken"), "a file");
    expectOneLine(runMrose({"compare", file}), {"--log", "required"}, 2);
    for (const char* flag : {"--start", "--duration", "--every"})
        expectOneLine(runMrose({"compare", file, "--log", log, std::string(flag) + "=nan"}), {flag, "nan"}, 2);
}

}  // namespace
}  // namespace mrose

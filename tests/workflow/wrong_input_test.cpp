// What is wrong with logs, networks and files of windows, as every workflow that reads them says it.
#include "support/workshop.h"
#include "workflow/evaluate_network.h"
#include "workflow/expect_error.h"
#include "workflow/inspect_log.h"
#include "workflow/predict_windows.h"
#include "workflow/train_network.h"

namespace mrose {
namespace {

/// Requests of this folder's files; nothing that is wrong leaves an output.
class WrongInput : public Workshop {
protected:
    PredictRequest prediction(const std::string& net) { return {net, log(), windows(), path("p.csv")}; }
    ~WrongInput() override {
        EXPECT_EQ(read("b.net"), "");
        EXPECT_EQ(read("p.csv"), "");
    }
};

/// Rows every 50 ms of a robot that stands still.
std::string restingRows(int count, double start = 100) {
    std::string text;
    for (int i = 0; i < count; ++i) text += std::to_string(start + 0.05 * i) + ",0,0,1,2,0.5\n";
    return text;
}

TEST_F(WrongInput, BrokenRowsAreNamedByLineColumnAndKey) {
    struct Case {
        std::string name, content;
        std::vector<std::string> parts;
    };
    const std::string header = "t,v_cmd,w_cmd,x,y,heading\n", rows = restingRows(40);
    for (const Case& c :
         {Case{"columns.csv", header + rows + "102.0,0,0,1,2\n" + restingRows(9, 103), {"columns.csv:42:", "5", "6"}},
          Case{"nan.csv", header + rows + "102.0,0,nan,1,2,0\n", {"nan.csv:42:9: ", "w_cmd"}},
          Case{"inf.csv", header + rows + "102.0,inf,0,1,2,0\n", {"inf.csv:42:7: ", "v_cmd"}},
          Case{"text.csv", header + rows + "102.0,0,0,1,left,0\n", {"text.csv:42:13: ", "y"}},
          Case{"twice.csv", "t,x,x\n" + rows, {"twice.csv:1:", "x"}},
          Case{"backwards.csv", header + restingRows(400, 500) + restingRows(400, 100), {"backwards.csv:402", "t"}}}) {
        const std::string file = write(c.name, c.content);
        expectError(inspectLog({file}), file, c.parts);
        expectError(trainNetwork(training(file, path("b.net"))), file, c.parts);
    }
}

TEST_F(WrongInput, LogWithoutGroundTruthIsRefused) {
    std::string rows = "t,v_cmd,w_cmd\n";
    for (int i = 0; i < 1000; ++i) rows += std::to_string(0.05 * i) + ",0.2,0.1\n";
    const std::string commands = write("commands.csv", rows);
    expectError(trainNetwork(training(commands, path("b.net"))), commands, {"ground truth"});
    expectError(evaluateNetwork({network(), commands}), commands, {"ground truth"});
    EXPECT_TRUE(inspectLog({commands})) << "what it holds can still be said";
}

TEST_F(WrongInput, CommandsAndGroundTruthOfDifferentTimesAreRefused) {
    std::string rows = "t,v_cmd,w_cmd,x,y,heading\n";
    for (int i = 0; i < 600; ++i) rows += std::to_string(0.05 * i) + ",0.2,0.1,,,\n";
    for (int i = 0; i < 600; ++i) rows += std::to_string(5000 + 0.05 * i) + ",,," + std::to_string(0.01 * i) + ",0,0\n";
    const std::string apart = write("apart.csv", rows);
    expectError(evaluateNetwork({network(), apart}), apart, {"expected both of the same time"});
}

TEST_F(WrongInput, NothingIsLearnedFromPositionsInMillimetres) {
    std::string rows = "t,v_cmd,w_cmd,x,y,heading\n";
    for (int i = 0; i < 1000; ++i) rows += std::to_string(0.05 * i) + ",0.2,0," + std::to_string(10 * i) + ",0,0\n";
    const std::string file = write("millimetres.csv", rows);
    expectError(trainNetwork(training(file, path("b.net"))), file, {"at 200 m/s", "millimetres; expected metres"});
}

TEST_F(WrongInput, LogTooShortForAWindowIsRefused) {
    const std::string brief = write("brief.csv", firstLines(plantedCsv(), 60));
    expectError(trainNetwork(training(brief, path("b.net"))), brief);
    expectError(evaluateNetwork({network(), brief}), brief);
    // Long enough for windows, but one trajectory cannot be learned from and held out at once.
    const std::string single = write("single.csv", firstLines(plantedCsv(), 1500));
    expectError(trainNetwork(training(single, path("b.net"))), single, {"too short"});
}

TEST_F(WrongInput, LogGivenTwiceIsNotLearnedFromAndHeldOutAtOnce) {
    const std::string copy = write("copy.csv", plantedCsv());
    TrainRequest request = training(log(), path("b.net"));
    request.logs.sources.push_back(copy);
    expectError(trainNetwork(request), copy, {"twice", log()});
}

TEST_F(WrongInput, LogsOfDifferentKindsOfRobotMakeNoNetwork) {
    write("real/Robot1_Odometry.dat", "# command\n0.0 0.1 0.0\n0.1 0.1 0.0\n");
    write("real/Robot1_Groundtruth.dat", "# truth\n0.0 0 0 0\n0.1 0.01 0 0\n");
    const std::string synthetic = write("synthetic.csv", "# synthetic\n" + plantedCsv());
    TrainRequest request = training(synthetic, path("b.net"));
    request.logs.sources.push_back(path("real"));
    expectError(trainNetwork(request), path("real"), {"another kind of robot", synthetic});
}

TEST_F(WrongInput, UnknownRobotIsNamed) {
    const std::vector<std::string> robots{"planted", "r2d2"};
    expectError(inspectLog({log(), robots}), log(), {"r2d2"});
    TrainRequest learning = training(log(), path("b.net"));
    learning.logs.robots = robots;
    expectError(trainNetwork(learning), log(), {"r2d2"});
    expectError(evaluateNetwork({network(), log(), robots}), log(), {"r2d2"});
    PredictRequest predicting = prediction(network());
    predicting.robots = robots;
    expectError(predictWindows(predicting), log(), {"r2d2"});
}

TEST_F(WrongInput, ForeignAndHalfNetworksAreRefused) {
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
        const std::string file = write(c.name, c.content);
        expectError(evaluateNetwork({file, log()}), file, c.parts);
        expectError(predictWindows(prediction(file)), file, c.parts);
    }
    expectError(evaluateNetwork({path("no.net"), log()}), path("no.net"), {"No such file"});
    expectError(evaluateNetwork({path(""), log()}), path(""), {"Is a directory"});
    expectError(evaluateNetwork({good, log(), {}, {path("no.net")}}), path("no.net"));
}

TEST_F(WrongInput, NetworkForAnotherPeriodIsRefused) {
    network();
    const std::string other = write("other.net", replaced(read("a.net"), "period_s = 0.1\n", "period_s = 0.07\n"));
    expectError(evaluateNetwork({other, log()}), other, {"period_s: ", "0.07"});
    expectError(predictWindows(prediction(other)), other, {"period_s: ", "0.07"});
}

TEST_F(WrongInput, HorizonBetweenTwoStepsIsRefused) {
    EvaluateRequest judging{network(), log()};
    judging.horizon = 0.55;
    expectError(evaluateNetwork(judging), "", {"horizon: 0.55 s", "0.1 s"});
    PredictRequest predicting = prediction(network());
    predicting.horizon = 0.55;
    expectError(predictWindows(predicting), "", {"horizon: 0.55 s", "0.1 s"});
}

TEST_F(WrongInput, WindowsFileErrorsNameLineAndColumn) {
    PredictRequest request = prediction(network());
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
        request.windows = write(c.name, c.content);
        expectError(predictWindows(request), request.windows, c.parts);
    }
    request.windows = path("no.csv");
    expectError(predictWindows(request), request.windows);
}

}  // namespace
}  // namespace mrose

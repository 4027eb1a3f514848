#include <algorithm>
#include <chrono>
#include <cstdio>

#include "common.h"
#include "io/format.h"
#include "kicker.h"
#include "report/program_json.h"
#include "workflow/train_network.h"
#include "workflow/train_sensor.h"

namespace mrose::cli {
namespace {

struct TrainFlags {
    TrainRequest request;
    TrainSensorRequest sensor;  ///< of what concerns sensors alone
    std::string model, method = "irprop+", loss, holdOutBy, family = "network";
    bool meanAlone = false, kicker = false;

    /// How a kicker is learned, where the flags say it.
    TrainKickerRequest wholeKicker(const CommonFlags& common) const {
        TrainKickerRequest whole{request.logs.sources, request.output, common.overwrite, request.logs.robots,
                                 request.robotKind};
        const auto take = [](int given, int& option) {
            if (given > 0) option = given;
        };
        take(request.hidden, whole.training.hidden);
        take(request.epochs, whole.training.epochs);
        take(request.patience, whole.training.patience);
        if (foldsGiven != nullptr && *foldsGiven) whole.training.folds = request.folds;
        if (componentsGiven != nullptr && *componentsGiven) whole.training.components = sensor.training.components;
        whole.training.seed = common.seed;
        whole.command = commandLine();
        return whole;
    }
    const CLI::Option *foldsGiven = nullptr, *componentsGiven = nullptr;

    TrainSensorRequest wholeSensor(const CommonFlags& common) const {
        TrainSensorRequest whole = sensor;
        whole.logs = request.logs.sources;
        whole.robots = request.logs.robots;
        whole.output = request.output;
        whole.robotKind = request.robotKind;
        const auto at = std::ranges::find(sensorFamilyNames, family);
        SensorTrainerOptions& training = whole.training;
        training.family = static_cast<RegressorFamily>(at - sensorFamilyNames.begin());
        const auto take = [](int given, int& option) {
            if (given > 0) option = given;
        };
        take(request.patience, training.patience);
        for (SensorHalfOptions* half : {&training.reported, &training.error}) {
            take(request.hidden, half->hidden);
            take(request.epochs, half->epochs);
        }
        training.seed = common.seed;
        whole.overwrite = common.overwrite;
        whole.command = commandLine();
        return whole;
    }

    /// With what these words mean.
    TrainRequest whole(const CommonFlags& common) const {
        TrainRequest whole = request;
        const auto indexOf = [](const auto& names, const std::string& word) {
            return std::find(names.begin(), names.end(), word) - names.begin();
        };
        if (!model.empty()) whole.recipe = NetworkRecipe(indexOf(networkRecipeNames, model));
        whole.method = TrainingMethod(indexOf(trainingMethodNames, method));
        if (!loss.empty()) whole.loss = loss == "rollout" ? LearningLoss::rollout : LearningLoss::oneStep;
        if (!holdOutBy.empty()) whole.logs.holdOutBy = holdOutBy == "groups" ? HoldOutBy::groups : HoldOutBy::time;
        if (meanAlone) whole.noise = false;
        whole.seed = common.seed;
        whole.overwrite = common.overwrite;
        whole.command = commandLine();
        return whole;
    }
};

void addWhat(CLI::App& sub, TrainFlags& flags) {
    sub.add_option("LOG", flags.request.logs.sources,
                   "Logs to learn from: MRCLAM folders, Husky windows, CSV files or folders of them")
        ->required();
    sub.add_option("-o,--output", flags.request.output, "The network file to write")->required()->check(someName());
    sub.add_option(
           "--model", flags.model,
           "What the network reads: see below. Default: velocity for robots that measure their own, history for "
           "others")
        ->check(CLI::IsMember({"history", "state", "velocity", "paper"}));
    sub.add_option("--robots", flags.request.logs.robots, "Learn from these robots only, by name: 1,2")->delimiter(',');
    sub.add_option("--type,--robot-type", flags.request.robotKind,
                   "Kind of robot, whose traits learning must know: its name, as irobot-create, or a robot file with "
                   "[kind]; default: what the log says");
    sub.add_option("--hold-out", flags.request.logs.holdOut,
                   "Share of the logs that nothing is learned from: mrose evaluate --held-out judges by it alone")
        ->check(numberRange(0.001, 0.5));
    sub.add_option("--hold-out-by", flags.holdOutBy,
                   "Held out are whole groups of trajectories, or blocks of time of long ones, with a guard before and "
                   "after them as long as what the model reads back and a rollout; default: groups where each log has "
                   "enough of them, else time")
        ->check(CLI::IsMember({"groups", "time"}))
        ->needs("--hold-out");
    sub.add_option("--hold-out-part", flags.request.logs.holdOutPart,
                   "Which share that is, for cross-validation: 0, 1, ...")
        ->needs("--hold-out")
        ->check(CLI::Range(0, 1000))
        ->capture_default_str();
}

void addHow(CLI::App& sub, TrainFlags& flags) {
    sub.add_option("--method", flags.method, "Learning method; lm fits single steps only")
        ->check(CLI::IsMember(std::vector<std::string>(trainingMethodNames.begin(), trainingMethodNames.end())))
        ->capture_default_str();
    sub.add_option("--loss", flags.loss, "What is minimised; default: one-step for paper, else rollout")
        ->check(CLI::IsMember({"one-step", "rollout"}));
    sub.add_option("--chain", flags.request.chain,
                   "Periods of a rollout that is learned from; default 20, 10 for velocity")
        ->check(CLI::Range(1, 1000));
    sub.add_option("--hidden", flags.request.hidden, "Hidden units of each member; default: the model's")
        ->check(CLI::Range(1, 1024));
    sub.add_option(
           "--members", flags.request.members,
           "Networks, each learned with another part of the logs held out, whose mean is saved as one; default 4 "
           "(velocity: 8, state and paper: 1)")
        ->check(CLI::Range(1, 64));
    sub.add_option("--folds", flags.request.folds,
                   "Parts that the logs are divided into, held out in turn; of a kicker 5 unless given")
        ->check(CLI::Range(2, 64))
        ->capture_default_str();
    sub.add_option("--epochs", flags.request.epochs, "At most so many epochs; default: the model's")
        ->check(CLI::Range(1, 10'000'000));
    sub.add_option("--patience", flags.request.patience,
                   "Stop after so many epochs without a better held-out error; default 300, but all for state")
        ->check(CLI::Range(1, 10'000'000));
    sub.add_option(
           "--phases", flags.request.phases,
           "Phases of the period at which the logs are read: more patterns from the same logs; default 5, 1 for "
           "state")
        ->check(CLI::Range(1, 20));
}

void addNoise(CLI::App& sub, TrainFlags& flags) {
    sub.add_flag("--mean-alone", flags.meanAlone,
                 "Learn no noise: in a third of the time a network that does not say how real runs differ from it. "
                 "Model paper has none");
}

/// Instead of what is identified from the logs.
void addResponseTimes(CLI::App& sub, TrainFlags& flags) {
    sub.add_option("--dead-time-v", flags.request.deadTimeV, "Dead time of v in s, instead of the one identified")
        ->check(numberRange(0.0, 2.0));
    sub.add_option("--dead-time-w", flags.request.deadTimeW, "Dead time of w in s, instead of the one identified")
        ->check(numberRange(0.0, 2.0));
    sub.add_option("--lag-v", flags.request.lagV, "Lag of v in s, instead of the one identified")
        ->check(numberRange(0.0, 2.0));
    sub.add_option("--lag-w", flags.request.lagW, "Lag of w in s, instead of the one identified")
        ->check(numberRange(0.0, 2.0));
}

void addSensor(CLI::App& sub, TrainFlags& flags) {
    CLI::Option* sensor = sub.add_option(
        "--sensor", flags.sensor.sensor,
        "Learn a sensor, by its name in the logs, instead of motion: how likely it reports a subject or, "
        "where it says where its robot is, that, and how the errors are distributed");
    sub.add_option("--family", flags.family, "What the sensor's distribution is learned by")
        ->check(CLI::IsMember(std::vector<std::string>(sensorFamilyNames.begin(), sensorFamilyNames.end())))
        ->needs(sensor)
        ->capture_default_str();
    sub.add_option(
           "--components", flags.sensor.training.components,
           "Of a network of a sensor or a kicker: normal distributions in its mixture; default 4, of a kicker 2")
        ->check(CLI::Range(1, ReadingForm::maxComponents));
    sub.add_option("--latency", flags.sensor.latency, "Of the sensor in s, instead of the one identified from turning")
        ->check(numberRange(0.0, 1.0))
        ->needs(sensor);
    for (const char* ofMotion : {"--model", "--hold-out", "--method", "--loss", "--chain", "--members", "--folds",
                                 "--phases", "--mean-alone", "--dead-time-v", "--dead-time-w", "--lag-v", "--lag-w"})
        sensor->excludes(sub.get_option(ofMotion));
}

void addKicker(CLI::App& sub, TrainFlags& flags) {
    CLI::Option* kicker =
        sub.add_flag("--kicker", flags.kicker,
                     "Learn a kicker instead of motion, from kicks and a tracked ball: when the ball leaves, whether, "
                     "how fast and in "
                     "which direction, given power, where it lay, and the robot's motion, as distributions");
    kicker->excludes(sub.get_option("--sensor"));
    for (const char* ofMotion : {"--model", "--hold-out", "--method", "--loss", "--chain", "--members", "--phases",
                                 "--mean-alone", "--dead-time-v", "--dead-time-w", "--lag-v", "--lag-w"})
        kicker->excludes(sub.get_option(ofMotion));
    flags.foldsGiven = sub.get_option("--folds");
    flags.componentsGiven = sub.get_option("--components");
}

/// What the models are, for the help.
constexpr const char* modelsText =
    "Models of motion:\n"
    "  history: commands of the last tenths of a second -> motion; learned on rollouts\n"
    "  state: velocity, and commands around the dead time -> motion and velocity; learned on rollouts, for robots of\n"
    "    limited acceleration\n"
    "  velocity: velocity, and commands in coarse bins -> motion and velocity; learned on rollouts, for robots that\n"
    "    measure their velocity\n"
    "  paper: (v, w, v_cmd, w_cmd) -> (dx, dy, dphi, v', w'); learned on single steps\n";

/// Shows how learning goes, and how long it still takes at most.
class TrainingDisplay {
public:
    explicit TrainingDisplay(bool quiet) : line_(quiet) {}

    bool prepares(double share) {
        if (share >= 1) begin_ = std::chrono::steady_clock::now();
        return !wasInterrupted();
    }
    bool fits(double share) {
        char text[100];
        std::snprintf(text, sizeof text, "fitting the noise, by which runs stray from the mean: %.0f %%", 100 * share);
        if (line_.terminal() || share >= 1) line_.show(text);
        return !wasInterrupted();
    }
    bool operator()(const NetworkProgress& p) {
        const double done = p.member + static_cast<double>(p.epoch) / p.epochs;
        const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - begin_;
        const int tenth = static_cast<int>(10 * done / p.members);
        if (line_.terminal() || tenth != shownTenth_) {
            shownTenth_ = tenth;
            const std::string noise = p.ofNoise ? " (for the noise)"
                                      : p.membersOfNoise > 0
                                          ? " (" + std::to_string(p.members - p.membersOfNoise) + " for the motion, " +
                                                std::to_string(p.membersOfNoise) + " for the noise)"
                                          : "";
            char text[200];
            std::snprintf(text, sizeof text,
                          "network %d of %d%s, epoch %d: loss %.3e, held out P %.2f %% Hd %.2f %%, at most %s left",
                          p.member + 1, p.members, noise.c_str(), p.epoch, p.loss, p.heldOut.position,
                          p.heldOut.heading, durationText(spent.count() / done * (p.members - done)).c_str());
            line_.show(text);
        }
        return !wasInterrupted();
    }

private:
    ProgressLine line_;
    int shownTenth_ = -1;                          ///< of all epochs
    std::chrono::steady_clock::time_point begin_;  ///< of learning
};

void printSummary(const TrainedNetwork& trained, const std::string& file, double seconds) {
    const MotionNetwork& n = trained.network;
    std::printf("%s%s: %d inputs, %d hidden units; learned from %lld patterns in %s (%lld epochs%s)\n", file.c_str(),
                trained.cancelled ? " (interrupted: the best network so far)" : "", n.mlp.shape.inputs,
                n.mlp.shape.hidden, static_cast<long long>(n.training.patterns), durationText(seconds).c_str(),
                static_cast<long long>(n.training.epochs),
                n.members.size() > 1 ? " in all, without those for the noise" : "");
    std::printf(
        "held out, %.1f s open loop, %lld windows: position error %.2f %% of the path, heading error %.2f %% of the "
        "rotation\n",
        n.heldOut.horizon, static_cast<long long>(n.heldOut.windows), n.heldOut.position, n.heldOut.heading);
    if (const std::string limits = limitsInWords(n.limits); !limits.empty())
        std::printf("limits of the drive, found in the logs: %s\n", limits.c_str());
    if (trained.noiseOfKnownRobots)
        std::puts(
            "Note: the logs have fewer than three robots: the noise is of robots that the network knows, over time "
            "that it does not. Other robots may stray further.");
    if (!trained.withoutNoise.empty())
        std::printf("Note: its noise was not learned: %s\n", trained.withoutNoise.c_str());
    if (n.heldOut.part.holdsAny())
        std::printf("kept from learning, for mrose evaluate --held-out: %s\n",
                    keptFromLearning(n.heldOut.part).c_str());
}

int runTrain(const TrainRequest& request, const CommonFlags& common) {
    if (const auto fits = checkTogether(request); !fits) {
        report(fits.error());
        return usage;
    }
    const auto begin = std::chrono::steady_clock::now();
    watchInterrupts();
    TrainingDisplay display(common.quiet);
    TrainProgress progress{{},
                           std::ref(display),
                           [&](double share) { return display.prepares(share); },
                           [&](double share) { return display.fits(share); }};
    if (!common.quiet && !common.json)
        progress.opened = [](const std::vector<std::string>& notes) {
            for (const std::string& note : notes) std::printf("Note: %s\n", note.c_str());
        };
    const auto trained = trainNetwork(request, progress);
    if (!trained && wasInterrupted()) return reportInterrupted();
    if (!trained) return report(trained.error());
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - begin;
    if (common.json)
        std::puts(trainingJson(*trained, request.output, spent.count()).c_str());
    else
        printSummary(*trained, request.output, spent.count());
    return trained->cancelled ? interruptedStatus() : success;
}

void printSensor(const TrainedSensor& trained, const std::string& file, double seconds) {
    const SensorNetwork& n = trained.network;
    for (const std::string& notice : trained.notices) std::printf("Note: %s\n", notice.c_str());
    std::printf("%s: %s of \"%s\", %d inputs; learned from %lld looks with %lld %s in %s\n", file.c_str(),
                std::string(nameOf(familyOf(n.learned.regressor))).c_str(), n.sensor.c_str(),
                static_cast<int>(n.learned.inputs.size()), static_cast<long long>(n.heldOut.looks),
                static_cast<long long>(n.heldOut.readings),
                n.measures == SensorNetwork::Measures::pose ? "poses" : "readings", durationText(seconds).c_str());
    // where each look has a report there is nothing to predict
    const bool gaps = n.heldOut.reported < -5e-5;
    std::printf("latency %.0f ms; held out, mean log-likelihood: %serror %.4f\n", 1e3 * toSeconds(n.latency),
                gaps ? ("detection " + fixed(n.heldOut.reported, 4) + ", ").c_str() : "", n.heldOut.error);
}

int runTrainSensor(const TrainSensorRequest& request, const CommonFlags& common) {
    const auto begin = std::chrono::steady_clock::now();
    watchInterrupts();
    LearningDisplay display(common.quiet, "learning");
    const auto trained = trainSensor(request, std::ref(display));
    if (!trained && wasInterrupted()) return reportInterrupted();
    if (!trained) return report(trained.error());
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - begin;
    if (common.json)
        std::puts(sensorTrainingJson(trained->network, trained->notices, request.output, spent.count()).c_str());
    else
        printSensor(*trained, request.output, spent.count());
    return success;
}

}  // namespace

Subcommand addTrain(CLI::App& app, CommonFlags& common) {
    auto flags = std::make_shared<TrainFlags>();
    const std::string examples =
        "  mrose train MRCLAM_Dataset6 -o create.net\n"
        "  mrose train MRCLAM_Dataset6 --model paper --seed 3 -o create_paper.net\n"
        "  mrose train husky_windows.csv --hold-out 0.2 -o husky.net\n"
        "  mrose train monday.csv tuesday.csv --robots attacker -o attacker.net\n"
        "  mrose train MRCLAM_Dataset6 --sensor camera -o create_camera.net\n"
        "  mrose train mylogs --sensor camera --family table -o camera_table.net\n"
        "  mrose train mykicks --kicker -o my_kicker.net\n" +
        std::string(modelsText) +
        "Ctrl-C, SIGTERM or SIGHUP ends learning and saves the best network so far (of motion; of others nothing); "
        "Ctrl-C after that ends the program at once.";
    CLI::App* sub = addSubcommand(app, common, "train",
                                  "Learn how robots move or kick, or what a sensor reports, from logs", examples);
    addSeed(*sub, common);
    addThreads(*sub, common);
    addOverwrite(*sub, common);
    addWhat(*sub, *flags);
    addHow(*sub, *flags);
    addNoise(*sub, *flags);
    addResponseTimes(*sub, *flags);
    addSensor(*sub, *flags);
    addKicker(*sub, *flags);
    const CLI::Option *components = sub->get_option("--components"), *hidden = sub->get_option("--hidden");
    return {sub, [flags, components, hidden, &common] {
                if (*components && !flags->kicker && flags->sensor.sensor.empty()) {
                    report(Error{{}, 0, 0, "--components", "is for --sensor and --kicker"});
                    return static_cast<int>(usage);
                }
                if (flags->kicker && flags->wholeKicker(common).training.folds > ReadingForm::maxMembers) {
                    report(Error{{}, 0, 0, "--folds", "of a kicker are at most 8"});
                    return static_cast<int>(usage);
                }
                if (flags->kicker) return runTrainKicker(flags->wholeKicker(common), common);
                if (*components && flags->family != "network") {
                    report(Error{{}, 0, 0, "--components", "is for --family network alone"});
                    return static_cast<int>(usage);
                }
                if (*hidden && !flags->sensor.sensor.empty() && flags->family != "network") {
                    report(Error{{}, 0, 0, "--hidden", "is for --family network alone"});
                    return static_cast<int>(usage);
                }
                return flags->sensor.sensor.empty() ? runTrain(flags->whole(common), common)
                                                    : runTrainSensor(flags->wholeSensor(common), common);
            }};
}

}  // namespace mrose::cli

// What the window costs with an hour's log of five robots at 65 Hz laid over a run that drives all of it open loop, and
// with two other models' rollouts: making a frame and painting it at 1280 x 800 with every layer but scans and trails
// of 2000 points, the whole window with the errors plotted, and the memory of it all.
#include <QApplication>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <functional>
#include <random>
#include <vector>

#include <sys/resource.h>

#include "behaviour/command_player.h"
#include "debug/run_frame.h"
#include "motion/learned_model.h"
#include "panels/plot_panel.h"
#include "support/scenes.h"
#include "synthetic/drive_patterns.h"
#include "widgets/field_view.h"
#include "window/main_window.h"

namespace mrose::gui {
namespace {

using Clock = std::chrono::steady_clock;
constexpr int robots = 5;

double milliseconds(const std::function<void()>& what) {
    const auto begin = Clock::now();
    what();
    return std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
}

/// Of this thread's work alone, whatever else the machine does.
double processorMilliseconds(const std::function<void()>& what) {
    const auto now = [] {
        timespec time{};
        clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
        return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
    };
    const double begin = now();
    what();
    return now() - begin;
}

void tell(const char* what, std::vector<double> times) {
    std::sort(times.begin(), times.end());
    std::printf("%-44s median %6.2f ms   95 %% %6.2f ms   worst of %zu %6.2f ms\n", what, times[times.size() / 2],
                times[times.size() * 95 / 100], times.size(), times.back());
}

void reportMemory(const char* when) {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    std::printf("%-44s at most %.0f MB so far\n", when, static_cast<double>(usage.ru_maxrss) / 1024);
    std::fflush(stdout);
}

/// Where ideal kinematics lead, `gain` times as fast.
std::vector<StampedPose> driven(const std::vector<StampedCommand>& commands, Pose pose, Nanoseconds step, double gain) {
    std::vector<StampedPose> poses;
    double heading = pose.heading;
    std::size_t next = 0;
    Command inForce;
    for (Nanoseconds t = 0; t <= commands.back().time; t += step) {
        while (next < commands.size() && commands[next].time <= t) inForce = commands[next++].command;
        poses.push_back({t, {pose.x, pose.y, heading}});
        pose = pose * exp({gain * inForce.v * toSeconds(step), 0, inForce.w * toSeconds(step)});
        heading += inForce.w * toSeconds(step);
    }
    return poses;
}

std::shared_ptr<const Log> hourOf(double seconds) {
    auto log = std::make_shared<Log>();
    log->source = "made-up";
    for (std::uint32_t i = 0; i < robots; ++i) {
        Trajectory trajectory;
        trajectory.commands = patternCommands(mrose::DrivePattern::random, seconds, 7, i);
        trajectory.poses = driven(trajectory.commands, {2.0 * i, 1.5 * (i % 2), 0}, nanosecondsPerSecond / 65, 0.97);
        log->robots.push_back({std::to_string(i + 1), {std::move(trajectory)}, {}});
    }
    return log;
}

Expected<OpenedRun> overlaid(double minutes) {
    auto log = hourOf(60 * minutes);
    auto network = loadNetwork("nets/create.net");
    if (!network) return tl::unexpected(network.error());
    const auto motion = std::make_shared<const LearnedMotion>(std::move(*network));
    ScenarioParts parts;
    parts.name = "overlaid";
    parts.scene.environment.floor.area = {{-10, -8}, {20, -8}, {20, 10}, {-10, 10}};
    parts.scene.robotTypes = {discRobot(0.17, 4.5)};
    parts.duration = fromSeconds(60 * minutes - 5);
    for (std::uint32_t i = 0; i < robots; ++i) {
        const std::string& real = log->robots[i].robot;
        parts.scene.models.push_back(std::make_shared<LearnedModel>(motion, real));
        parts.scene.robots.push_back({"create " + real, 0, i, 3, {}});
        parts.controllers.push_back(std::make_shared<CommandPlayer>(std::vector<StampedCommand>()));
        parts.players.push_back({i, {log->source, log->source, real, "", 0}});
    }
    const auto world = LogWorld::create(std::move(parts), log);
    if (!world) return tl::unexpected(world.error());
    const Nanoseconds start = 2 * nanosecondsPerSecond;
    const LogWorld::Opened opened = world->openAt(0, start, world->parts().duration, 1);
    Reality reality = realityOf(*world, 0, start);
    for (const double gain : {0.95, 1.0}) {
        Reality::ModelRollout rollout{gain < 1 ? "slow" : "ideal", opened.scenario->scene().tickLength, {}};
        for (const RobotLog& robot : log->robots) {
            std::vector<Pose>& poses = rollout.poses.emplace_back();
            for (const StampedPose& at :
                 driven(robot.trajectories[0].commands, robot.trajectories[0].poses[0].pose, rollout.step, gain))
                poses.push_back(at.pose);
        }
        reality.models.push_back(std::move(rollout));
    }
    OpenedRun run;
    run.name = "overlaid";
    run.setup = std::make_shared<const BranchSetup>(BranchSetup{{}, opened.scenario});
    run.start = opened.state;
    run.reality = std::make_shared<const Reality>(std::move(reality));
    return run;
}

FieldLayers allLayersButScans() {
    FieldLayers layers;
    for (const FieldLayerText& text : fieldLayerTexts) layers.set(text.layer, text.layer != FieldLayer::sensors);
    return layers;
}

/// Some ticks of the run from early to its end.
std::vector<std::int64_t> someTicks(std::int64_t last) {
    std::mt19937 random(1);
    std::vector<std::int64_t> ticks;
    for (int i = 0; i < 200; ++i) ticks.push_back(2000 + static_cast<std::int64_t>(random() % (last - 2000)));
    return ticks;
}

int benchFrames(const OpenedRun& run, std::int64_t last) {
    TimeTravel travel(run);
    const double took = milliseconds([&] {
        while (travel.tick() < last && travel.forward()) continue;
    });
    std::printf("%lld ticks driven in %.1f s\n", static_cast<long long>(travel.tick()), took / 1e3);
    FieldView view;
    view.resize(1280, 800);
    view.setLayers(allLayersButScans());
    view.show();
    QApplication::processEvents();
    FrameOptions options;
    options.trailTicks = 2000;
    std::vector<double> making, painting, both;
    for (const std::int64_t tick : someTicks(last)) {
        if (!travel.seek(tick)) return 1;
        std::shared_ptr<const FieldFrame> frame;
        making.push_back(
            processorMilliseconds([&] { frame = std::make_shared<const FieldFrame>(frameOf(travel, options)); }));
        view.setFrame(frame);
        view.setSelected(std::size_t{3});
        painting.push_back(processorMilliseconds([&] { view.repaint(); }));
        both.push_back(making.back() + painting.back());
    }
    tell("making a frame", making);
    tell("painting it", painting);
    tell("both", both);
    reportMemory("frames of an hour");
    return 0;
}

int benchWindow(const OpenedRun& run, std::int64_t last) {
    MainWindow window;
    window.resize(1280, 800);
    window.QWidget::show();
    window.show(run);
    window.session().settle();
    window.field().setLayers(allLayersButScans());
    FrameOptions options;
    options.trailTicks = 2000;
    window.session().setFrameOptions(options);
    window.field().setSelected(std::size_t{3});
    const auto settle = [&] {
        window.session().settle();
        QApplication::processEvents();
    };
    window.session().seek(last);
    settle();
    reportMemory("window, an hour driven");
    window.actions()["plot_errors"].trigger();
    std::printf("errors of an hour computed in %.1f s\n", milliseconds([&] { window.plots().settle(); }) / 1e3);
    settle();
    std::vector<double> jumps, steps;
    for (const std::int64_t tick : someTicks(last)) {
        window.session().seek(tick);
        settle();
        window.session().stepBy(1);
        jumps.push_back(processorMilliseconds(settle));
    }
    tell("all of the window, a tick that has been", jumps);
    window.session().seek(last);
    settle();
    for (int i = 0; i < 200; ++i) {
        window.session().stepBy(1);
        steps.push_back(processorMilliseconds(settle));
    }
    tell("all of the window, a tick that has not", steps);
    reportMemory("window, errors plotted");
    return 0;
}

int bench(double minutes, bool window) {
    const auto run = overlaid(minutes);
    if (!run) return std::fprintf(stderr, "%s\n", run.error().message().c_str()), 1;
    reportMemory("log and models");
    const auto last = static_cast<std::int64_t>((60 * minutes - 10) * 50);
    return window ? benchWindow(*run, last) : benchFrames(*run, last);
}

}  // namespace
}  // namespace mrose::gui

/// bench_overlay [frames | window] [minutes]
int main(int argc, char** argv) {
    if (!qEnvironmentVariableIsSet("QT_QPA_PLATFORM")) qputenv("QT_QPA_PLATFORM", "offscreen");
    QApplication app(argc, argv);
    QApplication::setStyle("Fusion");
    const bool window = argc > 1 && std::strcmp(argv[1], "window") == 0;
    return mrose::gui::bench(argc > 2 ? std::atof(argv[2]) : 60, window);
}

// What a frame of the window costs at 1280 x 800: making it of a run, and painting it.
#include <QApplication>
#include <numbers>

#include <benchmark/benchmark.h>

#include "debug/run_frame.h"
#include "scenario/scenario_file.h"
#include "sensing/laser.h"
#include "support/scenes.h"
#include "widgets/field_view.h"
#include "widgets/timeline_bar.h"

namespace mrose::gui {
namespace {

/// A run that has gone on for as long as trails reach back.
struct Run {
    Run(std::uint32_t robots, std::size_t trailTicks, const std::vector<SensorPointer>& sensors = {})
        : travel(open(crowd(robots, sensors))) {
        options.trailTicks = trailTicks;
        for (std::size_t i = 0; i < trailTicks; ++i) (void)travel.forward();
    }

    static OpenedRun open(Scenario scenario) {
        const auto shared = std::make_shared<const Scenario>(std::move(scenario));
        OpenedRun run;
        run.name = "crowd";
        run.setup = std::make_shared<const BranchSetup>(BranchSetup{{}, shared});
        run.start = shared->initialState();
        return run;
    }

    static Scenario crowd(std::uint32_t robots, const std::vector<SensorPointer>& sensors) {
        FieldOptions field;
        field.robots = robots;
        field.perception = cameraPerception(5);
        ScenarioParts parts = fieldScenario(field).parts();
        for (RobotType& type : parts.scene.robotTypes) type.sensors = sensors;
        return Scenario(std::move(parts));
    }

    TimeTravel travel;
    FrameOptions options;
};

Run& few() {
    static Run run(8, 2000);
    return run;
}

Run& crowd() {
    static Run run(1000, 100);
    return run;
}

/// Each robot has a scanner of 180 beams, which its controller does not read.
Run& scanning() {
    Laser::Options options;
    options.beams = 180;
    options.first = -std::numbers::pi / 2;
    options.step = std::numbers::pi / 179;
    options.errors.range = 8;
    static Run run(8, 2000, {std::make_shared<const Laser>(SensorTraits{"laser", 0}, options)});
    return run;
}

FieldLayers allButSensorFields() {
    FieldLayers layers;
    for (const FieldLayerText& text : fieldLayerTexts) layers.set(text.layer, text.layer != FieldLayer::sensors);
    return layers;
}

void makeFrame(benchmark::State& state, Run& run) {
    for (auto _ : state) benchmark::DoNotOptimize(frameOf(run.travel, run.options));
}

/// One tick further each time, as while playing: what is kept from frame to frame is not all that is measured.
void paint(benchmark::State& state, Run& run, bool selected, bool sensorFields = false) {
    FieldView view;
    view.resize(1280, 800);
    FieldLayers layers = allButSensorFields();
    layers.set(FieldLayer::sensors, sensorFields);
    view.setLayers(layers);
    view.show();
    constexpr int ticks = 50;
    std::vector<std::shared_ptr<const FieldFrame>> frames;
    (void)run.travel.seek(run.travel.last() - ticks);
    for (int i = 0; i < ticks; ++i) {
        frames.push_back(std::make_shared<const FieldFrame>(frameOf(run.travel, run.options)));
        (void)run.travel.forward();
    }
    view.setFrame(frames.front());
    if (selected) view.setSelected(3);
    QApplication::processEvents();
    std::size_t shown = 0;
    for (auto _ : state) {
        view.setFrame(frames[++shown % ticks]);
        view.repaint();
    }
}

void paintTimeline(benchmark::State& state) {
    TimelineBar bar;
    bar.resize(1280, bar.sizeHint().height());
    bar.show();
    QApplication::processEvents();
    TimelineBar::Content content;
    content.last = content.end = 180'000;
    auto marks = std::make_shared<std::vector<TimelineMark>>();
    for (std::int64_t tick = 0; tick < content.last; tick += 3)
        marks->push_back({tick, tick % 300 == 0 ? TimelineMark::Kind::kick : TimelineMark::Kind::contact, 0, 1});
    content.marks = marks;
    for (auto _ : state) {
        content.now = (content.now + 997) % content.last;
        bar.setContent(content);
        bar.repaint();
    }
}

BENCHMARK_CAPTURE(makeFrame, eightRobotsOf2000Points, few())->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(makeFrame, thousandRobotsOf100Points, crowd())->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(paint, eightRobotsOf2000Points, few(), true)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(paint, eightRobotsAndSensorFields, few(), true, true)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(makeFrame, eightRobotsWithLasers, scanning())->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(paint, eightRobotsWithLasers, scanning(), true)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(paint, thousandRobotsOf100Points, crowd(), true)->Unit(benchmark::kMillisecond);
BENCHMARK(paintTimeline)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace mrose::gui

int main(int argc, char** argv) {
    if (!qEnvironmentVariableIsSet("QT_QPA_PLATFORM")) qputenv("QT_QPA_PLATFORM", "offscreen");
    QApplication app(argc, argv);
    QApplication::setStyle("Fusion");
    benchmark::Initialize(&argc, argv);
    benchmark::RunSpecifiedBenchmarks();
    return 0;
}

#include "gui/reality_fixture.h"

#include <cmath>

#include <gtest/gtest.h>

#include "behaviour/command_player.h"
#include "motion/kinematic.h"
#include "support/scenes.h"
#include "widgets/field_fixture.h"

namespace mrose::gui {
namespace {

/// A scenario whose robots play all of a log's.
ScenarioParts playersOn(const Log& log, double gain, const std::vector<SensorPointer>& sensors) {
    ScenarioParts parts;
    parts.name = "overlaid";
    Scene& scene = parts.scene;
    scene.environment.floor.area = {{-5, -4}, {5, -4}, {5, 4}, {-5, 4}};
    ShapePart disc;
    disc.name = "disc";
    disc.radius = 0.3;
    disc.colour = bodyColour;
    RobotType type = discRobot(0.3);
    type.shape = std::make_shared<const Shape>(Shape::fromParts("disc", {disc}));
    type.sensors = sensors;
    scene.robotTypes = {type};
    Attention reads = Attention::ofItself();
    for (const SensorPointer& sensor : sensors)
        for (const ReadingKind& kind : sensor->gives()) reads.names.push_back(kind.name);
    KinematicParameters motion;
    motion.v.gain = gain;
    scene.models = {std::make_shared<const KinematicModel>(motion)};
    for (std::uint32_t i = 0; i < log.robots.size(); ++i) {
        SceneRobot robot;
        robot.name = "sim " + log.robots[i].robot;
        scene.robots.push_back(robot);
        parts.controllers.push_back(std::make_shared<CommandPlayer>(std::vector<StampedCommand>(), reads));
        parts.players.push_back({i, {log.source, log.source, log.robots[i].robot, "", 0}});
    }
    return parts;
}

}  // namespace

std::shared_ptr<const Log> logOfDrives(const std::vector<RealDrive>& drives, double seconds, std::int64_t rate) {
    auto log = std::make_shared<Log>();
    log->source = "made-up";
    log->format = "csv";
    for (const RealDrive& drive : drives) {
        Trajectory trajectory;
        for (Nanoseconds t = 0; t <= fromSeconds(seconds); t += nanosecondsPerSecond / 10)
            trajectory.commands.push_back({t, drive.command});
        for (Nanoseconds t = 0; t <= fromSeconds(seconds); t += nanosecondsPerSecond / rate) {
            bool seen = true;
            for (const auto& [from, to] : drive.unseen) seen = seen && (toSeconds(t) <= from || toSeconds(t) >= to);
            // The heading goes on beyond half a turn, as a log's does.
            Pose pose = drive.poseAt(toSeconds(t));
            pose.heading = drive.start.heading + drive.command.w * toSeconds(t);
            if (seen) trajectory.poses.push_back({t, pose});
        }
        log->robots.push_back({drive.robot, {std::move(trajectory)}, {}});
    }
    return log;
}

void addLooks(Log& log, const std::vector<RealDrive>& drives, const std::vector<Point>& landmarks, Nanoseconds period,
              double off) {
    for (const RealDrive& drive : drives)
        log.subjects.push_back({"robot " + drive.robot, LogSubject::Kind::robot, drive.robot, {}});
    for (std::size_t i = 0; i < landmarks.size(); ++i)
        log.subjects.push_back({std::to_string(i + 1), LogSubject::Kind::landmark, "", landmarks[i]});
    for (std::size_t robot = 0; robot < drives.size(); ++robot) {
        Trajectory& trajectory = log.robots[robot].trajectories[0];
        SensorLog camera{"camera"};
        for (Nanoseconds t = 0; t <= trajectory.poses.back().time; t += period) {
            Look& look = camera.looks.emplace_back(Look{t, {}});
            const Pose eye = drives[robot].poseAt(toSeconds(t));
            for (std::size_t subject = 0; subject < log.subjects.size(); ++subject) {
                if (subject == robot) continue;
                const Point at = subject < drives.size() ? position(drives[subject].poseAt(toSeconds(t)))
                                                         : *log.subjects[subject].position;
                const Point to = Placement(eye).rotateBack(at - position(eye));
                look.readings.push_back({subject, length(to) + off, std::atan2(to.y, to.x)});
            }
        }
        trajectory.sensors = {std::move(camera)};
    }
}

OpenedRun overlaidRun(std::shared_ptr<const Log> log, double start, double duration, double gain,
                      const std::vector<SensorPointer>& sensors) {
    const auto world = LogWorld::create(playersOn(*log, gain, sensors), log);
    if (!world) {
        ADD_FAILURE() << world.error().message();
        return {};
    }
    const LogWorld::Opened opened = world->openAt(0, fromSeconds(start), fromSeconds(duration), 1);
    OpenedRun run;
    run.name = "overlaid";
    run.setup = std::make_shared<const BranchSetup>(BranchSetup{{}, opened.scenario});
    run.start = opened.state;
    run.reality = std::make_shared<const Reality>(realityOf(*world, 0, fromSeconds(start)));
    return run;
}

}  // namespace mrose::gui

#include "workflow/check_description.h"

#include <filesystem>
#include <optional>
#include <set>

#include "drawing/content_text.h"
#include "io/file.h"
#include "io/format.h"
#include "io/made_folder.h"
#include "scenario/description_file.h"
#include "workflow/open_scenario.h"
#include "workflow/resources.h"

namespace mrose {
namespace {

CheckedDescription check(const Shape& shape, const DrawingOptions& options) {
    return {{}, "shape", shape.name, contentText(shape), drawShape(shape, options), {}};
}

CheckedDescription check(const Environment& environment, const DrawingOptions& options) {
    return {{}, "environment", environment.name, contentText(environment), drawEnvironment(environment, options), {}};
}

CheckedDescription check(const RobotDescription& robot, const DrawingOptions& options) {
    std::string sensors;
    for (const SensorPointer& sensor : robot.type.sensors) sensors += (sensors.empty() ? ": " : ", ") + sensor->name();
    return {{},
            "robot",
            robot.type.name,
            motionKind(robot) + ", " + counted(robot.type.manipulators.size(), "manipulator", "manipulators") + ", " +
                counted(robot.type.sensors.size(), "sensor") + sensors,
            drawRobot(robot.type, options),
            {}};
}

CheckedDescription check(const LoadedScenario& scenario, const DrawingOptions& options) {
    const Scene& scene = scenario.parts.scene;
    return {{},
            "scenario",
            scenario.parts.name,
            contentText(scene),
            drawScene(scene, scenario.parts.name, options),
            startsOutsideText(scene)};
}

Expected<std::vector<NamedFile>> pictures(const std::vector<CheckedDescription>& checked,
                                          const std::filesystem::path& out) {
    std::error_code error;
    std::vector<NamedFile> files;
    if (out.extension() == ".svg" && !std::filesystem::is_directory(out, error)) {
        if (checked.size() > 1) return fail(out.string(), "is one file for several pictures; expected a folder");
        files.push_back({out, checked[0].picture});
        return files;
    }
    std::set<std::filesystem::path> taken;
    for (const CheckedDescription& c : checked) {
        const auto path = out / (std::filesystem::path(c.file).stem().string() + '.' + c.kind + ".svg");
        if (!taken.insert(path).second) return fail(path.string(), "would be the picture of two of the files");
        files.push_back({path, c.picture});
    }
    return files;
}

}  // namespace

Expected<CheckedDescription> checkDescription(const CheckRequest& request) {
    DiskDescriptions source = openDescriptions(request.log);
    const auto description = loadDescription(request.file, source);
    if (!description) return tl::unexpected(description.error());
    CheckedDescription checked =
        std::visit([&](const auto& value) { return check(value, request.drawing); }, *description);
    checked.file = request.file;
    return checked;
}

Expected<void> writePictures(const std::vector<CheckedDescription>& checked, const std::string& out, bool overwrite) {
    if (checked.empty()) return {};
    const auto files = pictures(checked, out);
    if (!files) return tl::unexpected(files.error());
    std::optional<MadeFolder> folder;
    if (files->front().path != std::filesystem::path(out)) {
        auto made = MadeFolder::make(out);
        if (!made) return tl::unexpected(made.error());
        folder.emplace(std::move(*made));
    }
    for (const NamedFile& file : *files)
        if (auto writable = checkWritable(file.path, overwrite); !writable) return writable;
    return writeFilesAtomically(*files);
}

}  // namespace mrose

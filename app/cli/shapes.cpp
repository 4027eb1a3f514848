#include <cstdio>
#include <set>

#include "common.h"
#include "drawing/content_text.h"
#include "drawing/scene_drawing.h"
#include "io/file.h"
#include "io/format.h"
#include "io/made_folder.h"
#include "scenario/description_file.h"
#include "scenarios.h"
#include "workflow/resources.h"

namespace mrose::cli {
namespace {

struct ShapesFlags {
    std::vector<std::string> files;
    std::string out, log;
    DrawingOptions drawing;
};

/// A checked file: what is said of it, and its picture.
struct Checked {
    std::string file, kind, name, holds, picture;
};

Checked check(const Shape& shape, const DrawingOptions& options) {
    return {{}, "shape", shape.name, contentText(shape), drawShape(shape, options)};
}

Checked check(const Environment& environment, const DrawingOptions& options) {
    return {{}, "environment", environment.name, contentText(environment), drawEnvironment(environment, options)};
}

Checked check(const RobotDescription& robot, const DrawingOptions& options) {
    const std::string motion = motionKind(robot);
    return {{},
            "robot",
            robot.type.name,
            motion + ", " + counted(robot.type.manipulators.size(), "manipulator", "manipulators"),
            drawRobot(robot.type, options)};
}

Checked check(const LoadedScenario& scenario, const DrawingOptions& options) {
    const Scene& scene = scenario.parts.scene;
    return {{}, "scenario", scenario.parts.name, contentText(scene), drawScene(scene, scenario.parts.name, options)};
}

/// Where the pictures go: one file, or files named after the descriptions and their kinds in a folder.
Expected<std::vector<NamedFile>> pictures(const std::vector<Checked>& checked, const std::filesystem::path& out) {
    std::error_code error;
    std::vector<NamedFile> files;
    if (out.extension() == ".svg" && !std::filesystem::is_directory(out, error)) {
        if (checked.size() > 1) return fail(out.string(), "is one file for several pictures; expected a folder");
        files.push_back({out, checked[0].picture});
        return files;
    }
    std::set<std::filesystem::path> taken;
    for (const Checked& c : checked) {
        const auto path = out / (std::filesystem::path(c.file).stem().string() + '.' + c.kind + ".svg");
        if (!taken.insert(path).second) return fail(path.string(), "would be the picture of two of the files");
        files.push_back({path, c.picture});
    }
    return files;
}

Expected<void> draw(const std::vector<NamedFile>& files, const std::filesystem::path& out, bool overwrite) {
    const bool one = files.front().path == out;
    std::optional<MadeFolder> folder;
    if (!one) {
        auto made = MadeFolder::make(out);
        if (!made) return tl::unexpected(made.error());
        folder.emplace(std::move(*made));
    }
    for (const NamedFile& file : files)
        if (auto writable = checkWritable(file.path, overwrite); !writable) return writable;
    return writeFilesAtomically(files);
}

int shapes(const ShapesFlags& flags, const CommonFlags& common) {
    DiskDescriptions source = openDescriptions(flags.log);
    std::vector<Checked> checked;
    for (const std::string& file : flags.files) {
        // Checking a file must not run anybody's code.
        const auto description = loadDescription(file, source);
        if (!description) return report(description.error());
        if (const auto* const scenario = std::get_if<LoadedScenario>(&*description))
            sayStartsOutside(scenario->parts.scene);
        checked.push_back(std::visit([&](const auto& value) { return check(value, flags.drawing); }, *description));
        checked.back().file = file;
    }
    if (!flags.out.empty()) {
        const auto files = pictures(checked, flags.out);
        if (!files) return report(files.error());
        if (const auto drawn = draw(*files, flags.out, common.overwrite); !drawn) return report(drawn.error());
    }
    nlohmann::json json = nlohmann::json::array();
    for (const Checked& c : checked) {
        json.push_back({{"file", c.file}, {"kind", c.kind}, {"name", c.name}, {"holds", c.holds}});
        if (!common.json && !common.quiet)
            std::printf("%s: %s \"%s\", %s\n", c.file.c_str(), c.kind.c_str(), c.name.c_str(), c.holds.c_str());
    }
    if (common.json) std::puts(json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace).c_str());
    return success;
}

}  // namespace

Subcommand addShapes(CLI::App& app, CommonFlags& common) {
    auto flags = std::make_shared<ShapesFlags>();
    CLI::App* sub = addSubcommand(
        app, common, "shapes", "Check description files: shapes, robots, environments, scenarios; and draw them",
        "  mrose shapes shapes/pioneer1.toml\n"
        "  mrose shapes resources/scenarios/soccer.toml -o soccer.svg\n"
        "  mrose shapes shapes/*.toml resources/robots/*.toml --pieces -o pictures\n"
        "What is wrong is said with file, line, column and key. Pictures are SVG; a browser shows them.");
    addOverwrite(*sub, common);
    sub->add_option("FILE", flags->files, "Description files; also names of those that ship, such as shapes/ball.toml")
        ->required();
    sub->add_option("-o,--output", flags->out, "Draw: to this .svg file, or into this folder")->check(someName());
    sub->add_flag("--pieces", flags->drawing.pieces, "Draw the convex pieces too, into which polygons are divided");
    sub->add_option("--log", flags->log, "The log to read instead of those that scenarios name");
    return {sub, [flags, &common] { return shapes(*flags, common); }};
}

}  // namespace mrose::cli

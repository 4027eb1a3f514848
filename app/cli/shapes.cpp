#include <cstdio>

#include "common.h"
#include "workflow/check_description.h"

namespace mrose::cli {
namespace {

struct ShapesFlags {
    std::vector<std::string> files;
    std::string out;
    CheckRequest each;
};

int runShapes(const ShapesFlags& flags, const CommonFlags& common) {
    std::vector<CheckedDescription> checked;
    for (const std::string& file : flags.files) {
        CheckRequest request = flags.each;
        request.file = file;
        auto description = checkDescription(request);
        if (!description) return report(description.error());
        reportNotes(description->notes);
        checked.push_back(std::move(*description));
    }
    if (!flags.out.empty())
        if (const auto drawn = writePictures(checked, flags.out, common.overwrite); !drawn)
            return report(drawn.error());
    nlohmann::json json = nlohmann::json::array();
    for (const CheckedDescription& c : checked) {
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
    sub->add_flag("--pieces", flags->each.drawing.pieces,
                  "Draw the convex pieces too, into which polygons are divided");
    sub->add_option("--log", flags->each.log, "The log to read instead of those that scenarios name");
    return {sub, [flags, &common] { return runShapes(*flags, common); }};
}

}  // namespace mrose::cli

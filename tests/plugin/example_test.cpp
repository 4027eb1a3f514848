// The example is built and run by exactly the commands that its README tells.
#include <filesystem>

#include <gtest/gtest.h>

#include "io/file.h"
#include "support/places.h"
#include "support/run_program.h"
#include "support/temporary_folder.h"

namespace mrose {
namespace {

/// The first indented block of a text, without the indent.
std::string firstCommands(const std::string& text) {
    std::string commands;
    std::size_t at = text.find("\n    ");
    for (; at != std::string::npos && text.compare(at, 5, "\n    ") == 0; at = text.find('\n', at + 1))
        commands += text.substr(at + 5, text.find('\n', at + 1) - at - 4);
    return commands;
}

TEST(PluginExample, GrowsByTheCommandsOfItsReadme) {
    const auto readme = readFile(sourceFolder() / "resources/plugins/README.md");
    ASSERT_TRUE(readme);
    const std::string commands = firstCommands(*readme);
    ASSERT_NE(commands.find("cmake --build"), std::string::npos) << commands;
    const TemporaryFolder home;
    const std::string script = "export HOME='" + home.path().string() + "'\nPATH='" +
                               std::filesystem::path(mroseProgram()).parent_path().string() + "':$PATH\ncd '" +
                               sourceFolder().string() + "'\n" + commands;
    const ProgramResult result = RunningProgram({"/bin/sh", "-e", "-c", script}).finish();
    EXPECT_EQ(result.status, 0) << result.out << result.err;
    EXPECT_EQ(result.out.find("fault"), std::string::npos) << result.out;
    EXPECT_NE(result.out.find("keep distance, seed 1: 20.00 s"), std::string::npos) << result.out;
    EXPECT_TRUE(std::filesystem::exists(home.path() / "my_controller/build/keep_distance.so"));
}

/// The walk of resources/experiments/README.md, with fewer trials: built, run, tuned, learned, asked and validated.
TEST(PluginExample, DockingGoesFromFilesToAValidatedController) {
    const TemporaryFolder home;
    const std::string script =
        "PATH='" + std::filesystem::path(mroseProgram()).parent_path().string() + "':$PATH\ncp -r '" +
        (sourceFolder() / "resources/plugins/docking").string() + "' '" + home.path().string() + "/docking'\ncd '" +
        home.path().string() + "/docking'\ncmake -B build -DMROSE_HEADERS='" + (sourceFolder() / "core").string() +
        "'\ncmake --build build\n"
        "mrose experiment docking_trials.toml --trials 70 -o trials --quiet\n"
        "sed -i 's/^trials = 40/trials = 8/; s/^held_out = 300/held_out = 20/; s/^evaluations = 2500/evaluations = "
        "200/' "
        "docking_tuning.toml\n"
        "mrose tune docking_tuning.toml -o tuned --quiet\n"
        "mrose learn trials --target time_s --by-variant --hidden 4 --members 2 -o times.net --quiet\n"
        "mrose run docking.toml --settings tuned/settings.toml --set 'robot[1].controller.options.station=0' "
        "--set 'robot[1].controller.mappings={ times = \"times.net\" }'\n"
        "mrose validate docking_validation.toml --trials 20 -o validated --quiet\n"
        "mrose validate docking_choice_validation.toml --trials 20 -o chosen --quiet\n";
    const ProgramResult result = RunningProgram({"/bin/sh", "-e", "-c", script}).finish();
    EXPECT_EQ(result.status, 0) << result.out << result.err;
    EXPECT_EQ(result.out.find("fault"), std::string::npos) << result.out;
    EXPECT_NE(result.out.find("better than every variant alone"), std::string::npos) << result.out;
    EXPECT_NE(result.out.find("gain ratio, reality over "), std::string::npos) << result.out;
    for (const char* const page : {"docking/validated/report.html", "docking/chosen/report.html"})
        EXPECT_TRUE(std::filesystem::exists(home.path() / page)) << page;
}

}  // namespace
}  // namespace mrose

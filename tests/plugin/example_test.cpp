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

}  // namespace
}  // namespace mrose

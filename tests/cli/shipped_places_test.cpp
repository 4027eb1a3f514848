// Where a program finds what ships: wherever it was built, and where it is installed.
#include "io/file.h"
#include "support/places.h"
#include "support/workshop.h"

namespace mrose {
namespace {

class ShippedPlaces : public Workshop {
protected:
    /// The program at that place of the folder, with what it says of the ball that ships.
    ProgramResult ballOf(const std::string& program) const {
        std::filesystem::create_directories(std::filesystem::path(path(program)).parent_path());
        std::filesystem::copy_file(mroseProgram(), path(program));
        return RunningProgram({"/usr/bin/env", "-u", "MROSE_RESOURCES", path(program), "shapes", "ball.toml"}).finish();
    }
    std::string ball() const { return readFile(sourceFolder() / "shapes" / "ball.toml").value_or(""); }
};

TEST_F(ShippedPlaces, ProgramBuiltElsewhereFindsThemWhereItWasBuiltFrom) {
    const ProgramResult result = ballOf("elsewhere/build/mrose");
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_EQ(result.out, runMrose({"shapes", "ball.toml"}).out);
}

TEST_F(ShippedPlaces, InstalledProgramHasItsOwn) {
    write("usr/share/mrose/resources/robots/none.toml", "");
    write("usr/share/mrose/shapes/ball.toml", replaced(ball(), "name = \"", "name = \"an installed "));
    const ProgramResult result = ballOf("usr/bin/mrose");
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_NE(result.out.find("\"an installed "), std::string::npos) << result.out;
}

}  // namespace
}  // namespace mrose

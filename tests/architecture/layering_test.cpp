// Who may include whom, from the include lines of the source itself.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>

#include <gtest/gtest.h>

#include "architecture/source_files.h"
#include "support/places.h"

namespace mrose {
namespace {

/// For each folder of core the other ones that it may include. A new folder says here where it stands.
const std::map<std::string, std::set<std::string>> allowedLayers{
    {"io", {}},
    {"geometry", {}},
    {"planning", {"geometry"}},
    {"world", {"io", "geometry"}},
    {"learning", {"io", "geometry"}},
    {"logs", {"io", "geometry", "world"}},
    {"motion", {"io", "geometry", "world", "learning"}},
    {"perception", {"io", "geometry", "world", "learning", "logs"}},
    {"manipulation", {"io", "geometry", "world", "learning", "perception"}},
    {"identification", {"io", "geometry", "world", "learning", "logs", "motion", "perception", "manipulation"}},
    {"synthetic", {"io", "geometry", "world", "logs", "motion", "scene", "control", "sensing"}},
    {"physics", {"geometry", "world"}},
    {"scene", {"geometry", "world", "motion"}},
    {"control", {"geometry", "world"}},
    {"messages", {"io", "geometry", "world", "control"}},
    {"plugin", {"io", "geometry", "world", "learning", "control", "messages"}},
    {"drawing", {"io", "geometry", "scene"}},
    {"behaviour", {"geometry", "planning", "world", "control"}},
    {"sensing", {"io", "geometry", "world", "motion", "perception", "scene", "control"}},
    {"scenario",
     {"io", "geometry", "world", "logs", "motion", "perception", "manipulation", "synthetic", "physics", "scene",
      "control", "sensing", "behaviour", "planning", "plugin"}},
    {"simulation",
     {"io", "geometry", "world", "motion", "manipulation", "physics", "scene", "control", "scenario", "sensing"}},
    {"quantities", {"io", "geometry", "world", "motion", "physics", "scene", "control", "scenario", "simulation"}},
    {"experiment",
     {"io", "geometry", "world", "learning", "motion", "physics", "scene", "control", "behaviour", "scenario",
      "simulation", "quantities", "condition"}},
    {"tasks", {"io", "geometry", "world", "learning", "identification", "experiment"}},
    {"tuning", {"io", "geometry", "world", "learning", "scenario", "simulation", "experiment"}},
    {"validation", {"io", "geometry", "world", "learning", "motion", "scenario", "experiment"}},
    {"recording",
     {"io", "geometry", "world", "motion", "physics", "scene", "control", "messages", "scenario", "simulation",
      "quantities"}},
    {"assessment",
     {"io", "geometry", "world", "learning", "logs", "motion", "perception", "manipulation", "physics", "scene",
      "control", "sensing", "behaviour", "scenario", "simulation", "quantities"}},
    {"diagnosis",
     {"io", "geometry", "world", "learning", "logs", "motion", "physics", "scene", "control", "behaviour", "scenario",
      "simulation", "quantities", "assessment"}},
    {"report", {"io",     "geometry",   "world",          "learning",   "logs",      "perception", "manipulation",
                "motion", "scene",      "scenario",       "simulation", "recording", "experiment", "tasks",
                "tuning", "validation", "identification", "assessment", "diagnosis", "drawing"}},
    {"debug", {"io",        "geometry",  "world",      "learning",  "logs",       "motion",     "physics",
               "scene",     "control",   "messages",   "behaviour", "scenario",   "simulation", "quantities",
               "condition", "recording", "assessment", "diagnosis", "perception", "sensing"}},
    {"workflow", {"io",           "geometry",   "world",     "learning",   "logs",   "motion",   "perception",
                  "manipulation", "physics",    "scene",     "control",    "plugin", "scenario", "simulation",
                  "quantities",   "condition",  "recording", "experiment", "tasks",  "tuning",   "identification",
                  "synthetic",    "assessment", "diagnosis", "drawing",    "report", "debug",    "validation"}},
    {"script", {"io", "geometry"}},
    {"condition",
     {"io", "geometry", "world", "physics", "scene", "control", "scenario", "simulation", "quantities", "script"}},
};

/// Libraries that only some layers see: what an include begins with, and who may.
const std::map<std::string, std::set<std::string>> librariesOfLayers{
    {"box2d/", {"physics"}},
    {"boost/", {"planning"}},
    {"toml++/", {"io"}},
    {"xxhash.h", {"io", "world"}},
    {"zstd.h", {"io"}},
    {"CLI/", {"app/cli", "app/gui", "app/shared"}},
    {"spdlog/", {"app/cli", "app/gui"}},
    {"nlohmann/", {"report", "app/cli"}},
    {"nlopt.h", {"tuning"}},
    {"Eigen/", {"learning", "identification"}},
    {"immintrin.h", {"learning"}},
    {"lua.hpp", {"script", "condition", "app/gui"}},
    {"qcustomplot.h", {"widgets", "app/gui"}},
    {"Random123/", {"learning", "world"}},
    {"tbb/parallel", {"learning"}},
    {"oneapi/", {}},
};

std::string where(const SourceFile& file, const Include& include) {
    return file.path + ':' + std::to_string(include.line) + " includes " + include.name;
}

/// The layer of core that an include names; empty for the standard library, other libraries and a file beside.
std::string includedLayer(const Include& include) {
    const auto slash = include.name.find('/');
    return include.quoted && slash != std::string::npos ? include.name.substr(0, slash) : "";
}

bool isQt(const std::string& name) {
    return name.starts_with("Qt") || name.starts_with("qcustomplot") ||
           (name.size() > 2 && name[0] == 'Q' && std::isupper(static_cast<unsigned char>(name[1])) != 0);
}

TEST(Layering, SourceIsFoundAtAll) {
    std::set<std::string> layers;
    for (const SourceFile& file : sourceFiles({"core", "app"})) layers.insert(file.layer);
    for (const char* expected : {"io", "world", "logs", "motion", "learning", "assessment", "app/cli"})
        EXPECT_TRUE(layers.count(expected)) << expected;
}

TEST(Layering, ParserSeesEveryKindOfInclude) {
    const SourceFile file = parseSource("core/logs/a.h",
                                        "// c\n#pragma once\n#include \"io/error.h\"  // why\n"
                                        " # include <vector>\n// #include <no>\n");
    EXPECT_TRUE(file.header && file.pragmaOnce);
    EXPECT_EQ(file.layer, "logs");
    EXPECT_EQ(file.lines, 5);
    ASSERT_EQ(file.includes.size(), 2u);
    EXPECT_EQ(where(file, file.includes[0]), "core/logs/a.h:3 includes io/error.h");
    EXPECT_EQ(includedLayer(file.includes[0]), "io");
    EXPECT_EQ(file.includes[1].name, "vector");
    EXPECT_EQ(includedLayer(file.includes[1]), "");
    EXPECT_FALSE(parseSource("core/a/b.h", "#include <vector>\n#pragma once\n").pragmaOnce);
    EXPECT_EQ(parseSource("app/cli/main.cpp", "").layer, "app/cli");
    EXPECT_TRUE(isQt("QWidget") && isQt("QtCore/QString") && !isQt("Queue"));
}

/// Left never needs right: the table itself has no circle, so that each layer can be used without those above.
TEST(Layering, AllowedIncludesFormNoCircle) {
    std::set<std::string> placed;
    for (bool progress = true; progress;) {
        progress = false;
        for (const auto& [layer, below] : allowedLayers)
            if (!placed.count(layer) && std::includes(placed.begin(), placed.end(), below.begin(), below.end()))
                progress = placed.insert(layer).second;
    }
    EXPECT_EQ(placed.size(), allowedLayers.size());
}

TEST(Layering, FoldersOfCoreIncludeOnlyThoseBelowThem) {
    for (const SourceFile& file : sourceFiles({"core"})) {
        const auto allowed = allowedLayers.find(file.layer);
        ASSERT_NE(allowed, allowedLayers.end()) << file.path << ": core/" << file.layer << " is in no layer yet";
        for (const Include& include : file.includes) {
            const std::string layer = includedLayer(include);
            EXPECT_TRUE(!include.quoted || layer == file.layer || allowed->second.count(layer)) << where(file, include);
        }
    }
}

TEST(Layering, CoreAndProgramsIncludeOnlyDownwards) {
    const std::map<std::string, std::set<std::string>> forbidden{
        {"core", {"app", "widgets", "tests", "shared", "cli", "gui"}},
        {"widgets", {"app", "tests", "shared", "cli", "gui"}},
        {"app", {"tests", "cli", "gui"}}};
    for (const SourceFile& file : sourceFiles({"core", "widgets", "app"})) {
        const std::set<std::string>& no = forbidden.at(file.path.substr(0, file.path.find('/')));
        for (const Include& include : file.includes) {
            EXPECT_FALSE(no.count(includedLayer(include))) << where(file, include);
            EXPECT_EQ(include.name.find("../"), std::string::npos) << where(file, include);
        }
    }
}

TEST(Layering, QtStaysInWidgetsAndWindow) {
    for (const SourceFile& file : sourceFiles({"core", "app"}))
        for (const Include& include : file.includes)
            EXPECT_FALSE(file.layer != "app/gui" && isQt(include.name)) << where(file, include);
}

/// Each of the window's parts can be used, and tested, without those above it.
TEST(Layering, PartsOfTheWindowIncludeOnlyThoseBelowThem) {
    const std::vector<std::string> order{"session", "frame",   "panels",    "files", "reality",
                                         "export",  "actions", "scripting", "window"};
    std::map<std::string, std::set<std::string>> below;
    for (auto folder = order.begin(); folder != order.end(); ++folder)
        below[*folder] = std::set<std::string>(order.begin(), folder);
    const std::filesystem::path window = sourceFolder() / "app" / "gui";
    for (const auto& [folder, allowed] : below) {
        const std::vector<SourceFile> files = sourceFiles({"app/gui/" + folder});
        EXPECT_FALSE(files.empty()) << folder;
        for (const SourceFile& file : files)
            for (const Include& include : file.includes) {
                const std::string other = includedLayer(include);
                const bool ofWindow = !other.empty() && std::filesystem::is_directory(window / other);
                EXPECT_TRUE(!ofWindow || other == folder || allowed.count(other)) << where(file, include);
            }
    }
}

/// Widgets draw values, and so are used in any order: they know one another without circles.
TEST(Layering, WidgetsIncludeOneAnotherWithoutCircles) {
    std::map<std::string, std::set<std::string>> needs;
    for (const SourceFile& file : sourceFiles({"widgets"})) {
        const std::string stem = file.path.substr(0, file.path.rfind('.'));
        for (const Include& include : file.includes)
            if (include.quoted && include.name.starts_with("widgets/"))
                if (const std::string other = include.name.substr(0, include.name.rfind('.')); other != stem)
                    needs[stem].insert(other);
    }
    EXPECT_FALSE(needs.empty());
    // Who needs nobody that is left goes, and whom nobody needs, until none such is left.
    const auto leads = [&](const std::string& from, const std::string& to) {
        const auto found = needs.find(from);
        return found != needs.end() && found->second.count(to) > 0;
    };
    while (std::erase_if(needs, [&](const auto& entry) {
        const auto needed = [&](const auto& other) { return leads(entry.first, other.first); };
        const auto needing = [&](const auto& other) { return leads(other.first, entry.first); };
        return std::none_of(needs.begin(), needs.end(), needed) || std::none_of(needs.begin(), needs.end(), needing);
    })) {
    }
    for (const auto& [file, others] : needs) ADD_FAILURE() << file << " includes itself by way of other widgets";
}

/// Its parts know what they need of one another, and not the window that they are parts of.
TEST(Layering, TheWindowIsNamedInItsOwnFilesAndMain) {
    const std::regex window(R"(\bMainWindow\b)");
    for (const SourceFile& file : sourceFiles({"app", "widgets", "core"}))
        EXPECT_TRUE(!std::regex_search(file.text, window) || file.path == "app/gui/main.cpp" ||
                    file.path.starts_with("app/gui/window/main_window."))
            << file.path;
}

TEST(Layering, LibrariesStayWhereTheyBelong) {
    for (const SourceFile& file : sourceFiles({"core", "widgets", "app"}))
        for (const Include& include : file.includes)
            for (const auto& [library, layers] : librariesOfLayers)
                EXPECT_TRUE(!include.name.starts_with(library) || layers.count(file.layer)) << where(file, include);
}

TEST(Layering, CorePrintsNothing) {
    for (const SourceFile& file : sourceFiles({"core"}))
        for (const Include& include : file.includes)
            EXPECT_FALSE(include.name == "iostream" || include.name == "print") << where(file, include);
}

TEST(SourceFiles, HeadersBeginWithPragmaOnce) {
    for (const SourceFile& file : sourceFiles({"core", "app", "widgets", "tests"}))
        EXPECT_TRUE(!file.header || file.pragmaOnce) << file.path;
}

TEST(SourceFiles, OwnHeaderComesFirst) {
    for (const SourceFile& file : sourceFiles({"core", "widgets", "app"})) {
        if (file.ownHeader.empty()) continue;
        ASSERT_FALSE(file.includes.empty()) << file.path;
        EXPECT_EQ(file.includes.front().name, file.ownHeader) << file.path;
    }
}

/// The types and type aliases that a header defines, but for those within a class.
std::vector<std::string> typesOf(const SourceFile& header) {
    static const std::regex type(
        R"(^(?:(?:class|struct|union|enum(?: class)?) (\w+)(?: final)?(?: ?:(?!:)[^;]*)?(?: \{.*)?|using (\w+) =.*)$)");
    std::vector<std::string> types;
    std::istringstream lines(header.text);
    for (std::string line; std::getline(lines, line);)
        if (std::smatch match; std::regex_match(line, match, type)) types.push_back(match[match[1].matched ? 1 : 2]);
    return types;
}

TEST(SourceFiles, TypesOfAHeaderAreSeen) {
    const SourceFile header = parseSource("core/a/b.h",
                                          "class Ahead;\nclass A {\n    struct Within {};\n};\nstruct B {};\n"
                                          "struct A::Part {\n};\nenum class C : std::uint8_t { c };\nenum D { d };\n"
                                          "class E final : public A {\n};\nusing F = int;\nstruct G\n    : A {};\n");
    EXPECT_EQ(typesOf(header), (std::vector<std::string>{"A", "B", "C", "D", "E", "F", "G"}));
}

/// Who reads a name need not ask which one is meant.
TEST(SourceFiles, NoTwoHeadersNameATypeAlike) {
    std::map<std::string, std::string> headers;
    for (const SourceFile& file : sourceFiles({"core", "app", "widgets", "tests"})) {
        if (!file.header) continue;
        for (const std::string& type : typesOf(file))
            if (const auto [other, isNew] = headers.emplace(type, file.path); !isNew)
                ADD_FAILURE() << type << " is defined in " << other->second << " and in " << file.path;
    }
    EXPECT_GT(headers.size(), 300u);
}

/// Where a table of a README says what is in a folder, it says it of each file.
TEST(SourceFiles, ReadmesNameTheFilesOfTheirFolders) {
    for (const char* folder :
         {"core/debug", "core/diagnosis", "core/drawing", "core/report", "core/workflow", "widgets"}) {
        std::ostringstream readme;
        readme << std::ifstream(sourceFolder() / folder / "README.md").rdbuf();
        for (const SourceFile& file : sourceFiles({folder})) {
            const std::string name = std::filesystem::path(file.path).stem().string();
            EXPECT_TRUE(std::regex_search(readme.str(), std::regex('`' + name + "(\\.h)?`"))) << file.path;
        }
    }
}

TEST(SourceFiles, NoneIsLongerThan500Lines) {
    for (const SourceFile& file : sourceFiles({"core", "app", "widgets", "tests"}))
        EXPECT_LE(file.lines, 500) << file.path;
}

}  // namespace
}  // namespace mrose

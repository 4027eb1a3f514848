// The messages that other programs read, beside the schemas that Foxglove publishes (npm's @foxglove/schemas).
#include <set>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "io/file.h"
#include "recording/mcap_walk.h"
#include "recording/message_schemas.h"
#include "recording/node_modules.h"
#include "recording/recording_fixture.h"
#include "support/places.h"
#include "support/run_program.h"

namespace mrose {
namespace {

using Json = nlohmann::json;

/// What need not be as published: prose, and which fields must be there, as all of them are in what we write.
const std::set<std::string> ignored{"description", "$comment", "required"};

/// What one schema says and the other does not, as paths into them.
void listDifferences(const Json& ours, const Json& published, const std::string& path,
                     std::vector<std::string>& differences) {
    if (ours.is_object() && published.is_object()) {
        std::set<std::string> keys;
        for (const Json& schema : {ours, published})
            for (const auto& [key, value] : schema.items()) keys.insert(key);
        for (const std::string& key : keys) {
            // A field may well be called "description".
            if (ignored.count(key) != 0 && !path.ends_with("/properties")) continue;
            const std::string place = path + '/' + key;
            if (!ours.contains(key))
                differences.push_back(place + " is missing");
            else if (!published.contains(key))
                differences.push_back(place + " is not published");
            else
                listDifferences(ours[key], published[key], place, differences);
        }
    } else if (ours.is_array() && published.is_array() && ours.size() == published.size()) {
        for (std::size_t i = 0; i < ours.size(); ++i)
            listDifferences(ours[i], published[i], path + '/' + std::to_string(i), differences);
    } else if (ours != published) {
        differences.push_back(path + " is " + ours.dump() + ", published " + published.dump());
    }
}

std::vector<std::string> differences(const Json& ours, const Json& published) {
    std::vector<std::string> all;
    listDifferences(ours, published, "", all);
    return all;
}

TEST_F(RecordingFile, SchemasAreThoseThatFoxglovePublishes) {
    const auto modules = nodeModulesWith("@foxglove/schemas");
    if (!modules) GTEST_SKIP() << "no node, or no @foxglove/schemas: run tests/recording/install_reader";
    const std::string script = (sourceFolder() / "tests/recording/print_foxglove_schemas.cjs").string();
    const ProgramResult printed = RunningProgram({"/usr/bin/env", "node", script, *modules, "FrameTransforms",
                                                  "SceneUpdate", "Log", "LaserScan", "PointCloud"})
                                      .finish();
    ASSERT_EQ(printed.status, 0) << printed.err;
    const Json published = Json::parse(printed.out);
    std::set<std::string> compared;
    std::map<std::string, Json> schemas = walkSchemas(*readFile(record()));
    schemas["/ROBOT/laser"] = Json::parse(laserScanSchema());
    schemas["/ROBOT/sonar"] = Json::parse(pointCloudSchema());
    for (const auto& [topic, schema] : schemas) {
        const std::string title = schema["title"];
        if (!title.starts_with("foxglove.")) continue;
        ASSERT_TRUE(published.contains(title)) << title;
        for (const std::string& difference : differences(schema, published[title]))
            ADD_FAILURE() << topic << difference;
        compared.insert(title);
    }
    EXPECT_EQ(compared.size(), published.size());
}

/// The comparison itself: a field that is missing, that is not published, or of another type.
TEST(PublishedSchemas, DifferencesAreFound) {
    const Json published = Json::parse(R"({"title":"t","description":"prose","properties":
        {"a":{"type":"number","description":"of a"},"b":{"type":"array","items":{"type":"string"}}}})");
    Json ours = Json::parse(
        R"({"title":"t","properties":{"a":{"type":"number"},"b":{"type":"array","items":{"type":"string"}}}})");
    EXPECT_EQ(differences(ours, published).size(), 0u);
    ours["properties"]["b"]["items"]["type"] = "number";
    EXPECT_EQ(differences(ours, published),
              std::vector<std::string>{"/properties/b/items/type is \"number\", published \"string\""});
    ours["properties"].erase("b");
    EXPECT_EQ(differences(ours, published), std::vector<std::string>{"/properties/b is missing"});
    EXPECT_EQ(differences(published, ours), std::vector<std::string>{"/properties/b is not published"});
}

}  // namespace
}  // namespace mrose

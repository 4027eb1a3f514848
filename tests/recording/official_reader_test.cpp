// Recordings read by MCAP's official reader (npm's @mcap/core), where node and it are present.
#include <cmath>
#include <filesystem>
#include <optional>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "io/bytes.h"
#include "io/file.h"
#include "recording/mcap_walk.h"
#include "recording/node_modules.h"
#include "recording/recording_fixture.h"
#include "support/places.h"
#include "support/run_program.h"

namespace mrose {
namespace {

using Json = nlohmann::json;

class OfficialReader : public RecordingFile {
protected:
    void SetUp() override {
        modules = nodeModulesWith("@mcap/core");
        if (!modules) GTEST_SKIP() << "no node, or no @mcap/core: run tests/recording/install_reader";
    }

    Json read(const std::filesystem::path& file, bool cut = false) const {
        std::vector<std::string> words{"/usr/bin/env", "node",
                                       (sourceFolder() / "tests/recording/read_with_mcap_core.cjs").string(), *modules,
                                       file.string()};
        if (cut) words.emplace_back("cut");
        const ProgramResult result = RunningProgram(words).finish();
        EXPECT_EQ(result.status, 0) << result.err;
        return result.status == 0 ? Json::parse(result.out) : Json();
    }

    void expectPoses(const Json& poses, std::int64_t lastTick) const {
        ASSERT_FALSE(poses.empty());
        std::int64_t last = 0;
        for (const Json& pose : poses) {
            const std::int64_t tick = pose[0].get<std::int64_t>() / scenario.scene().tickLength;
            std::string frame = pose[1];
            const bool branch = frame.starts_with("branch_1/");
            if (branch) frame = frame.substr(9);
            const WorldState& state = branch ? branchRun.states[static_cast<std::size_t>(tick - branchTick)]
                                             : run.states[static_cast<std::size_t>(tick)];
            const std::size_t body = frame == "ball" ? 8 : frame == "crate" ? 9 : std::stoul(frame.substr(6)) - 1;
            const Pose& expected = Scenario::poseOf(state, body);
            EXPECT_NEAR(pose[2], expected.x, 5.1e-4);
            EXPECT_NEAR(pose[3], expected.y, 5.1e-4);
            const double heading = 2 * std::atan2(pose[4].get<double>(), pose[5].get<double>());
            EXPECT_NEAR(std::remainder(heading - expected.heading, 2 * std::acos(-1.0)), 0, 1.42e-3);
            last = std::max(last, tick);
        }
        EXPECT_EQ(last, lastTick);
    }

    /// Of an attachment: after its two times its name, its media type and its data, each behind its length.
    static Json nameAndSize(std::string_view content) {
        ByteReader reader(content.substr(16));
        const std::string_view name = reader.take(reader.number<std::uint32_t>());
        reader.take(reader.number<std::uint32_t>());
        return Json::array({name, reader.number<std::uint64_t>()});
    }

    std::optional<std::string> modules;
};

TEST_F(OfficialReader, SeesTheSamePosesByIndexAndAsStream) {
    const std::filesystem::path path = record();
    const Json found = read(path);
    ASSERT_FALSE(found.is_null());
    const Json &index = found["index"], &stream = found["stream"];
    EXPECT_EQ(index["poses"].size(), 10u * (ticks / 5 + 1 + branchTicks / 5 + 1));
    expectPoses(index["poses"], ticks);
    expectPoses(stream["poses"], ticks);
    EXPECT_EQ(index["counts"], stream["counts"]);
    EXPECT_TRUE(stream["done"]);
    EXPECT_EQ(index["end"], ticks * scenario.scene().tickLength);
}

TEST_F(OfficialReader, FindsAllThatTheSummaryTells) {
    const std::filesystem::path path = record();
    const std::string file = *readFile(path);
    const Json found = read(path);
    ASSERT_FALSE(found.is_null());
    Json attachments = Json::array();
    std::size_t chunks = 0;
    for (const WalkedRecord& part : walkRecords(file)) {
        if (part.kind == 0x0f) break;
        chunks += part.kind == 6;
        if (part.kind == 9) attachments.push_back(nameAndSize(part.content));
    }
    const Json& index = found["index"];
    EXPECT_EQ(index["attachments"], attachments);
    EXPECT_EQ(found["stream"]["attachments"], attachments.size());
    ASSERT_FALSE(attachments.empty());
    EXPECT_EQ(attachments[0][0], "mrose/scenario/0");
    const std::size_t messages = walkMessages(file).size();
    EXPECT_EQ(index["statistics"], (std::vector<std::size_t>{messages, 7, 12, attachments.size(), 2, chunks}));
    EXPECT_EQ(index["library"], "mrose " + thisOrigin().version);
    EXPECT_EQ(index["metadata"]["mrose.run"]["scenario"], "match");
    EXPECT_EQ(index["metadata"]["mrose.run"]["seed"], "77");
}

/// Cut off at the end of a chunk or anywhere in the next one, the chunks before are read.
TEST_F(OfficialReader, ReadsWhatIsLeftOfACutFile) {
    const std::string file = *readFile(record());
    std::size_t last = 0, ends = 0;
    for (const WalkedRecord& part : walkRecords(file)) {
        if (part.kind == 0x0f) break;
        if (part.kind == 6) last = part.offset, ends = part.end;
    }
    for (const std::size_t cut : {last, last + 30, ends - 1}) {
        const std::string left = file.substr(0, cut);
        const Json stream = read(folder.write("cut.mcap", left), true)["stream"];
        ASSERT_FALSE(stream.is_null());
        EXPECT_FALSE(stream["done"]);
        std::int64_t expected = 0;
        for (const WalkedMessage& message : walkMessages(left))
            if (message.topic == "/tf") expected = message.time / scenario.scene().tickLength;
        EXPECT_GT(expected, 100);
        expectPoses(stream["poses"], expected);
    }
}

}  // namespace
}  // namespace mrose

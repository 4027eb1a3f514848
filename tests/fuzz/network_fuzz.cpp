// Whatever the bytes are, a file of a motion network or a kicker gives one that predicts and comes back from its own
// text, or an error of one line; strict reading of TOML never leaves its bounds.
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "fuzz/require.h"
#include "io/toml_table.h"
#include "manipulation/learned_kicker.h"
#include "motion/learned_model.h"

namespace mrose {
namespace {

/// A history of irregular commands that depends on the input; more of them than it can hold.
CommandHistory arbitraryHistory(std::string_view bytes) {
    CommandHistory history;
    Nanoseconds time = 0;
    for (std::size_t i = 0; i < 2 * CommandHistory::capacity; ++i) {
        const auto byte = static_cast<unsigned char>(bytes[i % bytes.size()]);
        time += 1 + byte * Nanoseconds{200'000};
        history.issue(time, {0.01 * (byte - 100), 0.05 * (100 - byte)});
    }
    return history;
}

void requirePrediction(const MotionNetwork& network, std::string_view bytes) {
    const auto motion = std::make_shared<const LearnedMotion>(network);
    const CommandHistory history = arbitraryHistory(bytes), empty;
    std::vector<std::string> robots = network.robots;
    robots.resize(std::min<std::size_t>(robots.size(), 3));
    robots.push_back("no such robot");
    for (const std::string& robot : robots) {
        const LearnedModel model(motion, robot);
        for (const Nanoseconds start : {Nanoseconds{0}, Nanoseconds{900'000'000}, Nanoseconds{1} << 50}) {
            model.predictOne({&history, start, {0.2, -0.3}});
            std::vector<std::byte> memory(model.memorySize());
            as<LearnedMotion::Memory>(std::span(memory)) = {{0.1, 0.1}, 1};
            model.predictOne({&empty, start, {}, memory});
        }
        const LearnedModel noisy(motion, robot, MotionDraw::noisy);
        std::vector<std::byte> memory(noisy.memorySize());
        for (int tick = 0; tick < 3; ++tick)
            noisy.predictOne({&history, 900'000'000, {0.2, -0.3}, memory, NoiseKey{1, tick, 0, 0}});
    }
}

void requireKicker(std::string_view text) {
    const auto network = parseKick(text, "net");
    if (!network) return requireOneLine(network.error());
    const auto again = parseKick(kickText(*network), "net");
    require(again && *again == *network);
    const LearnedKicker kicker(*network);
    for (const double power : {0.0, 0.4, 1.0}) {
        const KickState state{power, {0.3, -1}, {0.25, 0.02}};
        require(kicker.drawDelay(state, {1, 2, 3, 0}) >= 0);
        const KickDeparture departure = kicker.drawDeparture(state, {1, 2, 3, 0});
        require(!departure.hit || departure.speed >= 0);
    }
}

void requireSound(std::string_view text) {
    requireKicker(text);
    const auto network = parseNetwork(text, "net");
    if (!network) return requireOneLine(network.error());
    const auto again = parseNetwork(networkText(*network), "net");
    require(again && *again == *network);
    requirePrediction(*network, text);
}

/// Every kind of read, of keys of every kind.
void requireStrictReads(std::string_view text) {
    TomlTable table(text, "toml");
    for (const char* key : {"a", "hidden", "inputs", "layers", "training"}) {
        table.number(key, {-1, 1});
        table.integer(key, 0, 9);
        table.boolean(key);
        table.choice(key, {"x", "y"});
        table.strings(key);
        table.numbers(key, 3);
        table.matrix(key, 2, 3);
        table.table(key).string("a");
        for (TomlTable& element : table.tables(key)) element.rejectUnknown();
    }
    table.rejectUnknown();
    if (table.failed()) requireOneLine(table.error());
}

}  // namespace
}  // namespace mrose

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    mrose::requireStrictReads(text);
    if (!text.empty()) mrose::requireSound(text);
    return 0;
}

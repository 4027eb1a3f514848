#include "manipulation/kick_network.h"

#include <limits>
#include <numbers>

#include "io/file.h"
#include "io/format.h"
#include "io/toml_table.h"
#include "io/toml_text.h"
#include "learning/network_file.h"

namespace mrose {
namespace {

std::string kickSectionText(const KickNetwork& n) {
    std::string text = "[kick]\nrobot_type = " + tomlString(n.robotType) +
                       "\ncomponents = " + std::to_string(n.components) + "\nmembers = " + std::to_string(n.members) +
                       "\ndirection_rad = " + numberText(n.direction) + "\nseen = [ # least and most of each input\n";
    for (const KickNetwork::Range& range : n.seen)
        text += "  [" + numberText(range.least) + ", " + numberText(range.most) + "],\n";
    const KickNetwork::Constant& c = n.constant;
    text += "]\nconstant = { dead_time_s = " + numberText(c.deadTime) + ", speed_mps = " + numberText(c.speedAtFull) +
            ", hits = " + numberText(c.hits) + ", delay_spread_s = " + numberText(c.delaySpread) +
            ", speed_spread_mps = " + numberText(c.speedSpread) +
            ", direction_spread_rad = " + numberText(c.directionSpread) +
            " } # the same every time but for constant noise, to compare with\n";
    const KickNetwork::HeldOut& h = n.heldOut;
    return text + "held_out_score = { kicks = " + std::to_string(h.kicks) + ", hits = " + std::to_string(h.hits) +
           ", hit = " + numberText(h.hit) + ", delay = " + numberText(h.delay) +
           ", departure = " + numberText(h.departure) + " } # mean logarithms of likelihoods\n";
}

void readKickConstant(TomlTable table, KickNetwork::Constant& constant) {
    constant.deadTime = table.number("dead_time_s", {0, 2});
    constant.speedAtFull = table.number("speed_mps", {-100, 100});
    constant.hits = table.number("hits", {0, 1});
    constant.delaySpread = table.number("delay_spread_s", {1e-9, 10});
    constant.speedSpread = table.number("speed_spread_mps", {1e-9, 100});
    constant.directionSpread = table.number("direction_spread_rad", {1e-9, 10});
    table.rejectUnknown();
}

void readKickHeldOut(TomlTable table, KickNetwork::HeldOut& heldOut) {
    constexpr std::int64_t most = std::numeric_limits<std::int64_t>::max();
    heldOut = {table.integer("kicks", 0, most), table.integer("hits", 0, most), table.number("hit"),
               table.number("delay"), table.number("departure")};
    table.rejectUnknown();
}

bool sameVariables(const std::vector<NetworkVariable>& a, const std::vector<NetworkVariable>& b) {
    bool same = a.size() == b.size();
    for (std::size_t i = 0; same && i < a.size(); ++i) same = a[i].name == b[i].name && a[i].unit == b[i].unit;
    return same;
}

void readKickSection(TomlTable& table, const LearnedNetwork& learned, KickNetwork& network) {
    network.robotType = table.string("robot_type");
    network.components = static_cast<int>(table.integer("components", 1, std::int64_t{ReadingForm::maxComponents}));
    network.members = static_cast<int>(table.integer("members", 1, std::int64_t{ReadingForm::maxMembers}));
    network.direction = table.number("direction_rad", {-std::numbers::pi, std::numbers::pi});
    const std::vector<double> ends = table.matrix("seen", KickState::inputs, 2);
    for (std::size_t i = 0; i + 1 < ends.size(); i += 2) {
        if (ends[i] > ends[i + 1]) table.rejectElement("seen", i / 2, "expected the least before the most");
        network.seen[i / 2] = {ends[i], ends[i + 1]};
    }
    readKickConstant(table.table("constant"), network.constant);
    readKickHeldOut(table.table("held_out_score"), network.heldOut);
    if (table.failed()) return;
    if (!sameVariables(learned.inputs, kickInputs()))
        table.reject("seen",
                     "is of other inputs than the network has; expected power, robot_v, robot_w, ball_x, ball_y");
    else if (const auto expected = kickOutputs(network); !sameVariables(learned.outputs, expected))
        table.reject("components", "are described by other outputs than the network has: expected " +
                                       std::to_string(expected.size()) + " from \"" + expected.front().name +
                                       "\" to \"" + expected.back().name + '"');
}

/// Of one mixture: its shares, means and spreads, of all members.
void addMixture(std::vector<NetworkVariable>& outputs, const ReadingForm& form,
                std::initializer_list<std::pair<const char*, const char*>> dimensions) {
    for (int m = 0; m < form.members; ++m)
        for (int k = 0; k < form.components; ++k) {
            std::string of = form.members == 1 ? "" : " of member " + std::to_string(m + 1);
            if (k > 0) of.insert(0, '_' + std::to_string(k + 1));
            const std::string what = dimensions.size() == 1 ? "delay_" : "departure_";
            if (k > 0) outputs.push_back({"log_" + what + "share" + of, "1"});
            for (const auto& [name, unit] : dimensions) outputs.push_back({name + of, unit});
            for (const auto& [name, unit] : dimensions)
                outputs.push_back({"log_" + std::string(name) + "_spread" + of, "1"});
        }
}

}  // namespace

std::vector<NetworkVariable> kickInputs() {
    return {{"power", "1"}, {"robot_v", "m/s"}, {"robot_w", "rad/s"}, {"ball_x", "m"}, {"ball_y", "m"}};
}

std::vector<NetworkVariable> kickOutputs(const KickNetwork& network) {
    std::vector<NetworkVariable> outputs;
    addMixture(outputs, network.delayForm(), {{"delay", "s"}});
    outputs.push_back({"hit_quantile", "1"});
    addMixture(outputs, network.departureForm(), {{"speed", "m/s"}, {"direction", "rad"}});
    return outputs;
}

std::string kickText(const KickNetwork& network) { return networkFileText(network.learned, kickSectionText(network)); }

Expected<KickNetwork> parseKick(std::string_view text, const std::string& file) {
    TomlTable root(text, file);
    KickNetwork network;
    constexpr std::array<std::string_view, 1> families{regressorFamilyNames[0]};
    auto learned = readNetworkFile(
        root, KickNetwork::kind,
        [&](TomlTable& section, const LearnedNetwork& of) { readKickSection(section, of, network); }, families);
    if (!learned) return tl::unexpected(learned.error());
    network.learned = std::move(*learned);
    return network;
}

Expected<KickNetwork> loadKick(const std::filesystem::path& path) {
    return readFile(path).and_then([&](const std::string& text) { return parseKick(text, path.string()); });
}

}  // namespace mrose

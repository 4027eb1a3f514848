#include "scenario/description_edit.h"

#include <limits>

#include "scenario/description_source.h"
#include "scenario/toml_edit.h"

namespace mrose {
Expected<Descriptions> withNetwork(const Descriptions& descriptions, const std::string& robot,
                                   const std::string& network, const std::string& content) {
    Descriptions changed = descriptions;
    std::string& text = changed.texts[changed.scenario];
    const auto table = tomlTableNamed(text, changed.scenario, {"robot", "person"}, robot);
    if (!table) return tl::unexpected(table.error());
    if (table->empty()) return fail(changed.scenario, "has no robot \"" + robot + '"');
    auto edited = withTomlValue(text, changed.scenario, {*table, "network", "type"}, tomlString(network));
    if (!edited) return tl::unexpected(edited.error());
    text = std::move(*edited);
    changed.texts[joinedName(changed.scenario, network)] = content;
    return changed;
}

Expected<Descriptions> withSeed(const Descriptions& descriptions, std::uint64_t seed) {
    if (seed > static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max()))
        return fail(descriptions.scenario, "a seed of " + std::to_string(seed) + " is beyond what a file can hold", 0,
                    "seed");
    Descriptions changed = descriptions;
    std::string& text = changed.texts[changed.scenario];
    auto edited = withTomlValue(text, changed.scenario, {"", "seed", "version"}, std::to_string(seed));
    if (!edited) return tl::unexpected(edited.error());
    text = std::move(*edited);
    return changed;
}

}  // namespace mrose

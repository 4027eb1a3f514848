#include "recording/kept_texts.h"

#include <charconv>

#include "scenario/scenario_file.h"
#include "scenario/variation.h"

namespace mrose {
namespace {

constexpr const char* trialName = "mrose:trial";  // no description has this name

}  // namespace

Expected<ScenarioValue> scenarioOfTexts(const std::string& scenario, const KeptTexts& texts) {
    KeptDescriptions source(texts);
    auto loaded = loadScenario(scenario, source);
    if (!loaded) return tl::unexpected(loaded.error());
    if (const auto kept = texts.find(trialName); kept != texts.end()) {
        std::uint32_t trial = 0;
        const char* const end = kept->second.data() + kept->second.size();
        if (std::from_chars(kept->second.data(), end, trial).ptr != end)
            return fail("", "has no number of a trial: " + kept->second);
        loaded = varied(*loaded, trial);
        if (!loaded) return tl::unexpected(loaded.error());
    }
    return std::move(loaded->value);
}

}  // namespace mrose

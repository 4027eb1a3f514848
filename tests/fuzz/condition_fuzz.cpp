// Whatever the text is, it becomes a condition that answers, each time the same, or an error of one line.
#include <cstdint>
#include <string_view>

#include "condition/condition.h"
#include "fuzz/require.h"
#include "support/scenes.h"

namespace mrose {
namespace {

void requireAnswers(std::string_view text) {
    static const Scenario scenario = fieldScenario({.robots = 2});
    static const WorldState start = scenario.initialState(), later = stepped(scenario, start);
    auto condition = compileCondition(text, scenario);
    if (!condition) return requireOneLine(condition.error());
    const auto answer = condition->holds({&scenario, &later}), again = condition->holds({&scenario, &later});
    require(answer.has_value() == again.has_value());
    if (!answer) return requireOneLine(answer.error());
    require(*answer == *again);
}

}  // namespace
}  // namespace mrose

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    mrose::requireAnswers({reinterpret_cast<const char*>(data), size});
    return 0;
}

#include "behaviour/method_choice.h"

#include <algorithm>
#include <charconv>
#include <limits>

namespace mrose {
namespace {

struct NamedEstimate {
    std::string_view name, unit;
    double TeamEstimate::*value;
};
constexpr std::array namedEstimates{
    NamedEstimate{"rests", "s", &TeamEstimate::rests},    NamedEstimate{"resting", "s", &TeamEstimate::resting},
    NamedEstimate{"stops", "s", &TeamEstimate::stops},    NamedEstimate{"length", "m", &TeamEstimate::length},
    NamedEstimate{"turns", "rad", &TeamEstimate::turns},  NamedEstimate{"nearest", "m", &TeamEstimate::nearest},
    NamedEstimate{"unclear", "", &TeamEstimate::unclear}, NamedEstimate{"stuck", "", &TeamEstimate::stuck}};

}  // namespace

std::optional<MethodChoice::Input> MethodChoice::input(std::string_view name, std::size_t methods) {
    if (name == "robots") return Input{.quantity = &MethodChoice::robots};
    if (name == "objects") return Input{.quantity = &MethodChoice::objects};
    const std::size_t line = name.rfind('_');
    if (line == std::string_view::npos) return std::nullopt;
    const auto named = std::ranges::find(namedEstimates, name.substr(0, line), &NamedEstimate::name);
    std::size_t method = 0;
    const char* const end = name.data() + name.size();
    const auto [read, error] = std::from_chars(name.data() + line + 1, end, method);
    if (named == namedEstimates.end() || error != std::errc() || read != end || method < 1 || method > methods)
        return std::nullopt;
    return Input{.method = method - 1, .estimate = named->value};
}

std::string MethodChoice::inputNames() {
    std::string names = "robots, objects";
    for (const NamedEstimate& estimate : namedEstimates) names += ", " + std::string(estimate.name) + "_1";
    return names + ", and so on for each method";
}

bool MethodChoice::hasListened(Nanoseconds now, const Options& options) {
    if (listening == 0) {
        listening = 1;
        since = now;
    }
    return now - since >= options.listen;
}

void MethodChoice::consider(const Problem& problem, const Options& options) {
    robots = static_cast<double>(problem.team.size());
    objects = problem.objects;
    considered = static_cast<std::int64_t>(options.methods.size());
    for (std::size_t k = 0; k < options.methods.size(); ++k)
        estimates[k] =
            teamPlan(problem.team, problem.space, options.methods[k], problem.drive, problem.separation).estimate;
    if (!options.time) return;
    std::vector<double> from;
    for (const Input& input : options.inputs)
        from.push_back(input.estimate ? estimates[input.method].*input.estimate : this->*input.quantity);
    const std::span<double> to = std::span(expected).first(options.methods.size());
    options.time->evaluate(from, to);
    beyond = options.time->beyond(from);
    chosen = 1 + (std::ranges::min_element(to) - to.begin());
}

void MethodChoice::explain(const Options& options, MemoryEntries& entries) const {
    if (options.methods.empty()) return;
    const auto known = [&](double value) { return considered != 0 ? value : std::numeric_limits<double>::quiet_NaN(); };
    entries.add("considered", static_cast<double>(considered));
    entries.add("chosen", static_cast<double>(chosen));
    entries.add("robots", known(robots));
    entries.add("objects", known(objects));
    if (options.time) entries.add(beyondLearned, known(beyond));
    for (std::size_t k = 0; k < options.methods.size(); ++k) {
        const std::string number = '_' + std::to_string(k + 1);
        const EntryName method("method", number);
        if (entries.wants(method)) entries.add(method, nameOf(options.methods[k]));
        if (options.time) entries.add(EntryName("expected", number), known(expected[k]), "s");
        for (const NamedEstimate& estimate : namedEstimates)
            entries.add(EntryName(estimate.name, number), known(estimates[k].*estimate.value), estimate.unit);
    }
}

}  // namespace mrose

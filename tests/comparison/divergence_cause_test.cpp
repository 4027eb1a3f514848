#include "comparison/divergence_cause.h"

#include <array>
#include <cstdio>

#include <gtest/gtest.h>

#include "comparison/planted_logs.h"
#include "learning/parallel_for.h"

namespace mrose {
namespace {

/// What is said of one planted log; nothing: it does not diverge.
std::optional<Diagnosis> diagnosed(const PlantedLog& planted) {
    const auto world = LogWorld::create(planted.parts, planted.log);
    if (!world) return std::nullopt;
    const auto comparison = compare(*world, {&planted.request, 1});
    if (!comparison) return std::nullopt;
    const ComparedCourse& course = comparison->courses.front();
    DiagnosisOptions options;
    options.bound = planted.bound;
    options.models = planted.models;
    const auto divergence = firstDivergence(course, options.step, options.bound);
    if (!divergence) return std::nullopt;
    auto diagnosis = diagnose(*world, planted.request, course, *divergence, options);
    return diagnosis ? std::optional(std::move(*diagnosis)) : std::nullopt;
}

constexpr int none = 6;  // after the causes
constexpr std::size_t wanted = 50, attempts = 100;

/// How often each cause was named for logs of one kind.
struct Named {
    std::array<std::size_t, none + 1> causes{};
    std::size_t diverged = 0, made = 0;
};

Named namedFor(Planted kind) {
    std::vector<std::optional<Diagnosis>> diagnoses(attempts);
    parallelFor(attempts, [&](std::size_t i) { diagnoses[i] = diagnosed(plantedLog(kind, i)); });
    Named named;
    for (const auto& diagnosis : diagnoses) {
        if (named.diverged == wanted) break;
        ++named.made;
        if (!diagnosis) continue;
        ++named.diverged;
        const int cause = diagnosis->likely ? static_cast<int>(diagnosis->trials[*diagnosis->likely].kind) : none;
        ++named.causes[static_cast<std::size_t>(cause)];
    }
    return named;
}

TEST(DivergenceCause, IsNamedWherePlantedAndNoOtherwise) {
    std::printf("%-18s%8s%8s", "synthetic, planted", "made", "diverged");
    for (int cause = 0; cause < none; ++cause) std::printf("%23s", name(static_cast<CauseKind>(cause)));
    std::printf("%15s\n", "none of these");
    for (int kind = 0; kind < plantedKinds; ++kind) {
        const auto planted = static_cast<Planted>(kind);
        const Named named = namedFor(planted);
        std::printf("%-18s%8zu%8zu", name(planted), named.made, named.diverged);
        for (int cause = 0; cause <= none; ++cause)
            std::printf("%*zu", cause == none ? 15 : 23, named.causes[static_cast<std::size_t>(cause)]);
        std::printf("\n");
        const auto right = static_cast<std::size_t>(causeOf(planted) ? static_cast<int>(*causeOf(planted)) : none);
        EXPECT_EQ(named.diverged, wanted) << name(planted);
        EXPECT_GE(10 * named.causes[right], 9 * named.diverged) << name(planted);
    }
}

}  // namespace
}  // namespace mrose

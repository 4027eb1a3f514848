// How much two minutes that `mrose advise` chose teach, beside two minutes at random (adviceTrial): bench_advice SEEDS
// EPOCHS FIRST_SEED. Held out are drives as mrose generate makes them, which know all of the robot's range.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <limits>

#include "identification/advice_trial.h"
#include "synthetic/log_generator.h"

namespace mrose {
namespace {

double medianOf(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    const std::size_t n = values.size();
    return (values[(n - 1) / 2] + values[n / 2]) / 2;
}

void report(const std::vector<AdviceTrial>& all) {
    const auto ratio = [&](const char* name, auto error, OpenLoopError AdviceTrial::*other) {
        std::vector<double> ratios, before, advised, random;
        for (const AdviceTrial& o : all) {
            before.push_back(error(o.before));
            advised.push_back(error(o.advised));
            random.push_back(error(o.*other));
            const double lowered = before.back() - random.back();
            ratios.push_back(lowered > 0 ? (before.back() - advised.back()) / lowered
                                         : std::numeric_limits<double>::infinity());
        }
        std::printf("%s: before %.2f, advised %.2f, other %.2f (medians); lowered by times as much: median %.2f\n",
                    name, medianOf(before), medianOf(advised), medianOf(random), medianOf(ratios));
    };
    const auto position = [](const OpenLoopError& e) { return e.position; };
    const auto heading = [](const OpenLoopError& e) { return e.heading; };
    ratio("P, beside mrose generate's random", position, &AdviceTrial::random);
    ratio("P, beside even commands", position, &AdviceTrial::even);
    ratio("Hd, beside mrose generate's random", heading, &AdviceTrial::random);
    ratio("Hd, beside even commands", heading, &AdviceTrial::even);
}

}  // namespace
}  // namespace mrose

int main(int argc, char** argv) {
    using namespace mrose;
    const int seeds = argc > 1 ? std::atoi(argv[1]) : 20;
    const int epochs = argc > 2 ? std::atoi(argv[2]) : 800;
    const auto heldOut = generateLog({DrivePattern::random, 40, 14}, 4321);
    std::vector<AdviceTrial> all;
    const int first = argc > 3 ? std::atoi(argv[3]) : 1;
    for (int seed = first; seed < first + seeds; ++seed) {
        all.push_back(adviceTrial(std::uint64_t(seed), epochs, *heldOut, true));
        const AdviceTrial& o = all.back();
        std::printf("seed %d: P %.2f, advised %.2f, random %.2f, even %.2f; Hd %.2f, %.2f, %.2f, %.2f\n", seed,
                    o.before.position, o.advised.position, o.random.position, o.even.position, o.before.heading,
                    o.advised.heading, o.random.heading, o.even.heading);
        std::fflush(stdout);
    }
    report(all);
}

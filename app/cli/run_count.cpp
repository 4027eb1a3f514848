#include "run_count.h"

#include <cstdio>

namespace mrose::cli {

void RunCount::show(std::int64_t done, std::int64_t all) {
    const Clock::time_point now = Clock::now();
    if (doneBefore_ < 0) doneBefore_ = done - 1;
    if (now < next_) return;
    next_ = now + (line_.terminal() ? std::chrono::milliseconds(200) : std::chrono::seconds(10));
    const double each = seconds() / static_cast<double>(done - doneBefore_);
    const std::string left = done < all ? durationText(each * static_cast<double>(all - done)) + " left" : "writing";
    line_.show(std::to_string(done) + " of " + std::to_string(all) + " runs, " + left);
}

void printEnd(const RunsDone& of, double seconds, const std::string& folder) {
    if (!of.complete) {
        std::printf("interrupted after %lld of %lld runs; the same command goes on with the rest\n",
                    static_cast<long long>(of.done), static_cast<long long>(of.runs));
        return;
    }
    const std::string before = of.resumed > 0 ? ", " + std::to_string(of.resumed) + " of them done before" : "";
    std::printf("%lld run%s in %s%s; results in %s/results.csv\n", static_cast<long long>(of.runs),
                of.runs == 1 ? "" : "s", durationText(seconds).c_str(), before.c_str(), folder.c_str());
}

}  // namespace mrose::cli

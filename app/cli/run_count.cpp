#include "run_count.h"

namespace mrose::cli {

void RunCount::show(std::int64_t done, std::int64_t all) {
    const Clock::time_point now = Clock::now();
    if (doneBefore_ < 0) doneBefore_ = done - 1;
    if (now < next_) return;
    next_ = now + (line_.terminal() ? std::chrono::milliseconds(200) : std::chrono::seconds(10));
    const double each = seconds() / static_cast<double>(done - doneBefore_);
    line_.show(std::to_string(done) + " of " + std::to_string(all) + " runs, " +
               durationText(each * static_cast<double>(all - done)) + " left");
}

}  // namespace mrose::cli

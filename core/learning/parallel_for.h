#pragma once

#include <cstddef>

#include <tbb/parallel_for.h>

#ifdef MROSE_THREAD_SANITIZER
#include <sanitizer/tsan_interface.h>
#endif

namespace mrose {

/// body(i) for each i below `count`, in any order and on any thread; comes back when all are done.
template <typename Body>
void parallelFor(std::size_t count, const Body& body) {
#ifdef MROSE_THREAD_SANITIZER
    // The sanitizer does not see into oneTBB's library: parallelFor() declares what a parallel loop orders, and no
    // more.
    char begun = 0, done = 0;
    __tsan_release(&begun);
    tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
        __tsan_acquire(&begun);
        body(i);
        __tsan_release(&done);
    });
    __tsan_acquire(&done);
#else
    tbb::parallel_for(std::size_t{0}, count, body);
#endif
}

}  // namespace mrose

#pragma once

#include <memory>

#include "bench/mlp_patterns.h"

namespace mrose::bench {

/// FANN, set up as the same network and the same loss; absent if it was not there to build with.
class FannPeer {
public:
    static std::unique_ptr<FannPeer> make(const PatternRows& rows, int hidden);

    virtual ~FannPeer() = default;
    virtual void epoch() = 0;                     ///< of RPROP on the training patterns
    virtual const float* run(float* inputs) = 0;  ///< one pattern
};

}  // namespace mrose::bench

#include "recording/origin.h"

#include "recording/mrose_commit.h"

namespace mrose {

Origin thisOrigin() { return {MROSE_VERSION, MROSE_COMMIT, MROSE_COMPILER, MROSE_BUILD_TYPE, stepVersion}; }

std::vector<std::string> differences(const Origin& recorded, const Origin& here) {
    std::vector<std::string> sentences;
    const auto compare = [&](const char* what, const std::string& then, const std::string& now) {
        if (then != now)
            sentences.push_back("it was recorded " + (what + (' ' + (then.empty() ? "unknown" : then))) + "; this is " +
                                (now.empty() ? "unknown" : now));
    };
    if (recorded.step != here.step)
        sentences.push_back("it was recorded by step " + std::to_string(recorded.step) + " of mrose; this is step " +
                            std::to_string(here.step) + ": it is exact at its keyframes alone");
    compare("by mrose", recorded.version, here.version);
    compare("by a build of commit", recorded.commit, here.commit);
    compare("by a build by", recorded.compiler, here.compiler);
    compare("by a build of type", recorded.buildType, here.buildType);
    return sentences;
}

}  // namespace mrose

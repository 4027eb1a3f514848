#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "io/bytes.h"
#include "simulation/step.h"

namespace mrose {

/// Appends what was decided in one tick: of every robot that decided its orders, exact to the bit, whether they came
/// from outside instead of from its controller, and why it was made to stand where its controller failed. What is only
/// to be looked at (annotations, breaks) is left out.
void appendDecisions(const StepTrace& trace, std::string& bytes);

/// Which decisions are read: all, or only those that came from outside.
enum class DecisionsOf { all, outside };

/// Reads the decisions of one tick after the other.
class DecisionReader {
public:
    explicit DecisionReader(std::string_view bytes) : bytes_(bytes) {}

    /// Those of the next tick, ascending by robot; whether there was a sound one.
    bool next(DecisionsOf whose);
    const std::vector<RobotDecision>& decisions() const { return decisions_; }
    bool done() const { return bytes_.done(); }
    std::size_t rest() const { return bytes_.rest().size(); }  ///< bytes not yet read

private:
    ByteReader bytes_;
    std::vector<RobotDecision> decisions_;
};

}  // namespace mrose

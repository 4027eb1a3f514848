#pragma once

#include <cstddef>

namespace mrose {

/// How the numbers that a regressor gives describe the distribution of a reading: first the normal quantile of the
/// probability that there is one. Its error is, with the same probability, as each of some members says, whose numbers
/// follow each other: for each component of a mixture its share (a logarithm, against the first component's; not of
/// the first itself), its mean errors and the logarithms of its standard deviations, each by dimension.
struct ReadingForm {
    static constexpr int maxDimensions = 3, maxComponents = 4, maxMembers = 8;

    int dimensions = 2;  ///< range and bearing [m, rad]: 2; a pose in its own frame [m, m, rad]: 3
    int components = 1;  ///< of each member
    int members = 1;
    bool operator==(const ReadingForm&) const = default;

    static constexpr int reported = 0;
    static constexpr int errors = 1;  ///< the first member's numbers begin
    /// How many numbers one member gives, and the places of each among them.
    int memberOutputs() const { return components * (2 * dimensions + 1) - 1; }
    int shareOf(int component) const { return component * (2 * dimensions + 1) - 1; }
    int errorOf(int component, int dimension) const { return shareOf(component) + 1 + dimension; }
    int spreadOf(int component, int dimension) const { return errorOf(component, dimension) + dimensions; }
    int outputs() const { return errors + members * memberOutputs(); }
};

}  // namespace mrose

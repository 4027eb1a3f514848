#pragma once

#include <cstddef>
#include <initializer_list>
#include <span>
#include <string>

namespace mrose {

/// A quantity that a learned mapping reads or gives.
struct MappingVariable {
    const char* name = "";
    const char* unit = "";  ///< "m/s"; "1" of what has none
};

/// Something learned that a controller calls: numbers to numbers, in the units that it names. Const, and the same bits
/// wherever and however often it is called.
class LearnedMapping {
public:
    virtual ~LearnedMapping() = default;
    virtual std::size_t inputs() const = 0;
    virtual std::size_t outputs() const = 0;
    virtual MappingVariable input(std::size_t index) const = 0;
    virtual MappingVariable output(std::size_t index) const = 0;
    /// `from` has inputs() numbers, `to` outputs(); otherwise it throws std::invalid_argument.
    virtual void evaluate(std::span<const double> from, std::span<double> to) const = 0;
    /// How far outside of what it was learned at the input lies that is farthest out, as a share of its range: 0
    /// within, or where that is not known. Throws likewise.
    virtual double beyond(std::span<const double> from) const = 0;
};

/// "" where it reads and gives what is named here, in this order; otherwise what it maps and what was expected.
inline std::string mismatch(const LearnedMapping& mapping, std::initializer_list<const char*> inputs,
                            std::initializer_list<const char*> outputs) {
    std::string theirs, ours;
    for (std::size_t i = 0; i < mapping.inputs(); ++i) theirs += std::string(mapping.input(i).name) + ' ';
    for (const char* const name : inputs) ours += std::string(name) + ' ';
    theirs += "->", ours += "->";
    for (std::size_t i = 0; i < mapping.outputs(); ++i) theirs += std::string(" ") + mapping.output(i).name;
    for (const char* const name : outputs) ours += std::string(" ") + name;
    return theirs == ours ? "" : "maps " + theirs + "; expected " + ours;
}

}  // namespace mrose

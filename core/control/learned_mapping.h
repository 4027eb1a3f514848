#pragma once

#include <cstddef>
#include <cstdio>
#include <initializer_list>
#include <limits>
#include <span>
#include <string>

namespace mrose {

/// A quantity that a learned mapping reads or gives.
struct MappingVariable {
    const char* name = "";
    const char* unit = "";  ///< "m/s"; "1" of what has none
    /// Of an input: between which values it was learned, in its unit; infinite where that is not known.
    double least = -std::numeric_limits<double>::infinity(), most = std::numeric_limits<double>::infinity();
};

/// An input that a controller asks for by its name, and between which values it will ask, in the mapping's unit, where
/// it says so.
struct AskedInput {
    AskedInput(const char* its) : name(its) {}
    AskedInput(const char* its, double from, double to) : name(its), least(from), most(to), bounded(true) {}

    const char* name;
    double least = 0, most = 0;
    bool bounded = false;
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

/// The entry of a controller's memory that says LearnedMapping::beyond of what it asked last: a run tells for how long
/// that was more than 0.
inline constexpr const char* beyondLearned = "beyond what was learned";

/// "" where it reads and gives what is named here, in this order; otherwise what it maps and what was expected.
template <class Input>
std::string mismatch(const LearnedMapping& mapping, std::initializer_list<Input> inputs,
                     std::initializer_list<const char*> outputs) {
    std::string theirs, ours;
    for (std::size_t i = 0; i < mapping.inputs(); ++i) theirs += std::string(mapping.input(i).name) + ' ';
    for (const Input& input : inputs) ours += std::string(AskedInput(input).name) + ' ';
    theirs += "->", ours += "->";
    for (std::size_t i = 0; i < mapping.outputs(); ++i) theirs += std::string(" ") + mapping.output(i).name;
    for (const char* const name : outputs) ours += std::string(" ") + name;
    return theirs == ours ? "" : "maps " + theirs + "; expected " + ours;
}

/// So far outside of where it was learned a mapping may be asked, as a share of that range: trials hardly ever reach
/// the ends of what they are drawn from.
inline constexpr double hardlyBeyond = 0.05;

/// "" where the mapping, which reads these inputs in this order, was learned wherever it is to be asked, or does not
/// say where; otherwise where it was and what was expected.
inline std::string learnedTooNarrowly(const LearnedMapping& mapping, std::initializer_list<AskedInput> asked) {
    std::size_t index = 0;
    for (const AskedInput& input : asked) {
        const MappingVariable learned = mapping.input(index++);
        const double spare = hardlyBeyond * (learned.most - learned.least);
        if (!input.bounded || (input.least >= learned.least - spare && input.most <= learned.most + spare)) continue;
        char text[200];
        std::snprintf(text, sizeof text, "was learned at %s from %.3g to %.3g; expected from %.3g to %.3g", input.name,
                      learned.least, learned.most, input.least, input.most);
        return text;
    }
    return "";
}

}  // namespace mrose

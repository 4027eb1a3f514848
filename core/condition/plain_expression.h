#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "quantities/quantity.h"

namespace mrose {

/// An expression of numbers and truths, as nearly all conditions are: arithmetic, comparisons, functions of numbers,
/// and what bodies and their parts, goals, the run and a trial are asked for; a part's entry may be compared with a
/// text. It gives what Lua would, to the bit, sooner.
class PlainExpression {
public:
    /// The number of the body that a text names, "robot[1]"; noBody: `wall`. Nothing: no body.
    using FindBody = std::function<std::optional<std::uint32_t>(std::string_view)>;

    /// Of a text that Lua accepts; `start` is what is known at a run's start. Nothing: it is none.
    static std::optional<PlainExpression> read(std::string_view text, const Moment& start, const FindBody& findBody);

    /// Nothing: Lua must say what it gives, or what is wrong. Arguments as of Condition::holds().
    std::optional<std::variant<bool, double>> evaluate(const Moment& at) const;

private:
    friend class PlainReader;

    /// As Lua computes: whole numbers are a type of their own. Here they are below 2^53.
    struct Number {
        enum class Kind : std::uint8_t { none, truth, real, whole };
        double value = 0;
        Kind kind = Kind::none;

        bool isNumber() const { return kind == Kind::real || kind == Kind::whole; }
        bool counts() const { return kind != Kind::truth || value != 0; }  ///< as true, to `and`, `or` and `not`
    };
    enum class Operation : std::uint8_t {
        constant,
        quantity,
        drawn,
        measured,
        minus,
        square,
        negation,
        add,
        subtract,
        multiply,
        divide,
        less,
        lessOrEqual,
        equal,
        different,
        conjunction,
        disjunction,
        item,
        isText,
        isOtherText,
        ofOne,
        ofTwo
    };
    struct Node {
        Operation operation = Operation::constant;
        int left = -1, right = -1;  ///< operands
        Number number = {};
        const Quantity* asked = nullptr;
        std::uint32_t body = noBody, other = noBody;
        std::string name = {};  ///< of what was drawn or measured, of an item; the text to compare with
        std::string part = {};  ///< of which an item is
        std::size_t place = 0;  ///< where that was at the start
        double (*one)(double) = nullptr;
        double (*two)(double, double) = nullptr;
    };

    Number of(int node, const Moment& at) const;
    Number ofNumbers(const Node& node, const Moment& at) const;
    static Number combined(Operation operation, Number a, Number b);
    static Number compared(Operation operation, Number a, Number b);
    static Number asked(const Node& node, const Moment& at);
    static std::optional<QuantityValue> itemOf(const Node& node, const Moment& at);
    static Number ofTrial(const Node& node, const DrawnValues* values);

    std::vector<Node> nodes_;
    int root_ = -1;
    std::size_t robots_ = 0, objects_ = 0, goals_ = 0;  ///< of the scenario that it was read for
};

}  // namespace mrose

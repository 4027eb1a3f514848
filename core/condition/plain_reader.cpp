#include <algorithm>
#include <array>
#include <charconv>
#include <limits>
#include <numbers>
#include <span>
#include <utility>

#include "condition/lua_paths.h"
#include "condition/plain_expression.h"
#include "quantities/catalogue.h"
#include "quantities/part.h"
#include "script/lua_math.h"
#include "script/lua_tokens.h"

namespace mrose {

/// Reads by recursive descent, in Lua's order of operators.
class PlainReader {
public:
    PlainReader(std::string_view text, const Moment& start, const PlainExpression::FindBody& findBody)
        : text_(text), start_(start), findBody_(findBody), tokens_(luaTokens(text)), paths_(luaPaths(text)) {}

    std::optional<PlainExpression> read() {
        if (paths_.empty() &&
            std::ranges::any_of(tokens_, [](const LuaToken& token) { return token.kind == LuaToken::Kind::name; }))
            return std::nullopt;
        result_.root_ = disjunction();
        if (failed_ || next_ != tokens_.size()) return std::nullopt;
        result_.robots_ = start_.scene().robots.size();
        result_.objects_ = start_.scene().objects.size();
        result_.goals_ = start_.scene().environment.goals.size();
        return std::move(result_);
    }

private:
    using Operation = PlainExpression::Operation;
    using Number = PlainExpression::Number;
    using Node = PlainExpression::Node;

    static constexpr std::size_t mostNodes = 300;  // so that evaluation needs little of the stack
    static constexpr int mostNested = 100;

    std::string_view wordAt(std::size_t i) const {
        return i < tokens_.size() ? text_.substr(tokens_[i].begin, tokens_[i].end - tokens_[i].begin) : "";
    }
    /// Takes an operator or a word, which may be two tokens without a gap.
    bool take(std::string_view word) {
        if (wordAt(next_) == word && !(word.size() == 1 && isLonger())) return ++next_, true;
        if (word.size() != 2 || wordAt(next_) != word.substr(0, 1) || wordAt(next_ + 1) != word.substr(1)) return false;
        if (tokens_[next_].end != tokens_[next_ + 1].begin) return false;
        next_ += 2;
        return true;
    }
    /// Whether the operator of one character that is next begins a longer one that is not read here.
    bool isLonger() const {
        constexpr std::array<std::string_view, 3> longer{"//", "<<", ">>"};
        if (next_ + 1 >= tokens_.size() || tokens_[next_].end != tokens_[next_ + 1].begin) return false;
        return std::ranges::find(longer, text_.substr(tokens_[next_].begin, 2)) != longer.end();
    }

    int fail() {
        failed_ = true;
        return -1;
    }
    int add(Node node) {
        if (failed_ || result_.nodes_.size() == mostNodes) return fail();
        result_.nodes_.push_back(std::move(node));
        return static_cast<int>(result_.nodes_.size()) - 1;
    }
    int constant(double value, Number::Kind kind) {
        return add({.operation = Operation::constant, .number = {value, kind}});
    }

    struct Operator {
        std::string_view word;
        Operation operation;
        bool swapped = false;
    };
    const Operator* taken(std::span<const Operator> operators) {
        const auto found = std::ranges::find_if(operators, [&](const Operator& one) { return take(one.word); });
        return failed_ || found == operators.end() ? nullptr : &*found;
    }
    int joined(const Operator& by, int left, int right) {
        return add({.operation = by.operation, .left = by.swapped ? right : left, .right = by.swapped ? left : right});
    }
    /// Operators of one rank, from the left; `operand` reads what is between them.
    int chain(std::span<const Operator> operators, int (PlainReader::*operand)()) {
        int left = (this->*operand)();
        while (const Operator* const by = taken(operators)) left = joined(*by, left, (this->*operand)());
        return left;
    }
    int disjunction() {
        constexpr Operator operators[] = {{"or", Operation::disjunction}};
        return chain(operators, &PlainReader::conjunction);
    }
    int conjunction() {
        constexpr Operator operators[] = {{"and", Operation::conjunction}};
        return chain(operators, &PlainReader::comparison);
    }
    int comparison() {
        // Lua, too, takes `a > b` as `b < a`.
        constexpr Operator operators[] = {{"<=", Operation::lessOrEqual}, {">=", Operation::lessOrEqual, true},
                                          {"==", Operation::equal},       {"~=", Operation::different},
                                          {"<", Operation::less},         {">", Operation::less, true}};
        int left = sum();
        while (const Operator* const by = taken(operators))
            left = next_ < tokens_.size() && tokens_[next_].kind == LuaToken::Kind::string
                       ? comparedWithText(by->operation, left)
                       : joined(*by, left, sum());
        return left;
    }
    int comparedWithText(Operation operation, int left) {
        const auto text = plainText(wordAt(next_++));
        const bool equality = operation == Operation::equal || operation == Operation::different;
        if (failed_ || !text || !equality ||
            result_.nodes_[static_cast<std::size_t>(left)].operation != Operation::item)
            return fail();
        return add({.operation = operation == Operation::equal ? Operation::isText : Operation::isOtherText,
                    .left = left,
                    .name = std::string(*text)});
    }
    int sum() {
        constexpr Operator operators[] = {{"+", Operation::add}, {"-", Operation::subtract}};
        return chain(operators, &PlainReader::product);
    }
    int product() {
        constexpr Operator operators[] = {{"*", Operation::multiply}, {"/", Operation::divide}};
        return chain(operators, &PlainReader::unary);
    }
    int unary() {
        if (nested_ == mostNested) return fail();
        ++nested_;
        const bool negation = take("not"), minus = !negation && take("-");
        const int result = negation ? add({.operation = Operation::negation, .left = unary()})
                           : minus  ? add({.operation = Operation::minus, .left = unary()})
                                    : square();
        --nested_;
        return result;
    }
    int square() {
        const int base = primary();
        if (!take("^")) return base;
        return take("2") ? add({.operation = Operation::square, .left = base}) : fail();
    }
    int primary() {
        if (failed_ || next_ >= tokens_.size()) return fail();
        if (take("true")) return constant(1, Number::Kind::truth);
        if (take("false")) return constant(0, Number::Kind::truth);
        if (tokens_[next_].kind == LuaToken::Kind::number) return number();
        if (tokens_[next_].kind == LuaToken::Kind::name) return named();
        if (!take("(")) return fail();
        const int inner = disjunction();
        return take(")") ? inner : fail();
    }

    /// A decimal one.
    int number() {
        const std::string_view word = wordAt(next_++);
        double value = 0;
        const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
        if (error != std::errc() || end != word.data() + word.size() || !(value < 0x1p53)) return fail();
        const bool whole = word.find_first_of(".eE") == std::string_view::npos;
        return constant(value, whole ? Number::Kind::whole : Number::Kind::real);
    }

    /// The path that begins with the next token, which it takes.
    const LuaPath* path() {
        if (next_ >= tokens_.size()) return nullptr;
        const auto found = std::ranges::find(paths_, tokens_[next_].begin, &LuaPath::offset);
        if (found == paths_.end()) return nullptr;
        while (next_ < tokens_.size() && tokens_[next_].begin < found->offset + found->text.size()) ++next_;
        return &*found;
    }
    /// The name, text or number of a part of a path; nothing of a text that is not written plainly.
    static std::optional<std::string_view> nameOf(const LuaPath& path, std::size_t part) {
        std::string_view name = path.text.substr(path.parts[part].begin, path.parts[part].end - path.parts[part].begin);
        if (isQuoted(name)) return plainText(name.substr(0, name.find_last_of("\"'") + 1));
        if (name.starts_with('[')) return std::nullopt;
        return name.substr(0, name.find_first_of("] \t\r\n"));
    }
    static bool isQuoted(std::string_view text) { return text.starts_with('"') || text.starts_with('\''); }
    /// What stands between quotation marks; nothing where that means something else than it says.
    static std::optional<std::string_view> plainText(std::string_view quoted) {
        if (!isQuoted(quoted) || quoted.size() < 2 || quoted.find('\\') != std::string_view::npos) return std::nullopt;
        const std::string_view inner = quoted.substr(1, quoted.size() - 2);
        const bool whole = quoted.back() == quoted.front() && inner.find(quoted.front()) == std::string_view::npos;
        return whole ? std::optional(inner) : std::nullopt;
    }

    int named() {
        const LuaPath* const found = path();
        if (found == nullptr) return fail();
        const std::string_view first = *nameOf(*found, 0);  // no text can be first
        if (found->parts.size() == 1) return wordAt(next_) == "(" ? called(first) : ofRun(first);
        const auto written = nameOf(*found, found->parts.size() - 1);
        if (!written) return fail();
        const std::string_view last = *written;
        if (found->parts.size() == 2) {
            if (first == "draw") return ofTrial(Operation::drawn, last, start_.drawnValues());
            if (first == "measure") return ofTrial(Operation::measured, last, start_.measured);
            if (const Quantity* const quantity = quantityOf(first, isOfGoal)) return ofGoal(*quantity, *found, last);
        }
        const auto body = bodyAbove(*found, 1);
        return body ? ofBody(*body, last) : ofItem(*found, last);
    }
    /// What the path is without its last parts, if that is a body.
    std::optional<std::uint32_t> bodyAbove(const LuaPath& path, std::size_t parts) const {
        if (path.parts.size() <= parts) return std::nullopt;
        const auto body = findBody_(path.text.substr(0, path.parts[path.parts.size() - 1 - parts].end));
        return body && *body != noBody ? body : std::nullopt;
    }
    int ofTrial(Operation operation, std::string_view name, const DrawnValues* values) {
        std::size_t place = 0;
        while (values != nullptr && place < values->size() && (*values)[place].name != name) ++place;
        return add({.operation = operation, .name = std::string(name), .place = place});
    }

    const Quantity* quantityOf(std::string_view name, bool (*fits)(const Quantity&)) const {
        const auto found = std::ranges::find_if(
            quantities(), [&](const Quantity& quantity) { return quantity.name == name && fits(quantity); });
        return found == quantities().end() ? nullptr : &*found;
    }
    int ofRun(std::string_view name) {
        if (name == "pi") return constant(std::numbers::pi, Number::Kind::real);
        if (name == "huge") return constant(std::numeric_limits<double>::infinity(), Number::Kind::real);
        const Quantity* const quantity = quantityOf(name, [](const Quantity& q) { return q.of == Quantity::Of::run; });
        return quantity == nullptr ? fail() : add({.operation = Operation::quantity, .asked = quantity});
    }
    static bool isOfGoal(const Quantity& quantity) { return quantity.of == Quantity::Of::goal; }
    int ofGoal(const Quantity& quantity, const LuaPath& path, std::string_view which) {
        const bool named = path.text.find_first_of("\"'.") != std::string_view::npos;
        const std::vector<Goal>& goals = start_.scene().environment.goals;
        for (std::size_t i = 0; i < goals.size(); ++i)
            if (which == (named ? goals[i].name : std::to_string(i + 1)))
                return add(
                    {.operation = Operation::quantity, .asked = &quantity, .body = static_cast<std::uint32_t>(i)});
        return fail();
    }
    const Quantity* quantityOf(std::uint32_t body, std::string_view name) const {
        const auto found = std::ranges::find_if(quantities(), [&](const Quantity& quantity) {
            return quantity.name == name && hasQuantity(start_.scene(), body, quantity);
        });
        return found == quantities().end() ? nullptr : &*found;
    }
    int ofBody(std::uint32_t body, std::string_view name) {
        const Quantity* const quantity = quantityOf(body, name);
        if (quantity == nullptr || quantity->of == Quantity::Of::items) return fail();
        return add({.operation = Operation::quantity, .asked = quantity, .body = body});
    }
    /// robot[1].note.distance, or an entry of a part's memory: robot[1].controller.state.
    int ofItem(const LuaPath& path, std::string_view name) {
        const auto body = bodyAbove(path, 2);
        if (!body) return fail();
        const auto of = nameOf(path, path.parts.size() - 2);
        if (!of) return fail();
        Node node{
            .operation = Operation::item, .asked = quantityOf(*body, *of), .body = *body, .name = std::string(name)};
        if (node.asked == nullptr) {
            const auto part = partNamed(*start_.scenario, *body, *of);
            if (!part) return fail();
            node.asked = &partQuantity();
            node.other = static_cast<std::uint32_t>(*part);
            node.part = *of;
        }
        return node.asked->of == Quantity::Of::items ? add(std::move(node)) : fail();
    }

    int called(std::string_view name) {
        take("(");
        if (const Quantity* const pair = quantityOf(name, [](const Quantity& q) { return q.isPair(); }))
            return ofPair(*pair);
        const std::span<const MathFunction> functions = mathFunctions();
        const auto function = std::ranges::find(functions, name, &MathFunction::name);
        if (function == functions.end()) return fail();
        int result = disjunction(), count = 1;
        for (; !failed_ && take(","); ++count) {
            if (function->ofTwo == nullptr || (count == 2 && !function->ofMore)) return fail();
            const int next = disjunction();
            result = add({.operation = Operation::ofTwo, .left = result, .right = next, .two = function->ofTwo});
        }
        if (!take(")")) return fail();
        if (count > 1) return result;
        return function->ofOne == nullptr
                   ? fail()
                   : add({.operation = Operation::ofOne, .left = result, .one = function->ofOne});
    }
    std::optional<std::uint32_t> bodyTaken() {
        const LuaPath* const found = path();
        return found == nullptr ? std::nullopt : findBody_(found->text);
    }
    int ofPair(const Quantity& quantity) {
        const auto first = bodyTaken();
        if (!take(",")) return fail();
        const auto second = bodyTaken();
        if (!take(")") || !first || !second) return fail();
        if (quantity.of != Quantity::Of::touchingPair && (*first == noBody || *second == noBody)) return fail();
        if (quantity.of == Quantity::Of::seenPair && *first >= start_.scene().robots.size()) return fail();
        return add({.operation = Operation::quantity, .asked = &quantity, .body = *first, .other = *second});
    }

    std::string_view text_;
    const Moment& start_;
    const PlainExpression::FindBody& findBody_;
    std::vector<LuaToken> tokens_;
    std::vector<LuaPath> paths_;
    std::size_t next_ = 0;
    int nested_ = 0;
    bool failed_ = false;
    PlainExpression result_;
};

std::optional<PlainExpression> PlainExpression::read(std::string_view text, const Moment& start,
                                                     const FindBody& findBody) {
    return PlainReader(text, start, findBody).read();
}

}  // namespace mrose

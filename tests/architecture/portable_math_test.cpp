// The C library and the compilers choose their sines and logarithms by processor: what feeds the state, what is
// identified and what is learned is computed by geometry/elementary.h alone.
#include <algorithm>
#include <cctype>
#include <set>
#include <sstream>

#include <gtest/gtest.h>

#include "architecture/source_files.h"
#include "support/referee.h"

namespace mrose {
namespace {

/// Without "f" or "l" behind it, for float or long double. The square root, remainders and rounding are exact.
const std::set<std::string> notPortable{"sin",  "cos",  "tan",    "sincos", "asin",  "acos", "atan", "atan2", "sinh",
                                        "cosh", "tanh", "asinh",  "acosh",  "atanh", "exp",  "exp2", "exp10", "expm1",
                                        "log",  "log2", "log10",  "log1p",  "logb",  "pow",  "cbrt", "hypot", "fma",
                                        "erf",  "erfc", "tgamma", "lgamma", "polar", "lerp", "beta", "sinpi", "cospi"};

/// Pictures and pages: nothing of them comes back into a state or a result that is compared.
const std::set<std::string> pictures{"drawing", "report"};

bool isNotPortable(std::string name) {
    if (name.starts_with("__builtin_")) name.erase(0, 10);
    if (notPortable.count(name) || name.ends_with("_distribution")) return true;
    if (name.empty() || (name.back() != 'f' && name.back() != 'l')) return false;
    name.pop_back();
    return notPortable.count(name) != 0;
}

bool inName(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

/// Comments and what stands in quotes become blanks; lines stay.
std::string codeOf(const std::string& text) {
    std::string code = text;
    const auto blank = [&](std::size_t from, std::size_t to) {
        for (std::size_t i = from; i < std::min(to, code.size()); ++i)
            if (code[i] != '\n') code[i] = ' ';
    };
    for (std::size_t i = 0; i < text.size();) {
        std::size_t end = i + 1;
        if (text.compare(i, 2, "//") == 0) {
            end = text.find('\n', i);
        } else if (text.compare(i, 2, "/*") == 0) {
            end = text.find("*/", i + 2);
        } else if (text.compare(i, 2, "R\"") == 0) {
            const std::size_t open = text.find('(', i);
            end = text.find(')' + text.substr(i + 2, open - i - 2) + '"', open) + open - i;
        } else if (text[i] == '"' || (text[i] == '\'' && (i == 0 || !inName(text[i - 1])))) {
            while (end < text.size() && text[end] != text[i]) end += text[end] == '\\' ? 2 : 1;
            ++end;
        } else {
            ++i;
            continue;
        }
        blank(i, end);
        i = std::min(end, text.size());
    }
    return code;
}

/// How a name at `from` is qualified: "std::", "::", ".", "->" or "".
std::string qualifierBefore(const std::string& code, std::size_t from) {
    const auto before = [&](std::size_t& at) {
        while (at > 0 && std::isspace(static_cast<unsigned char>(code[at - 1])) != 0) --at;
    };
    before(from);
    if (from >= 1 && code[from - 1] == '.') return ".";
    if (from >= 2 && code.compare(from - 2, 2, "->") == 0) return "->";
    if (from < 2 || code.compare(from - 2, 2, "::") != 0) return "";
    from -= 2;
    before(from);
    std::size_t begin = from;
    while (begin > 0 && inName(code[begin - 1])) --begin;
    return code.substr(begin, from - begin) + "::";
}

/// Lines that call a function that is not portable, or name one of the library's: "core/a/b.cpp:12: std::sin".
std::vector<std::string> portabilityFaults(const SourceFile& file) {
    const std::string code = codeOf(file.text);
    const auto includes = [&](auto fits) { return std::any_of(file.includes.begin(), file.includes.end(), fits); };
    // There exp and log are SE(2)'s, which hide those of the library: what is not of SE(2) does not compile.
    const bool ofPoses = file.path == "core/geometry/pose.h" || includes([](const Include& include) {
                             return include.name == "geometry/pose.h" || include.name == "geometry/point.h";
                         });
    const bool ofEigen = includes([](const Include& include) { return include.name.starts_with("Eigen/"); });
    std::vector<std::string> faults;
    int line = 1;
    for (std::size_t i = 0; i < code.size(); ++i) {
        line += code[i] == '\n' ? 1 : 0;
        if (!inName(code[i]) || (i > 0 && inName(code[i - 1]))) continue;
        std::size_t end = i;
        while (end < code.size() && inName(code[end])) ++end;
        const std::string name = code.substr(i, end - i), qualifier = qualifierBefore(code, i);
        if (!isNotPortable(name)) continue;
        const std::size_t next = code.find_first_not_of(" \n", end);
        const bool called = next != std::string::npos && code[next] == '(' && code.compare(next, 2, "()") != 0;
        const bool member = qualifier == "." || qualifier == "->";
        const bool ofLibrary = qualifier == "std::" || qualifier == "::" || name.starts_with("__builtin_");
        const bool named = called && qualifier.empty() && !(ofPoses && (name == "exp" || name == "log"));
        const bool byEigen = ofEigen && member && next != std::string::npos && code[next] == '(';
        if (ofLibrary || named || byEigen)
            faults.push_back(file.path + ':' + std::to_string(line) + ": " + qualifier + name);
    }
    return faults;
}

std::vector<std::string> faultsOf(const std::string& text) {
    return portabilityFaults(parseSource("core/world/a.cpp", text));
}

TEST(PortableMath, EverySpellingIsFound) {
    for (const char* const call : {"std::sin(x)",
                                   "::sin(x)",
                                   "sin(x)",
                                   "sinf(x)",
                                   "std::sinf(x)",
                                   "__builtin_sin(x)",
                                   "std :: sin (x)",
                                   "sinl( x )",
                                   "std::hypot(a, b)",
                                   "std::atan2(y, x)",
                                   "powf(a, 2)",
                                   "std::transform(a, b, c, std::exp<double>)",
                                   "f<std::log>",
                                   "using std::cos;",
                                   "fma(a, b, c)",
                                   "std::fma(a, b, c)",
                                   "std::normal_distribution<double> n",
                                   "exp(x)",
                                   "log(x)",
                                   "std::\n  tan(x)",
                                   "__builtin_fmaf(a, b, c)"})
        EXPECT_EQ(faultsOf(std::string("int a;\ndouble b = ") + call + ";\n").size(), 1u) << call;
    EXPECT_EQ(faultsOf("\n\nx = 2 * std::sin(y);\n"), std::vector<std::string>{"core/world/a.cpp:3: std::sin"});
    EXPECT_EQ(faultsOf("std::sin(a) + cos(b)").size(), 2u);
    EXPECT_EQ(faultsOf("#include <Eigen/Core>\nh = x.array().tanh() + y.exp();").size(), 2u);
    EXPECT_EQ(faultsOf("'a'; \"\\\"\"; std::sin(1'000);").size(), 1u);
}

TEST(PortableMath, OtherNamesAreNotFound) {
    for (const char* const text : {"// std::sin(x)", "/* sin(x)\n cos(y) */", "\"std::sin(x)\"", "R\"(sin(x))\"",
                                   "R\"a(sin(\"x))a\"", "world.log(1)", "world->log(file)", "const Log& log() const",
                                   "sine(x) + cosine(y)", "std::sqrt(x)", "std::fmod(x, y)", "single(x)", "Log::log(x)",
                                   "elementary::exp(x)", "double log;", "std::floor(x)", "'\\''; '\"'; x"})
        EXPECT_TRUE(faultsOf(text).empty()) << text;
    EXPECT_TRUE(faultsOf("#include \"geometry/pose.h\"\nPose p = exp(twist);").empty());
    EXPECT_EQ(faultsOf("#include \"geometry/pose.h\"\nPose p = exp(twist) + std::exp(x) + ::log(x) + sin(x);").size(),
              3u);
}

TEST(PortableMath, NothingThatFeedsTheStateCallsTheLibrarys) {
    std::size_t looked = 0;
    for (const SourceFile& file : sourceFiles({"core"})) {
        if (pictures.count(file.layer)) continue;
        ++looked;
        for (const std::string& fault : portabilityFaults(file))
            ADD_FAILURE() << fault << ": use geometry/elementary.h, which gives the same bits on every processor";
    }
    EXPECT_GT(looked, 300u);
}

/// The same of the compiled library, also of what comes from other libraries' headers, where a folder is one object.
TEST(PortableMath, NoObjectOfTheLibraryNeedsThem) {
    const auto symbols = outputOf("nm --print-file-name --undefined-only '" MROSE_CORE_LIBRARY "'");
    if (!symbols) GTEST_SKIP() << "no nm here";
    if (symbols->find("UnifiedSource_simulation") == std::string::npos)
        GTEST_SKIP() << "folders are not one object each";
    std::istringstream lines(*symbols);
    bool drawingSeen = false;
    for (std::string line; std::getline(lines, line);) {
        const std::string symbol = line.substr(line.rfind(' ') + 1);
        if (!isNotPortable(symbol)) continue;
        const bool picture = std::any_of(pictures.begin(), pictures.end(), [&](const std::string& folder) {
            return line.find("UnifiedSource_" + folder + '_') != std::string::npos;
        });
        EXPECT_TRUE(picture) << line;
        drawingSeen = drawingSeen || picture;
    }
    EXPECT_TRUE(drawingSeen) << "not even in pictures: they are not found at all";
}

}  // namespace
}  // namespace mrose

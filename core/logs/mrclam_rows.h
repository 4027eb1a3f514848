#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "logs/decimal.h"
#include "logs/row_check.h"
#include "logs/text_lines.h"

namespace mrose {

/// How files of one kind are laid out: the names of their columns, and how the numbers of a row make a sample. Where
/// samples have a time, it is the first column, and no number of `store`'s.
template <class Sample, std::size_t columns>
struct MrclamLayout {
    std::array<const char*, columns> keys;
    void (*store)(Sample&, const double* numbers);
};

/// A file of the MRCLAM data sets while it is read: rows of numbers separated by blanks; lines that begin with # are
/// comments. Refers to text, name and layout, which must outlive it.
template <class Sample, std::size_t columns>
class MrclamRows {
public:
    MrclamRows(std::string_view content, const std::string& name, const MrclamLayout<Sample, columns>& layout)
        : content_(content), name_(name), layout_(layout), end_(content.data() + content.size()) {}

    /// As in the file; a last line that is cut off is left out and counted. Error: another number of columns, no number
    /// where one belongs, time running backwards for good.
    Expected<std::vector<Sample>> parse(std::int64_t& cutLines) {
        std::vector<Sample> samples;
        samples.reserve(content_.size() / (12 * columns));
        for (const char* at = nextLine(content_.data(), end_); at != end_; at = nextLine(at, end_)) {
            at = parseRow(at, samples.emplace_back());
            if (error_) return *error_;
            if (at != nullptr) continue;
            samples.pop_back();
            ++cutLines;
            break;
        }
        if constexpr (timed) {
            const auto checked = checkDirection(samples, name_, [&](std::size_t row) { return lineOf(row); });
            if (!checked) return tl::unexpected(checked.error());
        }
        return samples;
    }

    int lineOf(std::size_t row) const {
        const char* at = nextLine(content_.data(), end_);
        for (std::size_t i = 0; i < row; ++i) at = nextLine(lineEnd(at, end_), end_);
        return positionIn(content_, at).line;
    }

private:
    static constexpr bool timed = requires(Sample sample) { sample.time; };
    static constexpr std::string_view blanks = " \t\r\n";

    /// The end of the row's line; nullptr where it is cut off, and with error_ where something is wrong.
    const char* parseRow(const char* at, Sample& sample) {
        std::array<double, columns> values;
        for (std::size_t i = 0; i < columns; ++i) {
            const char* const behind = parseCell(at, i, sample, values[i]);
            if (behind == nullptr || (behind < end_ && blanks.find(*behind) == blanks.npos)) return reject(at, i);
            at = skipBlanks(behind, end_);
        }
        if (at == end_) return nullptr;
        if (*at != '\n') return refuse(at, {}, "more than " + std::to_string(columns) + " columns");
        layout_.store(sample, values.data() + timed);
        return at + 1;
    }

    const char* parseCell(const char* at, std::size_t column, Sample& sample, double& value) const {
        if constexpr (timed)
            if (column == 0) return parseInstant(at, end_, sample.time);
        return parseSample(at, end_, value);
    }

    const char* reject(const char* at, std::size_t column) {
        // What is cut off ends in the middle of a number, or before it.
        if (std::find_first_of(at, end_, blanks.begin(), blanks.end()) == end_) return nullptr;
        if (*at == '\n')
            return refuse(at, layout_.keys[column],
                          "missing: " + std::to_string(column) + " of " + std::to_string(columns) + " columns");
        return refuse(at, layout_.keys[column], noNumberCause(content_, at, blanks, timed && column == 0));
    }

    const char* refuse(const char* at, std::string key, std::string cause) {
        error_ = failAt(name_, content_, at, std::move(key), std::move(cause));
        return nullptr;
    }

    std::string_view content_;
    const std::string& name_;
    const MrclamLayout<Sample, columns>& layout_;
    const char* end_;
    std::optional<tl::unexpected<Error>> error_;
};

}  // namespace mrose

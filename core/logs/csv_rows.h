#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/error.h"
#include "world/time.h"

namespace mrose {

enum class CellKind { number, instant, text };

/// What a cell holds by its column's kind; an empty cell holds nothing.
struct CsvCell {
    bool present = false;
    double number = 0;
    Nanoseconds instant = 0;
    std::string_view text;
};

/// Rows of a comma-separated text: one header line, blanks around cells ignored, empty lines and lines that begin with
/// # skipped, no quotes. Refers to the text and the name, which must outlive it.
class CsvRows {
public:
    /// Error: no header line.
    static Expected<CsvRows> open(std::string_view content, const std::string& name);

    const std::vector<std::string_view>& header() const { return header_; }
    /// What stands above the header: comments.
    std::string_view preamble() const {
        return {content_.data(), static_cast<std::size_t>(headerStart_ - content_.data())};
    }
    int headerLine() const;

    /// One for each column of the header; to be called once, before the first row.
    void setKinds(std::vector<CellKind> kinds);

    /// The next row; false at the end and where something is wrong: another number of cells than the header has, no
    /// finite number where one belongs, a last line that is cut off.
    bool next();
    const std::optional<Error>& error() const { return error_; }
    /// The error is no more than that the text ends within its last line, without a line break.
    bool cutOff() const { return cutOff_; }

    std::span<const CsvCell> cells() const { return cells_; }
    int line() const;  ///< of the current row; counts from the start of the text
    const char* position() const { return row_; }

    /// An error about the current row.
    Error about(std::string key, std::string cause) const;

private:
    CsvRows(std::string_view content, const std::string& name) : content_(content), name_(&name) {}

    bool readHeader();
    bool readRow();
    const char* readCell(const char* at, std::size_t column);
    bool refuse(const char* at, std::string key, std::string cause);
    bool refuseCount(const char* at, std::size_t column);
    bool refuseCell(const char* at, std::size_t column);

    std::string_view content_;
    const std::string* name_;
    std::vector<std::string_view> header_;
    std::vector<CellKind> kinds_;
    std::vector<CsvCell> cells_;
    const char* headerStart_ = nullptr;
    const char* at_ = nullptr;
    const char* row_ = nullptr;
    std::optional<Error> error_;
    bool cutOff_ = false;
};

}  // namespace mrose

#include "logs/csv_rows.h"

#include <algorithm>
#include <cstring>

#include "logs/decimal.h"
#include "logs/row_check.h"
#include "logs/text_lines.h"

namespace mrose {
namespace {

constexpr std::string_view byteOrderMark = "\xEF\xBB\xBF";

std::string_view trimmed(const char* begin, const char* end) {
    begin = skipBlanks(begin, end);
    while (end > begin && (end[-1] == ' ' || end[-1] == '\t' || end[-1] == '\r')) --end;
    return {begin, static_cast<std::size_t>(end - begin)};
}

std::string columnCount(std::size_t count) { return std::to_string(count) + (count == 1 ? " column" : " columns"); }

}  // namespace

Expected<CsvRows> CsvRows::open(std::string_view content, const std::string& name) {
    if (content.starts_with(byteOrderMark)) content.remove_prefix(byteOrderMark.size());
    CsvRows rows(content, name);
    if (!rows.readHeader()) return fail(name, "is empty; expected a header line");
    return rows;
}

bool CsvRows::readHeader() {
    const char* const end = content_.data() + content_.size();
    row_ = headerStart_ = nextLine(content_.data(), end);
    if (row_ == end) return false;
    const char* const stop = lineEnd(row_, end);
    for (const char* cell = row_;;) {
        const void* comma = std::memchr(cell, ',', static_cast<std::size_t>(stop - cell));
        const char* const cellEnd = comma == nullptr ? stop : static_cast<const char*>(comma);
        header_.push_back(trimmed(cell, cellEnd));
        if (comma == nullptr) break;
        cell = cellEnd + 1;
    }
    at_ = stop;
    return true;
}

int CsvRows::headerLine() const {
    const char* const end = content_.data() + content_.size();
    return positionIn(content_, nextLine(content_.data(), end)).line;
}

void CsvRows::setKinds(std::vector<CellKind> kinds) {
    kinds_ = std::move(kinds);
    cells_.resize(kinds_.size());
}

int CsvRows::line() const { return positionIn(content_, row_).line; }

Error CsvRows::about(std::string key, std::string cause) const {
    return {*name_, line(), 0, std::move(key), std::move(cause)};
}

bool CsvRows::next() {
    const char* const end = content_.data() + content_.size();
    if (error_ || at_ == end) return false;
    row_ = nextLine(at_, end);
    return row_ != end && readRow();
}

bool CsvRows::readRow() {
    const char* const end = content_.data() + content_.size();
    const char* at = row_;
    for (std::size_t i = 0; i < kinds_.size(); ++i) {
        at = readCell(at, i);
        if (at == nullptr) return false;
        const bool comma = at < end && *at == ',';
        if (comma == (i + 1 < kinds_.size())) {
            at += comma;
            continue;
        }
        return comma ? refuse(at, {}, "more than the " + columnCount(kinds_.size()) + " of the header")
                     : refuseCount(at, i + 1);
    }
    at_ = at;
    return true;
}

/// The comma, line break or end of text behind the cell; nullptr where it is none of its kind.
const char* CsvRows::readCell(const char* at, std::size_t column) {
    const char* const end = content_.data() + content_.size();
    CsvCell& cell = cells_[column];
    at = skipBlanks(at, end);
    cell.present = at < end && *at != ',' && *at != '\n';
    if (!cell.present) return at;
    const char* behind = at;
    if (kinds_[column] == CellKind::text) {
        while (behind < end && *behind != ',' && *behind != '\n') ++behind;
        cell.text = trimmed(at, behind);
        return behind;
    }
    behind =
        kinds_[column] == CellKind::number ? parseSample(at, end, cell.number) : parseInstant(at, end, cell.instant);
    if (behind != nullptr) behind = skipBlanks(behind, end);
    if (behind != nullptr && (behind == end || *behind == ',' || *behind == '\n')) return behind;
    refuseCell(at, column);
    return nullptr;
}

/// What is no number, as it stands or because the text ends within it.
bool CsvRows::refuseCell(const char* at, std::size_t column) {
    const char* const end = content_.data() + content_.size();
    const bool last = column + 1 == kinds_.size();
    if (std::find_if(at, end, [](char c) { return c == ',' || c == '\n'; }) == end &&
        (!last || std::string_view(at, end).find_first_not_of("+-.0123456789eE") == std::string_view::npos))
        return refuseCount(at, column);
    return refuse(at, std::string(header_[column]),
                  noNumberCause(content_, at, ",\r\n", kinds_[column] == CellKind::instant));
}

bool CsvRows::refuse(const char* at, std::string key, std::string cause) {
    error_ = failAt(*name_, content_, at, std::move(key), std::move(cause)).value();
    return false;
}

bool CsvRows::refuseCount(const char* at, std::size_t count) {
    cutOff_ = lineEnd(at, content_.data() + content_.size()) == content_.data() + content_.size();
    return refuse(at, std::string(header_[count]),
                  (cutOff_ ? "the last line is cut off: " : "missing: ") + std::to_string(count) + " of " +
                      columnCount(kinds_.size()));
}

}  // namespace mrose

#include "report/page.h"

#include <cmath>

#include "io/format.h"
#include "io/made_folder.h"
#include "report/page_style.h"
#include "world/seconds_text.h"

namespace mrose {
namespace {

std::string intervalText(const Interval& interval, std::size_t windows) {
    if (windows < leastForInterval) return cat("of ", std::to_string(windows), ": too few for an interval");
    return cat("95\u00a0% interval ", fixed(interval.low, 2), "–", percentText(interval.high));
}

std::string percentilesText(const Distribution& d, double unit, std::string_view unitText) {
    if (d.count < leastForPercentile)
        return cat("mean ", fixed(unit * d.mean, 1), unitText, ", of ", std::to_string(d.count));
    return cat("mean ", fixed(unit * d.mean, 1), ", 90th percentile ", p90Text(d, unit, 1), unitText);
}

std::string attribute(std::string_view cssClass) {
    return cssClass.empty() ? std::string{} : cat(" class=\"", cssClass, "\"");
}

}  // namespace

std::string element(std::string_view tag, std::string_view cssClass, std::string_view content) {
    return cat("<", tag, attribute(cssClass), ">", content, "</", tag, ">\n");
}

std::string reportPage(std::string_view title, std::string_view body) {
    return cat("<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"/>\n",
               "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n<title>", title,
               "</title>\n<style>", reportStyle, "</style></head>\n<body><main>\n", body, "</main></body></html>\n");
}

std::string pageHead(std::string_view title, std::string_view subtitle, const PageSource& source,
                     const ReportContext& context, const std::vector<std::string>& notices) {
    const char* const badge = source.synthetic ? "<span class=\"badge\">synthetic data</span>" : "";
    const std::string program = context.program.empty() ? "" : cat(" · ", escaped(context.program));
    std::string text =
        element("h1", "", cat(title, badge)) +
        element("p", "sub", cat(subtitle, ", ", source.kind, " <code>", escaped(source.log), "</code>", program));
    for (const std::string& notice : notices) text += element("p", "notice", escaped(notice));
    return text;
}

std::string heading(std::string_view content) { return element("h2", "", content); }

std::string paragraph(std::string_view content) { return element("p", "", content); }

std::string definition(std::string_view term, std::string_view meaning) {
    return cat("<dt>", term, "</dt><dd>", meaning, "</dd>\n");
}

std::string card(std::string_view title, std::string_view content) {
    return element("div", "card", cat(element("h3", "", title), content));
}

std::string tableCard(std::string_view content) { return element("div", "card", content); }

std::string adviceCard(const DriveAdvice& advice) {
    if (!advice.missing.empty()) return card("What to drive next", paragraph(escaped(advice.missing)));
    std::string list;
    for (const std::string& reason : advice.reasons) list += element("li", "", escaped(reason));
    return card("What to drive next",
                cat(paragraph(cat("Beside this log the network would learn most from ", escaped(advice.drive), ":")),
                    element("ul", "", list), paragraph(cat("<code>", escaped(advice.command), "</code>"))));
}

std::string cardPair(std::string_view first, std::string_view second) {
    return element("div", "pair", cat(first, second));
}

std::string figurePair(std::string_view position, std::string_view heading) {
    return cardPair(card("Position", position), card("Heading", heading));
}

std::string p90Text(const Distribution& d, double unit, int decimals) {
    return d.count < leastForPercentile ? "" : fixed(unit * d.p90, decimals);
}

std::string capitalised(std::string text) {
    if (!text.empty() && text[0] >= 'a' && text[0] <= 'z') text[0] = static_cast<char>(text[0] - 'a' + 'A');
    return text;
}

std::string knownText(double value, int decimals) { return std::isfinite(value) ? fixed(value, decimals) : ""; }

std::string offText(const Summary& summary) {
    return cat("off by <b>", percentText(summary.p), "</b> of the path driven (P) and its heading by <b>",
               percentText(summary.hd), "</b> of the rotation turned (Hd), on average over time. ");
}

std::string errorDefinitions(const WindowOptions& options, std::string_view windows) {
    return definition("P", cat("Sum over the ", windows, " of the position error’s time-mean (every ",
                               secondsText(options.step), " s), divided by the sum of the path lengths.")) +
           definition("Hd", cat("Sum over the ", windows,
                                " of the absolute heading error’s time-mean, divided by the sum of the absolute "
                                "rotations."));
}

std::string percentText(double value) { return cat(fixed(value, 2), "\u00a0%"); }

std::string lengthText(Nanoseconds shortest, Nanoseconds longest) {
    return cat(shortest == longest ? "" : cat(secondsText(shortest, 0), " to "), secondsText(longest, 0), " s");
}

std::string tile(std::string_view label, std::string_view value, std::string_view unit, std::string_view more) {
    return element("div", "tile",
                   cat("<div class=\"name\">", label, "</div><div class=\"value\">", value, " <small>", unit,
                       "</small></div><div class=\"more\">", more, "</div>"));
}

std::string tileRow(std::string_view tiles) { return element("div", "tiles", tiles); }

std::string tiles(const Summary& s) {
    return tileRow(cat(tile("P: position error over path", fixed(s.p, 2), "%", intervalText(s.p95, s.windows)),
                       tile("Hd: heading error over rotation", fixed(s.hd, 2), "%", intervalText(s.hd95, s.windows)),
                       tile("position at the end, median", fixed(100 * s.positionFinal.median, 1), "cm",
                            percentilesText(s.positionFinal, 100, " cm")),
                       tile("heading at the end, median", cat(fixed(degrees * s.headingFinal.median, 1), "°"), "",
                            percentilesText(s.headingFinal, degrees, "°"))));
}

HtmlTable::HtmlTable(const std::vector<Group>& groups, std::string cssClass) : cssClass_(std::move(cssClass)) {
    std::string headings, columns, headingWords, columnWords;
    for (const Group& group : groups) {
        headingWords += group.heading;
        headings += cat("<th colspan=\"", std::to_string(group.columns.size()), "\">", group.heading, "</th>");
        for (const std::string& column : group.columns) {
            columnWords += column;
            columns += cat("<th scope=\"col\">", column, "</th>");
            ++columns_;
        }
    }
    if (!headingWords.empty()) head_ = cat("<tr class=\"groups\">", headings, "</tr>\n");
    if (!columnWords.empty()) head_ += cat("<tr>", columns, "</tr>");
}

void HtmlTable::part(std::string_view content) {
    rows_ += cat("<tr class=\"part\"><th colspan=\"", std::to_string(columns_), "\">", content, "</th></tr>\n");
}

void HtmlTable::row(const std::vector<std::string>& cells) {
    rows_ += "<tr>";
    for (std::size_t i = 0; i < cells.size(); ++i)
        rows_ += i == 0 ? cat("<th scope=\"row\">", cells[i], "</th>") : cat("<td>", cells[i], "</td>");
    rows_ += "</tr>\n";
}

std::string HtmlTable::text() const {
    const std::string head = head_.empty() ? "" : cat("<thead>\n", head_, "</thead>");
    return cat("<div class=\"scroll\"><table", attribute(cssClass_), ">", head, "<tbody>\n", rows_,
               "</tbody></table></div>\n");
}

std::string defectTable(const LogWindows& log) {
    HtmlTable table({{"", {"", "windows"}},
                     {"stamps", {"out of order", "duplicate"}},
                     {"samples", {"blips", "pose outliers", "unpaired", "heading wraps"}},
                     {"command gaps", {"number", "longest s"}},
                     {"truth gaps", {"number", "longest s"}}});
    for (const LogWindows::Robot& robot : log.robots) {
        if (robot.windows == 0) continue;
        const LogDefects& d = robot.defects;
        std::vector<std::string> cells{cat("robot ", escaped(robot.name)), std::to_string(robot.windows)};
        for (const auto count : {d.outOfOrder, d.duplicates, d.blips, d.poseOutliers, d.unpaired, d.headingWraps})
            cells.push_back(std::to_string(count));
        cells.push_back(std::to_string(d.commandGaps));
        cells.push_back(fixed(d.longestCommandGap, 2));
        cells.push_back(std::to_string(d.poseGaps));
        cells.push_back(fixed(d.longestPoseGap, 2));
        table.row(cells);
    }
    return table.text();
}

void addModelFacts(HtmlTable& table, const ReportContext& context) {
    for (const auto& [key, value] : context.modelFacts)
        table.row({escaped(key), key == "command" ? cat("<code>", escaped(value), "</code>") : escaped(value)});
}

std::string fileTable(const std::vector<LogFile>& files) {
    HtmlTable table({{"", {"file", "XXH3"}}}, "files");
    for (const LogFile& file : files)
        table.row({cat("<code>", escaped(file.path), "</code>"), cat("<code>", escaped(file.hash), "</code>")});
    return table.text();
}

std::string foldedFiles(const std::vector<LogFile>& files) {
    if (files.empty()) return {};
    return cat("<details><summary>", counted(files.size(), "file"), " with hashes</summary>\n", fileTable(files),
               "</details>\n");
}

Expected<void> checkReportFolder(const std::filesystem::path& folder, std::span<const char* const> names,
                                 bool overwrite) {
    std::error_code ignored;
    if (std::filesystem::is_directory(folder, ignored)) {
        for (const char* const name : names)
            if (auto writable = checkWritable(folder / name, overwrite); !writable) return writable;
        return {};
    }
    // It will be made within the nearest folder that is there.
    std::filesystem::path within = std::filesystem::absolute(folder, ignored).lexically_normal(), inside;
    while (within.has_relative_path() && !std::filesystem::exists(within, ignored)) {
        inside = within;
        within = within.parent_path();
    }
    if (!std::filesystem::is_directory(within, ignored))
        return fail(folder.string(), cat("cannot be made: ", within.string(), " is no folder"));
    if (const auto writable = checkWritable(inside); !writable) return fail(folder.string(), writable.error().cause);
    return {};
}

Expected<void> writeReportFiles(const std::filesystem::path& folder, std::vector<NamedFile> files) {
    const auto made = MadeFolder::make(folder);
    if (!made) return tl::unexpected(made.error());
    for (NamedFile& file : files) file.path = folder / file.path;
    return writeFilesAtomically(files);
}

}  // namespace mrose

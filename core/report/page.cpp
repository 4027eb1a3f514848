#include "report/page.h"

#include "drawing/markup.h"
#include "io/format.h"
#include "io/made_folder.h"
#include "report/page_style.h"

namespace mrose {
namespace {

std::string tile(std::string_view label, std::string_view value, std::string_view unit, std::string_view more) {
    return element("div", "tile",
                   cat("<div class=\"name\">", label, "</div><div class=\"value\">", value, " <small>", unit,
                       "</small></div><div class=\"more\">", more, "</div>"));
}

std::string intervalText(const Interval& interval, std::size_t windows) {
    if (windows < leastForInterval) return cat("of ", std::to_string(windows), ": too few for an interval");
    return cat("95\u00a0% interval ", fixed(interval.low, 2), "–", percentText(interval.high));
}

std::string percentilesText(const Distribution& d, double unit, std::string_view unitText) {
    if (d.count < leastForPercentile)
        return cat("mean ", fixed(unit * d.mean, 1), unitText, ", of ", std::to_string(d.count));
    return cat("mean ", fixed(unit * d.mean, 1), ", 90th percentile ", p90Text(d, unit, 1), unitText);
}

}  // namespace

std::string reportPage(std::string_view title, std::string_view body) {
    return cat("<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"/>\n",
               "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n<title>", title,
               "</title>\n<style>", reportStyle, "</style></head>\n<body><main>\n", body, "</main></body></html>\n");
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

std::string p90Text(const Distribution& d, double unit, int decimals) {
    return d.count < leastForPercentile ? "" : fixed(unit * d.p90, decimals);
}

std::string percentText(double value) { return cat(fixed(value, 2), "\u00a0%"); }

std::string tiles(const Summary& s) {
    return element("div", "tiles",
                   cat(tile("P: position error over path", fixed(s.p, 2), "%", intervalText(s.p95, s.windows)),
                       tile("Hd: heading error over rotation", fixed(s.hd, 2), "%", intervalText(s.hd95, s.windows)),
                       tile("position at the end, median", fixed(100 * s.positionFinal.median, 1), "cm",
                            percentilesText(s.positionFinal, 100, " cm")),
                       tile("heading at the end, median", cat(fixed(degrees * s.headingFinal.median, 1), "°"), "",
                            percentilesText(s.headingFinal, degrees, "°"))));
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

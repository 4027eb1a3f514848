#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace mrose {

/// All parts one after another; each is something a string_view can be made from.
template <class... Parts>
std::string cat(const Parts&... parts) {
    std::string text;
    (text.append(std::string_view(parts)), ...);
    return text;
}

/// Text for HTML and SVG, also within attributes: markup characters escaped, control characters and bytes that are no
/// UTF-8 replaced.
std::string escaped(std::string_view text);

/// <tag class="...">content</tag>; the content is markup.
std::string element(std::string_view tag, std::string_view cssClass, std::string_view content);

/// Pixels in a picture: "12.50"; 0 of what is not finite.
std::string px(double pixels);

/// A table with a header row. Cells are markup; the first column is a row header, the others are numbers aligned right
/// unless said otherwise.
class HtmlTable {
public:
    explicit HtmlTable(std::vector<std::string> header, std::string cssClass = {});

    /// Columns under one heading: its markup and how many they are; to be called for all columns in order.
    void group(std::string_view content, std::size_t columns);
    void part(std::string_view content);  ///< a row that heads those below it
    void row(const std::vector<std::string>& cells, std::string_view cssClass = {});
    std::string text() const;

private:
    std::vector<std::string> header_;
    std::string cssClass_, groups_, rows_;
};

}  // namespace mrose

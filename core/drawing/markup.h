#pragma once

#include <initializer_list>
#include <string>
#include <string_view>

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

/// Pixels in a picture: "12.50"; 0 of what is not finite.
std::string px(double pixels);

/// Attributes of an element, in order. Text is escaped, numbers are pixels.
class Attributes {
public:
    struct Attribute {
        Attribute(std::string_view name, std::string_view value);
        Attribute(std::string_view name, const char* value) : Attribute(name, std::string_view(value)) {}
        Attribute(std::string_view name, double pixels);
        std::string markup;
    };
    Attributes(std::initializer_list<Attribute> attributes = {}) {
        for (const Attribute& attribute : attributes) markup_ += attribute.markup;
    }
    Attributes& operator+=(const Attributes& more) {
        markup_ += more.markup_;
        return *this;
    }
    friend Attributes operator+(Attributes first, const Attributes& second) { return first += second; }
    const std::string& markup() const { return markup_; }

private:
    std::string markup_;
};

/// <tag ...>content</tag>, the content markup; <tag .../> where it is empty.
std::string element(std::string_view tag, const Attributes& attributes, std::string_view content = {});

}  // namespace mrose

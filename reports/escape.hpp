// Makes names from outside safe to print in HTML, XML, Markdown and on a terminal.
#pragma once

#include <string>
#include <string_view>

namespace broadside::reports {

// Valid UTF-8 on one line: bytes that are not UTF-8, control characters (a terminal would obey them), and U+FFFE and
// U+FFFF (XML forbids them) become U+FFFD; line breaks and tabs become spaces.
std::string printable(std::string_view text);

// For element content and for attribute values in double or single quotes. Both include printable().
std::string html(std::string_view text);
std::string xml(std::string_view text);

// For running text and table cells of GitHub-flavored Markdown: no markup, no raw HTML, no mention of an account, no
// link that was not asked for. Includes printable().
std::string markdown(std::string_view text);

// Code points, which is what a terminal's columns count for the names that occur here. The text is printable().
std::size_t width(std::string_view text);
// At most `columns` wide, the last one an ellipsis where something was cut.
std::string clipped(std::string_view text, std::size_t columns);

}  // namespace broadside::reports

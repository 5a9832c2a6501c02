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
// automatic link. Includes printable().
std::string markdown(std::string_view text);

// The number of code points: the columns that a terminal uses for names as they occur here. The text is printable().
std::size_t width(std::string_view text);
// The text, at most `columns` wide; where something was cut, the last column is an ellipsis.
std::string clipped(std::string_view text, std::size_t columns);

}  // namespace broadside::reports

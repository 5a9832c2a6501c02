// A small checker of markup: tags balance, attributes are quoted and occur once, every '<' and '&' means something.
#pragma once

#include <cctype>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace broadside::reports::testing_markup {

struct Element {
  std::string name;
  std::map<std::string, std::string> attributes;  // as written, entities and all
  std::string parent;
};

struct Markup {
  std::string problem;  // empty = well-formed
  std::vector<Element> elements;

  [[nodiscard]] std::size_t count(std::string_view name) const {
    std::size_t n = 0;
    for (const Element& e : elements) n += e.name == name ? 1U : 0U;
    return n;
  }
};

// For HTML, elements that have no end tag and those whose content is raw text are known by name.
inline Markup check_markup(std::string_view text, bool is_html) {
  static const std::set<std::string, std::less<>> kVoid{"meta", "link", "br", "img", "input", "hr", "wbr"};
  static const std::set<std::string, std::less<>> kRaw{"style", "script"};
  Markup markup;
  std::vector<std::string> open;
  const auto fail = [&](const std::string& what, std::size_t at) {
    if (markup.problem.empty()) markup.problem = what + " near: " + std::string(text.substr(at, 80));
    return markup;
  };
  const auto is_name = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '_' || c == ':';
  };
  std::size_t at = 0;
  while (at < text.size()) {
    if (text[at] == '&') {
      const std::size_t end = text.find(';', at);
      if (end == std::string_view::npos || end - at > 8) return fail("a bare ampersand", at);
    }
    if (text[at] == '>') return fail("a bare '>'", at);
    if (text[at] != '<') {
      ++at;
      continue;
    }
    if (text.substr(at, 2) == "<?" || text.substr(at, 2) == "<!") {
      at = text.find('>', at) + 1;
      if (at == 0) return fail("an unfinished declaration", 0);
      continue;
    }
    const std::size_t start = at++;
    const bool is_end = at < text.size() && text[at] == '/';
    if (is_end) ++at;
    std::string name;
    while (at < text.size() && is_name(text[at])) name += text[at++];
    if (name.empty()) return fail("a bare '<'", start);
    if (is_end) {
      if (at >= text.size() || text[at] != '>') return fail("an end tag with more in it", start);
      if (open.empty() || open.back() != name)
        return fail("</" + name + "> closes <" + (open.empty() ? "" : open.back()) + ">", start);
      open.pop_back();
      ++at;
      continue;
    }
    Element element{name, {}, open.empty() ? "" : open.back()};
    bool is_closed = false;
    for (;;) {
      while (at < text.size() && std::isspace(static_cast<unsigned char>(text[at])) != 0) ++at;
      if (at >= text.size()) return fail("an unfinished tag", start);
      if (text[at] == '>') break;
      if (text.substr(at, 2) == "/>") {
        is_closed = true;
        ++at;
        break;
      }
      std::string key;
      while (at < text.size() && is_name(text[at])) key += text[at++];
      if (key.empty()) return fail("something that is no attribute", at);
      std::string value;
      if (at < text.size() && text[at] == '=') {
        if (++at >= text.size() || text[at] != '"') return fail("an unquoted attribute", at);
        const std::size_t end = text.find('"', ++at);
        if (end == std::string_view::npos) return fail("an unfinished attribute", at);
        value = text.substr(at, end - at);
        if (value.find('<') != std::string::npos) return fail("a '<' in an attribute", at);
        at = end + 1;
      } else if (!is_html) {
        return fail("an attribute without a value", at);
      }
      if (!element.attributes.emplace(key, value).second) return fail("attribute " + key + " twice", at);
    }
    ++at;
    markup.elements.push_back(std::move(element));
    if (is_html && kRaw.contains(name)) {
      const std::size_t end = text.find("</" + name + ">", at);
      if (end == std::string_view::npos) return fail("an unfinished " + name, start);
      at = end + name.size() + 3;
      continue;
    }
    if (!is_closed && !(is_html && kVoid.contains(name))) open.push_back(name);
  }
  if (!open.empty()) return fail("<" + open.back() + "> is never closed", 0);
  return markup;
}

}  // namespace broadside::reports::testing_markup

#include "reports/plots/plot_style.hpp"

#include <array>
#include <string_view>

namespace broadside::reports::plots {
namespace {

struct Color {
  std::string_view name;
  std::string_view light;
  std::string_view dark;
};

// The colors of reports/page/report.css; a test checks that both are equal.
constexpr std::array<Color, 13> kColors{{
    {"paper", "#ffffff", "#10161c"},
    {"ink", "#17202a", "#e4eaf0"},
    {"soft", "#586673", "#a3b0bc"},
    {"line", "#dfe5ea", "#2b3640"},
    {"fail", "#b3201c", "#e5534b"},
    {"s0", "#2f5d8c", "#5a92c9"},
    {"s1", "#7ba3c7", "#a9c9e6"},
    {"s2", "#d9902f", "#e3a557"},
    {"s3", "#3f8f78", "#4fae92"},
    {"s4", "#8fbf9f", "#a7d4b5"},
    {"s5", "#9c4f6d", "#cc7d9c"},
    {"s6", "#8577b3", "#a79bd6"},
    {"s7", "#a08a5b", "#c4ae7f"},
}};

enum class Shade { kVariable, kLight, kDark };

std::string color(std::string_view name, Shade shade) {
  if (shade == Shade::kVariable) return "var(--" + std::string(name) + ")";
  for (const Color& c : kColors)
    if (c.name == name) return std::string(shade == Shade::kLight ? c.light : c.dark);
  return "currentColor";
}

std::string rule(std::string_view selector, std::string_view property, std::string_view name, Shade shade) {
  return ".plot ." + std::string(selector) + "{" + std::string(property) + ":" + color(name, shade) + "}\n";
}

std::string colored(Shade shade) {
  std::string css;
  for (int k = 0; k < kSeriesColors; ++k) {
    const std::string n = std::to_string(k);
    css += rule("s" + n, "fill", "s" + n, shade) + rule("l" + n, "stroke", "s" + n, shade) +
           rule("b" + n, "fill", "s" + n, shade);
  }
  css += rule("grid", "stroke", "line", shade) + rule("frame", "stroke", "soft", shade) +
         rule("whisker", "stroke", "ink", shade) + rule("across", "stroke", "ink", shade) +
         rule("across-name", "fill", "ink", shade) + rule("across-name", "stroke", "paper", shade) +
         rule("model-box", "stroke", "fail", shade) + rule("paper", "fill", "paper", shade) +
         rule("hollow", "fill", "paper", shade);
  for (const std::string_view text : {"tick", "name"}) css += rule(text, "fill", "soft", shade);
  for (const std::string_view text : {"heading", "value"}) css += rule(text, "fill", "ink", shade);
  return css + rule("on-full", "fill", "paper", shade);
}

constexpr std::string_view kShapes =
    ".plot{max-width:100%;height:auto}\n"
    ".plot text{font:11px system-ui,-apple-system,\"Segoe UI\",Roboto,\"Liberation Sans\",sans-serif}\n"
    ".plot .heading{font-size:13px;font-weight:650}\n"
    ".plot .grid,.plot .frame,.plot .whisker{stroke-width:1;fill:none}\n"
    ".plot .curve{fill:none;stroke-width:1.75;stroke-linejoin:round}\n"
    ".plot .fitted{fill:none;stroke-width:1.25;stroke-dasharray:5 4}\n"
    ".plot .band{opacity:.2}\n"
    ".plot .across{stroke-width:1;stroke-dasharray:4 3;fill:none}\n"
    ".plot .across-name{stroke-width:3;paint-order:stroke;stroke-linejoin:round}\n"
    ".plot .model-box{fill:none;stroke-width:.9;stroke-linejoin:round}\n"
    ".plot .model-box.behind{stroke-width:.6;opacity:.45}\n";

}  // namespace

std::string plot_style() {
  return std::string(kShapes) + colored(Shade::kVariable);
}

std::string file_style() {
  return std::string(kShapes) + colored(Shade::kLight) + "@media (prefers-color-scheme:dark){\n" +
         colored(Shade::kDark) + "}\n";
}

}  // namespace broadside::reports::plots

// SCHEMA.md lists exactly what is in a trace: nothing more, nothing less.
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <set>
#include <sstream>

#include "core/trace/trace_writer.hpp"
#include "tests/core/trace/random_frames.hpp"
#include "tests/core/trace/raw_file.hpp"

namespace broadside::tests {
namespace {

using namespace core;

struct Row {
  std::string shape;  // "[F, n, 3]"
  std::string type;
  std::string unit;
};

std::string trimmed(std::string text) {
  const auto is_mark = [](char c) { return c == ' ' || c == '`'; };
  while (!text.empty() && is_mark(text.front())) text.erase(0, 1);
  while (!text.empty() && is_mark(text.back())) text.pop_back();
  return text;
}

// Path -> row of the page's one large table.
std::map<std::string, Row> documented() {
  std::ifstream page(BROADSIDE_SOURCE_DIR "/core/trace/SCHEMA.md");
  EXPECT_TRUE(page.good());
  std::map<std::string, Row> rows;
  for (std::string line; std::getline(page, line);) {
    if (line.rfind("| `/", 0) != 0) continue;
    std::vector<std::string> cells;
    std::istringstream cell_text(line);
    for (std::string cell; std::getline(cell_text, cell, '|');) cells.push_back(trimmed(cell));
    EXPECT_EQ(cells.size(), 7U) << line;
    EXPECT_TRUE(cells[5] == "1" || cells[5] == "2") << "since: " << line;
    EXPECT_FALSE(cells[6].empty()) << "meaning: " << line;
    EXPECT_TRUE(rows.emplace(cells[1], Row{cells[2], cells[3], cells[4]}).second) << "twice: " << line;
  }
  return rows;
}

// The page's sizes, all different in this trace, so that a wrong letter shows.
struct Sizes {
  std::map<std::string, std::uint64_t> of;

  [[nodiscard]] std::string shape(const std::string& symbols) const {
    std::string numbers;
    std::istringstream text(symbols.substr(1, symbols.size() - 2));
    for (std::string symbol; std::getline(text, symbol, ',');) {
      symbol = trimmed(symbol);
      const auto known = of.find(symbol);
      numbers += (known == of.end() ? symbol : std::to_string(known->second)) + " ";
    }
    return numbers;
  }
};

Sizes write_trace(const std::filesystem::path& path) {
  Scene scene = tetrahedra_scene(13);
  scene.mass_properties.assign(13, {{}, {1, 1, 1, 0, 0, 0}});
  scene.is_fast.assign(13, 1);
  auto writer = TraceWriter::create(path, header_of(scene, kAllGroups));
  EXPECT_TRUE(writer.ok());
  Bits bits(3);
  std::uint64_t p = 0, c = 0, x = 0, k = 0, s = 0, o = 0, b = 0, u = 0, l = 0, t = 0, z = 0;
  for (std::uint64_t step = 0; step < 250; ++step) {
    const FrameRecord f = random_frame(bits, step, 13, kAllGroups);
    p += f.pairs.size();
    c += f.confirmed.size();
    x += f.proximity.size();
    k += f.contacts.size();
    s += f.measured.size();
    o += f.octree_nodes.size();
    t += f.points.size();
    z += f.part_poses.size();
    b += f.shape_of_body.size();
    u += f.body_octree_boxes.size();
    l += f.leaf_of_vertex.size();
    EXPECT_TRUE(writer.value().append(f).ok());
  }
  EXPECT_TRUE(writer.value().finish().ok());
  // Two meshes of 4 and 5 vertices and 4 triangles each; 250 steps are three windows.
  Sizes sizes{{{"F", 250},  {"F+1", 251}, {"n", 13},     {"M", 2},        {"M+1", 3}, {"V", 9}, {"T", 8},
               {"W", 3},    {"P", p},     {"C", c},      {"X", x},        {"K", k},   {"S", s}, {"O", o},
               {"B", b},    {"U", u},     {"L", l},      {"N", t},        {"Z", z},   {"Q", 4}, {"H", 5},
               {"n+1", 14}, {"8n", 104},  {"F n", 3250}, {"8 F n", 26000}}};
  std::set<std::uint64_t> distinct;
  for (const auto& [name, value] : sizes.of)
    EXPECT_TRUE(name == "M+1" || distinct.insert(value).second) << name << " is as large as another size";
  return sizes;
}

std::string numbers(const std::vector<std::uint64_t>& shape) {
  std::string text;
  for (const std::uint64_t d : shape) text += std::to_string(d) + " ";
  return text;
}

TEST(Schema, ThePageAndAFileSayTheSame) {
  const Folder folder;
  const Sizes sizes = write_trace(folder / "t.h5");
  std::map<std::string, Row> rows = documented();
  std::set<std::string> seen;
  for (const RawItem& item : raw_items(folder / "t.h5")) {
    std::string path = item.path;
    for (const std::string group : {"/provenance/notes@", "/declaration@"})
      if (item.path.rfind(group, 0) == 0) path = group + "*";
    seen.insert(path);
    ASSERT_TRUE(rows.contains(path)) << path << " is in the file and not in SCHEMA.md";
    const Row& row = rows[path];
    EXPECT_EQ(sizes.shape(row.shape), numbers(item.shape)) << path;
    EXPECT_EQ(row.type, item.type) << path;
    EXPECT_TRUE(path.find('@') != std::string::npos || row.unit == item.unit) << path << ": " << item.unit;
  }
  for (const auto& [path, row] : rows)
    EXPECT_TRUE(seen.contains(path)) << path << " is in SCHEMA.md and not in the file";
}

TEST(Schema, GroupsThatAreNotRecordedAreNotInTheFile) {
  const Folder folder;
  auto writer = TraceWriter::create(folder / "t.h5", header_of(tetrahedra_scene(2), bit(Group::kPairs)));
  ASSERT_TRUE(writer.ok());
  ASSERT_TRUE(writer.value().finish().ok());
  std::set<std::string> groups;
  for (const RawItem& item : raw_items(folder / "t.h5"))
    if (item.path.rfind("/trace/", 0) == 0) groups.insert(item.path.substr(7, item.path.find('/', 7) - 7));
  EXPECT_EQ(groups, (std::set<std::string>{"digest", "pairs", "step", "time"}));
}

}  // namespace
}  // namespace broadside::tests

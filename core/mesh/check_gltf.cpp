#include "core/mesh/check_gltf.hpp"

#include <initializer_list>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "core/json_depth.hpp"
#include "core/mesh/gltf_file.hpp"
#include "core/mesh/gltf_nodes.hpp"
#include "core/mesh/regular_files.hpp"

namespace broadside::core {
namespace {

using Json = nlohmann::json;

// Offsets and lengths beyond this are refused. Sums and products of smaller ones do not overflow.
constexpr std::uint64_t kLargestNumber = std::uint64_t{1} << 40U;
constexpr std::uint64_t kLargestStride = 1U << 16U;

// The array with this name; empty where there is none.
const Json& list_of(const Json& document, const char* name) {
  static const Json kNone = Json::array();
  const auto found = document.find(name);
  return found == document.end() || !found->is_array() ? kNone : *found;
}

// A whole number up to kLargestNumber, or `missing` when the key is absent; nothing when the value is something else.
std::optional<std::uint64_t> whole(const Json& object, const char* key, std::optional<std::uint64_t> missing) {
  if (!object.is_object()) return std::nullopt;
  const auto found = object.find(key);
  if (found == object.end()) return missing;
  if (!found->is_number_unsigned() || found->get<std::uint64_t>() > kLargestNumber) return std::nullopt;
  return found->get<std::uint64_t>();
}

Json only(const Json& object, std::initializer_list<const char*> keys) {
  Json kept = Json::object();
  if (!object.is_object()) return kept;
  for (const char* key : keys)
    if (const auto found = object.find(key); found != object.end()) kept[key] = *found;
  return kept;
}

class GltfCheck {
 public:
  GltfCheck(const std::filesystem::path& path, const Json& document, const GltfFile& file)
      : path_(path), document_(document), file_(file) {}

  Status run() {
    if (Status s = check_version(); !s) return s;
    if (std::string wrong = wrong_with_nodes(document_, kDeepestGltfNode); !wrong.empty()) return bad(wrong);
    const Json& meshes = list_of(document_, "meshes");
    for (std::size_t m = 0; m < meshes.size(); ++m)
      if (Status s = check_mesh(meshes[m], m); !s) return s;
    return check_amount();
  }

  [[nodiscard]] std::string kept() const {
    Json kept = only(document_, {"scene", "buffers"});
    kept["asset"] = {{"version", "2.0"}};
    keep("scenes", {"name", "nodes"}, kept);
    keep("nodes", {"name", "children", "mesh", "matrix", "translation", "rotation", "scale"}, kept);
    keep("accessors", {"bufferView", "byteOffset", "componentType", "count", "type", "normalized"}, kept);
    keep("bufferViews", {"buffer", "byteOffset", "byteLength", "byteStride"}, kept);
    keep("buffers", {"byteLength", "uri"}, kept);
    keep("meshes", {"name", "primitives"}, kept);
    for (Json& mesh : kept["meshes"])
      for (Json& primitive : mesh["primitives"]) {
        const Json attributes = only(primitive["attributes"], {"POSITION"});
        primitive = only(primitive, {"indices", "mode"});
        primitive["attributes"] = attributes;
      }
    return kept.dump();
  }

 private:
  [[nodiscard]] Error bad(const std::string& what) const {
    return {"not a readable mesh: " + what, path_.string(), "check that the file is whole"};
  }
  [[nodiscard]] Error too_much(const std::string& what, const char* advice) const {
    return {what, path_.string(), advice};
  }

  void keep(const char* name, std::initializer_list<const char*> keys, Json& kept) const {
    Json list = Json::array();
    for (const Json& object : list_of(document_, name)) list.push_back(only(object, keys));
    kept[name] = std::move(list);
  }

  [[nodiscard]] Status check_version() const {
    const auto asset = document_.find("asset");
    const bool has_version = asset != document_.end() && asset->is_object() && asset->contains("version") &&
                             asset->at("version").is_string();
    if (!has_version) return bad("it does not say which version of glTF it has");
    const std::string version = asset->at("version");
    if (!version.starts_with("2.")) return bad("it has a version of glTF other than 2, the one that is read here");
    return Done{};
  }

  Status check_mesh(const Json& mesh, std::size_t number) {
    std::uint64_t elements = 0;
    for (const Json& primitive : list_of(mesh, "primitives")) {
      const std::string where = "mesh " + std::to_string(number);
      if (!primitive.is_object()) return bad(where + " has a primitive that is no object");
      const auto attributes = primitive.find("attributes");
      const auto position = attributes == primitive.end() ? std::nullopt : whole(*attributes, "POSITION", {});
      if (!position) return bad(where + " has a primitive without positions");
      if (Status s = check_accessor(*position, Use::kPosition, elements); !s) return s;
      if (!primitive.contains("indices")) continue;
      const auto indices = whole(primitive, "indices", {});
      if (!indices) return bad(where + " has indices that are no accessor's number");
      if (Status s = check_accessor(*indices, Use::kIndex, elements); !s) return s;
    }
    elements_of_mesh_.push_back(elements);
    return Done{};
  }

  enum class Use { kPosition, kIndex };

  // Bytes of an element; 0 when it has another type.
  static std::uint64_t bytes_of(const Json& accessor, Use use) {
    const auto type = accessor.find("type");
    const auto component = whole(accessor, "componentType", {});
    if (type == accessor.end() || !type->is_string() || !component) return 0;
    if (use == Use::kPosition) return *type == "VEC3" && *component == 5126 ? 12 : 0;
    if (*type != "SCALAR") return 0;
    return *component == 5121 ? 1 : *component == 5123 ? 2 : *component == 5125 ? 4 : 0;
  }

  Status check_accessor(std::uint64_t number, Use use, std::uint64_t& elements) {
    const std::string where = "accessor " + std::to_string(number);
    const Json& accessors = list_of(document_, "accessors");
    if (number >= accessors.size()) return bad(where + " does not exist");
    const Json& accessor = accessors[number];
    const auto count = whole(accessor, "count", {});
    const auto start = whole(accessor, "byteOffset", 0);
    if (!count || !start || *count == 0) return bad(where + " has no count, or an offset that is no number");
    if (accessor.contains("sparse") || !accessor.contains("bufferView"))
      return too_much(where + " is sparse or compressed, which is not read here", "write its values out plainly");
    const std::uint64_t size = bytes_of(accessor, use);
    if (size == 0)
      return too_much(where + (use == Use::kPosition ? " holds positions that are not three floats each"
                                                     : " holds indices that are not unsigned whole numbers"),
                      "write the mesh without quantization");
    elements += *count;
    if (elements > kMostGltfElements) return too_many(elements);
    const auto view = whole(accessor, "bufferView", {});
    if (!view) return bad(where + " has a bufferView that is no number");
    return check_range(where, *view, *start, *count, size);
  }

  Status check_range(const std::string& where, std::uint64_t number, std::uint64_t start, std::uint64_t count,
                     std::uint64_t size) {
    const Json& views = list_of(document_, "bufferViews");
    if (number >= views.size())
      return bad(where + " names bufferView " + std::to_string(number) + ", which does not exist");
    const Json& view = views[number];
    const auto offset = whole(view, "byteOffset", 0);
    const auto length = whole(view, "byteLength", {});
    const auto stride = whole(view, "byteStride", size);
    const auto buffer = whole(view, "buffer", {});
    if (!offset || !length || !stride || !buffer || *stride > kLargestStride || *stride < size)
      return bad("bufferView " + std::to_string(number) + " has an offset, length or stride that is no proper number");
    if (start + *stride * (count - 1) + size > *length) return bad(where + " ends outside its bufferView");
    const Json& buffers = list_of(document_, "buffers");
    if (*buffer >= buffers.size()) return bad("buffer " + std::to_string(*buffer) + " does not exist");
    const auto bytes = whole(buffers[*buffer], "byteLength", {});
    if (!bytes || *offset + *length > *bytes)
      return bad("bufferView " + std::to_string(number) + " ends outside its buffer");
    return check_buffer(buffers[*buffer], *buffer, *bytes);
  }

  Status check_buffer(const Json& buffer, std::uint64_t number, std::uint64_t bytes) {
    const std::string where = "buffer " + std::to_string(number);
    if (!buffer.contains("uri")) {
      const bool is_body = file_.is_binary && number == 0 && bytes <= file_.body.size();
      return is_body ? Status(Done{}) : Status(bad(where + " has no uri, or is longer than the file's body"));
    }
    if (!buffer.at("uri").is_string()) return bad(where + " has a uri that is no text");
    const std::string& uri = buffer.at("uri").get_ref<const std::string&>();
    if (uri.starts_with("data:")) return Done{};
    const std::filesystem::path named = path_.parent_path() / uri;
    std::error_code failed;
    if (!is_regular_and_bounded(named) || std::filesystem::file_size(named, failed) < bytes || failed)
      return Error{
          where + " names '" + printable(uri) + "', which is no regular file of " + std::to_string(bytes) + " bytes",
          path_.string(), "put the buffer's file beside it"};
    return Done{};
  }

  // The path for assimp and the line of an error must not contain control characters.
  static std::string printable(std::string text) {
    if (text.size() > 200) text.resize(200);
    for (char& c : text)
      if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) c = '?';
    return text;
  }

  Status check_amount() {
    std::uint64_t shown = 0;
    for (const Json& node : list_of(document_, "nodes")) {
      if (!node.contains("mesh")) continue;
      const auto mesh = whole(node, "mesh", {});
      if (!mesh || *mesh >= elements_of_mesh_.size()) return bad("a node shows a mesh that does not exist");
      shown += elements_of_mesh_[*mesh];
      if (shown > kMostGltfElements) return too_many(shown);
    }
    return Done{};
  }

  [[nodiscard]] Error too_many(std::uint64_t count) const {
    return too_much("its nodes show " + std::to_string(count) + " corners and indices or more, and " +
                        std::to_string(kMostGltfElements) + " are the most that are read",
                    "decimate it first, or show fewer copies");
  }

  const std::filesystem::path& path_;
  const Json& document_;
  const GltfFile& file_;
  std::vector<std::uint64_t> elements_of_mesh_;
};

}  // namespace

Result<std::string> checked_gltf(const std::filesystem::path& path, bool is_binary) {
  const auto bad = [&](const std::string& what) {
    return Error{"not a readable mesh: " + what, path.string(), "check that the file is whole"};
  };
  GltfFile file;
  if (Status s = read_gltf_file(path, is_binary, file); !s) return s.error();
  if (const std::size_t depth = json_depth(file.json); depth > kDeepestGltfJson)
    return bad("its JSON nests " + std::to_string(depth) + " levels deep, and " + std::to_string(kDeepestGltfJson) +
               " are the most that are read");
  const Json document = Json::parse(file.json.begin(), file.json.end(), nullptr, false);
  if (document.is_discarded() || !document.is_object()) return bad("its text is not a JSON object");
  GltfCheck check(path, document, file);
  if (Status s = check.run(); !s) return s.error();
  return with_json(file, check.kept());
}

}  // namespace broadside::core

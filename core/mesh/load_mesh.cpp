#include "core/mesh/load_mesh.hpp"

#include <assimp/BaseImporter.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <array>
#include <assimp/IOSystem.hpp>
#include <assimp/Importer.hpp>
#include <cctype>
#include <cmath>
#include <exception>
#include <fstream>
#include <map>
#include <new>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "core/mesh/check_gltf.hpp"
#include "core/mesh/check_off.hpp"
#include "core/mesh/check_ply.hpp"
#include "core/mesh/placement.hpp"
#include "core/mesh/regular_files.hpp"
#include "core/nearest_name.hpp"

namespace broadside::core {
namespace {

constexpr std::array<std::string_view, 6> kFormats{".obj", ".ply", ".stl", ".off", ".gltf", ".glb"};

Error bad(const std::filesystem::path& path, std::string what, std::string advice) {
  return {std::move(what), path.string(), std::move(advice), Exit::kBadInput};
}

std::string lower_extension(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return extension;
}

Status check_file(const std::filesystem::path& path) {
  std::error_code failed;
  const auto status = std::filesystem::status(path, failed);
  if (status.type() == std::filesystem::file_type::not_found) return bad(path, "no such mesh file", "check the path");
  if (failed) return bad(path, "cannot be opened: " + failed.message(), "check the path and its permissions");
  if (status.type() != std::filesystem::file_type::regular) return bad(path, "not a file", "give a mesh file");

  const std::string extension = lower_extension(path);
  if (std::find(kFormats.begin(), kFormats.end(), extension) == kFormats.end())
    return bad(path, "unknown mesh format '" + extension + "'", advise_name(extension, kFormats));

  if (!std::ifstream(path, std::ios::binary)) return bad(path, "cannot be read", "check its permissions");
  const auto size = std::filesystem::file_size(path, failed);
  if (failed) return bad(path, "cannot be read: " + failed.message(), "check its permissions");
  if (size == 0) return bad(path, "the file is empty", "give a mesh with at least one triangle");
  if (size > kMaxMeshFileBytes)
    return bad(path, "the file has " + std::to_string(size >> 20) + " MiB, more than a mesh here may (2048 MiB)",
               "decimate it first");
  if (extension == ".ply") return check_ply(path);
  if (extension == ".off") return check_off(path);
  return Done{};
}

// assimp's messages may span several lines; an error here is one line.
std::string one_line(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return std::iscntrl(c) != 0; }, ' ');
  while (!text.empty() && text.back() == ' ') text.pop_back();
  return text;
}

bool is_finite(const aiVector3D& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

// Called before any post-processing: spatial sorting of NaN is undefined.
Status check_vertices(const std::filesystem::path& path, const aiScene& scene) {
  std::uint64_t count = 0;
  for (unsigned m = 0; m < scene.mNumMeshes; ++m) {
    const aiMesh& part = *scene.mMeshes[m];
    for (unsigned v = 0; v < part.mNumVertices; ++v)
      if (!is_finite(part.mVertices[v]))
        return bad(path, "vertex " + std::to_string(count + v) + " is NaN or infinite", "repair the mesh file");
    count += part.mNumVertices;
  }
  if (count == 0) return bad(path, "the mesh is empty: it has no vertices", "give a mesh with at least one triangle");
  return Done{};
}

void append(const aiMesh& part, Mesh& mesh) {
  const auto base = static_cast<std::uint32_t>(mesh.vertices.size());
  for (unsigned v = 0; v < part.mNumVertices; ++v)
    mesh.vertices.push_back({part.mVertices[v].x, part.mVertices[v].y, part.mVertices[v].z});
  for (unsigned f = 0; f < part.mNumFaces; ++f) {
    const aiFace& face = part.mFaces[f];
    if (face.mNumIndices != 3) continue;  // points and lines
    mesh.triangles.push_back({base + face.mIndices[0], base + face.mIndices[1], base + face.mIndices[2]});
  }
}

Mesh gathered(const aiScene& scene) {
  Mesh mesh;
  for (unsigned m = 0; m < scene.mNumMeshes; ++m) append(*scene.mMeshes[m], mesh);
  return mesh;
}

// When assimp joins vertices it drops those that no face uses; this counts them.
std::uint64_t unreferenced_count(const aiScene& scene) {
  std::uint64_t count = 0;
  for (unsigned m = 0; m < scene.mNumMeshes; ++m) {
    const aiMesh& part = *scene.mMeshes[m];
    std::vector<bool> is_named(part.mNumVertices, false);
    for (unsigned f = 0; f < part.mNumFaces; ++f)
      for (unsigned k = 0; k < part.mFaces[f].mNumIndices; ++k) is_named[part.mFaces[f].mIndices[k]] = true;
    count += static_cast<std::uint64_t>(std::count(is_named.begin(), is_named.end(), false));
  }
  return count;
}

// assimp triangulates a polygon by searching all of its corners for one ear after another. Where there are few ears, as
// in a spiral, this takes time proportional to the cube of the corners (4,000 corners: 6 s). Limits of the corners of
// one face, and of the sum of their cubes over faces of more than four corners: about 5 s.
constexpr std::uint64_t kMostPolygonCorners = 3'600;
constexpr std::uint64_t kMostPolygonWork = 50'000'000'000;

Status check_polygon(const std::filesystem::path& path, std::uint64_t corners, std::uint64_t& work) {
  if (corners > kMostPolygonCorners)
    return bad(path,
               "a face has " + std::to_string(corners) + " corners, and " + std::to_string(kMostPolygonCorners) +
                   " are the most that are read",
               "cut it into triangles first");
  work += corners > 4 ? corners * corners * corners : 0;
  if (work > kMostPolygonWork)
    return bad(path,
               "its polygons' corners cubed add up to more than " + std::to_string(kMostPolygonWork) +
                   ", the most that are read",
               "cut them into triangles first");
  return Done{};
}

// Called before assimp's post-processing: joining uses vertex indices unchecked, triangulation aborts on a face without
// corners, and a scene of points alone fails without a clear message.
Status check_faces(const std::filesystem::path& path, const aiScene& scene) {
  bool has_area = false;
  std::uint64_t polygon_work = 0;
  for (unsigned m = 0; m < scene.mNumMeshes; ++m) {
    const aiMesh& part = *scene.mMeshes[m];
    for (unsigned f = 0; f < part.mNumFaces; ++f) {
      const aiFace& face = part.mFaces[f];
      if (face.mNumIndices == 0)
        return bad(path, "face " + std::to_string(f) + " has no corners", "repair the mesh file");
      has_area = has_area || face.mNumIndices >= 3;
      if (Status s = check_polygon(path, face.mNumIndices, polygon_work); !s) return s;
      for (unsigned k = 0; k < face.mNumIndices; ++k)
        if (face.mIndices[k] >= part.mNumVertices)
          return bad(path, "a face names vertex " + std::to_string(face.mIndices[k]) + ", which does not exist",
                     "repair the mesh file");
    }
  }
  if (!has_area) return bad(path, "the mesh has no triangles", "give a mesh with at least one triangle");
  return Done{};
}

Matrix product(const Matrix& p, const aiMatrix4x4& q) {
  Matrix m;
  for (unsigned r = 0; r < 3; ++r)
    for (unsigned c = 0; c < 4; ++c)
      m[r][c] = p[r][0] * q[0][c] + p[r][1] * q[1][c] + p[r][2] * q[2][c] + (c == 3 ? p[r][3] : 0.0);
  return m;
}

class NodeGatherer {
 public:
  NodeGatherer(const std::filesystem::path& path, const aiScene& scene) : path_(path), scene_(scene) {}

  // Visits parents before their children, in the file's order. Without recursion, because the file determines how deep
  // nodes nest.
  Status walk(const aiNode& root) {
    std::vector<std::pair<const aiNode*, Matrix>> waiting{{&root, kIdentity}};
    while (!waiting.empty()) {
      const auto [node, parent] = waiting.back();
      waiting.pop_back();
      const Matrix here = product(parent, node->mTransformation);
      if (node->mNumMeshes > 0)
        if (Status s = add(*node, here); !s) return s;
      for (unsigned k = node->mNumChildren; k-- > 0;) waiting.emplace_back(node->mChildren[k], here);
    }
    return Done{};
  }
  LoadedNodes nodes() && { return std::move(loaded_); }

 private:
  static constexpr std::uint32_t kNoMesh = 0xFFFFFFFFU;  // for nodes that show points and lines, and so no triangle
  using Key = std::pair<std::vector<unsigned>, Matrix>;

  Status add(const aiNode& node, const Matrix& here) {
    const std::string name = one_line(node.mName.C_Str());
    const std::optional<Placement> place = taken_apart(here);
    if (!place || !std::isfinite(length(place->position)))
      return bad(path_, "node '" + name + "' has a transform that is not finite or flattens it", "repair the file");
    const Key key{{node.mMeshes, node.mMeshes + node.mNumMeshes}, place->rest};
    const auto [entry, is_new] = known_.try_emplace(key, 0U);
    if (is_new) {
      Mesh mesh;
      for (const unsigned m : key.first) append(*scene_.mMeshes[m], mesh);
      transform(mesh, place->rest);
      clean_mesh(mesh);
      mesh.name = one_line(scene_.mMeshes[key.first.front()]->mName.C_Str());
      entry->second = mesh.triangles.empty() ? kNoMesh : static_cast<std::uint32_t>(loaded_.meshes.size());
      if (!mesh.triangles.empty()) loaded_.meshes.push_back(std::move(mesh));
    }
    if (entry->second != kNoMesh) loaded_.nodes.push_back({name, entry->second, place->position, place->orientation});
    return Done{};
  }

  const std::filesystem::path& path_;
  const aiScene& scene_;
  LoadedNodes loaded_;
  std::map<Key, std::uint32_t> known_;
};

struct Imported {
  Mesh mesh;
  std::uint64_t unreferenced_vertices = 0;  // those that were removed from the mesh
};

constexpr unsigned kCleaning = aiProcess_RemoveComponent | aiProcess_Triangulate | aiProcess_JoinIdenticalVertices;

// When the reader for a file's extension refuses it, assimp tries its forty other readers, for which nothing above has
// checked the file. So only the reader for the extension stays registered. Of the two for glTF, only that for version 2
// stays, because the other one loads the file to find its version.
void keep_reader_of(Assimp::Importer& importer, const std::filesystem::path& path) {
  const std::string wanted = lower_extension(path).substr(1);
  for (std::size_t k = importer.GetImporterCount(); k-- > 0;) {
    Assimp::BaseImporter* reader = importer.GetImporter(k);
    std::set<std::string> extensions;
    reader->GetExtensionList(extensions);
    const bool is_old_gltf = std::string_view(reader->GetInfo()->mName) == "glTF Importer";
    if ((extensions.contains(wanted) && !is_old_gltf) || importer.UnregisterLoader(reader) != aiReturn_SUCCESS)
      continue;
    delete reader;  // UnregisterLoader gives up ownership
  }
}

// Reads the file as it is, and checks for what would make post-processing fail.
Result<const aiScene*> read_checked(Assimp::Importer& importer, const std::filesystem::path& path) {
  importer.SetPropertyInteger(AI_CONFIG_PP_RVC_FLAGS, aiComponent_NORMALS | aiComponent_TANGENTS_AND_BITANGENTS |
                                                          aiComponent_COLORS | aiComponent_TEXCOORDS |
                                                          aiComponent_BONEWEIGHTS | aiComponent_ANIMATIONS |
                                                          aiComponent_TEXTURES | aiComponent_LIGHTS |
                                                          aiComponent_CAMERAS | aiComponent_MATERIALS);
  keep_reader_of(importer, path);
  const std::string extension = lower_extension(path);
  if (extension == ".gltf" || extension == ".glb") {
    Result<std::string> content = checked_gltf(path, extension == ".glb");
    if (!content) return content.error();
    importer.SetIOHandler(regular_files(path, std::move(content).value()).release());
  } else {
    importer.SetIOHandler(regular_files().release());
  }
  const aiScene* scene = importer.ReadFile(path.string(), 0);
  if (scene == nullptr)
    return bad(path, "not a readable mesh: " + one_line(importer.GetErrorString()), "check that the file is whole");
  if (Status s = check_vertices(path, *scene); !s) return s.error();
  if (Status s = check_faces(path, *scene); !s) return s.error();
  return scene;
}

Result<Imported> imported(const std::filesystem::path& path) {
  Assimp::Importer importer;
  const Result<const aiScene*> read = read_checked(importer, path);
  if (!read) return read.error();
  const std::uint64_t unreferenced = unreferenced_count(*read.value());
  const aiScene* scene = importer.ApplyPostProcessing(kCleaning | aiProcess_PreTransformVertices);
  if (scene == nullptr)
    return bad(path, "cannot be prepared: " + one_line(importer.GetErrorString()), "repair the mesh file");
  // Checked again, because a node's transform may overflow.
  if (Status s = check_vertices(path, *scene); !s) return s.error();
  return Imported{gathered(*scene), unreferenced - std::min(unreferenced, unreferenced_count(*scene))};
}

Result<LoadedNodes> imported_nodes(const std::filesystem::path& path) {
  Assimp::Importer importer;
  const Result<const aiScene*> read = read_checked(importer, path);
  if (!read) return read.error();
  const aiScene* scene = importer.ApplyPostProcessing(kCleaning);
  if (scene == nullptr)
    return bad(path, "cannot be prepared: " + one_line(importer.GetErrorString()), "repair the mesh file");
  NodeGatherer gatherer(path, *scene);
  if (Status s = gatherer.walk(*scene->mRootNode); !s) return s.error();
  return std::move(gatherer).nodes();
}

// Turns what assimp throws into a result.
template <typename Read>
auto guarded(const std::filesystem::path& path, const Read& read) -> decltype(read(path)) {
  try {
    return read(path);
  } catch (const std::bad_alloc&) {
    return bad(path, "the mesh does not fit in memory", "check that the file is whole, or decimate it");
  } catch (const std::exception& e) {
    return bad(path, "not a readable mesh: " + one_line(e.what()), "check that the file is whole");
  }
}

}  // namespace

Result<LoadedMesh> load_mesh(const std::filesystem::path& path) {
  if (Status s = check_file(path); !s) return s.error();
  Result<Imported> read = guarded(path, imported);
  if (!read) return read.error();
  const std::uint64_t unreferenced = read.value().unreferenced_vertices;
  LoadedMesh loaded;
  loaded.mesh = std::move(read).value().mesh;
  if (loaded.mesh.triangles.empty())
    return bad(path, "the mesh has no triangles", "give a mesh with at least one triangle");
  const std::size_t given = loaded.mesh.triangles.size();
  loaded.dropped = clean_mesh(loaded.mesh);
  loaded.dropped.unreferenced_vertices += unreferenced;
  if (loaded.mesh.triangles.empty())
    return bad(path, "all " + std::to_string(given) + " triangles are degenerate (no area)", "repair the mesh file");
  loaded.mesh.name = path.stem().string();
  loaded.mesh.source = path.filename().string();
  return loaded;
}

Result<LoadedNodes> load_nodes(const std::filesystem::path& path) {
  if (Status s = check_file(path); !s) return s.error();
  Result<LoadedNodes> loaded = guarded(path, imported_nodes);
  if (!loaded) return loaded;
  if (loaded.value().nodes.empty())
    return bad(path, "no node shows a triangle with area", "give a file with at least one");
  for (Mesh& mesh : loaded.value().meshes) mesh.source = path.filename().string();
  return loaded;
}

}  // namespace broadside::core

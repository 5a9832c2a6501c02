#include "bench/contest/passage_courses.hpp"

#include <fmt/format.h>

#include <array>
#include <string_view>

#include "bench/contest/contest_request.hpp"

namespace broadside::bench::contest {
namespace {

struct FastScene {
  std::string_view name;
  std::string_view what;
  double speed_m_s;
  double own_steps_a_second;
};

// Speeds of the fast body; of the needle, of its tip.
constexpr std::array kFastScenes{
    FastScene{"rigid:two-spheres:fast", "A ball of 0.1 m at 200 m/s hits another one.", 200.0, 60.0},
    FastScene{"rigid:bullet-through-cards", "A bullet at 300 m/s hits ten free cards of 3 mm and pushes them along.",
              300.0, 240.0},
    FastScene{"rigid:needle-through-plate", "The tip of a spinning needle hits a plate of 2 cm.", 20.0, 60.0},
};
constexpr std::array kStepsASecond{60.0, 120.0, 240.0, 480.0, 960.0};

// A plate of 0.1 m below it, at the scene's own step of 1/60 s.
constexpr std::string_view kDropped = "bunny";
constexpr std::array kDropSpeeds_m_s{1, 5, 20, 50, 100, 200};

}  // namespace

std::vector<PassageCourse> passage_courses() {
  std::vector<PassageCourse> courses;
  for (const FastScene& fast : kFastScenes) {
    PassageCourse course{std::string(fast.name), std::string(fast.what), {}};
    for (const double steps : kStepsASecond)
      course.runs.push_back({scene_at(course.name, 1.0 / fast.own_steps_a_second, fast.own_steps_a_second / steps),
                             fast.speed_m_s / steps});
    courses.push_back(std::move(course));
  }
  PassageCourse drop{fmt::format("drop:{}:1", kDropped),
                     fmt::format("A {} is dropped on a plate of 0.1 m at 1 to 200 m/s.", kDropped),
                     {}};
  for (const int speed : kDropSpeeds_m_s)
    drop.runs.push_back({fmt::format("drop:{}:1[rigid=1,speed_m_s={},frames=60]", kDropped, speed), speed / 60.0});
  courses.push_back(std::move(drop));
  return courses;
}

}  // namespace broadside::bench::contest

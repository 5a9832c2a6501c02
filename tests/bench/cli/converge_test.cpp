// broadside converge as a user runs it.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/whole_file.hpp"
#include "tests/bench/cli/program.hpp"

namespace broadside::tests {
namespace {

TEST(Converge, AnOrderThatIsDeclaredAndShown) {
  const ScratchFolder folder;
  const std::string rows_file = (folder / "order.json").string();
  const Ended ended = run_program({"converge", "rigid:spin-up", "--engine", "plain-rigid", "--json", rows_file});
  EXPECT_EQ(ended.exit_code, 0) << ended.out << ended.err;
  EXPECT_NE(ended.out.find("converge: pass of plain-rigid on rigid:spin-up"), std::string::npos) << ended.out;
  const auto text = core::read_whole_file(rows_file);
  ASSERT_TRUE(text.ok());
  const auto parsed = nlohmann::json::parse(text.value());
  EXPECT_EQ(parsed["dt_s"].size(), 3U);
  EXPECT_EQ(parsed["outcome"], "pass");
  EXPECT_NEAR(parsed["figures"][0]["observed_orders"][1].get<double>(), 1.0, 0.1) << parsed["figures"][0];
}

TEST(Converge, WhatHasNoOrderOrNoAnswerSaysSo) {
  const Ended stands = run_program({"converge", "rigid:tip:push-stands", "--frames", "40", "--engine", "plain-rigid"});
  EXPECT_EQ(stands.exit_code, 3) << stands.out << stands.err;
  const Ended none = run_program({"converge", "two-body:rest", "--engine", "plain-rigid"});
  EXPECT_EQ(none.exit_code, 2) << none.out << none.err;
  EXPECT_NE(none.err.find("the scene has no exact answer"), std::string::npos) << none.err;
  const Ended cannot = run_program({"converge", "rigid:flight:pushed", "--engine", "hash-cpu"});
  EXPECT_EQ(cannot.exit_code, 3) << cannot.out << cannot.err;
}

}  // namespace
}  // namespace broadside::tests

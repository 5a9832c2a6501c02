// octree-cpu with given settings: the frames that the GPU's pipelines have to make.
#pragma once

#include <gtest/gtest.h>

#include <map>
#include <memory>
#include <string>
#include <utility>

#include "core/engine/engine.hpp"
#include "reference/engines.hpp"

namespace broadside::gpu {

using Given = std::map<std::string, std::string>;

inline std::unique_ptr<core::Dynamics> twin_of(const Given& given) {
  const core::EngineRow row = reference::octree_cpu_row();
  auto settings = core::Settings::parse(row.id, row.settings, given);
  EXPECT_TRUE(settings.ok());
  return std::move(row.create(settings.value()).value().dynamics);
}

}  // namespace broadside::gpu

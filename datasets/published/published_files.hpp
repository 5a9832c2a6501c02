// The files of this folder, compiled in by CMake so that a program without its source tree has them too.
#pragma once

#include <string_view>

namespace broadside::datasets {

extern const std::string_view kTable5Csv;
extern const std::string_view kTable6Csv;
extern const std::string_view kTableA1Csv;
extern const std::string_view kMemoryCsv;
extern const std::string_view kFigure4Csv;
extern const std::string_view kClaimsCsv;

}  // namespace broadside::datasets

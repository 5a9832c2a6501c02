# Writes the kept seconds of cells as a C++ source. In: FILE (results/seconds.tsv), OUT (the source).
file(READ ${FILE} text)
file(WRITE ${OUT} "#include \"bench/contest/cell_seconds.hpp\"\n\nnamespace broadside::bench::contest {\n\n")
file(APPEND ${OUT} "std::string_view kept_seconds_text() {\n  return R\"seconds(")
file(APPEND ${OUT} "${text}")
file(APPEND ${OUT} ")seconds\";\n}\n\n}  // namespace broadside::bench::contest\n")

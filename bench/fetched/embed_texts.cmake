# Writes text files as a C++ source. In: ROOT (of the tree), FILES (paths from there, separated by |), OUT (the source).
# Text is read and written without CMake lists, in which semicolons would be lost.
string(REPLACE "|" ";" paths "${FILES}")
file(WRITE ${OUT} "#include \"bench/fetched/program_files.hpp\"\n\nnamespace broadside::bench {\n\n")
file(APPEND ${OUT} "std::span<const ProgramFile> program_files() {\n  static const ProgramFile kFiles[] = {\n")
foreach(path IN LISTS paths)
  file(READ ${ROOT}/${path} text)
  file(APPEND ${OUT} "      {\"${path}\", R\"program(")
  file(APPEND ${OUT} "${text}")
  file(APPEND ${OUT} ")program\"},\n")
endforeach()
file(APPEND ${OUT} "  };\n  return kFiles;\n}\n\n}  // namespace broadside::bench\n")

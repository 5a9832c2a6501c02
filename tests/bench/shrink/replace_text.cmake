# cmake -D FROM=file -D TO=file -D TEXT=text -D BY=text -P replace_text.cmake: a copy with one text in place of another.
file(READ ${FROM} content)
string(FIND "${content}" "\"${TEXT}\"" at)
if(at EQUAL -1)
  message(FATAL_ERROR "${FROM} does not hold \"${TEXT}\"")
endif()
string(REPLACE "\"${TEXT}\"" "\"${BY}\"" content "${content}")
file(WRITE ${TO} "${content}")

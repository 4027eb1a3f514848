# Run at each build (cmake -D OUTPUT=... -D SOURCE=... -P): tells the program which commit it is of, and leaves the header
# as it is where nothing changed.
cmake_minimum_required(VERSION 3.25)
set(commit "unknown")
find_package(Git QUIET)
if(Git_FOUND)
  execute_process(COMMAND ${GIT_EXECUTABLE} -C ${SOURCE} describe --always --exclude=* --abbrev=12 --dirty=+
    OUTPUT_VARIABLE described OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE result)
  if(result EQUAL 0)
    set(commit "${described}")
  endif()
endif()
file(CONFIGURE OUTPUT ${OUTPUT} CONTENT "#pragma once\n\n#define MROSE_COMMIT \"${commit}\"\n" @ONLY)

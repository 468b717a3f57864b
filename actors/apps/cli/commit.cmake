# Writes the commit of this source tree into a C++ file, and touches the file only if it changes:
#   cmake -DSOURCE=FOLDER -DFILE=commit.cpp -P commit.cmake
set(commit unknown)
find_program(GIT git)
if(GIT AND EXISTS ${SOURCE}/.git)
  execute_process(COMMAND ${GIT} describe --always --exclude=* --abbrev=12 --dirty=+
    WORKING_DIRECTORY ${SOURCE} OUTPUT_VARIABLE said OUTPUT_STRIP_TRAILING_WHITESPACE
    RESULT_VARIABLE failed ERROR_QUIET)
  if(NOT failed)
    set(commit ${said})
  endif()
endif()
file(CONFIGURE OUTPUT ${FILE} CONTENT [[
extern const char* const luxodus_commit;
const char* const luxodus_commit = "@commit@";
]] @ONLY)

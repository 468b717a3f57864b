# The program that reads OpenVDB files for `luxodus import vdb`: built beside luxodus if OpenVDB is
# found.
set(LUX_VDB "AUTO" CACHE STRING "whether OpenVDB files are read: AUTO (where OpenVDB is), ON, OFF")
set_property(CACHE LUX_VDB PROPERTY STRINGS AUTO ON OFF)
if(NOT LUX_VDB MATCHES "^(AUTO|ON|OFF)$")
  message(FATAL_ERROR "LUX_VDB is AUTO, ON or OFF, not \"${LUX_VDB}\"")
endif()
set(LUX_HAS_VDB OFF)
# What luxodus and luxodus_vdb share: the job's name (vdb_answer.hpp) reveals a program that was not
# rebuilt with the other.
file(GLOB exchanged CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/scenes/formats/vdb/*.[ch]pp
  ${PROJECT_SOURCE_DIR}/scenes/formats/vdb/program/*.cpp ${PROJECT_SOURCE_DIR}/runtime/core/isolated_job.*
  ${PROJECT_SOURCE_DIR}/runtime/core/plain_stream.*)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${exchanged})
set(LUX_VDB_BUILD "")
foreach(source ${exchanged})
  file(SHA256 ${source} hash)
  string(SHA256 LUX_VDB_BUILD "${LUX_VDB_BUILD}${hash}")
endforeach()
string(SUBSTRING "${LUX_VDB_BUILD}" 0 16 LUX_VDB_BUILD)
target_compile_definitions(lux_scenes_formats_vdb PRIVATE LUX_VDB_BUILD="${LUX_VDB_BUILD}")
if(LUX_VDB STREQUAL "OFF")
  return()
endif()
find_path(OPENVDB_INCLUDE_DIR openvdb/openvdb.h)
find_library(OPENVDB_LIBRARY openvdb)
find_package(TBB QUIET)
find_package(Imath QUIET)
if(OPENVDB_INCLUDE_DIR AND OPENVDB_LIBRARY AND TBB_FOUND AND Imath_FOUND)
  set(LUX_HAS_VDB ON)
elseif(LUX_VDB STREQUAL "ON")
  message(FATAL_ERROR "reading OpenVDB files needs libopenvdb-dev: ./setup.sh")
else()
  message(STATUS "OpenVDB is missing, so that OpenVDB files are not read: apt-get install libopenvdb-dev")
  return()
endif()

add_library(lux_openvdb INTERFACE)
target_include_directories(lux_openvdb SYSTEM INTERFACE ${OPENVDB_INCLUDE_DIR})
target_link_libraries(lux_openvdb INTERFACE ${OPENVDB_LIBRARY} TBB::tbb Imath::Imath)
# Compiled alone, since the library's headers take half a minute and half a gigabyte.
add_library(lux_vdb_job OBJECT ${PROJECT_SOURCE_DIR}/scenes/formats/vdb/program/file_watch.cpp
  ${PROJECT_SOURCE_DIR}/scenes/formats/vdb/program/read_grids.cpp)
# The library identifies its types by their names, which hidden visibility would break.
target_compile_options(lux_vdb_job PRIVATE -fPIE "${LUX_HARDENING}")
target_compile_definitions(lux_vdb_job PRIVATE LUX_VDB_BUILD="${LUX_VDB_BUILD}")
lux_optimise_less(lux_vdb_job)
target_link_libraries(lux_vdb_job PUBLIC lux_scenes_formats_vdb lux_openvdb)
add_executable(luxodus_vdb ${PROJECT_SOURCE_DIR}/scenes/formats/vdb/program/vdb_program.cpp
  $<TARGET_OBJECTS:lux_vdb_job>)
target_compile_options(luxodus_vdb PRIVATE -fPIE "${LUX_HARDENING}")
target_link_options(luxodus_vdb PRIVATE
  -pie "$<$<BOOL:${LUX_HARDENED}>:LINKER:-z,relro,-z,now,-z,noexecstack>")
lux_optimise_less(luxodus_vdb)
target_link_libraries(luxodus_vdb PRIVATE lux_scenes_formats_vdb lux_openvdb)

# The runtime as a library for other programs: one archive of its rooms, its headers, a CMake
# package and a pkg-config file, and the examples. Alone:
#   cmake -B build/runtime -DLUX_RUNTIME_ONLY=ON -DCMAKE_BUILD_TYPE=Release
#   cmake --build build/runtime && cmake --install build/runtime --prefix /opt/luxodus
# Of a build of everything: cmake --build ... --target luxodus-runtime, and
# cmake --install ... --component runtime.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(runtime_objects $<TARGET_OBJECTS:lux_proto_schemas>)
foreach(room ${LUX_RUNTIME_ROOMS})
  lux_target(${room} target)
  list(APPEND runtime_objects $<TARGET_OBJECTS:${target}>)
endforeach()
add_library(luxodus-runtime STATIC ${runtime_objects})
set_target_properties(luxodus-runtime PROPERTIES LINKER_LANGUAGE CXX EXPORT_NAME runtime)
target_compile_features(luxodus-runtime INTERFACE cxx_std_20)
target_include_directories(luxodus-runtime INTERFACE
  $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/luxodus>)
target_link_libraries(luxodus-runtime INTERFACE
  spdlog::spdlog fmt::fmt Boost::context cppzmq Threads::Threads
  $<BUILD_INTERFACE:PkgConfig::capnp> $<INSTALL_INTERFACE:PkgConfig::luxodus_capnp>
  $<BUILD_INTERFACE:PkgConfig::xxhash> $<INSTALL_INTERFACE:PkgConfig::luxodus_xxhash>)
if(LUX_SANITIZE)
  target_link_options(luxodus-runtime INTERFACE -fsanitize=${LUX_SANITIZE})
endif()
set(runtime_apart COMPONENT runtime)
if(NOT LUX_RUNTIME_ONLY)  # no part of the program's package
  list(APPEND runtime_apart EXCLUDE_FROM_ALL)
endif()

install(TARGETS luxodus-runtime EXPORT luxodus-runtime
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} ${runtime_apart})
foreach(room ${LUX_RUNTIME_ROOMS})
  file(GLOB headers CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/${room}/*.hpp)
  install(FILES ${headers} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/luxodus/${room}
    ${runtime_apart})
endforeach()
set(runtime_package ${CMAKE_INSTALL_LIBDIR}/cmake/luxodus-runtime)
install(EXPORT luxodus-runtime NAMESPACE luxodus:: FILE luxodus-runtimeTargets.cmake
  DESTINATION ${runtime_package} ${runtime_apart})
configure_package_config_file(runtime/luxodus-runtimeConfig.cmake.in
  ${PROJECT_BINARY_DIR}/generated/luxodus-runtimeConfig.cmake
  INSTALL_DESTINATION ${runtime_package})
write_basic_package_version_file(
  ${PROJECT_BINARY_DIR}/generated/luxodus-runtimeConfigVersion.cmake COMPATIBILITY SameMinorVersion)
# The file may be moved with what it describes.
file(RELATIVE_PATH runtime_prefix /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
configure_file(runtime/luxodus-runtime.pc.in generated/luxodus-runtime.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/generated/luxodus-runtimeConfig.cmake
  ${PROJECT_BINARY_DIR}/generated/luxodus-runtimeConfigVersion.cmake
  DESTINATION ${runtime_package} ${runtime_apart})
install(FILES ${PROJECT_BINARY_DIR}/generated/luxodus-runtime.pc
  DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig ${runtime_apart})

# The examples, of which one has a schema of its own. Tests run them.
set(ping ${PROJECT_BINARY_DIR}/generated/examples_schema)
add_custom_command(OUTPUT ${ping}/ping.capnp.c++ ${ping}/ping.capnp.h
  COMMAND ${CMAKE_COMMAND} -E make_directory ${ping}
  COMMAND ${CAPNP_TOOL} compile -oc++:${ping} --src-prefix=${PROJECT_SOURCE_DIR}/runtime/examples
    ${PROJECT_SOURCE_DIR}/runtime/examples/ping.capnp
  DEPENDS ${PROJECT_SOURCE_DIR}/runtime/examples/ping.capnp)
set(LUX_RUNTIME_EXAMPLES object ping_pong key_value pipeline)
foreach(example ${LUX_RUNTIME_EXAMPLES})
  add_executable(runtime_${example} runtime/examples/${example}.cpp)
  target_link_libraries(runtime_${example} PRIVATE lux_flags luxodus-runtime)
  set_target_properties(runtime_${example} PROPERTIES OUTPUT_NAME ${example}
    RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/runtime_examples)
endforeach()
target_sources(runtime_ping_pong PRIVATE ${ping}/ping.capnp.c++)
target_include_directories(runtime_ping_pong SYSTEM PRIVATE ${ping})

# The Python module, beside the program: PYTHONPATH=build/release python3 -c "import luxodus"
set(LUX_PYTHON "AUTO" CACHE STRING "whether the Python module is built: AUTO (where pybind11 is), ON, OFF")
set_property(CACHE LUX_PYTHON PROPERTY STRINGS AUTO ON OFF)
if(NOT LUX_PYTHON MATCHES "^(AUTO|ON|OFF)$")
  message(FATAL_ERROR "LUX_PYTHON is AUTO, ON or OFF, not \"${LUX_PYTHON}\"")
endif()
set(LUX_HAS_PYTHON OFF)
# A module with sanitizers would need a Python that starts with them.
if(LUX_PYTHON STREQUAL "ON" OR (LUX_PYTHON STREQUAL "AUTO" AND NOT LUX_SANITIZE))
  set(PYBIND11_FINDPYTHON ON)
  # Prefers the system's Python, which has pybind11 and NumPy as packages, to another one on the
  # path.
  if(NOT Python_EXECUTABLE AND EXISTS /usr/bin/python3)
    set(Python_EXECUTABLE /usr/bin/python3)
  endif()
  find_package(Python 3.9 COMPONENTS Interpreter Development.Module QUIET)
  find_package(pybind11 QUIET)
  if(Python_FOUND AND pybind11_FOUND)
    set(LUX_HAS_PYTHON ON)
  elseif(LUX_PYTHON STREQUAL "ON")
    message(FATAL_ERROR "the Python module needs pybind11 and Python's headers: install pybind11-dev "
      "and python3-dev (./setup.sh)")
  else()
    message(STATUS "pybind11 or Python's headers are missing, so that the Python module is not built: "
      "./setup.sh")
  endif()
endif()
if(NOT LUX_HAS_PYTHON)
  return()
endif()

file(GLOB python_sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/actors/apps/python/*.cpp)
pybind11_add_module(luxodus_python MODULE NO_EXTRAS ${python_sources})
set_target_properties(luxodus_python PROPERTIES OUTPUT_NAME luxodus)
target_compile_definitions(luxodus_python PRIVATE
  LUX_VERSION="${PROJECT_VERSION}" LUX_ARCH="${LUX_ARCH}")
target_compile_options(luxodus_python PRIVATE ${LUX_TAKES_ROUNDED} ${LUX_POSITION_INDEPENDENT})
lux_optimise_less(luxodus_python)
lux_use_precompiled(luxodus_python lux_headers)
lux_compile_together(luxodus_python 12)
get_property(rooms GLOBAL PROPERTY LUX_MODULE_LINKS)  # docs/architecture/rooms.md
target_link_libraries(luxodus_python PRIVATE lux_flags ${rooms} spdlog::spdlog)

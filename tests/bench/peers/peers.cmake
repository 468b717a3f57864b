# Libraries beside which net_bench puts the runtime. Each is compiled where its package is installed:
#   apt-get install libboost-fiber-dev libcaf-dev libnng-dev libopenmpi-dev openmpi-bin
set(peers bench/peers)
target_sources(net_bench PRIVATE ${peers}/peers.cpp ${peers}/processes.cpp ${peers}/luxodus.cpp
  ${peers}/zeromq.cpp)
target_link_libraries(net_bench PRIVATE cppzmq)
set(peers_absent)

find_package(boost_fiber 1.74 QUIET CONFIG)
if(boost_fiber_FOUND)
  target_sources(net_bench PRIVATE ${peers}/boost_fiber.cpp)
  target_link_libraries(net_bench PRIVATE Boost::fiber)
  target_compile_definitions(net_bench PRIVATE LUX_PEER_BOOST_FIBER)
else()
  list(APPEND peers_absent "Boost.Fiber (libboost-fiber-dev)")
endif()

# Debian's packages of CAF have neither a CMake package nor a pkg-config file.
find_library(LUX_CAF_CORE caf_core)
find_library(LUX_CAF_IO caf_io)
find_path(LUX_CAF_INCLUDE caf/io/all.hpp)
if(LUX_CAF_CORE AND LUX_CAF_IO AND LUX_CAF_INCLUDE)
  target_sources(net_bench PRIVATE ${peers}/caf.cpp)
  target_link_libraries(net_bench PRIVATE ${LUX_CAF_IO} ${LUX_CAF_CORE})
  target_compile_definitions(net_bench PRIVATE LUX_PEER_CAF)
else()
  list(APPEND peers_absent "CAF (libcaf-dev)")
endif()

find_package(nng QUIET CONFIG)
if(nng_FOUND)
  target_sources(net_bench PRIVATE ${peers}/nng.cpp)
  target_link_libraries(net_bench PRIVATE nng::nng)
  target_compile_definitions(net_bench PRIVATE LUX_PEER_NNG)
else()
  list(APPEND peers_absent "nng (libnng-dev)")
endif()

# Ranks of MPI are processes of a program of their own, which mpirun starts.
pkg_check_modules(ompi QUIET IMPORTED_TARGET ompi-c)
find_program(LUX_MPIRUN mpirun)
if(ompi_FOUND AND LUX_MPIRUN)
  target_sources(net_bench PRIVATE ${peers}/open_mpi.cpp)
  target_compile_definitions(net_bench PRIVATE LUX_PEER_OPEN_MPI)
  add_executable(net_peer_ranks EXCLUDE_FROM_ALL ${peers}/ranks_main.cpp ${peers}/processes.cpp)
  target_link_libraries(net_peer_ranks PRIVATE lux_flags lux_runtime_core PkgConfig::ompi
    Threads::Threads)
  # Its bindings for C++ are none of the standard's any more, and of another library.
  target_compile_definitions(net_peer_ranks PRIVATE OMPI_SKIP_MPICXX)
  add_dependencies(net_bench net_peer_ranks)
else()
  list(APPEND peers_absent "Open MPI (libopenmpi-dev, openmpi-bin)")
endif()

list(JOIN peers_absent ", " peers_absent)
target_compile_definitions(net_bench PRIVATE LUX_PEERS_ABSENT="${peers_absent}")

// Open MPI starts its processes by itself: net_peer_ranks, which lies beside this program.
#include <fmt/core.h>

#include <filesystem>

#include "tests/bench/peers/peer.hpp"

namespace luxodus::bench {

namespace {

/// Over TCP as all others are, and not by shared memory. Ranks give their processor up while they
/// wait for a message, since they are as many as the processors.
constexpr const char* options =
    "--allow-run-as-root --oversubscribe --bind-to none --mca btl self,tcp "
    "--mca btl_tcp_if_include lo --mca mpi_yield_when_idle 1";

std::string command(const Transfer& work, int64_t span_ns) {
  const auto here = std::filesystem::read_symlink("/proc/self/exe").parent_path();
  return fmt::format("mpirun {} -n 2 {} {} {} {} 2>/dev/null", options,
                     (here / "net_peer_ranks").string(), work.bytes, work.in_flight, span_ns);
}

}  // namespace

Peer open_mpi_peer() {
  Peer peer;
  peer.name = "Open MPI";
  peer.how =
      "two ranks over its TCP transport, MPI_Isend and MPI_Irecv with a tag for each request in "
      "flight, MPI_Waitsome; its ranks poll, so that processor time says nothing";
  peer.polls = true;
  peer.command = command;
  return peer;
}

}  // namespace luxodus::bench

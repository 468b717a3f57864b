// net_peer_ranks BYTES IN_FLIGHT SPAN_NS, by mpirun -n 2: rank 0 asks rank 1 for objects, and
// prints how many came, the seconds that it took, and those of processors.
#include <mpi.h>
#include <unistd.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <thread>
#include <vector>

#include "tests/bench/peers/processes.hpp"

namespace {

using luxodus::bench::Count;
using luxodus::bench::Transfer;

enum Rank : int { asker = 0, holder = 1 };
enum Tag : int { process = 0, request = 1, first_object = 2 };  // an object's is that of its slot

struct Request {
  uint64_t slot = 0;
  uint64_t number = 0;
};

/// Receives of requests that are posted at once: more than a rank handles between two waits.
constexpr size_t receives_posted = 128;

[[noreturn]] void serve(const Transfer& work) {
  const std::vector<std::string> objects(work.objects(), std::string(work.bytes, 'x'));
  std::vector<MPI_Request> answers(work.in_flight, MPI_REQUEST_NULL);
  const size_t posted = std::min(work.in_flight, receives_posted);
  std::vector<Request> requests(posted);
  std::vector<MPI_Request> receives(posted);
  std::vector<int> done(posted);
  const auto receive = [&](size_t i) {
    MPI_Irecv(&requests[i], sizeof(Request), MPI_BYTE, asker, request, MPI_COMM_WORLD,
              &receives[i]);
  };
  for (size_t i = 0; i < posted; ++i) receive(i);
  for (;;) {
    int count = 0;
    MPI_Waitsome(static_cast<int>(posted), receives.data(), &count, done.data(),
                 MPI_STATUSES_IGNORE);
    for (int n = 0; n < count; ++n) {
      const size_t i = static_cast<size_t>(done[n]);
      const Request asked = requests[i];
      receive(i);
      MPI_Wait(&answers[asked.slot], MPI_STATUS_IGNORE);  // of the slot's object before, which came
      const std::string& object = objects[asked.number % objects.size()];
      MPI_Isend(object.data(), static_cast<int>(object.size()), MPI_BYTE, asker,
                first_object + static_cast<int>(asked.slot), MPI_COMM_WORLD, &answers[asked.slot]);
    }
  }
}

[[noreturn]] void ask(const Transfer& work, Count& objects) {
  std::vector<std::string> room(work.in_flight, std::string(work.bytes, ' '));
  std::vector<Request> requests(work.in_flight);
  std::vector<MPI_Request> receives(work.in_flight), sends(work.in_flight, MPI_REQUEST_NULL);
  std::vector<int> done(work.in_flight);
  uint64_t asked = 0;
  const auto send = [&](size_t slot) {
    MPI_Irecv(room[slot].data(), static_cast<int>(work.bytes), MPI_BYTE, holder,
              first_object + static_cast<int>(slot), MPI_COMM_WORLD, &receives[slot]);
    MPI_Wait(&sends[slot], MPI_STATUS_IGNORE);  // of the request before, which was answered
    requests[slot] = {slot, asked++};
    MPI_Isend(&requests[slot], sizeof(Request), MPI_BYTE, holder, request, MPI_COMM_WORLD,
              &sends[slot]);
  };
  for (size_t slot = 0; slot < work.in_flight; ++slot) send(slot);
  for (;;) {
    int count = 0;
    MPI_Waitsome(static_cast<int>(work.in_flight), receives.data(), &count, done.data(),
                 MPI_STATUSES_IGNORE);
    objects.add(static_cast<uint64_t>(count));
    for (int n = 0; n < count; ++n) send(static_cast<size_t>(done[n]));
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) return 2;
  const Transfer work{std::stoul(argv[1]), std::stoul(argv[2])};
  const luxodus::Nanoseconds span = std::stoll(argv[3]);
  int threads = 0, rank = 0;
  MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &threads);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  pid_t self = ::getpid();
  if (rank == holder) {
    MPI_Send(&self, sizeof self, MPI_BYTE, asker, process, MPI_COMM_WORLD);
    serve(work);
  }
  pid_t other = 0;
  MPI_Recv(&other, sizeof other, MPI_BYTE, holder, process, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
  Count objects;
  std::thread measuring([&] {
    const auto taken = luxodus::bench::sample(objects, 2 * work.objects(), span, {other});
    if (taken) std::printf("%.0f %.9f %.9f\n", taken->count, taken->wall_s, taken->processor_s);
    std::fflush(stdout);
    std::quick_exit(0);  // mpirun ends the other
  });
  ask(work, objects);
}

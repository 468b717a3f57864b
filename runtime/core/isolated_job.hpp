// Work on bytes that nobody vouches for, by code of others (Assimp, librsvg), in a process of its
// own with limits on memory and time: what such code does with a damaged file, be it a crash, a
// loop or all the memory there is, becomes one Problem here. The process is this program again, or
// by ask_program() another one, begun anew (posix_spawn, not fork: other threads may hold locks),
// which finds the job by its name in main(). Beside its answer a job writes its share of the work
// back, behind the question. It is no defence against code that breaks out on purpose: it may read
// what we may.
//
//   this process                        the other one
//   question -> memory file ----------> 0
//   answer   <- memory file <---------- 1   limits set first; ends when its parent does
//                                           what it prints goes elsewhere
//
// Any thread may run a job. Jobs are made before main() begins, as globals: the one exception to
// "main wires everything", because test programs link different rooms, and each only its jobs.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "runtime/core/plain_stream.hpp"
#include "runtime/core/result.hpp"

namespace luxodus {

struct IsolatedLimits {
  /// Beyond what the program has mapped when it begins. Builds with sanitizers have none: their
  /// shadow is all the address space there is.
  uint64_t memory_bytes = uint64_t{512} << 20;
  /// Of one processor; waiting for a disk may take ten times as long.
  uint32_t processor_s = 20;
};

class IsolatedJob {
 public:
  /// Runs in the other process. What it throws is an error of the job.
  using Work = void (*)(PlainReader& question, PlainWriter& answer);

  /// Requires: a name of its own; a global, so that it is there when main() begins.
  IsolatedJob(const char* name, Work work);
  IsolatedJob(const IsolatedJob&) = delete;

  /// Asks, waits, and gives what was answered; the answer is to be read without trust.
  /// Errors: more memory or time than the limits, a crash, an exception, a process that cannot be
  /// started. No file is named: the caller knows it.
  /// `told`, where given, hears while it waits, and once at the end, the share that the job tells.
  Result<PlainReader> run(const std::function<void(PlainWriter& question)>& ask,
                          const IsolatedLimits& limits,
                          const std::function<void(double share)>& told = {}) const;

 private:
  friend std::optional<int> serve_isolated_job(int argc, char** argv);

  const char* name_;
  Work work_;
  const IsolatedJob* next_;  // of all jobs
};

/// A program other than this one, whose main() serves jobs: for what needs libraries that this
/// program is not linked with.
struct OtherProgram {
  std::string path;
  std::string packages;  // have its libraries
  std::string renewal;   // what to do where it is of another build: "build it again"
};

/// IsolatedJob::run by another program. The name of the job tells the builds that understand each
/// other: where it is not served, that program is of another build.
/// Errors: as of IsolatedJob::run; libraries that are missing, and another build, both at the path
/// of the program.
Result<PlainReader> ask_program(const OtherProgram& program, const char* job,
                                const std::function<void(PlainWriter& question)>& ask,
                                const IsolatedLimits& limits,
                                const std::function<void(double share)>& told = {});

/// In a job that has found how much there is to do: so much more than it was given. Elsewhere it
/// does nothing.
void allow_more(const IsolatedLimits& more);

/// In a job: how much of it is done, from 0 to 1. Elsewhere it does nothing.
void tell_share(double share);

/// Has the processes of jobs begun by this program with these words before its own, which is to
/// call serve_isolated_job: a library does, which is not the running program. Once, before any job.
/// Requires: a program at least.
void begin_isolated_jobs_by(std::vector<std::string> words);

/// As long as one lives, jobs are done by copies of this process (fork), also those of other
/// programs, which it has to have as its own: a process is begun in milliseconds, whatever its
/// libraries take to load. Limits and ends of jobs are the same. For tests of many files.
/// Requires: no other thread that holds a lock.
class ForkedJobs {
 public:
  ForkedJobs();
  ~ForkedJobs();
  ForkedJobs(const ForkedJobs&) = delete;
};

/// To be called first in main(): where this process was begun for a job, does it and gives the exit
/// code; otherwise nothing.
std::optional<int> serve_isolated_job(int argc, char** argv);

}  // namespace luxodus

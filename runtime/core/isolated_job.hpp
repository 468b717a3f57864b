// Runs work on untrusted bytes (librsvg, meshes) in a process of its own, with limits
// on memory and time. Whatever such code does with a damaged file - a crash, an endless loop,
// exhausted memory - becomes one Problem here. The process is this program again, or with
// ask_program() another one. It is started anew (posix_spawn, not fork: other threads may hold
// locks) and finds the job by its name in main(). A job also reports its progress, after the
// question in the same file. This is no defence against code that attacks on purpose: the process
// may read what we may.
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
  /// Beyond what the program has mapped at its start. Not enforced under sanitizers: their shadow
  /// memory takes all address space.
  uint64_t memory_bytes = uint64_t{512} << 20;
  /// CPU time; the wall-clock limit is ten times as long, for a slow disk.
  uint32_t processor_s = 20;
};

class IsolatedJob {
 public:
  /// Runs in the other process. An exception is reported as an error of the job.
  using Work = void (*)(PlainReader& question, PlainWriter& answer);

  /// Requires: a unique name; a global, so that it exists when main() begins.
  IsolatedJob(const char* name, Work work);
  IsolatedJob(const IsolatedJob&) = delete;

  /// Asks, waits, and returns the answer, which the caller must validate. Errors: memory or time
  /// beyond the limits, a crash, an exception, a process that cannot be started. The Problem names
  /// no file: the caller knows it. `told`, if given, receives the job's progress while it waits and
  /// once at the end.
  Result<PlainReader> run(const std::function<void(PlainWriter& question)>& ask,
                          const IsolatedLimits& limits,
                          const std::function<void(double share)>& told = {}) const;

 private:
  friend std::optional<int> serve_isolated_job(int argc, char** argv);

  const char* name_;
  Work work_;
  const IsolatedJob* next_;  // in the list of all jobs
};

/// Another program whose main() serves jobs: for libraries that this program does not link.
struct OtherProgram {
  std::string path;
  std::string packages;  // packages that provide its libraries
  std::string renewal;   // what to do if it comes from another build: "build it again"
};

/// Runs a job in another program. The job's name identifies compatible builds: a program that does
/// not serve it comes from another build. Errors: those of IsolatedJob::run, missing libraries, and
/// another build; the last two name the program's path.
Result<PlainReader> ask_program(const OtherProgram& program, const char* job,
                                const std::function<void(PlainWriter& question)>& ask,
                                const IsolatedLimits& limits,
                                const std::function<void(double share)>& told = {});

/// Called in a job that has found how much there is to do: raises its limits by `more`. Elsewhere
/// it does nothing.
void allow_more(const IsolatedLimits& more);

/// In a job: reports its progress, from 0 to 1. Elsewhere it does nothing.
void tell_share(double share);

/// Sets the command line prefix of processes that run jobs; that program must call
/// serve_isolated_job(). For a library, which is not the running program. Call it once, before any
/// job. Requires: at least the program's path.
void begin_isolated_jobs_by(std::vector<std::string> words);

/// While an instance exists, jobs run in copies of this process (fork), including jobs of other
/// programs, which this process must then define. A fork takes milliseconds, however long its
/// libraries take to load. Limits and errors are the same. For tests with many files. Requires: no
/// other thread holds a lock.
class ForkedJobs {
 public:
  ForkedJobs();
  ~ForkedJobs();
  ForkedJobs(const ForkedJobs&) = delete;
};

/// Call it first in main(): if this process was started for a job, runs it and returns the exit
/// code; otherwise returns nothing.
std::optional<int> serve_isolated_job(int argc, char** argv);

}  // namespace luxodus

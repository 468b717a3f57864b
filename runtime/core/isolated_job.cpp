// The other process sets its own limits before it reads any input: a limit on address space set
// from outside would have to know how much the program and its libraries map. An answer counts only
// if the process ended well and the answer begins with a mark: otherwise the output of a program
// whose main() does not serve jobs would be taken for an answer.
#include "runtime/core/isolated_job.hpp"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <new>

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define LUX_UNDER_SANITIZERS 1
#endif

namespace luxodus {

namespace {

constexpr char own_program[] = "/proc/self/exe";
constexpr char verb[] = "--isolated-job";
constexpr uint64_t mark = 0x31424F4A'5855'4CULL;  // "LUXJOB1"
constexpr uint32_t waits = 10;                    // wall-clock time over CPU time, at most
// Exit codes of the other process.
constexpr int out_of_memory = 3, no_such_job = 4, has_thrown = 5;
constexpr int not_begun = 127;  // its libraries were not found: ld.so(8)
#ifdef LUX_UNDER_SANITIZERS
constexpr bool limits_memory = false;
constexpr uint32_t slower = 20;  // factor over a release build, at most
#else
constexpr bool limits_memory = true;
constexpr uint32_t slower = 1;
#endif

/// All jobs, the newest first; constant-initialised, so that the order of globals does not matter.
constinit const IsolatedJob* first_job = nullptr;

// ---- in the other process ----------------------------------------------------------------------

uint64_t mapped_bytes() {
  unsigned long pages = 0;
  std::FILE* file = std::fopen("/proc/self/statm", "re");  // proc(5): the first number is all
  if (file == nullptr) return 0;
  const bool read = std::fscanf(file, "%lu", &pages) == 1;
  std::fclose(file);
  return read ? uint64_t{pages} * static_cast<uint64_t>(::sysconf(_SC_PAGESIZE)) : 0;
}

using Resource = decltype(RLIMIT_AS);

void limit(Resource what, uint64_t most) {
  rlimit now{};
  if (::getrlimit(what, &now) != 0) return;
  now.rlim_cur = std::min<rlim_t>(now.rlim_max, most);
  (void)::setrlimit(what, &now);
}

void raise(Resource what, uint64_t by) {
  rlimit now{};
  if (::getrlimit(what, &now) == 0 && now.rlim_cur != RLIM_INFINITY) limit(what, now.rlim_cur + by);
}

void limit_this_process(const IsolatedLimits& most) {
  (void)::prctl(PR_SET_PDEATHSIG, SIGKILL);  // without a parent nobody reads the answer
  limit(RLIMIT_CORE, 0);
  if (const uint64_t mapped = mapped_bytes(); limits_memory && mapped > 0)
    limit(RLIMIT_AS, mapped + most.memory_bytes);
  limit(RLIMIT_FSIZE, most.memory_bytes);
  limit(RLIMIT_CPU, uint64_t{most.processor_s} * slower);
  ::alarm(waits * most.processor_s * slower);
  ::signal(SIGINT, SIG_IGN);  // a signal from the terminal is the parent's to handle
}

// ---- in this process ---------------------------------------------------------------------------

/// A memory file whose descriptor is not 0, 1 or 2, which the other process replaces.
FileDescriptor memory_file() {
  const FileDescriptor file(::memfd_create("luxodus job", MFD_CLOEXEC));
  return FileDescriptor(file.valid() ? ::fcntl(file.number(), F_DUPFD_CLOEXEC, 3) : -1);
}

/// Where the other process writes its progress: after the question, in the same file.
void put_share(int file, off_t at, double share) {
  (void)!::pwrite(file, &share, sizeof share, at);
}

std::optional<double> share_at(int file, off_t at) {
  double share = 0;
  if (::pread(file, &share, sizeof share, at) != sizeof share) return std::nullopt;
  return share >= 0 && share <= 1 ? std::optional(share) : std::nullopt;
}

/// Waits until the process ends; meanwhile reports its progress.
void wait_and_tell(pid_t process, int question, off_t share_place,
                   const std::function<void(double)>& told) {
  constexpr int pause_ms = 200;
  const FileDescriptor watched(static_cast<int>(::syscall(SYS_pidfd_open, process, 0)));
  if (!watched.valid()) return;
  pollfd end{watched.number(), POLLIN, 0};
  for (int ended = 0; ended == 0 || (ended < 0 && errno == EINTR);) {
    ended = ::poll(&end, 1, pause_ms);
    if (ended != 0) continue;
    if (const auto share = share_at(question, share_place)) told(*share);
  }
}

/// In a job: the offset of its progress in descriptor 0; elsewhere -1.
off_t& share_place_of_job() {
  static off_t place = -1;
  return place;
}

/// The command line prefix that starts the other process: the running program (even if its file has
/// been replaced or removed since), unless begin_isolated_jobs_by() set another.
std::vector<std::string>& begun_by() {
  static std::vector<std::string> words{own_program};
  return words;
}

/// Actions and attributes for posix_spawn, freed in the destructor.
class Orders {
 public:
  Orders(int question, int answer) {
    posix_spawn_file_actions_init(&actions_);
    posix_spawn_file_actions_adddup2(&actions_, question, 0);
    posix_spawn_file_actions_adddup2(&actions_, answer, 1);
    if (limits_memory)  // a sanitizer's findings are worth reading
      posix_spawn_file_actions_addopen(&actions_, 2, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_addclosefrom_np(&actions_, 3);
    posix_spawnattr_init(&attributes_);
    sigset_t none, all;
    sigemptyset(&none);
    sigfillset(&all);
    posix_spawnattr_setsigmask(&attributes_, &none);
    posix_spawnattr_setsigdefault(&attributes_, &all);
    posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
  }
  ~Orders() {
    posix_spawn_file_actions_destroy(&actions_);
    posix_spawnattr_destroy(&attributes_);
  }
  Orders(const Orders&) = delete;

  /// Returns 0 or an errno.
  int spawn(pid_t& process, std::vector<std::string> words, const char* name) const {
    words.insert(words.end(), {verb, name});
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    return ::posix_spawn(&process, words[0].c_str(), &actions_, &attributes_, argv.data(), environ);
  }

 private:
  posix_spawn_file_actions_t actions_;
  posix_spawnattr_t attributes_;
};

std::string told(uint64_t bytes) {
  return std::to_string(bytes >> 20) + " MiB of memory";
}

/// Whether jobs run in copies of this process.
bool& forking() {
  static bool forks = false;
  return forks;
}

/// Runs the job as a new process would: with its descriptors and default signal handling.
[[noreturn]] void be_the_other_process(int question, int answer, const char* name) {
  constexpr int not_served = 1;
  for (int signal = 1; signal < NSIG; ++signal) ::signal(signal, SIG_DFL);
  if (::dup2(question, 0) < 0 || ::dup2(answer, 1) < 0) ::_exit(not_served);
  if (limits_memory) (void)!::freopen("/dev/null", "w", stderr);
  std::string words[] = {own_program, verb, name};
  char* argv[] = {words[0].data(), words[1].data(), words[2].data(), nullptr};
  ::_exit(serve_isolated_job(3, argv).value_or(not_served));
}

/// Returns 0 or an errno.
int begin_process(pid_t& process, int question, int answer, const std::vector<std::string>& words,
                  const char* name) {
  if (!forking()) return Orders(question, answer).spawn(process, words, name);
  process = ::fork();
  if (process == 0) be_the_other_process(question, answer, name);
  return process < 0 ? errno : 0;
}

/// Whether the other process ended well.
Result<void> ended_well(int status, const IsolatedLimits& most) {
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return {};
  if (WIFEXITED(status) && WEXITSTATUS(status) == out_of_memory)
    return problem("reading it takes more than " + told(most.memory_bytes) +
                   ": it is damaged, or too large for what it holds");
  const int signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  if (signal == SIGXCPU || signal == SIGALRM)
    return problem("reading it takes longer than " + std::to_string(most.processor_s * slower) +
                   " s: it is damaged, or has to be made simpler");
  if (signal == SIGXFSZ)
    return problem("it makes more than " + told(most.memory_bytes) + " of triangles or pixels");
  if (signal != 0)
    return problem(std::string("reading it ended in a crash (") + ::strsignal(signal) +
                   "): it is damaged; write it anew");
  return problem("reading it failed without a reason: it is damaged; write it anew");
}

/// Whether the program of another file, begun instead of this one, is the right one.
Result<void> began_well(int status, const OtherProgram& other) {
  const std::string name = other.path.substr(other.path.rfind('/') + 1);
  if (WIFEXITED(status) && WEXITSTATUS(status) == not_begun)
    return problem_in(other.path, name +
                                      " cannot be begun: its libraries are missing (apt-get "
                                      "install " +
                                      other.packages + ")");
  if (WIFEXITED(status) && WEXITSTATUS(status) == no_such_job)
    return problem_in(other.path,
                      name + " is of another build than this program: " + other.renewal);
  return {};
}

/// `words` start the program that does the job; `other` is set if that is another program.
Result<PlainReader> ask_process(const std::vector<std::string>& words, const char* job,
                                const std::function<void(PlainWriter& question)>& ask,
                                const IsolatedLimits& most,
                                const std::function<void(double)>& told_share,
                                const OtherProgram* other = nullptr) {
  FileDescriptor question = memory_file(), answer = memory_file();
  if (!question.valid() || !answer.valid())
    return system_problem({}, "no process can be begun to read it", errno);
  PlainWriter writer(question.number());
  writer.put(most);
  ask(writer);
  const bool asked = writer.flush();
  const off_t share_place = ::lseek(question.number(), 0, SEEK_END);
  put_share(question.number(), share_place, 0);
  if (!asked || ::lseek(question.number(), 0, SEEK_SET) != 0)
    return system_problem({}, "no process can be begun to read it", errno);
  pid_t process = 0;
  if (const int error = begin_process(process, question.number(), answer.number(), words, job);
      error)
    return system_problem({}, "no process can be begun to read it", error);
  if (told_share) wait_and_tell(process, question.number(), share_place, told_share);
  int status = 0;
  while (::waitpid(process, &status, 0) < 0)
    if (errno != EINTR) return system_problem({}, "the process that reads it was lost", errno);
  if (other != nullptr)
    if (auto ok = began_well(status, *other); !ok) return ok.problem();
  if (auto ok = ended_well(status, most); !ok) return ok.problem();
  if (const auto share = share_at(question.number(), share_place); told_share && share)
    told_share(*share);
  PlainReader reader(std::move(answer));
  uint64_t first = 0;
  if (!reader.get(first) || first != mark) {
    if (other != nullptr) return problem_in(other->path, "gives no answer: " + other->renewal);
    return problem("this program reads such files in a process of its own, and cannot begin one",
                   ProblemKind::system);
  }
  return reader;
}

}  // namespace

IsolatedJob::IsolatedJob(const char* name, Work work) : name_(name), work_(work), next_(first_job) {
  first_job = this;
}

Result<PlainReader> IsolatedJob::run(const std::function<void(PlainWriter& question)>& ask,
                                     const IsolatedLimits& most,
                                     const std::function<void(double)>& told_share) const {
  return ask_process(begun_by(), name_, ask, most, told_share);
}

Result<PlainReader> ask_program(const OtherProgram& program, const char* job,
                                const std::function<void(PlainWriter& question)>& ask,
                                const IsolatedLimits& most,
                                const std::function<void(double)>& told_share) {
  return ask_process({program.path}, job, ask, most, told_share, &program);
}

ForkedJobs::ForkedJobs() {
  forking() = true;
}

ForkedJobs::~ForkedJobs() {
  forking() = false;
}

void begin_isolated_jobs_by(std::vector<std::string> words) {
  begun_by() = std::move(words);
}

void allow_more(const IsolatedLimits& more) {
  rlimit core{};
  const uint32_t alarm_s = ::alarm(0);  // running in jobs only
  if (alarm_s == 0 || ::getrlimit(RLIMIT_CORE, &core) != 0 || core.rlim_cur != 0) return;
  ::alarm(alarm_s + waits * more.processor_s * slower);
  raise(RLIMIT_AS, more.memory_bytes);
  raise(RLIMIT_FSIZE, more.memory_bytes);
  raise(RLIMIT_CPU, uint64_t{more.processor_s} * slower);
}

void tell_share(double share) {
  const off_t place = share_place_of_job();
  if (place >= 0) put_share(0, place, share);
}

std::optional<int> serve_isolated_job(int argc, char** argv) {
  if (argc != 3 || std::strcmp(argv[1], verb) != 0) return std::nullopt;
  const IsolatedJob* job = first_job;
  while (job != nullptr && std::strcmp(job->name_, argv[2]) != 0) job = job->next_;
  PlainReader question(FileDescriptor(::fcntl(0, F_DUPFD_CLOEXEC, 3)));
  IsolatedLimits most;
  if (job == nullptr) return no_such_job;
  // Output of libraries must not get into the answer.
  const FileDescriptor answer_place(::fcntl(1, F_DUPFD_CLOEXEC, 3));
  (void)::dup2(2, 1);
  if (!question.get(most)) return has_thrown;
  limit_this_process(most);
  struct stat question_file {};
  if (::fstat(0, &question_file) == 0)
    share_place_of_job() = question_file.st_size - static_cast<off_t>(sizeof(double));
  int code = 0;
  try {
    PlainWriter answer(answer_place.number());
    answer.put(mark);
    job->work_(question, answer);
    if (!answer.flush()) code = has_thrown;
  } catch (const std::bad_alloc&) {
    code = out_of_memory;
  } catch (...) {
    code = has_thrown;
  }
  ::_exit(code);  // no destructors: nothing needs tidying up
}

}  // namespace luxodus

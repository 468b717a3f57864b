// odd_vdb: a luxodus_vdb that lists one grid, "density", and on reading does what the file says:
// simulates what OpenVDB may do with a damaged file.
#include <csignal>
#include <fstream>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "runtime/core/isolated_job.hpp"
#include "scenes/formats/vdb/vdb_answer.hpp"

namespace luxodus::vdb {
namespace {

volatile uint64_t spun = 0;

void do_odd_work(const std::string& what, PlainWriter& out) {
  if (what == "crash") std::raise(SIGSEGV);
  if (what == "loop")
    for (;;) spun = spun + 1;
  if (what == "flood") {
    std::vector<std::unique_ptr<char[]>> taken;  // not used: this exhausts the address space
    for (;;) taken.push_back(std::make_unique_for_overwrite<char[]>(size_t{1} << 28));
  }
  if (what == "lie") out.put(uint64_t{1} << 60);  // announces cells that do not follow
  if (what == "throw") throw std::runtime_error("no");
}

void odd_answer(PlainReader& in, PlainWriter& out) {
  Question question;
  std::string what;
  if (!get(in, question) || !std::getline(std::ifstream(question.file), what))
    throw std::runtime_error("no question");
  out.put(uint8_t{1});
  if (!question.grid.empty()) return do_odd_work(what, out);
  out.put(uint64_t{1});
  put(out, VdbGrid{"density", "float", "fog volume", 1, ""});
}

const IsolatedJob odd_job(job, odd_answer);

}  // namespace
}  // namespace luxodus::vdb

int main(int argc, char** argv) {
  return luxodus::serve_isolated_job(argc, argv).value_or(2);
}

// luxodus_vdb: reads OpenVDB files for `luxodus import vdb`, which starts it and passes the
// question in a memory file. It does nothing else.
#include <cstdio>

#include "runtime/core/isolated_job.hpp"

int main(int argc, char** argv) {
  if (const auto code = luxodus::serve_isolated_job(argc, argv)) return *code;
  std::fprintf(stderr, "luxodus_vdb is begun by `luxodus import vdb`\n");
  return 2;
}

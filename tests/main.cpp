// The one translation unit that carries the main of Catch2; every test program links it. A test
// program serves the jobs that its rooms run in processes of their own, as the program does.
#define CATCH_CONFIG_RUNNER
#include <catch2/catch.hpp>

#include "runtime/core/isolated_job.hpp"

int main(int argc, char** argv) {
  if (const auto served = luxodus::serve_isolated_job(argc, argv)) return *served;
  return Catch::Session().run(argc, argv);
}

// A port of leases that notes which are done, for tests of tracing without a network. One thread.
#pragma once

#include <catch2/catch.hpp>
#include <vector>

#include "actors/results/run/leased_work.hpp"

namespace luxodus::test {

struct NotedPort final : LeasePort {
  void want_leases(size_t) override {}
  void leases_done(std::span<const uint64_t> leases) override {
    done.insert(done.end(), leases.begin(), leases.end());
  }
  bool has_room_for(size_t) const override { return true; }
  void lease_failed(uint64_t, int64_t) override { FAIL("no batch fails"); }
  bool give_back(std::span<const uint64_t>) override { return true; }
  void return_leases() override {}
  void want_room() override {}
  bool room_to_come() const override { return false; }
  size_t flush_bytes() const override { return 0; }
  void give_up(const Problem& why) override { FAIL(why.what); }
  void thread_failed(const std::exception_ptr&) override { FAIL("a photon-thread failed"); }
  std::vector<uint64_t> done;
};

}  // namespace luxodus::test

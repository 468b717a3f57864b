// Shared by tests of cluster files: small files made of parts, and parse calls that must succeed or
// fail. Test code; one thread.
#pragma once

#include <catch2/catch.hpp>
#include <string>

#include "runtime/config/cluster_file.hpp"

namespace luxodus {

inline const std::string run_part = "[run]\nname = \"r\"\nscene = \"s.toml\"\n";
inline const std::string host_part = "[[host]]\nname = \"h\"\n";
inline const std::string controller_part = "[[node]]\nname = \"c\"\nrole = \"controller\"\n";
inline const std::string worker_part = "[[node]]\nname = \"n\"\n";
/// 10 lines: a controller "c" and a worker "n" on one host.
inline const std::string small_cluster = run_part + host_part + controller_part + worker_part;

inline std::string two_hosts(const std::string& first, const std::string& second) {
  return "[[host]]\nname = \"a\"\naddress = \"" + first +
         "\"\n[[host]]\nname = \"b\"\naddress = \"" + second + "\"\n";
}

inline std::string all_problems(const ReadCluster& read) {
  std::string text;
  for (const Problem& problem : read.problems.list()) text += problem.text() + "\n";
  return text;
}

inline ClusterConfig good(const std::string& text) {
  ReadCluster read = parse_cluster(text, "/etc/lux/c.toml");
  INFO(all_problems(read));
  REQUIRE(read.cluster.has_value());
  REQUIRE(read.problems.empty());
  return std::move(*read.cluster);
}

/// The only problem of a file.
inline Problem only_problem(const std::string& text) {
  const ReadCluster read = parse_cluster(text, "c.toml");
  INFO(text << "\n" << all_problems(read));
  REQUIRE_FALSE(read.cluster.has_value());
  REQUIRE(read.problems.list().size() == 1);
  return read.problems.list().front();
}

}  // namespace luxodus

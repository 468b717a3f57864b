#include "runtime/config/cluster_file.hpp"

#include <sstream>

#include "runtime/toml/findings.hpp"
#include "tests/unit/runtime/config/cluster_kit.hpp"

namespace luxodus {

TEST_CASE("a minimal file has the defaults of the rooms that use them", "[runtime][config]") {
  const ClusterConfig cluster = good(small_cluster);
  const NetConfig usual;
  CHECK(cluster.links.hop_limit == usual.hop_limit);
  CHECK(cluster.links.small_chunk_bytes == usual.small_chunk_bytes);
  CHECK(cluster.links.bulk_chunk_bytes == usual.bulk_chunk_bytes);
  CHECK(cluster.links.small_window_bytes == usual.small_window_bytes);
  CHECK(cluster.links.bulk_window_bytes == usual.bulk_window_bytes);
  CHECK(cluster.links.outbox_messages == usual.outbox_messages);
  CHECK(cluster.links.assemblies == usual.assemblies);
  CHECK(cluster.links.max_message_bytes == usual.max_message_bytes);
  CHECK(cluster.links.assembly_patience == usual.assembly_patience);
  CHECK(cluster.links.times.beat == usual.times.beat);
  CHECK(cluster.links.times.suspect_after_beats == usual.times.suspect_after_beats);
  CHECK(cluster.links.times.down_after_beats == usual.times.down_after_beats);
  CHECK(cluster.links.times.patience == usual.times.patience);
  CHECK(cluster.topology.kind == TopologyChoice::Kind::amp);
  CHECK(cluster.topology.max_links == 4);
  CHECK(cluster.topology.max_controller_links == 1);  // there is one worker
  CHECK(cluster.run.level == Level::bit);
  CHECK(cluster.run.id != 0);
  CHECK_FALSE(cluster.node(cluster.controller()).traces);
  CHECK(cluster.nodes[0].budget.object_bytes == uint64_t{1} << 30);
  CHECK(cluster.nodes[0].budget.stack_bytes == 64 * 1024);
  CHECK_FALSE(cluster.run.particles.has_value());
  CHECK(cluster.run.sharing);
  CHECK_FALSE(
      good(run_part + "sharing = false\n" + host_part + controller_part + worker_part).run.sharing);
}

TEST_CASE("paths are relative to the folder of the file", "[runtime][config]") {
  const ClusterConfig cluster = good("[keys]\nfolder = \"../keys\"\n" + small_cluster +
                                     "[topology]\nkind = \"file\"\nfile = \"/srv/graph.toml\"\n");
  CHECK(cluster.run.scene == "/etc/lux/s.toml");
  CHECK(cluster.run.out == "/etc/lux/out/r");
  CHECK(cluster.keys.folder == "/etc/keys");
  CHECK(cluster.topology.file == "/srv/graph.toml");
}

TEST_CASE("a run may use any time of the scene's clock", "[runtime][config]") {
  CHECK_FALSE(good(small_cluster).run.at_s.has_value());
  const auto at = [](const std::string& at_s) {
    return run_part + "at_s = " + at_s + "\n" + host_part + controller_part + worker_part;
  };
  CHECK(good(at("60")).run.at_s == 60.0);
  CHECK(good(at("-20")).run.at_s == -20.0);
  CHECK(only_problem(at("-2e6")).what.find("at_s") != std::string::npos);
}

TEST_CASE("shards of the totals are given to workers by name", "[runtime][config]") {
  CHECK(good(small_cluster).tally.shards.empty());
  const ClusterConfig cluster =
      good(small_cluster + "count = 4\n[tally]\nshards = [\"n3\", \"n0\"]\n");
  CHECK(cluster.tally.shards == std::vector<NodeId>{{3}, {0}});
}

TEST_CASE("a cluster makes pictures of a finished run if its file asks for them",
          "[runtime][config]") {
  CHECK(good(small_cluster).is_run());
  const ClusterConfig cluster =
      good(small_cluster + "[render]\nview = \"north\"\npaths = 48\ntime_s = 60\nraw = true\n");
  CHECK_FALSE(cluster.is_run());
  CHECK(cluster.render.asked);
  CHECK(cluster.render.view == "north");
  CHECK(cluster.render.paths == 48);
  CHECK(cluster.render.time_s == 60);
  CHECK_FALSE(cluster.render.error);
  CHECK(cluster.render.raw);
  CHECK_FALSE(cluster.render.full_paths);
}

TEST_CASE("the display is at the controller, or at the node that the file names",
          "[runtime][config]") {
  const ClusterConfig usual = good(small_cluster);
  CHECK(usual.display.node == usual.controller());
  CHECK_FALSE(usual.display.pictures);
  const ClusterConfig cluster =
      good(small_cluster + "count = 4\n[display]\nnode = \"n2\"\npictures = true\npreview_s = 5\n");
  CHECK(cluster.display.node == NodeId{2});
  CHECK(cluster.display.pictures);
  CHECK(cluster.display.preview_s == 5);
}

TEST_CASE("a node's own budget overrides the keys that it gives", "[runtime][config]") {
  const ClusterConfig cluster = good(small_cluster +
                                     "[node.budget]\nfibers = 7\nobject_bytes = \"2 GiB\"\n"
                                     "[budget]\nfibers = 100\nstack_kb = 96\n");
  const NodeBudget worker = cluster.nodes[0].budget, controller = cluster.nodes[1].budget;
  CHECK(worker.fibers == 7);
  CHECK(worker.object_bytes == uint64_t{2} << 30);
  CHECK(worker.stack_bytes == 96 * 1024);
  CHECK(controller.fibers == 100);
  CHECK(controller.object_bytes == uint64_t{1} << 30);
}

TEST_CASE("a wrong key is reported once, with its line", "[runtime][config]") {
  struct Row {
    std::string text;
    int line;
    std::string words;
  };
  const std::string hosts = two_hosts("10.0.0.1", "10.0.0.2");
  const std::string insecure = "[keys]\ninsecure = true\n";
  std::string deep_key = "a";
  for (int i = 0; i < 40; ++i) deep_key += ".a";
  const std::vector<Row> rows{
      {"a = ", 1, "this is not TOML"},
      {small_cluster + deep_key + " = 1\n", 11, "do not nest so deep"},
      {host_part + controller_part + worker_part, 1, "'run' is missing"},
      {"[run]\nname = \"r\"\n" + host_part + controller_part + worker_part, 1,
       "'scene' is missing"},
      {small_cluster + "port = \"x\"\n", 11, "'port' must be a whole number, not a text"},
      {small_cluster + "port = 80\n", 11, "'port' is 80 but must lie in [1024, 65534]"},
      {small_cluster + "prot = 2000\n", 11, "did you mean 'port'?"},
      {small_cluster + "colour = 3\n", 11,
       "known here: name count host role process port stores budget"},
      {small_cluster + "traces = true\n", 11, "unknown key 'traces'"},
      {small_cluster + "role = \"workr\"\n", 11, "did you mean \"worker\"?"},
      {small_cluster + "process = \"-x\"\n", 11, "'process' must be 1 to 32 letters"},
      {small_cluster + "process = \"a b\"\n", 11, "'process' must be 1 to 32 letters"},
      {small_cluster + "[budget]\nobject_bytes = \"1 Gb\"\n", 12, "a number of bytes, or a text"},
      {small_cluster + "[budget]\nobject_bytes = 1\n", 12, "must lie in [1048576, 1e14] B"},
      {small_cluster + "[lease]\nduration_s = nan\n", 12, "must be a finite number, not nan"},
      {small_cluster + "[links]\nsuspect_after = 9\n", 12, "must be less than 'down_after'"},
      {small_cluster + "[observe]\nlog_level = \"warm\"\n", 12, "did you mean \"warn\"?"},
      {small_cluster + "[observe]\nmetrics_address = \"here\"\n", 12, "must be an IPv4 address"},
      {small_cluster + "[topology]\nkind = \"ampp\"\n", 12, "did you mean \"amp\"?"},
      {small_cluster + "[topology]\nkind = \"file\"\n", 11, "'file' is missing"},
      {small_cluster + "[topology]\nfile = \"x\"\n", 12, "unknown key 'file'"},
      {small_cluster + "[topology]\ncontroller = \"node\"\ncontroller_links = 2\n", 13,
       "leave this out"},
      {small_cluster + "[keys]\nfolder = \"k\"\ninsecure = true\n", 13, "keep one of them"},
      {small_cluster + "[tally]\nshards = \"n\"\n", 12, "'shards' must be a list, not a text"},
      {small_cluster + "[tally]\nshards = [\n1]\n", 13,
       "'shards' must be a list of names, not an integer"},
      {small_cluster + "[tally]\nshards = [\n\"m\"]\n", 13, "there is no node \"m\""},
      {small_cluster + "[tally]\nshards = [\"c\"]\n", 12, "name workers"},
      {small_cluster + "[lease]\nfan_out = 1\n", 12, "0, or at least 2"},
      {small_cluster + "count = 4\n[lease]\nfan_out = 2\n[tally]\nshards = [\"n0\"]\n", 15,
       "need one coordinator for all nodes"},
      {small_cluster + "[tally]\nshards = [\"n\", \"n\"]\n", 12, "a share of the totals already"},
      {small_cluster + "[tally]\nshard = [\"n\"]\n", 12, "did you mean 'shards'?"},
      {small_cluster + "[display]\nnode = \"m\"\n", 12, "there is no node \"m\""},
      {small_cluster + "[view]\n[display]\npictures = true\n", 12, "a live view writes no results"},
      {small_cluster + "[view]\n[render]\n", 12, "makes pictures and nothing else"},
      {small_cluster + "[render]\npaths = 0\n", 12, "paths"},
      {small_cluster + "[node.budget]\nfibers = 0\n", 12, "must lie in [1, 100000]"},
      {small_cluster + "host = \"g\"\n", 11, "there is no host \"g\""},
      {small_cluster + worker_part, 12, "there is a node \"n\" already, in line 10"},
      {small_cluster + "count = 2000\n", 11, "must lie in [1, 1024]"},
      {small_cluster + "count = 1024\n", 11, "at most 1024 nodes"},
      {small_cluster + "port = 65530\ncount = 4\n", 11, "ports above 65535"},
      {run_part + host_part + "address = \"a\"\n" + host_part + "address = \"b\"\n" + worker_part +
           "host = \"h\"\n" + controller_part + "host = \"h\"\n",
       8, "host \"h\" already, in line 5"},
      {run_part + host_part + worker_part, 1, "no controller"},
      {small_cluster + "[[node]]\nname = \"d\"\nrole = \"controller\"\n", 12,
       "second controller; line 7 has the first"},
      {run_part + host_part + controller_part, 7, "nobody traces"},
      {run_part + controller_part + worker_part, 1, "'host' is missing"},
      {"host = 3\n" + run_part + worker_part + controller_part, 1,
       "list of tables, each opened by [[host]]"},
      {run_part + hosts + worker_part + "host = \"a\"\n" + controller_part, 13,
       "say on which this node runs"},
      {run_part + hosts + worker_part + "host = \"a\"\n" + controller_part + "host = \"b\"\n", 8,
       "no keys"},
      {run_part + two_hosts("10.0.0.1", "10.0.0.300") + insecure + worker_part + "host = \"a\"\n" +
           controller_part + "host = \"b\"\n",
       9, "must be an IPv4 address or a host's name"},
      {run_part + two_hosts("10.0.0.1", "10.0.0.1") + insecure + worker_part + "host = \"a\"\n" +
           controller_part + "host = \"b\"\n",
       16, "both use port 27600 of 10.0.0.1"},
  };
  for (const Row& row : rows) {
    INFO(row.words);
    const ReadCluster read = parse_cluster(row.text, "c.toml");
    INFO(row.text << "\n" << all_problems(read));
    CHECK_FALSE(read.cluster.has_value());
    REQUIRE_FALSE(read.problems.empty());
    const Problem& first = read.problems.list().front();
    CHECK(first.what.find(row.words) != std::string::npos);
    CHECK(first.where.file == "c.toml");
    CHECK(first.where.line == row.line);
  }
}

TEST_CASE("inconsistent parts are reported with the names involved", "[runtime][config]") {
  const std::string hosts =
      run_part + two_hosts("10.0.0.1", "lux2.example.org") + "[keys]\nfolder = \"k\"\n";
  const std::string a = "host = \"a\"\n", b = "host = \"b\"\n";
  CHECK(only_problem(hosts + worker_part + a + "process = \"p\"\n" + controller_part + b +
                     "process = \"p\"\n")
            .what == "process \"p\" runs on host \"a\", and node \"c\" on \"b\"");
  CHECK(only_problem(hosts + worker_part + a + "port = 2000\n[[node]]\nname = \"m\"\n" + a +
                     "port = 2001\n" + controller_part + b)
            .what.find("node \"n\" and node \"m\" both use port 2001") == 0);
  CHECK(only_problem(hosts + worker_part + a + controller_part + b +
                     "port = 2000\n[observe]\nmetrics_port = 27601\n")
            .what.find("node \"n\" and metrics of \"n\" both use port 27601") == 0);
  CHECK(only_problem(small_cluster + "count = 3\n[observe]\nmetrics_port = 65533\n")
            .what.find("metrics on port 65536") != std::string::npos);
  CHECK(only_problem(run_part + host_part + "first_port = 65530\n" + controller_part + worker_part +
                     "count = 3\n")
            .what.find("no port is left for \"c\"") == 0);
}

TEST_CASE("single links join two nodes, are given once, and respect the limit",
          "[runtime][config]") {
  const std::string nodes = small_cluster + "count = 4\n[topology]\nkind = \"links\"\n";
  const std::string ring = "[\"n0\",\"n1\"],[\"n1\",\"n2\"],[\"n2\",\"n3\"],[\"n3\",\"n0\"]";
  const auto links = [&](const std::string& more) {
    return nodes + "links = 3\ncontroller_links = 2\npairs = [" + ring + more + "]\n";
  };
  const ClusterConfig cluster = good(links(",[\"c\",\"n2\"]"));
  CHECK(cluster.topology.edges.size() == 5);
  CHECK(cluster.topology.edges.back() == Edge{NodeId{2}, NodeId{4}});

  CHECK(only_problem(links(",[\"n0\",\"n9\"]")).what == "there is no node \"n9\"");
  CHECK(only_problem(links(",[\"n0\",\"n0\"]")).what == "this links node \"n0\" to itself");
  CHECK(only_problem(links(",[\"n1\",\"n0\"]")).what == "\"n1\" and \"n0\" are linked already");
  CHECK(only_problem(links(",[\"n1\"]")).what == "'pairs' must be a list of pairs of names");
  CHECK(only_problem(links(",[\"n0\",\"n2\"],[\"n0\",\"c\"]")).what ==
        "\"n0\" has more than the 3 links that 'links' allows");
  CHECK(only_problem(links(",[\"c\",\"n0\"],[\"c\",\"n1\"],[\"c\",\"n2\"]")).what ==
        "\"c\" has more than the 2 links that 'controller_links' allows");
  CHECK(good(nodes + "links = 3\ncontroller = \"node\"\npairs = [[\"c\",\"n0\"],[\"c\",\"n1\"]," +
             "[\"c\",\"n2\"]]\n")
            .topology.max_controller_links == 0);
}

TEST_CASE("all mistakes in a file are reported at once, by line", "[runtime][config]") {
  const ReadCluster read =
      parse_cluster("[run]\nname = \"r r\"\nscene = 3\nlevel = \"bits\"\n" + host_part +
                        "adress = \"::1\"\n" + worker_part + "count = 0\n" + controller_part,
                    "c.toml");
  std::vector<int> lines;
  for (const Problem& problem : read.problems.list()) lines.push_back(problem.where.line);
  INFO(all_problems(read));
  CHECK(lines == std::vector<int>{2, 3, 4, 7, 7, 10});  // the misspelt key, and its value
}

TEST_CASE("a file that is too long, missing, or a folder is rejected with a reason",
          "[runtime][config]") {
  CHECK(only_problem(std::string(limits::cluster_file_bytes + 1, '\n')).what.find("longer than") !=
        std::string::npos);
  CHECK(all_problems(read_cluster("/nowhere/c.toml")).find("cannot be read") != std::string::npos);
  CHECK(all_problems(read_cluster("/")).find("Is a directory") != std::string::npos);
  const ReadCluster read = parse_cluster(
      std::string("[run]\n") +
          [] {
            std::string many;
            for (int i = 0; i < 5000; ++i) many += "zz" + std::to_string(i) + " = 1\n";
            return many;
          }(),
      "c.toml");
  CHECK(read.problems.list().size() == limits::toml_problems + 1);
}

TEST_CASE("a damaged file gives either a cluster or problems with lines, never both",
          "[runtime][config]") {
  const std::string text = small_cluster + "count = 3\nport = 2000\n[node.budget]\nfibers = 3\n" +
                           "[topology]\nkind = \"links\"\npairs = [[\"n0\", \"n1\"]]\n[links]\n" +
                           "hop_limit = 3\nmax_message_bytes = 70000\n[keys]\ninsecure = false\n" +
                           "[lease]\nduration_s = 1.5\n[observe]\nmetrics_port = 9000\n";
  good(text);
  std::vector<std::string> rows;
  std::istringstream in(text);
  for (std::string row; std::getline(in, row);) rows.push_back(row);
  int refused = 0;
  for (size_t i = 0; i < rows.size(); ++i) {
    std::vector<std::string> damaged{"", rows[i] + rows[i], rows[i] + "\n" + rows[i]};
    const size_t equals = rows[i].find(" = ");
    for (const char* value : {"nan", "-1", "1e300", "9223372036854775807", "true", "\"\"", "\"x\"",
                              "[]", "[[1]]", "{}", "[{ a = 1 }]", "2024-01-01", "\"\\u0000\""}) {
      if (equals != std::string::npos) damaged.push_back(rows[i].substr(0, equals + 3) + value);
    }
    for (const std::string& replacement : damaged) {
      std::string file;
      for (size_t k = 0; k < rows.size(); ++k) file += (k == i ? replacement : rows[k]) + "\n";
      const ReadCluster read = parse_cluster(file, "c.toml");
      INFO("line " << i + 1 << ": " << replacement << "\n" << all_problems(read));
      REQUIRE(read.cluster.has_value() == read.problems.empty());
      for (const Problem& problem : read.problems.list()) CHECK(problem.where.line > 0);
      refused += read.cluster ? 0 : 1;
    }
  }
  CHECK(refused > 200);
}

}  // namespace luxodus

#include "actors/lab/study/study_schema.hpp"

#include "runtime/config/cluster_schema.hpp"

namespace luxodus {

namespace {

using toml::KeySpec;
using toml::TableSpec;

TableSpec top_table() {
  return {"study",
          "Top of the file",
          {
              {"title", "text", "", "required", "", "of the study, above its plots"},
              {"question", "text", "", "\"\"", "", "what it asks, in a sentence or two"},
              {"scene", "path", "", "required", "", "scene file"},
              {"scenario", "text", "", "\"\"", "", "state of the building; the first if empty"},
              {"tally", "choice", "", "\"objects\"", "objects, scene",
               "what is counted: one bin for each side of an object, so that the study is about "
               "fetching, or all that the scene asks for"},
              {"costs", "path", "", "", "",
               "file of `luxodus study calibrate`: what work takes; simulations need one"},
              {"seeds", "integer", "", "3", "[1, 100]", "runs of each point, of different chance"},
              {"first_seed", "integer", "", "1", "[0, 1e9]", "the others follow it"},
              {"cores", "integer", "", "0", "[0, 1024]",
               "simulated nodes share a machine of so many cores; 0: each has its own"},
              {"jitter_ms", "number", "ms", "0.02", "[0, 1000]",
               "of simulated links, on top of their delay, uniform"},
              {"crash_for_s", "number", "s", "1", "(0, 1e5]",
               "with `crash_s`: how long the node is gone"},
              {"sweep", "table", "", "", "", "what is varied; each key one value or a list"},
              {"plot", "tables", "", "required", "", "what is drawn"},
          }};
}

TableSpec sweep_table() {
  return {
      "sweep",
      "`[sweep]`: every combination is a point",
      {
          {"on", "choice sweep", "", "\"simulation\"", "simulation, replay, nodes, processes",
           "nodes simulated by virtual time, with real tracing or with recorded references; or "
           "real nodes by the clock on the wall, in one process or each in its own"},
          {"topology", "choice sweep", "", "\"amp\"",
           "amp, torus, mesh, hypercube, ring, chordal-ring, ternary-tree, random-regular",
           "of the links; the controller is one vertex more, linked to up to four nodes"},
          {"nodes", "integer sweep", "", "4", "[1, 1023]", "workers"},
          {"links", "integer sweep", "", "4", "[1, 16]",
           "of a node at most, for amp and random-regular"},
          {"fan_out", "integer sweep", "", "0", "[0, 1023]",
           "nodes that a coordinator leads at most; 0: all below 64 workers, else their square "
           "root"},
          {"tally_shards", "integer sweep", "", "1", "[1, 256]",
           "shares of the totals: one stays with the controller, nodes hold the others"},
          {"delay_ms", "number sweep", "ms", "0.05", "[0, 10000]", "of every link, one way"},
          {"bytes_per_second", "number sweep", "B/s", "1e9", "[0, 1e13]",
           "of every link, each way; 0: no limit"},
          {"fibers", "integer sweep", "", "16", "[1, 16384]", "photon-threads of a node"},
          {"cache", "number sweep", "", "0.25", "[0, 100]",
           "budget of a node for objects, as a share of what all take once built; 0: everything "
           "is resident"},
          {"profile", "number sweep", "", "0", "[0, 1]",
           "share of the particles that is traced beforehand, to plan who traces, holds and keeps "
           "what; 0: no plan"},
          {"prefetch", "integer sweep", "", "0", "[0, 64]",
           "cells that a ray enters next, asked for ahead of the one that is waited for"},
          {"cells", "integer sweep", "", "64", "[1, 100000]",
           "parts that the geometry is cut into"},
          {"particles", "integer sweep", "", "4096", "[1, 1e12]", "of the run"},
          {"scaling", "choice sweep", "", "\"strong\"", "strong, weak",
           "`particles` are those of the run, or of each node"},
          {"lease_particles", "integer sweep", "", "64", "[1, 1e9]",
           "of one batch, which is one lease"},
          {"lease_s", "number sweep", "s", "120", "(0, 1e6]",
           "a batch that is not back by then is lent to another"},
          {"crash_s", "number sweep", "s", "0", "[0, 1e6]",
           "of simulated time: when a node crashes; 0: none does"},
      }};
}

TableSpec plot_table() {
  return {"plot",
          "`[[plot]]`: a curve for each combination of what else is varied",
          {
              {"name", "name", "", "required", "", "of its file, NAME.svg"},
              {"title", "text", "", "required", "", "above it"},
              {"x", "text", "", "required", "", "a key of `[sweep]`"},
              {"y", "text", "", "required", "", "a column of the results"},
              {"log_x", "flag", "", "false", "", "a logarithmic axis"},
              {"log_y", "flag", "", "false", "", "likewise"},
              {"explain", "text", "", "required", "", "how to read it"},
          }};
}

TableSpec costs_table() {
  const auto cost = [](std::string_view name, std::string_view unit, std::string_view meaning) {
    return KeySpec{name, "number", unit, "required", "[0, 1e12]", meaning};
  };
  return {
      "costs",
      "A file of costs, as `luxodus study calibrate` writes it",
      {
          cost("particle_ns", "ns", "of a particle by itself: its birth, its part of a portion"),
          cost("ray_ns", "ns", "of a flight"),
          cost("collision_ns", "ns", "of one with a medium, on top"),
          cost("reference_ns", "ns", "of an object that a ray looks into, where resident"),
          cost("look_ns", "ns", "of a unit of paths from the eye, its references aside"),
          cost("switch_ns", "ns", "of a fiber that runs and suspends"),
          cost("turn_ns", "ns", "of a turn of a node's loop"),
          cost("build_ns", "ns", "of building any object"),
          cost("build_byte_ns", "ns", "on top, of each byte as it travels"),
          cost("lease_ns", "ns", "of a batch that is opened, closed and merged"),
          cost("pack_byte_ns", "ns", "of a flush, at the worker, of each byte"),
          cost("count_byte_ns", "ns", "likewise, at the controller"),
          cost("receive_ns", "ns", "of a frame that is received"),
          cost("send_ns", "ns", "of a frame that is sent"),
          cost("frame_byte_ns", "ns", "of each byte of it, at either end"),
          cost("wake_ns", "ns", "until a node that rests sees what has come"),
          cost("rest_ns", "ns", "of going to rest and waking again, on its own processor"),
          {"machine", "text", "", "\"\"", "", "what it was measured on"},
          {"scene", "text", "", "\"\"", "", "likewise: costs of tracing are a scene's"},
      }};
}

}  // namespace

const toml::Schema& study_schema() {
  static const toml::Schema schema{{top_table(), sweep_table(), plot_table(), costs_table()},
                                   config::text_rules()};
  return schema;
}

}  // namespace luxodus

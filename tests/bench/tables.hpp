// The tables that luxodus_bench prints, one function each. README.md explains the columns. One
// thread.
#pragma once

#include <string>

namespace luxodus::bench {

/// Particles and rays per second of whole runs, and their share of bare Embree; `repeats` pairs
/// each.
void print_speed(int repeats);
/// Two threads against one, wall time.
void print_threads(int repeats);
/// Bytes per triangle, patch and voxel of a scene of 2 n^2 triangles.
void print_memory(int n);
/// Nanoseconds of the small functions on the path of every ray.
void print_pieces(int repeats);
/// Nanoseconds of the runtime's own operations: switches, messages, timers.
void print_switch(int repeats);
/// CPU time of routes: for a whole graph, and for one node after a link change.
void print_routes(int repeats);
/// Nanoseconds per free flight and per optical depth, by kind of media.
void print_flights();
/// Hit rates of nodes for scene parts, and what they fetch, with and without a profile: for the
/// office floor, or a packed scene of ten times a node's budget.
void print_residency(const std::string& pack);
/// Fetches and builds of a room full of smoke data, with sharing and without.
void print_smoke();
/// Runs on nodes against the plain loop, everything resident.
void print_nodes(int repeats);
/// Runs on nodes that fetch, with and without a delay on their links, by fibers.
void print_delay(int repeats);
/// Size and cost of flushes of a large scene, by their interval.
void print_flushes(int repeats);

/// Gain in figure of merit of each sampling method over the plain weighted game, on the scenes with
/// this name prefix.
void print_merit(int turns, const std::string& scene);
/// Errors of pictures against a long run, by paths and seconds, and by patch size; with a share of
/// the particles and of the long picture's paths.
void print_images(double share);
/// Errors over several seeds against one long picture, by final gather only; a few bright paths
/// decide the error of one.
void print_image_seeds(double share);
/// Bias of pictures that end in patches and voxels, by voxel size, on the scenes with this name
/// prefix; with a share of the particles and of the paths.
void print_bias(double share, const std::string& scene);
/// Gain of paths of all bands over paths of one, and colour errors of filtered pictures; with a
/// share of the particles and of the long picture's paths.
void print_colours(double share);
/// Gain of paths that choose emitters by learned importance of cells of space; with a share of the
/// particles and paths.
void print_choice(double share);
/// Time and variance of a picture path, by view; with a share of the particles and paths.
void print_views(double share);
/// CPU seconds of pictures of a furnished room to an error of 10 %, in clear air and in smoke; with
/// a share of the particles and of the long picture's paths.
void print_rooms(double share);
/// Cost of each scene feature: absent, unused and used.
void print_features(int repeats);
/// Gain of adaptively allocated batches; with a share of the particles.
void print_allocation(double share);
/// Layouts of luminaires by greedy choice, by the integer program and by a genetic algorithm; with
/// a share of a minute for each of the last two.
void print_layouts(double share);
/// Gain of equal random numbers in the comparison of two variants of a scene.
void print_edits();

}  // namespace luxodus::bench

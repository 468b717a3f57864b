// The tables that luxodus_bench prints, one function each. What each column means: README.md beside
// this.
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
/// Nanoseconds of the small pieces that every ray passes.
void print_pieces(int repeats);
/// Nanoseconds of the runtime's own steps: switches, messages, timers.
void print_switch(int repeats);
/// What routes take: of a whole graph, and of one node after a link has changed.
void print_routes(int repeats);
/// Nanoseconds of a free flight and of an optical depth, by kind of media.
void print_flights();
/// How often nodes find parts of a scene resident, and what they fetch, with and without a profile:
/// of the office floor, or of a pack of a scene that is ten times what a node may hold.
void print_residency(const std::string& pack);
/// What nodes fetch and build of a room full of smoke data, with sharing and without.
void print_smoke();
/// Runs on nodes against the plain loop, everything resident.
void print_nodes(int repeats);
/// Runs on nodes that fetch, with and without a delay on their links, by fibers.
void print_delay(int repeats);
/// What flushes of a large scene send and cost, by their interval.
void print_flushes(int repeats);

/// What each way of sampling gains in figure of merit over the plain weighted game, on the scenes
/// whose names begin so.
void print_merit(int turns, const std::string& scene);
/// How far pictures are from a long run, by paths and seconds, and by the size of patches; with a
/// share of the particles and of the long picture's paths.
void print_images(double share);
/// The same of several seeds, against one long picture, by final gather alone; a few bright paths
/// decide the error of one.
void print_image_seeds(double share);
/// How far pictures that end in patches and voxels are off in the mean, by the voxels' edge, on the
/// scenes whose names begin so; with a share of the particles and of the paths.
void print_bias(double share, const std::string& scene);
/// What paths of all bands gain over paths of one, and how true colours of filtered pictures are;
/// with a share of the particles and of the long picture's paths.
void print_colours(double share);
/// What paths gain that choose emitters by what cells of space have learned; of a share of the
/// particles and paths.
void print_choice(double share);
/// Time and variance of a path of pictures, by view; of a share of the particles and paths.
void print_views(double share);
/// Processor seconds that pictures of a furnished room take to an error of 10 %, in clear air and
/// in smoke; with a share of the particles and of the long picture's paths.
void print_rooms(double share);
/// What each feature of a scene costs where it is absent, unused and used.
void print_features(int repeats);
/// What batches dealt to source groups by need gain; with a share of the particles.
void print_allocation(double share);
/// Layouts of luminaires by greedy choice, by the integer program and by a genetic algorithm; with
/// a share of a minute for each of the last two.
void print_layouts(double share);
/// What the same random numbers gain where two variants of a scene are compared.
void print_edits();

}  // namespace luxodus::bench

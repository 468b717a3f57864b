// Part of compile: materials per band, surfaces, triangles with their flux patches, and geometry
// cells.
#pragma once

#include <span>

#include "scenes/light/transport/compile_light.hpp"

namespace luxodus {

/// Surface models of every material in every band; the last material is the dark back of signs.
void compile_materials(CompiledScene& scene);

/// The faces of all signs: frames in local coordinates, luminances and reflectances per band.
void compile_sign_faces(CompiledScene& scene);

/// Surfaces of objects (doors moved as the scenario says), sign faces and emitter bodies.
/// Degenerate triangles were dropped on reading; what single precision makes degenerate is dropped
/// here and counted in the warnings.
/// Errors: more flux patches than are counted; nothing was taken for them.
Result<void> compile_triangles(CompiledScene& scene, int cells);

/// The same of a scene whose triangles are in a pack.
/// Errors: a scenario whose doors stand otherwise than where it was packed.
Result<void> adopt_packed_geometry(CompiledScene& scene);

/// Shares of a diffuse reflection by surface, side and band, as integers.
void compile_lambert_fractions(CompiledScene& scene);

/// The meshes as the scenario has them, in scene coordinates: bounds of everything solid.
Bounds solid_bounds(const SceneDescription& description, const Scenario& scenario);

}  // namespace luxodus

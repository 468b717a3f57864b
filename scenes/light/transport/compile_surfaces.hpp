// Part of compile: materials per band, surfaces, triangles with their flux patches, and geometry
// cells. One thread.
#pragma once

#include <span>

#include "scenes/light/transport/compile_light.hpp"

namespace luxodus {

/// Surface models of every material in every band; the last material is that of sign backs.
void compile_materials(CompiledScene& scene);

/// The faces of all signs: frames in local coordinates, luminances and reflectances per band.
void compile_sign_faces(CompiledScene& scene);

/// Surfaces of objects (doors turned as the scenario says), sign faces and emitter bodies.
/// Degenerate triangles were dropped on reading; triangles that become degenerate in single
/// precision are dropped here and counted in the warnings.
/// Errors: more flux patches than the limit; checked before memory is taken for them.
Result<void> compile_triangles(CompiledScene& scene, int cells);

/// Takes the geometry of a scene whose triangles are in a pack.
/// Errors: a scenario whose doors differ from those of the pack.
Result<void> adopt_packed_geometry(CompiledScene& scene);

/// Lambertian reflectance by surface, side and band, as integer fractions.
void compile_lambert_fractions(CompiledScene& scene);

/// Bounds of all solids: the meshes as the scenario has them, in scene coordinates.
Bounds solid_bounds(const SceneDescription& description, const Scenario& scenario);

}  // namespace luxodus

using System.Collections.Immutable;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Scenes.Lights;

/// <summary>
/// The irradiance of a sky divided by π, for unit normals n: a + b·n.y + c·n.y², and for a sky that differs from side to side the six
/// terms of <see cref="Sides"/> besides. Linear light.
/// </summary>
/// <param name="Constant">The term a.</param>
/// <param name="Linear">The factor b.</param>
/// <param name="Quadratic">The factor c.</param>
/// <param name="Sides">
/// Factors of n.x, n.z, n.x·n.y, n.y·n.z, n.x·n.z and n.x² − n.z²; empty for a sky that is the same on all sides.
/// </param>
public readonly record struct SkyIrradiance(Vector Constant, Vector Linear, Vector Quadratic, ImmutableArray<Vector> Sides);

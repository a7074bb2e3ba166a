using FractalEngine.Core.Approximation.Grammars;
using FractalEngine.Core.Distances;
using FractalEngine.Core.Geometry;

namespace FractalEngine.Parsing.Approximation;

/// <summary>A fractal for a mesh with what was measured on its files, as they are read back.</summary>
/// <param name="Verdict">How good it is.</param>
/// <param name="Grammar">What to write: a base mesh alone where no fractal is better.</param>
/// <param name="Made">All faces that it makes.</param>
/// <param name="Bytes">Size of the fractal file without comments, and of its meshes.</param>
/// <param name="Distance">How far the mesh and it are apart.</param>
/// <param name="VertexDistance">
/// The largest distance of a vertex of either from the nearest of the other, scene units; null where it only approximates.
/// </param>
/// <param name="MatchingVertices">
/// How many vertices of the mesh it has within 1e-6 of the diagonal, of how many at different places; null where it is exact or no fractal.
/// </param>
/// <param name="SameBytes">The simplified mesh of as many bytes, and how far it is from the mesh; null where the fractal is exact.</param>
public sealed record ApproximationResult(
    ApproximationVerdict Verdict,
    MeshGrammar Grammar,
    Mesh Made,
    long Bytes,
    SurfaceDistance Distance,
    double? VertexDistance,
    (int Near, int All)? MatchingVertices,
    (Mesh Mesh, SurfaceDistance Distance)? SameBytes);

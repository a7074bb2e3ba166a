using FractalEngine.Tests.Oracles.Graphs.Models;

namespace FractalEngine.Tests.Oracles.Graphs.Expansion;

/// <summary>An instance of a base mesh.</summary>
/// <param name="Mesh">The base mesh.</param>
/// <param name="Map">From the frame of the mesh to that of the fractal.</param>
/// <param name="Reach">The largest absolute coordinate of the origins of all frames on the way, which rounding is measured against.</param>
internal sealed record PlacedMesh(OracleMesh Mesh, RowMap Map, double Reach);

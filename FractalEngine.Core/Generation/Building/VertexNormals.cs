using System.Collections.Immutable;
using FractalEngine.Core.Geometry.Surfaces;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Generation.Building;

/// <summary>
/// Computes the normals of generated smooth faces: at each corner the mean over the faces of one smoothing group, weighted by area.
/// </summary>
/// <remarks>
/// Generated meshes state their smoothing groups, so that no crease angle has to tell smooth edges from sharp ones as in
/// <see cref="NormalGenerator"/>. Weights by area cost less than those by angle.
/// </remarks>
internal static class VertexNormals
{
    /// <summary>Computes the normals of all smooth faces.</summary>
    /// <param name="positions">Positions of the mesh.</param>
    /// <param name="triangles">Faces of the mesh.</param>
    /// <returns>Normals, [n × 3], and their indices, [faces × 3], −1 for flat faces; both empty when all faces are flat.</returns>
    public static (ImmutableArray<double> Normals, ImmutableArray<int> Indices) Compute(
        List<Vector> positions, List<MeshTriangle> triangles)
    {
        var indexOfCorner = new Dictionary<(int Position, int Smoothing), int>();
        var sums = new List<Vector>();
        var indices = ImmutableArray.CreateBuilder<int>(3 * triangles.Count);
        foreach (var (a, b, c, smoothing) in triangles)
        {
            if (smoothing == 0)
            {
                indices.AddRange(-1, -1, -1);
                continue;
            }

            var start = positions[a.PositionIndex];
            var area = Vector.Cross(positions[b.PositionIndex] - start, positions[c.PositionIndex] - start);
            foreach (var corner in (ReadOnlySpan<MeshCorner>)[a, b, c])
            {
                if (!indexOfCorner.TryGetValue((corner.PositionIndex, smoothing), out var index))
                {
                    index = sums.Count;
                    indexOfCorner[(corner.PositionIndex, smoothing)] = index;
                    sums.Add(Vector.Zero);
                }

                sums[index] += area;
                indices.Add(index);
            }
        }

        if (sums.Count == 0)
        {
            return ([], []);
        }

        var normals = ImmutableArray.CreateBuilder<double>(3 * sums.Count);
        foreach (var sum in sums)
        {
            var normal = sum == Vector.Zero ? Vector.J : sum.UnitVector();
            normals.AddRange(normal.X, normal.Y, normal.Z);
        }

        return (normals.MoveToImmutable(), indices.MoveToImmutable());
    }
}

using System.Collections.Immutable;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Generation;

/// <summary>Normals of smooth faces: at each corner the mean over the faces of one smoothing group, weighted by area.</summary>
internal static class VertexNormals
{
    /// <summary>Normals, [n × 3], and their numbers, [faces × 3], −1 for flat faces; empty when all are flat.</summary>
    public static (ImmutableArray<double> Normals, ImmutableArray<int> Faces) Compute(List<Vector> positions, List<MeshTriangle> triangles)
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
                    index = indexOfCorner[(corner.PositionIndex, smoothing)] = sums.Count;
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

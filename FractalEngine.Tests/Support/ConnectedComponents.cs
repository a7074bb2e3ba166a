using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Tests.Support;

/// <summary>Counts the connected components of the instances of a mesh, where those that share a vertex are connected.</summary>
internal static class ConnectedComponents
{
    public static int Count(IReadOnlyList<AffineMap> instances, Mesh mesh, double tolerance)
    {
        var parents = Enumerable.Range(0, instances.Count).ToArray();
        var firstAt = new Dictionary<(long, long, long, int), int>();
        for (var instance = 0; instance < instances.Count; instance++)
        {
            for (var vertex = 0; vertex < mesh.VertexCount; vertex++)
            {
                var point = (0.25 / tolerance) * (instances[instance] * mesh.Vertex(vertex));
                // Eight grids, shifted by half a cell: two points closer than the tolerance share a cell of at least one.
                for (var grid = 0; grid < 8; grid++)
                {
                    var cell = (Cell(point.X, grid & 1), Cell(point.Y, grid & 2), Cell(point.Z, grid & 4), grid);
                    if (firstAt.TryGetValue(cell, out var other))
                    {
                        parents[FindRoot(parents, instance)] = FindRoot(parents, other);
                    }
                    else
                    {
                        firstAt[cell] = instance;
                    }
                }
            }
        }

        return Enumerable.Range(0, parents.Length).Count(instance => parents[instance] == instance);
    }

    private static long Cell(double coordinate, int shiftBit) => (long)Math.Floor(coordinate + (shiftBit == 0 ? 0 : 0.5));

    private static int FindRoot(int[] parents, int instance)
    {
        while (parents[instance] != instance)
        {
            instance = parents[instance] = parents[parents[instance]];
        }

        return instance;
    }
}

using FractalEngine.Core.Fractals.Levels.Building;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Geometry.Triangles;
using FractalEngine.Core.Maths;

namespace FractalEngine.Tests.Fractals.Levels.Building;

/// <summary>All instances of recursives that call each other, found by following each call. It shares nothing with the hierarchy.</summary>
internal sealed class ExpandedRecursives
{
    private readonly FractalRecursive[] _recursives;
    private readonly List<Instance> _instances = [];
    private readonly List<(Vector A, Vector B, Vector C)> _faces = [];

    public ExpandedRecursives(FractalRecursive[] recursives, int root, long levels)
    {
        _recursives = recursives;
        Add(root, levels, AffineMap.Identity, []);
        foreach (var (mesh, map, _) in _instances)
        {
            for (var face = 0; face < mesh.FaceCount; face++)
            {
                var (a, b, c) = mesh.Face(face);
                _faces.Add((map * a, map * b, map * c));
            }
        }
    }

    public IReadOnlyList<Instance> Instances => _instances;

    public int FaceCount => _faces.Count;

    public BoundingBox Box
    {
        get
        {
            var box = BoundingBox.Empty;
            foreach (var (a, b, c) in _faces)
            {
                box = box.Including(a).Including(b).Including(c);
            }

            return box;
        }
    }

    /// <summary>The distances of all faces from a position.</summary>
    public double[] Distances(Vector position) =>
        [.. _faces.Select(face => Math.Sqrt(TriangleKernel.ClosestPoint(position, face.A, face.B, face.C).DistanceSquared))];

    /// <summary>The triangle that a result names.</summary>
    public (Vector A, Vector B, Vector C) FaceOf(ReadOnlySpan<int> path, int face)
    {
        foreach (var (mesh, map, instancePath) in _instances)
        {
            if (path.SequenceEqual(instancePath))
            {
                var (a, b, c) = mesh.Face(face);
                return (map * a, map * b, map * c);
            }
        }

        throw new KeyNotFoundException($"no instance has the path {string.Join(' ', path.ToArray())}");
    }

    private void Add(int recursive, long levels, AffineMap map, int[] path)
    {
        if (levels <= 0)
        {
            _instances.Add(new(_recursives[recursive].BaseMesh, map, path));
            return;
        }

        foreach (var (i, call) in _recursives[recursive].Calls.Index())
        {
            Add(call.Recursive, levels - call.LevelsLess, map * call.Map, [.. path, i]);
        }
    }

    /// <summary>An instance of a base mesh.</summary>
    /// <param name="Mesh">The base mesh.</param>
    /// <param name="Map">From its frame to that of the whole.</param>
    /// <param name="Path">Indices of the calls that lead to it.</param>
    internal readonly record struct Instance(Mesh Mesh, AffineMap Map, int[] Path);
}

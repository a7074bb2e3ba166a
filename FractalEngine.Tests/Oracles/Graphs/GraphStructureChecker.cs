using System.Numerics;
using FractalEngine.Core.Colliders;
using FractalEngine.Core.Fractals;
using FractalEngine.Tests.Oracles.Graphs.Expansion;
using FractalEngine.Tests.Support;
using static FractalEngine.Tests.Oracles.Graphs.GraphMismatch;
using Vector = FractalEngine.Core.Maths.Vector;

namespace FractalEngine.Tests.Oracles.Graphs;

/// <summary>Compares counts, bounds and expansions of a fractal with an expansion.</summary>
internal static class GraphStructureChecker
{
    // Points of either surface that are looked for on the other one.
    private const int SurfacePoints = 10;

    /// <summary>Checks all of them.</summary>
    /// <exception cref="GraphMismatch">Something differs.</exception>
    public static void Check(Fractal fractal, TriangleSoup soup, Random random)
    {
        CheckCounts(fractal, soup);
        if (soup.Triangles.IsEmpty)
        {
            return;
        }

        CheckBounds(fractal, soup);
        CheckFlat(fractal, soup, random);
        var budget = random.Next(1, soup.Instances.Length + 1);
        var cut = fractal.WithMaxInstances(budget);
        ThrowUnless(cut.InstanceCount <= budget, "cut", $"{cut.InstanceCount} instances instead of {budget}");
    }

    /// <summary>Compares the numbers of chains and of their faces, equal ones counted: of all meshes, and of each.</summary>
    private static void CheckCounts(Fractal fractal, TriangleSoup soup)
    {
        ThrowUnless(fractal.InstanceCount == soup.Instances.Length, "instances", $"{fractal.InstanceCount}, not {soup.Instances.Length}");
        var faces = soup.Instances.Sum(static instance => instance.Mesh.FaceCount);
        ThrowUnless(fractal.FaceCount == (BigInteger)faces, "faces", $"{fractal.FaceCount}, not {faces}");
        var meshes = new HitTriangles(fractal, soup).Meshes;
        for (var i = 0; i < meshes.Length; i++)
        {
            var count = soup.Instances.Count(instance => ReferenceEquals(instance.Mesh, meshes[i]));
            var found = fractal.ByMesh[i].InstanceCount;
            ThrowUnless(found == count, "instances of a mesh", $"{found} of mesh {i}, not {count}");
        }
    }

    /// <summary>Compares the box: that of the vertices, the unused ones included or not.</summary>
    private static void CheckBounds(Fractal fractal, TriangleSoup soup)
    {
        var vertices = soup.Instances.SelectMany(static instance => instance.Mesh.Vertices.Select(instance.Map.Apply)).ToArray();
        var (low, high) = (vertices.Aggregate(Vector.Min), vertices.Aggregate(Vector.Max));
        // A tenth of it is promised.
        var margin = 1e-12 * Math.Max(soup.Reach, Math.Max(TriangleSoup.Largest(low), TriangleSoup.Largest(high))) * Vector.One;
        var box = fractal.Bounds;
        ThrowUnless(
            IsBelow(box.Minimum, soup.Minimum + margin) && IsBelow(soup.Maximum - margin, box.Maximum)
            && IsBelow(low - margin, box.Minimum) && IsBelow(box.Maximum, high + margin),
            "bounds", $"{box}, not {soup.Minimum} to {soup.Maximum}");
    }

    /// <summary>Compares the mesh of all distinct faces: no more than there are, and the same surface.</summary>
    private static void CheckFlat(Fractal fractal, TriangleSoup soup, Random random)
    {
        var flat = fractal.Flatten(soup.Triangles.Length);
        ThrowUnless(flat.FaceCount <= soup.Triangles.Length, "flat", $"{flat.FaceCount} faces, not {soup.Triangles.Length}");
        // It expands the fractal too.
        var collider = Collider.For(fractal, ColliderKind.Hierarchy);
        var tolerance = 1e-12 * soup.Reach;
        for (var i = 0; i < SurfacePoints; i++)
        {
            var (u, v) = random.Barycentrics();
            var (a, b, c) = flat.Face(random.Next(flat.FaceCount));
            var off = soup.FindClosest(a + (u * (b - a)) + (v * (c - a))).Distance;
            ThrowUnless(off <= tolerance, "flat", $"a face is {off:R} off all");
            var missing = collider.FindClosest(soup.Triangles[random.Next(soup.Triangles.Length)].Point(u, v)).Distance;
            ThrowUnless(missing <= tolerance, "flat", $"a face is missing, by {missing:R}");
        }
    }

    private static bool IsBelow(Vector v1, Vector v2) => v1.X <= v2.X && v1.Y <= v2.Y && v1.Z <= v2.Z;
}

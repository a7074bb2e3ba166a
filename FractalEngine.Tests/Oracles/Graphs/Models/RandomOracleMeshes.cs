using System.Collections.Immutable;
using FractalEngine.Core.Maths;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Oracles.Graphs.Models;

/// <summary>Draws base meshes: closed, open, flat, thin, far away, without area, small and large.</summary>
internal static class RandomOracleMeshes
{
    /// <summary>Draws different meshes.</summary>
    /// <param name="random">The numbers.</param>
    /// <param name="count">How many.</param>
    /// <param name="isForImages">Whether they have to be closed and of ordinary size.</param>
    public static ImmutableArray<OracleMesh> Create(Random random, int count, bool isForImages)
    {
        List<OracleMesh> meshes = [.. OracleMesh.ShapeNames.Select(OracleMesh.Shape)];
        for (var i = 1; i <= count;)
        {
            var (vertices, indices) = isForImages ? CreateClosed(random) : CreateAny(random);
            if (!meshes.Exists(mesh => mesh.Vertices.SequenceEqual(vertices) && mesh.Indices.SequenceEqual(indices)))
            {
                meshes.Add(new($"m{i}", $"{(random.Next(3) == 0 ? "meshes/" : "")}m{i}.obj", [.. vertices], [.. indices]));
                i++;
            }
        }

        return [.. meshes[^count..]];
    }

    private static (Vector[] Vertices, int[] Indices) CreateAny(Random random)
    {
        var (vertices, indices) = random.Draw<Func<Random, (Vector[], int[])>>(
            (6, CreateClosed), (4, CreatePatch), (5, CreateFlat), (3, CreateTriangle), (3, CreateNeedles), (2, CreateWithoutArea))(random);
        if (random.Happens(12))
        {
            // A far corner of some triangle.
            vertices[random.Next(vertices.Length)] += Math.Pow(10, random.Next(2, 8)) * random.Direction();
        }

        if (random.Happens(5))
        {
            // A far vertex that no triangle has.
            vertices = [.. vertices, Math.Pow(10, random.Next(1, 8)) * random.Direction()];
        }

        var factor = random.Draw((12, 1.0), (1, Math.Pow(10, random.Next(-6, 0))), (1, Math.Pow(10, random.Next(1, 5))));
        var offset = random.Draw((8, Vector.Zero), (2, Round(random.Vector(3))), (1, Round(random.Vector(1000))));
        return ([.. vertices.Select(v => factor * (v + offset))], indices);
    }

    /// <summary>Creates an octahedron, a cuboid or a tetrahedron, each with moved corners at times.</summary>
    private static (Vector[] Vertices, int[] Indices) CreateClosed(Random random)
    {
        var roughness = random.Next(2) * 0.2;
        var (vertices, indices) = random.Draw<(Vector[], int[])>(
            (1, ([new(1, 0, 0), new(-1, 0, 0), new(0, 1, 0), new(0, -1, 0), new(0, 0, 1), new(0, 0, -1)],
                [0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4, 2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5])),
            (1, ([new(-0.5, -0.5, -0.5), new(0.5, -0.5, -0.5), new(-0.5, 0.5, -0.5), new(0.5, 0.5, -0.5),
                new(-0.5, -0.5, 0.5), new(0.5, -0.5, 0.5), new(-0.5, 0.5, 0.5), new(0.5, 0.5, 0.5)],
                [0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 4, 2, 4, 6, 2, 1, 3, 5, 3, 7, 5, 2, 6, 3, 3, 6, 7, 0, 1, 4, 1, 5, 4])),
            (1, ([new(1, 1, 1), new(1, -1, -1), new(-1, 1, -1), new(-1, -1, 1)], [0, 1, 2, 0, 2, 3, 0, 3, 1, 1, 3, 2])));
        return ([.. vertices.Select(v => v + Round(random.Vector(roughness)))], indices);
    }

    /// <summary>Creates an open grid over the plane of x and z.</summary>
    private static (Vector[] Vertices, int[] Indices) CreatePatch(Random random) => CreateGrid(random, height: 0.3);

    /// <summary>Creates a mesh whose vertices all lie in one plane: along axes exactly, else to rounding.</summary>
    private static (Vector[] Vertices, int[] Indices) CreateFlat(Random random)
    {
        var (vertices, indices) = random.Next(2) == 0 ? CreateGrid(random, height: 0) : CreateNeedlesIn(random, height: 0);
        var level = random.Draw((2, 0.0), (2, 0.7), (1, random.Between(-3, 3)));
        var (right, up) = (random.Direction(), random.Direction());
        var turn = random.Draw<Func<Vector, Vector>>(
            (3, static v => v),
            (2, static v => new(v.Y, v.X, v.Z)),
            (2, static v => new(v.X, v.Z, v.Y)),
            (3, v => (v.X * right) + (v.Z * up)));
        return ([.. vertices.Select(v => turn(v + (level * Vector.J)))], indices);
    }

    private static (Vector[] Vertices, int[] Indices) CreateTriangle(Random random) =>
        ([Round(random.Vector()), Round(random.Vector()), Round(random.Vector())], [0, 1, 2]);

    private static (Vector[] Vertices, int[] Indices) CreateNeedles(Random random) =>
        CreateNeedlesIn(random, height: Math.Pow(10, random.Next(-9, 0)));

    private static (Vector[] Vertices, int[] Indices) CreateNeedlesIn(Random random, double height)
    {
        var (start, end) = (random.Vector(), random.Vector());
        var width = Math.Pow(10, random.Next(-8, 0));
        List<Vector> vertices = [start, end];
        List<int> indices = [];
        for (var i = random.Next(1, 4); i >= 0; i--)
        {
            indices.AddRange([0, 1, vertices.Count]);
            vertices.Add(start + (random.Between(-0.5, 1.5) * (end - start)) + (width * random.Direction()));
        }

        return ([.. vertices.Select(v => new Vector(v.X, height * v.Y, v.Z))], [.. indices]);
    }

    /// <summary>Creates triangles of which some are segments or points.</summary>
    private static (Vector[] Vertices, int[] Indices) CreateWithoutArea(Random random)
    {
        var (a, b, c) = (Round(random.Vector()), Round(random.Vector()), Round(random.Vector()));
        return random.Next(3) switch
        {
            0 => ([a, b, 0.5 * (a + b), c], [0, 1, 2, 0, 1, 3]),
            1 => ([a, b, c], [0, 0, 1, 0, 1, 2, 2, 2, 2]),
            _ => ([Vector.Zero, new(1, 2, 3), new(0.5, 1, 1.5)], [0, 1, 2]),
        };
    }

    private static (Vector[] Vertices, int[] Indices) CreateGrid(Random random, double height)
    {
        var (columns, rows) = (random.Next(1, 4), random.Next(1, 4));
        // Regular ones have edges along the axes, and equal coordinates.
        var roughness = random.Next(2) * 0.3;
        List<Vector> vertices = [];
        List<int> indices = [];
        for (var vertex = 0; vertex < (columns + 1) * (rows + 1); vertex++)
        {
            var (column, row) = (vertex % (columns + 1), vertex / (columns + 1));
            vertices.Add(new Vector(column, 0, row) + random.Vector().Stretch(new(roughness, height, roughness)));
            if (column < columns && row < rows)
            {
                var (b, c, d) = (vertex + 1, vertex + columns + 1, vertex + columns + 2);
                indices.AddRange(random.Next(2) == 0 ? [vertex, d, b, vertex, c, d] : [vertex, c, b, b, c, d]);
            }
        }

        return ([.. vertices], [.. indices]);
    }

    private static Vector Round(Vector v) => new(Math.Round(v.X, 3), Math.Round(v.Y, 3), Math.Round(v.Z, 3));
}

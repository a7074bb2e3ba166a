using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Generation;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Parsing.Assets;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Recorded;

/// <summary>The shapes of the recorded tables: the project's own fractals, meshes of all generators, and what breaks bounds.</summary>
internal static class RecordedShapes
{
    private const int RandomCount = 45;
    private const int MaxChain = 50;

    /// <summary>Fractals by their names: those of the assets, and drawn ones in both compositions, some without end.</summary>
    public static IEnumerable<(string Name, Fractal Fractal)> Fractals()
    {
        var files = Directory.GetFiles(Repository.Full("assets/fractals"), "*.fdo").Order(StringComparer.Ordinal);
        foreach (string file in files)
        {
            yield return (Path.GetFileName(file), ((FractalModel)AssetLoader.Load(file).Scene.Models.Single()).Fractal);
        }

        for (int seed = 1; seed <= RandomCount; seed++)
        {
            yield return ($"shape {seed}", RandomShapes.Create(new(seed), 2000, 8000));
        }

        for (int seed = 1; seed <= 6; seed++)
        {
            yield return ($"sums {seed}", RandomFractals.Create(new(seed), Composition.Componentwise));
            yield return ($"infinite {seed}", RandomFractals.Create(new(seed), infinite: true));
        }
    }

    /// <summary>Meshes by their names: one of each generator, and drawn ones.</summary>
    public static IEnumerable<(string Name, Mesh Mesh)> Meshes()
    {
        foreach (var generator in MeshGenerators.All)
        {
            yield return (generator.Name, generator.Create(7, 700));
        }

        for (int seed = 1; seed <= 20; seed++)
        {
            yield return ($"mesh {seed}", RandomMeshes.Create(new(seed)));
        }
    }

    /// <summary>Positions in and around a box and far away, and every second one near a face.</summary>
    public static Vector[] Positions(Func<Random, Vector> target, BoundingBox box, int seed, int count)
    {
        var random = new Random(seed);
        return [.. Enumerable.Range(0, count).Select(i => i % 2 == 0
            ? target(random) + (0.01 * box.Diagonal * random.Vector())
            : box.Centre + ((i % 8 == 1 ? 15 : i % 8 == 3 ? 2 : 0.55) * random.Vector().Stretch(box.Size)))];
    }

    /// <summary>All shapes by their names, with what draws a face of them.</summary>
    public static IEnumerable<(string Name, Model Model, Func<Random, (Vector A, Vector B, Vector C)> Face)> Faces() =>
        Fractals().Where(static shape => shape.Fractal.BaseMesh.FaceCount > 0)
            .Select(static shape => (shape.Name, (Model)new FractalModel(shape.Fractal), FacesOf(shape.Fractal)))
            .Concat(Meshes().Where(static shape => shape.Mesh.FaceCount > 0)
                .Select(static shape => (shape.Name, (Model)new MeshModel(shape.Mesh), FacesOf(shape.Mesh))));

    /// <summary>Draws a point on a face of a mesh.</summary>
    public static Func<Random, Vector> TargetsOf(Mesh mesh) => random => PointOf(FacesOf(mesh)(random), random);

    /// <summary>Draws a point on a face of an instance of a fractal; of one that is composed componentwise, a point nearby.</summary>
    public static Func<Random, Vector> TargetsOf(Fractal fractal)
    {
        var onMesh = TargetsOf(fractal.BaseMesh);
        var instance = InstancesOf(fractal);
        return random => instance(random) * onMesh(random);
    }

    private static Func<Random, (Vector A, Vector B, Vector C)> FacesOf(Mesh mesh) => random => mesh.Face(random.Next(mesh.FaceCount));

    private static Func<Random, (Vector A, Vector B, Vector C)> FacesOf(Fractal fractal)
    {
        var onMesh = FacesOf(fractal.BaseMesh);
        var instance = InstancesOf(fractal);
        return random =>
        {
            var map = instance(random);
            var (a, b, c) = onMesh(random);
            return (map * a, map * b, map * c);
        };
    }

    private static Vector PointOf((Vector A, Vector B, Vector C) face, Random random)
    {
        var (u, v) = random.Barycentrics();
        return face.A + (u * (face.B - face.A)) + (v * (face.C - face.A));
    }

    private static Func<Random, AffineMap> InstancesOf(Fractal fractal) => random =>
    {
        var map = AffineMap.Identity;
        for (long level = 0; level < Math.Min(fractal.LevelCount ?? MaxChain, MaxChain); level++)
        {
            var maps = fractal.LevelAt(level).Maps;
            map = map * maps[random.Next(maps.Length)];
        }

        return map;
    };
}

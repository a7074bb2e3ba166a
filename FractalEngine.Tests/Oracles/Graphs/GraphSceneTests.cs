using FractalEngine.Core.Colliders;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Rays;
using FractalEngine.Core.SceneQueries;
using FractalEngine.Core.Scenes;
using FractalEngine.Parsing;
using FractalEngine.Parsing.Assets;
using FractalEngine.Tests.Oracles.Graphs.Expansion;
using FractalEngine.Tests.Oracles.Graphs.Models;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Oracles.Graphs;

/// <summary>Random files as objects of scenes, under placements that stretch, turn and mirror.</summary>
public class GraphSceneTests
{
    [Fact]
    public void Answers_OfPlacedFiles_AreThoseOfAllTriangles() => Seeded.RunMost(30, random => Check(random, 10, 10), minShare: 0.8);

    [Fact]
    [Trait("Category", "Soak")]
    public void Answers_OfManyPlacedFiles_AreThoseOfAllTriangles() =>
        Seeded.RunMostInParallel(1000, random => Check(random, 50, 50), minShare: 0.8);

    private static bool Check(Random random, int points, int rays)
    {
        var (file, instances) = RandomGraphFiles.Create(random, new());
        MapLeaf.Placement placement = new(random.Vector(5), random.Degrees(), 2 * random.Transformation().Scale);
        var map = RowMap.Of(placement);
        TriangleSoup soup = new([.. instances.Select(instance => instance with
        {
            Map = map.After(instance.Map),
            // The frames of the fractal under the placement, and that of the placement itself.
            Reach = 2 * Math.Max(instance.Reach, TriangleSoup.Largest(map.Translation)),
        })]);
        if (soup.Triangles.IsEmpty)
        {
            return false;
        }

        var texts = GraphTexts.Of(file, random);
        using TemporaryFolder folder = new();
        var path = texts.WriteTo(folder);
        var (position, rotation, scale) = (placement.Position!.Value, placement.Rotation!.Value, placement.Scale!.Value);
        folder.Write("a.sdo", $"o \"main.fdo\" ({Format(position)}, {Format(rotation)}, {Format(scale)})\n");
        var scene = AssetLoader.Load(folder["a.sdo"]).Scene;
        var fractal = ((FractalModel)scene.Objects[0].Model).Fractal;
        Assert.Equal(FractalFile.Read(path), fractal);
        GraphQueries queries = new(random, soup);
        var collider = Collider.For(scene);
        GraphRayChecker checker = new(RayCaster.For(scene), fractal, soup);
        for (var i = 0; i < points; i++)
        {
            var query = queries.DrawPosition();
            var (distance, _, index) = soup.FindClosest(query);
            // As without a placement, see GraphChecker.
            var tolerance = 1e-12 * Math.Max(TriangleSoup.Largest(query) + distance, soup.Triangles[index].Reach);
            var found = collider.FindClosest(query);
            var isRight = Math.Abs(found.Distance - distance) <= tolerance
                && soup.FindClosest(found.Point).Distance <= 1e-12 * Math.Max(TriangleSoup.Largest(query) + distance, soup.Reach);
            GraphMismatch.ThrowUnless(isRight, "scene", $"{found.Distance:R} from {QueryText.Of(query)}, not {distance:R}\n{texts}");
        }

        for (var i = 0; i < rays; i++)
        {
            checker.Check(i % 2 == 0 ? queries.DrawPlainRay() : queries.DrawAimedRay(), isAimed: i % 2 == 1);
        }

        return true;
    }

    private static string Format(Vector v) => FormattableString.Invariant($"({v.X:R}, {v.Y:R}, {v.Z:R})");
}

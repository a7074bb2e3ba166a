using FractalEngine.Benchmarks.Measuring;
using FractalEngine.Core.Collision;
using FractalEngine.Core.Collision.Bvh;
using FractalEngine.Core.Collision.Fractals;
using FractalEngine.Core.Collision.Reference;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;

namespace FractalEngine.Benchmarks.Paper;

/// <summary>What the colliders look at for a query near the surface of a model, and how often the two that approximate are wrong.</summary>
/// <param name="Simple">Face tests.</param>
/// <param name="Fractal">Face tests; null for a mesh.</param>
/// <param name="Boxes">Face tests, counted as the paper counts: see <see cref="BoundingBoxCollider"/>.</param>
/// <param name="BoxDepth">Levels of the octree.</param>
/// <param name="Exact">Face and bound tests of the engine's own collider: the hierarchy for a mesh, the exact one for a fractal.</param>
/// <param name="FractalWrong">Percent of the answers that are off by more than 1e-6 of the size; null for a mesh.</param>
/// <param name="BoxesWrong">The same.</param>
internal sealed record PaperCollision(
    double Simple, double? Fractal, double Boxes, int BoxDepth, (double Faces, double Bounds) Exact, double? FractalWrong,
    double BoxesWrong)
{
    private const int Queries = 1000;
    private const int SimpleQueries = 2;
    private const int MostFaces = 50_000_000;

    // As a part of the size; in the other table the same.
    private const double Wrong = 1e-6;

    /// <summary>Counts. Fractals are expanded for the colliders that know only meshes: a few GB for the largest.</summary>
    public static PaperCollision Of(Model model)
    {
        var fractal = (model as FractalModel)?.Fractal;
        var random = new Random(1);
        var positions = Enumerable.Range(0, Queries)
            .Select(_ => fractal is null ? QueryPositions.Near(random, model.Mesh) : QueryPositions.Near(random, fractal)).ToArray();
        var mesh = fractal is null ? model.Mesh : FractalGenerator.Flatten(fractal, MostFaces);
        var boxes = new BoundingBoxCollider(mesh);
        Collider exact = fractal is null ? new HierarchyCollider(mesh) : new ExactFractalCollider(fractal);
        var greedy = fractal is null ? null : new FractalCollider(fractal);
        return new(
            new AskedCollider(new SimpleCollider(mesh), positions[..SimpleQueries]).FaceTests,
            greedy is null ? null : new AskedCollider(greedy, positions).FaceTests,
            new AskedCollider(boxes, positions).FaceTests,
            boxes.Depth,
            new AskedCollider(exact, positions) switch { var asked => (asked.FaceTests, asked.BoundTests) },
            greedy is null ? null : PercentWrong(greedy, exact, positions, model.Bounds),
            PercentWrong(boxes, exact, positions, model.Bounds));
    }

    private static double PercentWrong(Collider collider, Collider exact, Vector[] positions, BoundingBox bounds)
    {
        var record = new QueryContext();
        return Math.Round(100.0
            * positions.Count(position => Math.Abs(Distance(collider, position, record) - Distance(exact, position, record)) > Wrong
                * bounds.Diagonal) / positions.Length, 3);
    }

    private static double Distance(Collider collider, Vector position, QueryContext record) =>
        collider.TryFindClosest(position, double.PositiveInfinity, record, out var closest) ? closest.Distance : double.PositiveInfinity;
}

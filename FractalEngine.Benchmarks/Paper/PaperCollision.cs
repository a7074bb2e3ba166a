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
/// <param name="SimpleFaceTests">Face tests.</param>
/// <param name="FractalFaceTests">Face tests; null for a mesh.</param>
/// <param name="BoundingBoxFaceTests">Face tests, counted as the paper counts: see <see cref="BoundingBoxCollider"/>.</param>
/// <param name="OctreeDepth">Levels of the octree.</param>
/// <param name="ExactTests">
/// Face and bound tests of the engine's own collider: the hierarchy for a mesh, the exact one for a fractal.
/// </param>
/// <param name="FractalWrongPercent">Percent of the answers that are off by more than 1e-6 of the size; null for a mesh.</param>
/// <param name="BoundingBoxWrongPercent">The same.</param>
internal sealed record PaperCollision(
    double SimpleFaceTests, double? FractalFaceTests, double BoundingBoxFaceTests, int OctreeDepth,
    (double Faces, double Bounds) ExactTests, double? FractalWrongPercent,
    double BoundingBoxWrongPercent)
{
    private const int Queries = 1000;
    private const int SimpleQueries = 2;
    private const int MaxFaces = 50_000_000;

    // As a part of the size; in the other table the same.
    private const double MaxRelativeError = 1e-6;

    /// <summary>Counts. Fractals are expanded for the colliders that know only meshes: a few GB for the largest.</summary>
    public static PaperCollision Measure(Model model)
    {
        var fractal = (model as FractalModel)?.Fractal;
        var random = new Random(1);
        var positions = Enumerable.Range(0, Queries)
            .Select(_ => fractal is null ? QueryPositions.NearSurface(random, model.Mesh) : QueryPositions.NearSurface(random, fractal))
            .ToArray();
        var mesh = fractal is null ? model.Mesh : FractalGenerator.Flatten(fractal, MaxFaces);
        var boxes = new BoundingBoxCollider(mesh);
        Collider exact = fractal is null ? new HierarchyCollider(mesh) : new ExactFractalCollider(fractal);
        var greedy = fractal is null ? null : new FractalCollider(fractal);
        return new(
            new ColliderWorkload(new SimpleCollider(mesh), positions[..SimpleQueries]).FaceTests,
            greedy is null ? null : new ColliderWorkload(greedy, positions).FaceTests,
            new ColliderWorkload(boxes, positions).FaceTests,
            boxes.Depth,
            new ColliderWorkload(exact, positions) switch { var workload => (workload.FaceTests, workload.BoundTests) },
            greedy is null ? null : MeasureWrongPercent(greedy, exact, positions, model.Bounds),
            MeasureWrongPercent(boxes, exact, positions, model.Bounds));
    }

    private static double MeasureWrongPercent(Collider collider, Collider exact, Vector[] positions, BoundingBox bounds)
    {
        var context = new QueryContext();
        return Math.Round(100.0
            * positions.Count(
                position => Math.Abs(Distance(collider, position, context) - Distance(exact, position, context)) > MaxRelativeError
                * bounds.Diagonal) / positions.Length, 3);
    }

    private static double Distance(Collider collider, Vector position, QueryContext context) =>
        collider.TryFindClosest(position, double.PositiveInfinity, context, out var closest) ? closest.Distance : double.PositiveInfinity;
}

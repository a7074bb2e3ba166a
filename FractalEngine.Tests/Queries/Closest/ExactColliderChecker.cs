using System.Globalization;
using FractalEngine.Core.Colliders;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Geometry.Triangles;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Queries;
using FractalEngine.Tests.Fractals;
using FractalEngine.Tests.Support;
using Xunit.Sdk;

namespace FractalEngine.Tests.Queries.Closest;

/// <summary>
/// Checks results of the exact collider on a fractal against distances that were found by other means. Safe for concurrent use.
/// </summary>
/// <param name="name">The fractal and its depth, for messages of failures.</param>
/// <param name="fractal">A fractal in affine composition.</param>
internal sealed class ExactColliderChecker(string name, Fractal fractal)
{
    /// <summary>
    /// Relative error of a distance, as a part of the largest coordinate: some last places over a chain of some maps.
    /// </summary>
    public const double Tolerance = 1e-12;

    // A point is known less well than its distance, since it may move along a thin triangle.
    private const double PointTolerance = 1e-9;

    /// <summary>The fractal that is checked.</summary>
    public Fractal Fractal { get; } = fractal;

    /// <summary>The exact collider of the fractal.</summary>
    public ExactFractalCollider Collider { get; } = new(fractal);

    /// <summary>Creates a collider that tests every face of a fractal.</summary>
    /// <param name="fractal">The fractal, which is expanded.</param>
    /// <param name="limit">Maximum number of faces.</param>
    public static Collider BruteForce(Fractal fractal, long limit = 10_000_000) =>
        new SimpleCollider(FractalGenerator.Flatten(fractal, limit));

    /// <summary>Queries a position, and fails unless all of the result is right.</summary>
    /// <param name="position">Position of the query, finite.</param>
    /// <param name="context">The context of the thread.</param>
    /// <param name="expected">The closest distance.</param>
    public ClosestPoint CheckQuery(Vector position, QueryContext context, double expected)
    {
        var size = FractalPositions.Magnitude(Fractal, position);
        var found = Collider.TryFindClosest(position, double.PositiveInfinity, context, out var closest);
        ThrowUnless(found, position, "nothing found");
        ThrowUnless(Math.Abs(closest.Distance - expected) <= Tolerance * size, position,
            $"distance {closest.Distance:R}, not {expected:R}, of size {size}");
        CheckResult(position, context, closest);
        return closest;
    }

    /// <summary>Fails unless the point, the normal, the barycentrics and the instance of a result belong together.</summary>
    public void CheckResult(Vector position, QueryContext context, ClosestPoint closest)
    {
        var size = FractalPositions.Magnitude(Fractal, position);
        ThrowUnless(Math.Abs((closest.Point - position).Length() - closest.Distance) <= PointTolerance * size, position,
            $"point {closest.Point} is not at distance {closest.Distance:R}");
        ThrowUnless(Math.Abs(closest.Normal.Length() - 1) <= 1e-12, position, $"normal {closest.Normal}");
        var map = FindInstanceMap(position, context);
        var (a, b, c) = Fractal.BaseMesh.Face(closest.FaceIndex);
        var (weightA, weightB, weightC) = closest.Barycentrics;
        var isWeight = Math.Min(weightA, Math.Min(weightB, weightC)) >= 0 && Math.Abs(weightA + weightB + weightC - 1) <= 1e-12;
        ThrowUnless(isWeight, position, $"weights {closest.Barycentrics}");
        (a, b, c) = (map * a, map * b, map * c);
        var point = (weightA * a) + (weightB * b) + (weightC * c);
        ThrowUnless(Near.Difference(point, closest.Point) <= Tolerance * size, position,
            $"weights give {point} on instance {FormatPath(context)}, not {closest.Point}");
        // A thin triangle's normal is less certain, but by much less than this.
        var ab = b - a;
        var ac = c - a;
        var isPerpendicular = Math.Abs(Vector.Dot(closest.Normal, ab)) <= 1e-6 * ab.Length()
            && Math.Abs(Vector.Dot(closest.Normal, ac)) <= 1e-6 * ac.Length();
        var isPoint = ab.Length() + ac.Length() < Tolerance * size;
        ThrowUnless(isPerpendicular || isPoint, position, $"normal {closest.Normal} is not that of the face");
    }

    /// <summary>
    /// Queries again with search radii just above and just below the distance that is known to be right. Here a bound that is a little too
    /// large culls the closest instance; without a radius it mostly changes only the order of instances.
    /// </summary>
    public void CheckMaxDistance(Vector position, QueryContext context, double distance)
    {
        var size = FractalPositions.Magnitude(Fractal, position);
        var maxDistance = distance + (Tolerance * size);
        ThrowUnless(Collider.TryFindClosest(position, maxDistance, context, out var closest), position,
            $"nothing within {maxDistance:R}, though it is at {distance:R}");
        ThrowUnless(Math.Abs(closest.Distance - distance) <= Tolerance * size, position,
            $"distance {closest.Distance:R} within {maxDistance:R}, not {distance:R}");
        var justBelow = distance - (Tolerance * size);
        ThrowUnless(justBelow < 0 || !Collider.TryFindClosest(position, justBelow, context, out closest), position,
            $"found at {closest.Distance:R} within {justBelow:R}");
    }

    /// <summary>Fails with the fractal and the position unless a condition holds.</summary>
    public void ThrowUnless(bool condition, Vector position, FormattableString message)
    {
        if (!condition)
        {
            throw new XunitException(string.Create(
                CultureInfo.InvariantCulture,
                $"{name}, position new({position.X:R}, {position.Y:R}, {position.Z:R}): {message.ToString(CultureInfo.InvariantCulture)}"));
        }
    }

    private void ThrowUnless(bool condition, Vector position, string message) =>
        ThrowUnless(condition, position, (FormattableString)$"{message}");

    private AffineMap FindInstanceMap(Vector position, QueryContext context)
    {
        var map = AffineMap.Identity;
        for (var level = 0; level < context.InstancePath.Length; level++)
        {
            map *= Fractal.LevelAt(level).Maps[context.InstancePath[level]];
        }

        // A path may end early where the rest is below the precision, or where only identities follow.
        var isSmall = BoundingSphere.OperatorNormBound(map.Linear) * Fractal.BaseMesh.Bounds.Diagonal
            <= Tolerance * Fractal.Bounds.Diagonal;
        var pathLength = context.InstancePath.Length;
        var hasIdentities = Fractal.LevelCount is not { } count || Enumerable.Range(pathLength, (int)Math.Min(100, count - pathLength))
            .All(level => Fractal.LevelAt(level).Maps.Contains(AffineMap.Identity));
        ThrowUnless(isSmall || pathLength == Fractal.LevelCount || (Fractal.LevelCount is null or > 2000 && hasIdentities), position,
            $"the path ends at {FormatPath(context)}");
        return map;
    }

    private static string FormatPath(QueryContext context) => $"[{string.Join(", ", context.InstancePath.ToArray())}]";
}

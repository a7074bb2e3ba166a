using FractalEngine.Core.Generation;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;

namespace FractalEngine.Core.Physics.Descriptions;

/// <summary>Fits the balls of a compound to a model: to points all over a mesh, or over the box of a fractal.</summary>
internal static class CompoundFit
{
    // Points of the surface besides the vertices, to which balls are fitted.
    private const int MaxPoints = 4000;
    private const int MaxPointsPerSide = 64;

    // Rounds of Lloyd's method: each moves the centres to the middle of the points that they are closest to.
    private const int MaxRounds = 50;

    // Only so many points tell where the centres are; the balls contain all of them.
    private const int MaxFittedPoints = 50_000;

    /// <summary>Fits a shape to a placed model.</summary>
    /// <param name="placed">The object with its model.</param>
    /// <param name="shape">Balls or a capsule.</param>
    /// <returns>The shape in world axes about the object's position; null for a model without size.</returns>
    /// <exception cref="ArgumentException">The model is too long for a capsule of its width.</exception>
    public static CompoundShape? Fit(PlacedModel placed, BodyShape shape)
    {
        var linear = placed.ObjectToWorld.Linear;
        var mesh = placed.Model is FractalModel fractal ? Shapes.Box(fractal.Bounds) : placed.Model.Mesh;
        var points = PointsOf(mesh, linear);
        if (points.Count == 0 || !points.TrueForAll(static point => point.IsFinite()))
        {
            return null;
        }

        return shape.IsCapsule ? FitCapsule(points, linear, placed.Model.Bounds.Size) : FitBalls(points, shape.BallCount);
    }

    /// <summary>All vertices, and points in a grid on each face: the more, the larger its share of the surface is.</summary>
    private static List<Vector> PointsOf(Mesh mesh, Matrix linear)
    {
        var points = new List<Vector>();
        var area = 0.0;
        for (var face = 0; face < mesh.FaceCount; face++)
        {
            var (a, b, c) = mesh.Face(face);
            area += Vector.Cross(linear * (b - a), linear * (c - a)).Length();
        }

        for (var face = 0; face < mesh.FaceCount; face++)
        {
            var (a, b, c) = mesh.Face(face);
            var share = Vector.Cross(linear * (b - a), linear * (c - a)).Length() / area;
            var sides = double.IsFinite(share) ? (int)Math.Clamp(Math.Sqrt(2 * MaxPoints * share), 1, MaxPointsPerSide) : 1;
            for (var i = 0; i <= sides; i++)
            {
                for (var j = 0; j <= sides - i; j++)
                {
                    var (u, v) = (i / (double)sides, j / (double)sides);
                    points.Add(linear * (((1 - u - v) * a) + (u * b) + (v * c)));
                }
            }
        }

        return points;
    }

    private static CompoundShape? FitCapsule(List<Vector> points, Matrix linear, Vector size)
    {
        Vector[] sides = [size.X * linear.V1, size.Y * linear.V2, size.Z * linear.V3];
        var longest = sides.MaxBy(static side => side.Length());
        if (longest == Vector.Zero)
        {
            return null;
        }

        var axis = longest.UnitVector();
        var minimum = points.Aggregate(Vector.Min);
        var maximum = points.Aggregate(Vector.Max);
        var middle = 0.5 * (minimum + maximum);
        double Along(Vector point) => Vector.Dot(point - middle, axis);
        double Across(Vector point) => (point - middle - (Along(point) * axis)).Length();
        var radius = points.Max(Across);
        // As short as it may be: each point is within the radius of the segment's ends.
        double End(Vector point) => Math.Abs(Along(point)) - Math.Sqrt(Math.Max(0, (radius * radius) - (Across(point) * Across(point))));
        var before = points.Where(point => Along(point) < 0).Select(End).Append(0).Max();
        var behind = points.Where(point => Along(point) > 0).Select(End).Append(0).Max();
        return radius > 0 ? CompoundShape.Capsule(middle - (before * axis), middle + (behind * axis), radius) : null;
    }

    private static CompoundShape? FitBalls(List<Vector> points, int count)
    {
        var nearest = new int[points.Count];
        var centres = FindCentres(points, count, nearest);
        Assign(points, centres, nearest);
        var radii = new double[count];
        for (var i = 0; i < nearest.Length; i++)
        {
            radii[nearest[i]] = Math.Max(radii[nearest[i]], (points[i] - centres[nearest[i]]).Length());
        }

        var balls = Enumerable.Range(0, count).Where(ball => radii[ball] > 0)
            .Select(ball => new CompoundBall(centres[ball], radii[ball])).ToArray();
        return balls.Length > 0 ? CompoundShape.OfBalls(balls) : null;
    }

    /// <summary>Finds centres by Lloyd's method, of all points or of as many as take no time, evenly chosen.</summary>
    /// <param name="points">The points.</param>
    /// <param name="count">Number of centres.</param>
    /// <param name="nearest">Room for an index for each point.</param>
    private static Vector[] FindCentres(List<Vector> points, int count, int[] nearest)
    {
        var stride = ((points.Count - 1) / MaxFittedPoints) + 1;
        var fitted = stride == 1 ? points : points.Where((_, i) => i % stride == 0).ToList();
        var centres = Spread(fitted, count);
        var hasChanged = true;
        for (var round = 0; round < MaxRounds && hasChanged; round++)
        {
            hasChanged = Assign(fitted, centres, nearest);
            MoveToMiddles(centres, fitted, nearest);
        }

        return centres;
    }

    /// <summary>Moves each centre to the middle of its points.</summary>
    private static void MoveToMiddles(Vector[] centres, List<Vector> points, int[] nearest)
    {
        var sums = new Vector[centres.Length];
        var counts = new int[centres.Length];
        for (var i = 0; i < points.Count; i++)
        {
            sums[nearest[i]] += points[i];
            counts[nearest[i]]++;
        }

        for (var ball = 0; ball < centres.Length; ball++)
        {
            centres[ball] = counts[ball] > 0 ? sums[ball] / counts[ball] : centres[ball];
        }
    }

    /// <summary>
    /// Chooses centres far from each other: each is the point farthest from those before, and the first one that from the middle.
    /// </summary>
    private static Vector[] Spread(List<Vector> points, int count)
    {
        var middle = points.Aggregate((sum, point) => sum + point) / points.Count;
        var distances = points.Select(point => (point - middle).LengthSquared()).ToArray();
        var centres = new Vector[count];
        for (var ball = 0; ball < count; ball++)
        {
            centres[ball] = points[Array.IndexOf(distances, distances.Max())];
            for (var i = 0; i < distances.Length; i++)
            {
                var distance = (points[i] - centres[ball]).LengthSquared();
                distances[i] = ball == 0 ? distance : Math.Min(distances[i], distance);
            }
        }

        return centres;
    }

    /// <summary>Finds the closest centre of each point.</summary>
    /// <returns>True where one has changed.</returns>
    private static bool Assign(List<Vector> points, Vector[] centres, int[] nearest)
    {
        var hasChanged = false;
        for (var i = 0; i < points.Count; i++)
        {
            var closest = 0;
            for (var ball = 1; ball < centres.Length; ball++)
            {
                closest = (points[i] - centres[ball]).LengthSquared() < (points[i] - centres[closest]).LengthSquared() ? ball : closest;
            }

            hasChanged |= nearest[i] != closest;
            nearest[i] = closest;
        }

        return hasChanged;
    }
}

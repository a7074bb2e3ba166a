using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;

namespace FractalEngine.Core.Physics.Compounds;

/// <summary>Fits the balls of a compound to a model: to points all over a mesh, or over the box of a fractal.</summary>
internal static class CompoundFit
{
    // Points of the surface besides the vertices, to which balls are fitted.
    private const int MaxPoints = 4000;
    private const int MaxPointsPerSide = 64;

    // Rounds of Lloyd's method: each moves the centres to the middle of the points that they are closest to.
    private const int MaxRounds = 50;

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
        var centres = Spread(points, count);
        var nearest = new int[points.Count];
        for (var round = 0; round < MaxRounds && Assign(points, centres, nearest); round++)
        {
            for (var ball = 0; ball < count; ball++)
            {
                var own = points.Where((_, i) => nearest[i] == ball).ToArray();
                centres[ball] = own.Length > 0 ? own.Aggregate((sum, point) => sum + point) / own.Length : centres[ball];
            }
        }

        var balls = new List<CompoundBall>();
        for (var ball = 0; ball < count; ball++)
        {
            var radius = points.Where((_, i) => nearest[i] == ball).Select(point => (point - centres[ball]).Length()).Append(0).Max();
            if (radius > 0)
            {
                balls.Add(new(centres[ball], radius));
            }
        }

        return balls.Count > 0 ? CompoundShape.OfBalls(balls) : null;
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

using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Tests.Oracles.Graphs.Expansion;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Oracles.Graphs;

/// <summary>Draws positions and rays about the triangles of an expansion: ordinary ones, and those that are hard to answer.</summary>
internal sealed class GraphQueries(Random random, TriangleSoup soup)
{
    /// <summary>Draws a position: in and around the whole and its instances, on surfaces, at corners, and far away.</summary>
    public Vector DrawPosition()
    {
        var triangle = DrawTriangle();
        var (u, v) = random.Barycentrics();
        var size = Math.Max(triangle.LongestEdge, 1e-9);
        return random.Next(9) switch
        {
            0 => InBox(0),
            1 => InBox(0.5),
            2 => triangle.Point(u, v),
            3 => triangle.A,
            4 => triangle.B + (u * (triangle.C - triangle.B)),
            5 => triangle.Point(u, v) + (Math.Pow(10, -random.Next(0, 10)) * size * random.Direction()),
            6 => triangle.A + (random.Between(0, 3) * size * random.Direction()),
            7 => Centre + (Math.Pow(10, random.Next(0, 9)) * Size * random.Direction()),
            _ => random.Next(2) == 0 ? Vector.Zero : soup.Instances[triangle.Instance].Map.Translation,
        };
    }

    /// <summary>Draws a ray between random places, which meets edges by chance only.</summary>
    public Ray DrawPlainRay()
    {
        var triangle = DrawTriangle();
        var (u, v) = random.Barycentrics();
        var edge = Math.Max(triangle.LongestEdge, 1e-3 * Size);
        var near = triangle.Point(u, v) + (random.Between(0, 3) * edge * random.Direction());
        var (start, end) = random.Next(4) switch
        {
            0 => (InBox(0.5), InBox(0)),
            1 => (InBox(0.5), near),
            2 => (near, near + random.Direction()),
            // From a place beside a surface, as shadows are.
            _ => (triangle.Point(u, v) + (1e-3 * edge * random.Direction()), InBox(0.5)),
        };
        var direction = random.Next(5) == 0 ? DrawAxis() : end - start;
        return new(start, Scale(direction));
    }

    /// <summary>Draws a ray through corners and edges, from them, in the plane of a triangle, or along an axis through a corner.</summary>
    public Ray DrawAimedRay()
    {
        var (triangle, other) = (DrawTriangle(), DrawTriangle());
        var (u, v) = random.Barycentrics();
        var inPlane = triangle.Point(random.Between(-2, 2), random.Between(-2, 2));
        var (start, end) = random.Next(7) switch
        {
            0 => (InBox(0.5), triangle.A),
            1 => (InBox(0.5), 0.5 * (triangle.A + triangle.B)),
            2 => (triangle.Point(u, v), other.Point(v * (1 - u), u)),
            3 => (triangle.A, other.A),
            4 => (inPlane, triangle.Point(u, v)),
            5 => (triangle.A - (Size * DrawAxis()), triangle.A),
            _ => (triangle.A, triangle.B),
        };
        return new(start, Scale(end - start));
    }

    /// <summary>Draws a box somewhere about a surface.</summary>
    public BoundingBox DrawBox()
    {
        var centre = DrawPosition();
        var size = Math.Pow(10, random.Next(-4, 1)) * Size;
        var half = random.Next(6) == 0 ? Vector.Zero : size * new Vector(random.NextDouble(), random.NextDouble(), random.NextDouble());
        return new(centre - half, centre + half);
    }

    private double Size => Math.Max((soup.Maximum - soup.Minimum).Length(), 1e-9);

    private Vector Centre => soup.Minimum + (0.5 * (soup.Maximum - soup.Minimum));

    private OracleTriangle DrawTriangle() => soup.Triangles[random.Next(soup.Triangles.Length)];

    /// <summary>Draws a position in the box, which is larger by a part of its diagonal on all sides: what is flat too.</summary>
    private Vector InBox(double margin)
    {
        var size = soup.Maximum - soup.Minimum;
        Vector place = new(random.NextDouble(), random.NextDouble(), random.NextDouble());
        return soup.Minimum + size.Stretch(place) + random.Vector(margin * Size);
    }

    private Vector DrawAxis()
    {
        var sign = random.Next(2) == 0 ? 1.0 : -1.0;
        return random.Next(3) switch { 0 => new(sign, 0, -0.0), 1 => new(-0.0, sign, 0), _ => new(0, -0.0, sign) };
    }

    /// <summary>Makes the direction very short or long at times, and another one if it has no length.</summary>
    private Vector Scale(Vector direction)
    {
        var length = direction.Length();
        var factor = random.Draw((12, 1.0), (1, 1e-30), (1, 1e30));
        return length > 1e-100 ? factor * direction : random.Direction();
    }
}

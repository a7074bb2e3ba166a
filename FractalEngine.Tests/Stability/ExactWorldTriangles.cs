using FractalEngine.Core.Fractals;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Tests.Collision;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Stability;

/// <summary>
/// Every face of every instance of a placed shape, in world space by the arrays of <see cref="NaiveFractal"/>, and the distance from them
/// in exact arithmetic. Nothing of it is the engine's.
/// </summary>
internal sealed class ExactWorldTriangles
{
    private readonly (Vector A, Vector B, Vector C, Vector Centre, double Radius)[] _triangles;

    public ExactWorldTriangles(Mesh mesh, IEnumerable<double[][]> maps)
    {
        var faces = mesh.VertexIndices.Chunk(3).ToArray();
        _triangles = [.. from map in maps
                     from face in faces
                     select WithBoundingSphere(NaiveFractal.Apply(map, mesh.Vertex(face[0])), NaiveFractal.Apply(map, mesh.Vertex(face[1])),
                     NaiveFractal.Apply(map, mesh.Vertex(face[2])))];
        Box = NaiveFractal.Box(_triangles.SelectMany(face => new[] { face.A, face.B, face.C }));
    }

    /// <summary>Of all corners.</summary>
    public BoundingBox Box { get; }

    public static ExactWorldTriangles Of(Mesh mesh, Transformation placement) => new(mesh, [NaiveFractal.MapOf(placement)]);

    public static ExactWorldTriangles Of(Fractal fractal, Transformation placement) =>
        new(fractal.BaseMesh, NaiveFractal.Chains(fractal.Description)
        .Select(chain => NaiveFractal.Compose(NaiveFractal.MapOf(placement), chain)));

    /// <summary>What errors are measured against: the larger of the size and of the coordinates.</summary>
    public double Magnitude(Vector position) =>
        Math.Max(Box.Diagonal,
        Math.Max(position.MaxAbsComponent(), Math.Max(Box.Minimum.MaxAbsComponent(), Box.Maximum.MaxAbsComponent())));

    /// <summary>Exact for these corners. Faces whose balls are farther than what was found are left out.</summary>
    public double Distance(Vector position)
    {
        var margin = 1e-12 * Magnitude(position);
        var closest = double.PositiveInfinity;
        foreach (var (bound, (a, b, c, _, _)) in _triangles.Select(
            face => (Bound: (position - face.Centre).Length() - face.Radius - margin, face)).OrderBy(item => item.Bound))
        {
            if (bound > closest)
            {
                break;
            }

            closest = Math.Min(closest, ExactTriangleDistance.Distance(position, a, b, c));
        }

        return closest;
    }

    /// <summary>Anywhere around it: near, far, in corners, on edges and faces, in its middle.</summary>
    public Vector RandomPosition(Random random)
    {
        var (a, b, c, centre, radius) = _triangles[random.Next(_triangles.Length)];
        var (u, v) = (random.NextDouble(), random.NextDouble());
        (u, v) = u + v > 1 ? (1 - u, 1 - v) : (u, v);
        var inside = a + (u * (b - a)) + (v * (c - a));
        return random.Next(8) switch
        {
            0 => Box.Centre + (Math.Pow(10, random.Between(0, 6)) * Box.Diagonal * random.Direction()),
            1 => Box.Centre,
            2 => a,
            3 => 0.5 * (a + b),
            4 => inside,
            5 => inside + (Math.Pow(10, random.Between(-14, 0)) * radius * random.Direction()),
            6 => centre + (radius * random.Direction()),
            _ => Box.Centre + Box.Size.Stretch(random.Vector()),
        };
    }

    private static (Vector A, Vector B, Vector C, Vector Centre, double Radius) WithBoundingSphere(Vector a, Vector b, Vector c) =>
        ((a + b + c) / 3) switch
    {
        var centre => (a, b, c, centre, Math.Max((a - centre).Length(), Math.Max((b - centre).Length(), (c - centre).Length()))),
    };
}

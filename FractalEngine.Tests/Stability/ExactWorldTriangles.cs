using FractalEngine.Benchmarks.Measuring;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Tests.Colliders;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Stability;

/// <summary>
/// Every triangle of every instance of a placed shape, in world space by the arrays of <see cref="NaiveFractal"/>, and the distance from
/// them in exact arithmetic. It shares no arithmetic with the engine.
/// </summary>
internal sealed class ExactWorldTriangles
{
    private readonly (Vector A, Vector B, Vector C, Vector Centre, double Radius)[] _triangles;

    public ExactWorldTriangles(Mesh mesh, IEnumerable<double[][]> maps)
    {
        var faces = mesh.VertexIndices.Chunk(3).ToArray();
        _triangles =
        [
            .. from map in maps
               from face in faces
               let corners = face.Select(vertex => NaiveFractal.Apply(map, mesh.Vertex(vertex))).ToArray()
               select WithBoundingSphere(corners[0], corners[1], corners[2]),
        ];
        Box = NaiveFractal.Box(_triangles.SelectMany(face => new[] { face.A, face.B, face.C }));
    }

    /// <summary>Bounding box of all vertices.</summary>
    public BoundingBox Box { get; }

    public static ExactWorldTriangles Of(Mesh mesh, Transformation placement) => new(mesh, [NaiveFractal.MapOf(placement)]);

    public static ExactWorldTriangles Of(Fractal fractal, Transformation placement)
    {
        var chains = NaiveFractal.Chains(fractal.Description);
        return new(fractal.BaseMesh, chains.Select(chain => NaiveFractal.Compose(NaiveFractal.MapOf(placement), chain)));
    }

    /// <summary>Returns what errors are measured against: the larger of the size and the largest coordinate.</summary>
    public double Magnitude(Vector position)
    {
        double[] sizes = [Box.Diagonal, position.MaxAbsComponent(), Box.Minimum.MaxAbsComponent(), Box.Maximum.MaxAbsComponent()];
        return sizes.Max();
    }

    /// <summary>
    /// Computes the distance that is exact for these vertices. Triangles whose bounding spheres are farther than the closest one are
    /// skipped.
    /// </summary>
    public double Distance(Vector position)
    {
        var margin = 1e-12 * Magnitude(position);
        var closest = double.PositiveInfinity;
        var bounded = _triangles.Select(face => (Bound: (position - face.Centre).Length() - face.Radius - margin, Face: face));
        foreach (var (bound, face) in bounded.OrderBy(item => item.Bound))
        {
            if (bound > closest)
            {
                break;
            }

            closest = Math.Min(closest, ExactTriangleDistance.Distance(position, face.A, face.B, face.C));
        }

        return closest;
    }

    /// <summary>Creates a position anywhere around the shape: close, far, on vertices, edges and faces, or in its middle.</summary>
    public Vector RandomPosition(Random random)
    {
        var (a, b, c, centre, radius) = _triangles[random.Next(_triangles.Length)];
        var inside = QueryPositions.InTriangle(random, a, b, c);
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

    private static (Vector A, Vector B, Vector C, Vector Centre, double Radius) WithBoundingSphere(Vector a, Vector b, Vector c)
    {
        var centre = (a + b + c) / 3;
        return (a, b, c, centre, Math.Max((a - centre).Length(), Math.Max((b - centre).Length(), (c - centre).Length())));
    }
}

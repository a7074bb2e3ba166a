using System.Numerics;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Geometry.Triangles;
using FractalEngine.Core.Maths;
using FractalEngine.Tests.Colliders;
using Vector = FractalEngine.Core.Maths.Vector;

namespace FractalEngine.Tests.Queries.Closest;

/// <summary>
/// All triangles of a small fractal, with maps composed in exact arithmetic and vertices rounded once. It shares no search, no bound and no
/// composition with the colliders.
/// </summary>
internal sealed class ExactExpansion
{
    private readonly List<(Vector A, Vector B, Vector C, double Reach)> _triangles = [];

    public ExactExpansion(Fractal fractal)
    {
        var mesh = fractal.BaseMesh;
        List<(ExactMap Map, double Reach)> chains = [(ExactMap.Of(AffineMap.Identity), 0)];
        for (var level = 0L; level < fractal.LevelCount; level++)
        {
            var maps = fractal.LevelAt(level).Maps;
            chains = [.. from chain in chains
                         from map in maps
                         let composed = chain.Map.Then(map)
                         select (composed, Math.Max(chain.Reach, composed.Translation().MaxAbsComponent()))];
        }

        foreach (var (map, chainReach) in chains)
        {
            for (var face = 0; face < mesh.FaceCount; face++)
            {
                var (a, b, c) = mesh.Face(face);
                var reach = new[] { a, b, c }.Max(vertex => vertex.MaxAbsComponent());
                (a, b, c) = (map.Apply(a), map.Apply(b), map.Apply(c));
                reach = new[] { a, b, c }.Select(vertex => vertex.MaxAbsComponent()).Append(reach).Append(chainReach).Max();
                _triangles.Add((a, b, c, reach));
            }
        }
    }

    /// <summary>A vertex of a triangle.</summary>
    public Vector RandomVertex(Random random) => _triangles[random.Next(_triangles.Count)].A;

    /// <summary>Finds the closest distance, and the largest absolute coordinate on the way to the triangle.</summary>
    public (double Distance, double Reach) FindClosest(Vector position)
    {
        // The engine's kernel sorts; the closest few are decided exactly.
        var candidates = _triangles.Select(triangle => (Triangle: triangle, Rough: Rough(position, triangle.A, triangle.B, triangle.C)))
            .OrderBy(item => item.Rough).Take(4);
        return candidates
            .Select(item => (ExactTriangleDistance.Distance(position, item.Triangle.A, item.Triangle.B, item.Triangle.C),
                Math.Max(item.Triangle.Reach, position.MaxAbsComponent())))
            .Min();
    }

    private static double Rough(Vector position, Vector a, Vector b, Vector c) =>
        TriangleKernel.ClosestPoint(position, a, b, c).DistanceSquared;

    /// <summary>A map whose entries are integers times powers of two.</summary>
    private sealed record ExactMap(ExactNumber[] Entries)
    {
        public static ExactMap Of(AffineMap map)
        {
            var (v1, v2, v3) = map.Linear;
            var t = map.Translation;
            return new([.. new[] { v1.X, v2.X, v3.X, t.X, v1.Y, v2.Y, v3.Y, t.Y, v1.Z, v2.Z, v3.Z, t.Z }.Select(ExactNumber.Of)]);
        }

        public ExactMap Then(AffineMap next)
        {
            var inner = Of(next).Entries;
            var product = new ExactNumber[12];
            for (var row = 0; row < 3; row++)
            {
                for (var column = 0; column < 4; column++)
                {
                    var sum = column == 3 ? Entries[(4 * row) + 3] : default;
                    for (var k = 0; k < 3; k++)
                    {
                        sum += Entries[(4 * row) + k] * inner[(4 * k) + column];
                    }

                    product[(4 * row) + column] = sum;
                }
            }

            return new(product);
        }

        public Vector Translation() => new(Entries[3].ToDouble(), Entries[7].ToDouble(), Entries[11].ToDouble());

        public Vector Apply(Vector v)
        {
            ExactNumber[] point = [ExactNumber.Of(v.X), ExactNumber.Of(v.Y), ExactNumber.Of(v.Z)];
            return new(Row(0), Row(4), Row(8));

            double Row(int first) => ((Entries[first] * point[0]) + (Entries[first + 1] * point[1]) + (Entries[first + 2] * point[2])
                + Entries[first + 3]).ToDouble();
        }
    }

    /// <summary>An integer times a power of two.</summary>
    private readonly record struct ExactNumber(BigInteger Mantissa, int Exponent)
    {
        public static ExactNumber Of(double value)
        {
            if (value == 0)
            {
                return default;
            }

            var exponent = Math.ILogB(value) - 52;
            return new(new(Math.ScaleB(Math.ScaleB(value, -exponent / 2), -exponent - (-exponent / 2))), exponent);
        }

        public static ExactNumber operator *(ExactNumber a, ExactNumber b) => new(a.Mantissa * b.Mantissa, a.Exponent + b.Exponent);

        public static ExactNumber operator +(ExactNumber a, ExactNumber b) => a.Mantissa.IsZero ? b
            : b.Mantissa.IsZero ? a
            : a.Exponent <= b.Exponent ? new(a.Mantissa + (b.Mantissa << (b.Exponent - a.Exponent)), a.Exponent)
            : b + a;

        public double ToDouble()
        {
            // 64 bits suffice to round to 53, but for ties, which a bit for the rest decides.
            var length = (int)BigInteger.Abs(Mantissa).GetBitLength();
            var shift = Math.Max(0, length - 64);
            var top = Mantissa >> shift;
            var hasRest = top << shift != Mantissa;
            return Math.ScaleB((double)((top << 1) + (hasRest ? 1 : 0)), Exponent + shift - 1);
        }
    }
}

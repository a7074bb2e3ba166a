using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Tests.Physics.Rigid;

/// <summary>Volume, centre and inertia of closed surfaces, as sums over the tetrahedra between their faces and the origin.</summary>
internal sealed class SolidMoments
{
    private Vector _first;
    private Matrix _second = 0 * Matrix.Identity;

    public double Volume { get; private set; }

    public Vector Centre => _first / Volume;

    /// <summary>Of one kilogram about the centre.</summary>
    public Matrix Inertia
    {
        get
        {
            var second = (_second / Volume) + (-1 * Matrix.Outer(Centre, Centre));
            return ((second.V1.X + second.V2.Y + second.V3.Z) * Matrix.Identity) + (-1 * second);
        }
    }

    public static SolidMoments Of(Mesh mesh, params IEnumerable<AffineMap> maps)
    {
        var moments = new SolidMoments();
        foreach (var map in maps)
        {
            // A mirror turns all faces inside out.
            var sign = Math.Sign(map.Linear.Determinant());
            foreach (var (a, b, c) in PhysicsMeshes.TrianglesOf(mesh))
            {
                moments.AddTetrahedron(sign, map * a, map * b, map * c);
            }
        }

        return moments;
    }

    private void AddTetrahedron(int sign, Vector a, Vector b, Vector c)
    {
        var volume = sign * Vector.Dot(a, Vector.Cross(b, c)) / 6;
        var sum = a + b + c;
        Volume += volume;
        _first += 0.25 * volume * sum;
        _second += volume / 20 * (Matrix.Outer(sum, sum) + Matrix.Outer(a, a) + Matrix.Outer(b, b) + Matrix.Outer(c, c));
    }
}

using System.Numerics;
using FractalEngine.Core.Fractals.Levels;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Geometry.Hulls;
using FractalEngine.Core.Geometry.Surfaces;
using FractalEngine.Core.Maths;
using Vector = FractalEngine.Core.Maths.Vector;

namespace FractalEngine.Core.Fractals;

/// <summary>
/// Integrals over a solid of density 1: of 1, of the position and of its products. They are linear in the solid, so that the integrals of
/// a fractal follow from those of its base mesh level by level.
/// </summary>
/// <param name="Volume">Cubic scene units; what overlaps counts twice.</param>
/// <param name="FirstMoment">Integral of the position, scene units⁴.</param>
/// <param name="SecondMoment">Integral of the outer product of the position with itself, scene units⁵.</param>
internal readonly record struct MassProperties(double Volume, Vector FirstMoment, Matrix SecondMoment)
    : IAdditionOperators<MassProperties, MassProperties, MassProperties>
{
    // Relative to the cube of the diagonal: a smaller volume is that of rounding.
    private const double MinVolume = 1e-9;

    /// <summary>True where there is a volume to speak of in a box.</summary>
    public bool IsSolidWithin(BoundingBox box) => Volume > MinVolume * box.Diagonal * box.Diagonal * box.Diagonal;

    /// <summary>The centre of mass, scene units.</summary>
    public Vector Centre => FirstMoment / Volume;

    /// <summary>Inertia tensor of one kilogram about the centre of mass, scene units².</summary>
    public Matrix Inertia
    {
        get
        {
            var centre = Centre;
            var spread = (SecondMoment / Volume) + (-1 * Matrix.Outer(centre, centre));
            return ((spread.V1.X + spread.V2.Y + spread.V3.Z) * Matrix.Identity) + (-1 * spread);
        }
    }

    public static MassProperties operator +(MassProperties first, MassProperties second) => new(
        first.Volume + second.Volume, first.FirstMoment + second.FirstMoment, first.SecondMoment + second.SecondMoment);

    /// <summary>The integrals over the image of the solid under a map; mirrors keep the volume positive.</summary>
    public MassProperties Transform(in AffineMap map)
    {
        var factor = Math.Abs(map.Linear.Determinant());
        var moment = map.Linear * FirstMoment;
        var (shift, linear) = (map.Translation, map.Linear);
        return new(
            factor * Volume,
            factor * (moment + (Volume * shift)),
            factor * ((linear * SecondMoment * linear.Transpose()) + Matrix.Outer(moment, shift) + Matrix.Outer(shift, moment)
                + (Volume * Matrix.Outer(shift, shift))));
    }

    /// <summary>Integrates over a closed mesh, by its tetrahedra about the middle of its box.</summary>
    /// <param name="triangles">The faces, wound outwards.</param>
    /// <param name="origin">A point near the mesh, for accuracy.</param>
    public static MassProperties Of(IEnumerable<(Vector A, Vector B, Vector C)> triangles, Vector origin)
    {
        var sum = default(MassProperties);
        foreach (var triangle in triangles)
        {
            var (a, b, c) = (triangle.A - origin, triangle.B - origin, triangle.C - origin);
            var volume = Vector.Dot(a, Vector.Cross(b, c)) / 6;
            var corners = a + b + c;
            sum += new MassProperties(
                volume, 0.25 * volume * corners,
                0.05 * volume * (Matrix.Outer(a, a) + Matrix.Outer(b, b) + Matrix.Outer(c, c) + Matrix.Outer(corners, corners)));
        }

        return sum.Transform(AffineMap.Translate(origin));
    }

    /// <summary>Integrates over a mesh, or over its convex hull where it is not closed.</summary>
    /// <param name="mesh">Used vertices must be finite.</param>
    /// <param name="isClosed">Receives whether the mesh counts itself.</param>
    public static MassProperties Of(Mesh mesh, out bool isClosed)
    {
        isClosed = ClosedSurface.IsSolid(mesh);
        if (isClosed)
        {
            return Of(Enumerable.Range(0, mesh.FaceCount).Select(mesh.Face), mesh.UsedBounds.Centre);
        }

        var points = mesh.VertexIndices.Distinct().Select(mesh.Vertex).ToArray();
        var hull = points.Length > 0 ? ConvexHull.Build(points, points.Length + 4) : null;
        return hull is null ? default : Of(hull.Triangles, hull.Vertices[0]);
    }

    /// <summary>Sums over all instances of a fractal, by recurrence over its levels.</summary>
    /// <param name="hierarchy">With finitely many levels.</param>
    /// <param name="isClosed">Receives whether all base meshes are closed; the hulls of others count.</param>
    /// <returns>Null where the fractal has too many different parts.</returns>
    public static MassProperties? Of(FractalHierarchy hierarchy, out bool isClosed)
    {
        var areClosed = true;
        var sum = LevelSums.Of(
            hierarchy,
            index =>
            {
                var properties = Of(hierarchy.BaseMeshes[index], out var isBaseClosed);
                areClosed &= isBaseClosed;
                return properties;
            },
            static (properties, child) => properties.Transform(child.Map));
        isClosed = areClosed;
        return sum;
    }
}

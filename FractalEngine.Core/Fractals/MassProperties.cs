using FractalEngine.Core.Fractals.Levels;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Geometry.Hulls;
using FractalEngine.Core.Geometry.Surfaces;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Fractals;

/// <summary>
/// Integrals over a solid of density 1: of 1, of the position and of its products. They are linear in the solid, so that the integrals of
/// a fractal follow from those of its base mesh level by level.
/// </summary>
/// <param name="Volume">Cubic scene units; what overlaps counts twice.</param>
/// <param name="FirstMoment">Integral of the position, scene units⁴.</param>
/// <param name="SecondMoment">Integral of the outer product of the position with itself, scene units⁵.</param>
internal readonly record struct MassProperties(double Volume, Vector FirstMoment, Matrix SecondMoment)
{
    // States of a fractal that are summed up at most: some 100 ms.
    private const int MaxStates = 100_000;

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

    public static MassProperties operator +(in MassProperties first, in MassProperties second) => new(
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
        var states = FindStates(hierarchy);
        isClosed = true;
        if (states is null)
        {
            return null;
        }

        var sums = new Dictionary<LevelState, MassProperties>();
        foreach (var state in states)
        {
            if (hierarchy.IsBase(state.Level))
            {
                sums[state] = Of(hierarchy.BaseMeshes[hierarchy.At(state.Level).BaseIndex], out var isBaseClosed);
                isClosed &= isBaseClosed;
            }
            else
            {
                sums[state] = Sum(hierarchy, hierarchy.At(state.Level), state, sums);
            }
        }

        return sums[hierarchy.Start];
    }

    /// <summary>Lists the states that the whole fractal consists of, base meshes first.</summary>
    private static SortedSet<LevelState>? FindStates(FractalHierarchy hierarchy)
    {
        var order = Comparer<LevelState>.Create(
            static (state1, state2) => (state1.Level, state1.Way, state1.Size).CompareTo((state2.Level, state2.Way, state2.Size)));
        var states = new SortedSet<LevelState>(order) { hierarchy.Start };
        var open = new Stack<(SubFractal Part, LevelState State)>([(hierarchy.Root, hierarchy.Start)]);
        while (open.TryPop(out var next) && states.Count <= MaxStates)
        {
            foreach (var child in hierarchy.IsBase(next.State.Level) ? [] : next.Part.Children)
            {
                var state = hierarchy.Enter(child, next.State);
                if (child.Group is not null || states.Add(state))
                {
                    open.Push((hierarchy.At(child, state.Level), state));
                }
            }
        }

        return states.Count <= MaxStates ? states : null;
    }

    private static MassProperties Sum(
        FractalHierarchy hierarchy, SubFractal part, LevelState state, Dictionary<LevelState, MassProperties> sums)
    {
        var sum = default(MassProperties);
        foreach (var child in part.Children)
        {
            sum += child.Group is { } group
                ? Sum(hierarchy, group, state, sums) : sums[hierarchy.Enter(child, in state)].Transform(child.Map);
        }

        return sum;
    }
}

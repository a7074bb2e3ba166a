using FractalEngine.Core.Bvh;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Fractals.Levels;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Core.Physics.Statics;
using FractalEngine.Core.Queries.Regions;
using FractalEngine.Core.Scenes;

namespace FractalEngine.Core.Physics.Rigid;

/// <summary>
/// The surface of bodies or objects of one shape, as searches see it: each thread has its own copy of the parts that it has visited.
/// </summary>
/// <param name="create">Makes the tree of the surface.</param>
internal sealed class RigidShape(Func<SurfaceNodes> create)
{
    // Parts that are kept; beyond it, those of places that were visited long ago are given up with all others.
    private const int MaxNodes = 50_000;

    private readonly List<SurfaceNodes?> _nodesOfThread = [];

    /// <summary>A ball of radius 1, which the scale of a motion makes larger or smaller.</summary>
    public static RigidShape CreateBall() => new(static () => new([new((Vector.Zero, Vector.Zero, Vector.Zero), 1)]));

    /// <summary>Makes the surface of a capsule about its middle.</summary>
    /// <param name="start">Centre of one end.</param>
    /// <param name="end">Centre of the other end.</param>
    /// <param name="radius">Scene units.</param>
    public static RigidShape CreateCapsule(Vector start, Vector end, double radius) =>
        new(() => new([new((start, end, end), radius)]));

    /// <summary>Makes the surface of a compound: its balls, or the segment of a capsule.</summary>
    public static RigidShape Of(CompoundShape shape)
    {
        var balls = shape.Balls;
        return shape.IsCapsule ? CreateCapsule(balls[0].Offset, balls[^1].Offset, balls[0].Radius)
            : new(() => new([.. balls.Select(static ball => new SurfaceTriangle((ball.Offset, ball.Offset, ball.Offset), ball.Radius))]));
    }

    /// <summary>Makes the surface of a mesh or fractal about the centre of mass.</summary>
    public static RigidShape Of(MeshShape shape) => new(() => new(TreeOf(shape.Model), new(shape.Linear, -shape.Centre)));

    /// <summary>Makes the surface of an object about its position.</summary>
    public static RigidShape Of(StaticObject target)
    {
        var linear = target.Reference.ObjectToWorld.Linear;
        return new(() => new(TreeOf(target.Model), new(linear, Vector.Zero)));
    }

    /// <summary>Makes room for the copies of so many threads.</summary>
    public void Reserve(int threadCount)
    {
        while (_nodesOfThread.Count < threadCount)
        {
            _nodesOfThread.Add(null);
        }
    }

    /// <summary>Gives up trees that have become too large. Between steps: in one, what has been found names parts of a tree.</summary>
    /// <returns>True where there were any.</returns>
    public bool Trim()
    {
        var hasTrimmed = false;
        for (var thread = 0; thread < _nodesOfThread.Count; thread++)
        {
            if (_nodesOfThread[thread] is { Count: > MaxNodes })
            {
                _nodesOfThread[thread] = null;
                hasTrimmed = true;
            }
        }

        return hasTrimmed;
    }

    /// <summary>The tree of one of the threads.</summary>
    public SurfaceNodes NodesOf(int thread) => _nodesOfThread[thread] ??= create();

    private static ShapeTree TreeOf(Model model) => model switch
    {
        FractalModel { Fractal: { Description.Composition: Composition.Affine, Hierarchy: var hierarchy } } => new(
            hierarchy, Array.ConvertAll(hierarchy.BaseMeshes, TriangleBvh.For), LevelPrecision.MinRadius(hierarchy.Root)),
        FractalModel => model.CreateCollider().ShapeTree,
        _ => new(model.Mesh, TriangleBvh.For(model.Mesh)),
    };
}

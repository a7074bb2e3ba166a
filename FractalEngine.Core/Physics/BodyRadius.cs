using FractalEngine.Core.Collision.Fractals;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;

namespace FractalEngine.Core.Physics;

/// <summary>The radius of an object (paper §4.3.3): the distance of its farthest vertex under its matrix m from m's position.</summary>
internal static class BodyRadius
{
    // Of the radius: fractals are searched until the rest can't add more.
    private const double RelativeTolerance = 1e-9;
    private const int MaxNodes = 50_000;

    /// <summary>
    /// For a mesh exactly the farthest vertex; for a fractal no less than it, by a billionth more, or further where 50,000 sub-fractals do
    /// not tell.
    /// </summary>
    public static double Compute(PlacedModel placed) => placed.Model switch
    {
        FractalModel { Fractal: { Description.Composition: Composition.Affine } fractal } => Compute(fractal, placed.ObjectToWorld.Linear),
        FractalModel { Fractal: var fractal } => FractalGenerator.Expand(fractal, FractalLimits.MaxDrawnInstances)
            .Max(instance => MaxVertexDistance(fractal.BaseMesh, new AffineMap(placed.ObjectToWorld.Linear, Vector.Zero) * instance)),
        _ => MaxVertexDistance(placed.Model.Mesh, new(placed.ObjectToWorld.Linear, Vector.Zero)),
    };

    private static double Compute(Fractal fractal, Matrix linear)
    {
        var table = SubFractalTable.Build(fractal);
        var queue = new PriorityQueue<(SubFractal State, long Levels, AffineMap Map), double>();
        var maxDistance = 0.0;
        Enqueue(table.Root, table.Levels, new(linear, Vector.Zero));
        for (var nodes = 0; queue.TryDequeue(out var node, out var negatedBound); nodes++)
        {
            if (-negatedBound <= maxDistance * (1 + RelativeTolerance) || nodes == MaxNodes)
            {
                return Math.Max(maxDistance, -negatedBound);
            }

            maxDistance = Math.Max(maxDistance, node.Levels == 0 ? MaxVertexDistance(fractal.BaseMesh, node.Map) : 0);
            foreach (var childInstance in node.Levels == 0 ? [] : node.State.Children)
            {
                var childLevels = childInstance.RemainingLevels(node.Levels);
                Enqueue(table.At(childLevels), childLevels, node.Map * childInstance.Map);
            }
        }

        return maxDistance;

        void Enqueue(SubFractal subFractal, long levels, AffineMap map)
        {
            if (!subFractal.Box.IsEmpty)
            {
                queue.Enqueue((subFractal, levels, map), -MaxCornerDistance(subFractal.Box, map));
            }
        }
    }

    private static double MaxCornerDistance(BoundingBox box, AffineMap map)
    {
        var maxDistance = 0.0;
        for (var corner = 0; corner < 8; corner++)
        {
            var point = new Vector(
                (corner & 1) == 0 ? box.Minimum.X : box.Maximum.X, (corner & 2) == 0 ? box.Minimum.Y : box.Maximum.Y, (corner & 4) == 0
                ? box.Minimum.Z
                : box.Maximum.Z);
            maxDistance = Math.Max(maxDistance, (map * point).Length());
        }

        return maxDistance;
    }

    private static double MaxVertexDistance(Mesh mesh, AffineMap map)
    {
        var maxDistance = 0.0;
        for (var vertex = 0; vertex < mesh.VertexCount; vertex++)
        {
            maxDistance = Math.Max(maxDistance, (map * mesh.Vertex(vertex)).Length());
        }

        return maxDistance;
    }
}

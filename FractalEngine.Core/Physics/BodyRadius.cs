using FractalEngine.Core.Collision.Fractals;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;

namespace FractalEngine.Core.Physics;

/// <summary>
/// Computes the radius of a physics object (paper §4.3.3): the distance of its farthest vertex from the position of its matrix m.
/// </summary>
internal static class BodyRadius
{
    // Of the radius: fractals are searched until no remaining part can add more.
    private const double RelativeTolerance = 1e-9;
    private const int MaxNodes = 50_000;

    /// <summary>Computes the radius in scene units; 0 for a model without vertices.</summary>
    /// <returns>
    /// Exact for a mesh. For a fractal an upper bound, greater by a billionth at most, or by more where 50,000 sub-fractals do not decide.
    /// </returns>
    public static double Compute(PlacedModel placed)
    {
        var linear = new AffineMap(placed.ObjectToWorld.Linear, Vector.Zero);
        return placed.Model switch
        {
            FractalModel { Fractal: { Description.Composition: Composition.Affine } fractal } => SearchFractal(fractal, linear),
            FractalModel { Fractal: var fractal } => FractalGenerator.Expand(fractal, FractalLimits.MaxDrawnInstances)
                .Max(instance => MaxVertexDistance(fractal.BaseMesh, linear * instance)),
            _ => MaxVertexDistance(placed.Model.Mesh, linear),
        };
    }

    /// <summary>Searches the sub-fractals best first, those with the farthest corner of their boxes before the others.</summary>
    private static double SearchFractal(Fractal fractal, AffineMap linear)
    {
        var table = SubFractalTable.Build(fractal);
        var queue = new PriorityQueue<(SubFractal SubFractal, long Levels, AffineMap Map), double>();
        var maxDistance = 0.0;
        Enqueue(table.Root, table.Levels, linear);
        for (var nodes = 0; queue.TryDequeue(out var node, out var negatedBound); nodes++)
        {
            if (-negatedBound <= maxDistance * (1 + RelativeTolerance) || nodes == MaxNodes)
            {
                return Math.Max(maxDistance, -negatedBound);
            }

            if (node.Levels == 0)
            {
                maxDistance = Math.Max(maxDistance, MaxVertexDistance(fractal.BaseMesh, node.Map));
                continue;
            }

            foreach (var childInstance in node.SubFractal.Children)
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
                (corner & 1) == 0 ? box.Minimum.X : box.Maximum.X,
                (corner & 2) == 0 ? box.Minimum.Y : box.Maximum.Y,
                (corner & 4) == 0 ? box.Minimum.Z : box.Maximum.Z);
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

using FractalEngine.Core.Collision;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;

namespace FractalEngine.Core.Physics;

/// <summary>The radius of an object (paper §4.3.3): the distance of its farthest vertex under its matrix m from m's position.</summary>
internal static class BodyRadius
{
    // Of the radius: fractals are searched until the rest can't add more.
    private const double Precision = 1e-9;
    private const int MostNodes = 50_000;

    /// <summary>For a mesh exactly the farthest vertex; for a fractal no less than it, by a billionth more, or further where 50,000 sub-fractals do not tell.</summary>
    public static double Of(PlacedModel placed) => placed.Model switch
    {
        FractalModel { Fractal: { Description.Composition: Composition.Affine } fractal } => Of(fractal, placed.Map.Linear),
        FractalModel { Fractal: var fractal } => FractalGenerator.Expand(fractal, FractalLimits.DrawnInstances)
            .Max(instance => Farthest(fractal.BaseMesh, new AffineMap(placed.Map.Linear, Vector.Zero) * instance)),
        _ => Farthest(placed.Model.Mesh, new(placed.Map.Linear, Vector.Zero)),
    };

    private static double Of(Fractal fractal, Matrix axes)
    {
        var table = SubFractalTable.Of(fractal);
        var queue = new PriorityQueue<(SubFractal State, long Levels, AffineMap Map), double>();
        var farthest = 0.0;
        Enqueue(table.Root, table.Levels, new(axes, Vector.Zero));
        for (var nodes = 0; queue.TryDequeue(out var node, out var negative); nodes++)
        {
            if (-negative <= farthest * (1 + Precision) || nodes == MostNodes)
            {
                return Math.Max(farthest, -negative);
            }

            farthest = Math.Max(farthest, node.Levels == 0 ? Farthest(fractal.BaseMesh, node.Map) : 0);
            foreach (var copy in node.Levels == 0 ? [] : node.State.Copies)
            {
                var below = copy.LevelsLeft(node.Levels);
                Enqueue(table.At(below), below, node.Map * copy.Map);
            }
        }

        return farthest;

        void Enqueue(SubFractal state, long levels, AffineMap map)
        {
            if (!state.Box.IsEmpty)
            {
                queue.Enqueue((state, levels, map), -FarthestCorner(state.Box, map));
            }
        }
    }

    private static double FarthestCorner(BoundingBox box, AffineMap map)
    {
        var farthest = 0.0;
        for (var corner = 0; corner < 8; corner++)
        {
            var point = new Vector(
                (corner & 1) == 0 ? box.Minimum.X : box.Maximum.X, (corner & 2) == 0 ? box.Minimum.Y : box.Maximum.Y, (corner & 4) == 0 ? box.Minimum.Z : box.Maximum.Z);
            farthest = Math.Max(farthest, (map * point).Length());
        }

        return farthest;
    }

    private static double Farthest(Mesh mesh, AffineMap map)
    {
        var farthest = 0.0;
        for (var vertex = 0; vertex < mesh.VertexCount; vertex++)
        {
            farthest = Math.Max(farthest, (map * mesh.Vertex(vertex)).Length());
        }

        return farthest;
    }
}

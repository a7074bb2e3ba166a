using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Render.Preparation;

namespace FractalEngine.Render.Passes;

/// <summary>
/// The box that a scene's planes are made for. What moves all the time changes it in coarse steps only, since other planes mean that everything is chosen again;
/// and what falls out of the scene does not take the planes with it.
/// </summary>
internal static class SceneBounds
{
    // Of the scene's size: bodies within this of it are drawn wherever they are.
    private const double Margin = 0.5;

    // Of the scene's size: balls farther out do not matter, and places of others are rounded to this.
    private const double FarBalls = 2;
    private const double BallGrid = 0.25;

    /// <summary>World space.</summary>
    /// <param name="scene">As it was loaded.</param>
    /// <param name="boxes">Of its objects, where they are now.</param>
    /// <param name="balls">Beside them.</param>
    public static BoundingBox Of(DrawableScene scene, ReadOnlySpan<BoundingBox> boxes, IReadOnlyList<LooseBall> balls)
    {
        var (box, moves) = (BoundingBox.Empty, false);
        for (var i = 0; i < boxes.Length; i++)
        {
            moves |= scene.Objects[i].IsMoving;
            box = scene.Objects[i].IsMoving ? box : BoundingBox.Union(box, boxes[i]);
        }

        var whole = scene.Source.Bounds;
        box = moves ? BoundingBox.Union(box, Around(whole, Margin)) : box;
        var (far, grid) = (Around(whole, FarBalls), BallGrid * whole.Diagonal);
        foreach (var (centre, radius) in balls)
        {
            var reach = radius * Vector.One;
            box = far.DistanceSquared(centre) > 0 || !(grid > 0) ? box : BoundingBox.Union(box, new(Down(centre - reach, grid), -Down(-centre - reach, grid)));
        }

        return box;
    }

    private static BoundingBox Around(BoundingBox box, double sizes) => new(box.Minimum - (sizes * box.Size), box.Maximum + (sizes * box.Size));

    private static Vector Down(Vector v, double grid) => new(grid * Math.Floor(v.X / grid), grid * Math.Floor(v.Y / grid), grid * Math.Floor(v.Z / grid));
}

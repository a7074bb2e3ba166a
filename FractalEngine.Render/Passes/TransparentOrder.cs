using FractalEngine.Core.Geometry;
using FractalEngine.Core.Scenes;

namespace FractalEngine.Render.Passes;

/// <summary>The order in which the transparent objects of a scene are drawn: the farthest first, by the middles of their boxes.</summary>
/// <param name="objects">The numbers of the objects that have transparent parts.</param>
internal sealed class TransparentOrder(int[] objects)
{
    private readonly int[] _order = [.. objects];
    private readonly double[] _nearness = new double[objects.Length];

    /// <summary>The numbers of the objects, sorted. Allocates nothing; objects of the same depth keep the scene's order.</summary>
    /// <param name="camera">Where from.</param>
    /// <param name="boxes">Of all objects of the scene, world space.</param>
    public ReadOnlySpan<int> FarToNear(Camera camera, BoundingBox[] boxes)
    {
        objects.CopyTo(_order, 0);
        for (var i = 0; i < _order.Length; i++)
        {
            var nearness = -camera.Map(boxes[_order[i]].Centre).Z;
            var (item, place) = (_order[i], i);
            for (; place > 0 && _nearness[place - 1] > nearness; place--)
            {
                (_order[place], _nearness[place]) = (_order[place - 1], _nearness[place - 1]);
            }

            (_order[place], _nearness[place]) = (item, nearness);
        }

        return _order;
    }
}

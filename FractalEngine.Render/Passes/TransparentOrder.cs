using FractalEngine.Core.Geometry;
using FractalEngine.Core.Scenes;

namespace FractalEngine.Render.Passes;

/// <summary>The order in which the transparent objects of a scene are drawn: the farthest first, by the middles of their boxes.</summary>
/// <param name="objectIndices">The numbers of the objects that have transparent parts.</param>
internal sealed class TransparentOrder(int[] objectIndices)
{
    private readonly int[] _order = [.. objectIndices];
    private readonly double[] _negatedDepths = new double[objectIndices.Length];

    /// <summary>The numbers of the objects, sorted. Allocates nothing; objects of the same depth keep the scene's order.</summary>
    /// <param name="camera">Where from.</param>
    /// <param name="objectBounds">Of all objects of the scene, world space.</param>
    public ReadOnlySpan<int> SortBackToFront(Camera camera, BoundingBox[] objectBounds)
    {
        objectIndices.CopyTo(_order, 0);
        for (var i = 0; i < _order.Length; i++)
        {
            var negatedDepth = -camera.ToCameraSpace(objectBounds[_order[i]].Centre).Z;
            var (objectIndex, slot) = (_order[i], i);
            for (; slot > 0 && _negatedDepths[slot - 1] > negatedDepth; slot--)
            {
                (_order[slot], _negatedDepths[slot]) = (_order[slot - 1], _negatedDepths[slot - 1]);
            }

            (_order[slot], _negatedDepths[slot]) = (objectIndex, negatedDepth);
        }

        return _order;
    }
}

using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;

namespace FractalEngine.Render.Passes;

/// <summary>
/// Sorts the objects of a scene so that most of those that hide others are drawn first. What is hidden then needs no light.
/// </summary>
/// <remarks>
/// The farthest depth of an object's box decides: what stands on a floor comes before the floor, which hides nothing of it.
/// </remarks>
internal sealed class OpaqueOrder
{
    private int[] _order = [];

    // With the index, so that objects of the same depth keep the scene's order.
    private (double Depth, int ObjectIndex)[] _keys = [];

    /// <summary>Returns the indices of all objects, sorted.</summary>
    /// <param name="camera">Camera that depths are measured from.</param>
    /// <param name="objectBounds">Bounds of all objects of the scene, world space.</param>
    /// <remarks>Allocates nothing while the number of objects stays the same.</remarks>
    public ReadOnlySpan<int> SortFrontToBack(Camera camera, ReadOnlySpan<BoundingBox> objectBounds)
    {
        if (_order.Length != objectBounds.Length)
        {
            _order = new int[objectBounds.Length];
            _keys = new (double, int)[objectBounds.Length];
        }

        var forward = camera.LocalAxes.V3;
        var extent = 0.5 * forward.Absolute();
        for (var i = 0; i < _order.Length; i++)
        {
            ref readonly var box = ref objectBounds[i];
            _keys[i] = (Vector.Dot(forward, box.Centre) + Vector.Dot(extent, box.Size), i);
        }

        _keys.AsSpan().Sort();
        for (var i = 0; i < _order.Length; i++)
        {
            _order[i] = _keys[i].ObjectIndex;
        }

        return _order;
    }
}

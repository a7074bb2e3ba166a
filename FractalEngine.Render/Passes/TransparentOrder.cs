using FractalEngine.Core.Geometry;
using FractalEngine.Core.Scenes;
using FractalEngine.Render.Preparation;

namespace FractalEngine.Render.Passes;

/// <summary>Sorts the transparent objects of a scene from back to front, by the depths of their boxes' centres.</summary>
/// <param name="objectIndices">Indices of the objects that have transparent batches.</param>
internal sealed class TransparentOrder(int[] objectIndices)
{
    private readonly int[] _order = [.. objectIndices];

    // With the index, since sorting does not keep the order of equal keys.
    private readonly (double NegatedDepth, int ObjectIndex)[] _keys = new (double, int)[objectIndices.Length];

    /// <summary>Finds the objects of a scene that have transparent batches.</summary>
    public static TransparentOrder Create(DrawableScene scene) =>
        new([.. Enumerable.Range(0, scene.Objects.Length).Where(i => scene.Objects[i].Model.HasTransparentBatches)]);

    /// <summary>Returns the indices of the objects, sorted. Allocates nothing; objects of the same depth keep the scene's order.</summary>
    /// <param name="camera">Camera that depths are measured from.</param>
    /// <param name="objectBounds">Bounds of all objects of the scene, world space.</param>
    public ReadOnlySpan<int> SortBackToFront(Camera camera, ReadOnlySpan<BoundingBox> objectBounds)
    {
        for (var i = 0; i < _keys.Length; i++)
        {
            _keys[i] = (-camera.ToCameraSpace(objectBounds[objectIndices[i]].Centre).Z, objectIndices[i]);
        }

        _keys.AsSpan().Sort();
        for (var i = 0; i < _keys.Length; i++)
        {
            _order[i] = _keys[i].ObjectIndex;
        }

        return _order;
    }
}

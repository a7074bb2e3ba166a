using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Render.Drawables;
using FractalEngine.Render.Preparation;

namespace FractalEngine.Render.Upload;

/// <summary>Sorts objects of a scene by depth. Objects of the same depth keep the scene's order.</summary>
/// <param name="objectIndices">Indices of the objects, ascending.</param>
/// <remarks>Sorting allocates nothing.</remarks>
internal sealed class DepthOrder(int[] objectIndices)
{
    private readonly int[] _order = [.. objectIndices];

    // With the index, since sorting does not keep the order of equal keys.
    private readonly (double Key, int ObjectIndex)[] _keys = new (double, int)[objectIndices.Length];

    /// <summary>Finds the objects of a scene that are sorted.</summary>
    /// <param name="scene">The scene.</param>
    /// <param name="isSorted">Tells by its model whether an object is.</param>
    public static DepthOrder Of(DrawableScene scene, Predicate<DrawableModel> isSorted) =>
        new([.. Enumerable.Range(0, scene.Objects.Length).Where(i => isSorted(scene.Objects[i].Model))]);

    /// <summary>
    /// Returns the indices so that most of the objects that hide others come first. What is hidden then needs no light.
    /// </summary>
    /// <param name="camera">Camera that depths are measured from.</param>
    /// <param name="objectBounds">Bounds of all objects of the scene, world space.</param>
    /// <remarks>
    /// The farthest depth of an object's box decides: what stands on a floor comes before the floor, which hides nothing of it.
    /// </remarks>
    public ReadOnlySpan<int> SortFrontToBack(Camera camera, ReadOnlySpan<BoundingBox> objectBounds)
    {
        var forward = camera.LocalAxes.V3;
        var extent = 0.5 * forward.Absolute();
        for (var i = 0; i < _keys.Length; i++)
        {
            ref readonly var box = ref objectBounds[objectIndices[i]];
            _keys[i] = (Vector.Dot(forward, box.Centre) + Vector.Dot(extent, box.Size), objectIndices[i]);
        }

        return Sorted();
    }

    /// <summary>Returns the indices by the depths of the boxes' centres, the farthest first.</summary>
    /// <inheritdoc cref="SortFrontToBack" path="/param"/>
    public ReadOnlySpan<int> SortBackToFront(Camera camera, ReadOnlySpan<BoundingBox> objectBounds)
    {
        for (var i = 0; i < _keys.Length; i++)
        {
            _keys[i] = (-camera.ToCameraSpace(objectBounds[objectIndices[i]].Centre).Z, objectIndices[i]);
        }

        return Sorted();
    }

    private int[] Sorted()
    {
        _keys.AsSpan().Sort();
        for (var i = 0; i < _keys.Length; i++)
        {
            _order[i] = _keys[i].ObjectIndex;
        }

        return _order;
    }
}

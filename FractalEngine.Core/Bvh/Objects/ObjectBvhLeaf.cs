using FractalEngine.Core.Geometry;

namespace FractalEngine.Core.Bvh.Objects;

/// <summary>An object in an <see cref="ObjectBvh"/>. Owners derive from it what belongs to the object.</summary>
/// <param name="index">Index of the object in its list, from 0.</param>
/// <param name="bounds">Box in world space; it may be empty or unbounded.</param>
internal class ObjectBvhLeaf(int index, BoundingBox bounds)
{
    /// <summary>Index of the object in its list, from 0.</summary>
    public int Index { get; } = index;

    /// <summary>Box in world space. A box that holds no point, NaN included, is <see cref="BoundingBox.Empty"/>.</summary>
    public BoundingBox Bounds { get; } = bounds.IsEmpty ? BoundingBox.Empty : bounds;
}

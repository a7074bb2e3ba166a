using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Render.Preparation;

namespace FractalEngine.Render.Upload;

/// <summary>The current transforms and bounds of a scene's objects, in the order of <see cref="DrawableScene.Objects"/>.</summary>
/// <param name="scene">Declares the transforms at first.</param>
internal sealed class ObjectTransforms(DrawableScene scene)
{
    private readonly AffineMap[] _objectToWorld = [.. scene.Objects.Select(item => item.Map)];
    private readonly BoundingBox[] _bounds = [.. scene.Parts.Objects.Select(placed => placed.Bounds)];

    /// <summary>Maps from each object's model frame to world space.</summary>
    public ReadOnlySpan<AffineMap> ObjectToWorld => _objectToWorld;

    /// <summary>Bounding boxes of the objects in world space.</summary>
    public ReadOnlySpan<BoundingBox> Bounds => _bounds;

    /// <summary>Replaces the transform of one object.</summary>
    /// <param name="index">Index of the object in the scene, from 0.</param>
    /// <param name="objectToWorld">Map from the model's frame to world space.</param>
    /// <param name="modelBounds">Bounds of the object's model in its own frame.</param>
    public void Set(int index, AffineMap objectToWorld, BoundingBox modelBounds)
    {
        _objectToWorld[index] = objectToWorld;
        _bounds[index] = modelBounds.Transform(objectToWorld);
    }
}
